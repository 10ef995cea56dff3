"""The levels: what coarse-to-fine optimisation in image space makes of first poses."""

from __future__ import annotations

import numpy as np

from packwork.pipeline.alike import tied_alike
from packwork.pipeline.beginning import Beginning
from packwork.pipeline.dress.colours import colours_seen
from packwork.pipeline.film.recorder import Recorder
from packwork.pipeline.job import Job
from packwork.pipeline.placed import Placed
from packwork.pipeline.plan.leaning import job_leanings
from packwork.pipeline.plan.own_losses import in_colours, sees_colours
from packwork.pipeline.staying import as_it_was, calmed, needs_no_levels, with_homes
from packwork.pipeline.watch import Watch
from packwork.recipe.levels import refined_levels
from packwork.scene.layout import Layout
from packwork.solve.options import SolveOptions
from packwork.solve.solver import Ending, Outcome, solve

LEVELS_SHARE = 0.6
"""Share of the time left after the start that the levels may take; the finish, measuring
and writing need the rest. Chosen."""


def run_levels(begun: Beginning, watch: Watch) -> Placed:
    """What the levels make of the first poses; those themselves, where they are as good."""
    job, forces = begun.job, begun.forces
    recorder = watch.recorder()
    if recorder.is_on:
        _keep_start(recorder, begun)
    observer = watch.heard_by(recorder).observer
    with job.clock.time("levels"):
        if needs_no_levels(job) or begun.is_tight:
            return Placed.of(begun, Outcome(begun.poses, Ending.DONE), recorder)
        options = _solve_options(job)
        if sees_colours(job.plan.losses):
            options = _with_colours(options, begun)
        if begun.goes_on:
            options = calmed(options)
        forces = with_homes(begun) if job.plan.stays else tied_alike(job, forces)
        outcome = solve(
            begun.region, begun.outlines, begun.poses, begun.nominal, options,
            observer, watch.stop, begun.limits, forces,
        )  # fmt: skip
        return Placed.of(begun, outcome, recorder)


def _keep_start(recorder: Recorder, begun: Beginning) -> None:
    """Keep the first poses; before them, of what was put one by one, the largest first."""
    poses, outlines = begun.poses, begun.outlines
    if begun.method == "first-fit":
        order = np.argsort([-o.area * s**2 for o, s in zip(outlines, poses.scale, strict=True)])
        for put in range(len(order)):
            recorder.keep(poses.some(order[:put]), order[:put])
    recorder.keep(as_it_was(begun.job, poses))


def _with_colours(options: SolveOptions, begun: Beginning) -> SolveOptions:
    """Options whose losses see the items in colours."""
    job = begun.job
    layout = Layout(job.container, job.items, begun.poses, begun.nominal)
    losses = in_colours(options.losses, colours_seen(job, layout))
    return options.model_copy(update={"losses": losses})


def _solve_options(job: Job) -> SolveOptions:
    """Options of the solve, with levels fine enough for the items unless they were given."""
    plan, container = job.plan, job.container
    options = plan.solve_options(job.seconds_left(LEVELS_SHARE))
    if job.keeps_order:
        options = options.model_copy(update={"relocating": False, "exchanging": False})
    leans = job_leanings(job)
    if leans.any():
        options = options.model_copy(update={"leans": tuple(leans.tolist())})
    if plan.levels or not plan.is_default:
        return options
    levels = refined_levels(options.levels, container.side, container.outline.area, len(job.items))
    return options.model_copy(update={"levels": levels})
