"""Start and levels: from a job to the layout that the coarse-to-fine optimisation finds."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from packwork.forces.forces import Forces
from packwork.geometry.outline import Outline
from packwork.pipeline.film.recorder import Recorder
from packwork.pipeline.job import Job
from packwork.pipeline.placed import Placed
from packwork.pipeline.plan.leaning import job_leanings
from packwork.pipeline.plan.padding import check_padding, padded
from packwork.pipeline.start import Beginning, begin
from packwork.pipeline.staying import as_it_was, calmed, needs_no_levels, with_homes
from packwork.progress import Observer, Stop, together
from packwork.recipe.levels import refined_levels
from packwork.scene.container import Container
from packwork.solve.options import SolveOptions
from packwork.solve.solver import Ending, Outcome, solve

LEVELS_SHARE = 0.6
"""Share of the time left after the start that the levels may take; the finish, measuring
and writing need the rest. Chosen."""


def begun_and_solved(job: Job, observer: Observer | None, stop: Stop, record: bool) -> Placed:
    """First poses, and what the levels make of them."""
    recorder = Recorder() if record else None
    observer = together(observer, recorder)
    with job.clock.time("start"):
        outlines = job.solid_outlines
        check_padding(job.container, job.plan.gap, len(job.items))
        region = padded(job.container, job.plan.gap)
        forces = buoyant_forces(job)
        start = begin(job, region, outlines, forces, stop)
    if recorder is not None:
        _keep_start(recorder, job, start, outlines)
    with job.clock.time("levels"):
        outcome = _levels(job, region, outlines, start, forces, observer, stop)
    return Placed(job=job, start=start, outcome=outcome, recorder=recorder)


def buoyant_forces(job: Job) -> Forces | None:
    """What pulls items about, with what makes room for the heavy; None if nothing does."""
    forces = job.forces
    return None if forces is None else forces.buoyant(job.weights)


def _levels(
    job: Job,
    region: Container,
    outlines: Sequence[Outline],
    start: Beginning,
    forces: Forces | None,
    observer: Observer | None,
    stop: Stop,
) -> Outcome:
    """What the levels make of the first poses; those themselves, where they are as good."""
    if needs_no_levels(job) or start.is_tight:
        return Outcome(start.poses, Ending.DONE)
    options = _solve_options(job)
    if job.plan.stays:
        options = calmed(options)
        forces = with_homes(job, forces, start.poses, job.container)
    return solve(
        region, outlines, start.poses, start.nominal, options, observer, stop, start.limits, forces
    )


def _keep_start(
    recorder: Recorder, job: Job, start: Beginning, outlines: Sequence[Outline]
) -> None:
    """Keep the first poses; before them, of what was put one by one, the largest first."""
    poses = start.poses
    if start.method == "first-fit":
        order = np.argsort([-o.area * s**2 for o, s in zip(outlines, poses.scale, strict=True)])
        for put in range(len(order)):
            recorder.keep(poses.some(order[:put]), order[:put])
    recorder.keep(as_it_was(job, poses))


def _solve_options(job: Job) -> SolveOptions:
    """Options of the solve, with levels fine enough for the items unless they were given."""
    plan, container = job.plan, job.container
    options = plan.solve_options(job.seconds_left(LEVELS_SHARE))
    leans = job_leanings(job)
    if leans is not None:
        options = options.model_copy(update={"leans": tuple(leans.tolist())})
    if plan.levels is not None or not plan.is_default:
        return options
    levels = refined_levels(options.levels, container.side, container.outline.area, len(job.items))
    return options.model_copy(update={"levels": levels})
