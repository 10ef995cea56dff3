"""Levels: coarse-to-fine optimisation in image space, from first poses."""

from __future__ import annotations

from dataclasses import replace
from typing import final

import numpy as np

from packwork.pipeline.job import Job
from packwork.pipeline.plan.leaning import job_leanings
from packwork.pipeline.plan.own_losses import in_colours, sees_colours
from packwork.pipeline.plan.padding import padded
from packwork.pipeline.state import RunState
from packwork.pipeline.step import RunStep
from packwork.pipeline.watch import LEVELS, RunContext
from packwork.recipe.levels import refined_levels
from packwork.scene.layout import Layout
from packwork.solve.options import SolveOptions
from packwork.solve.solver import solve
from packwork.steps.alike import with_similarity_bond
from packwork.steps.dress.colours import colours_seen
from packwork.steps.earlier_layout import as_it_was, calmed, with_homes

LEVELS_SHARE = 0.6
"""Share of the time left after the start that the levels may take; the finish, measuring
and writing need the rest. Chosen."""


@final
class StartRecording(RunStep):
    """A recorder of the way of the items, which keeps the first poses.

    Of what was put one by one it keeps the largest first.
    """

    def run(self, state: RunState, watch: RunContext) -> RunState:
        """State with a recorder, if the run is recorded."""
        recorder, poses = watch.recorder(), state.poses
        if not recorder.is_on:
            return state
        if state.method == "first-fit":
            areas = np.array([outline.area for outline in state.job.solid_outlines])
            order = np.argsort(-areas * poses.scale**2)
            for put in range(len(order)):
                recorder.keep(poses.subset(order[:put]), order[:put])
        recorder.keep(as_it_was(state.job, poses))
        return replace(state, recorder=recorder)


@final
class Levels(RunStep):
    """Levels of the solver, coarse to fine."""

    share = LEVELS

    def run(self, state: RunState, watch: RunContext) -> RunState:
        """State with the poses that the levels found."""
        job, forces = state.job, state.forces
        with job.clock.time("levels"):
            options = _solve_options(job)
            if sees_colours(job.plan.losses):
                options = _with_colours(options, state)
            if state.goes_on:
                options = calmed(options)
            forces = with_homes(state) if job.plan.stays else with_similarity_bond(job, forces)
            outcome = solve(
                padded(job.container, job.plan.gap), job.solid_outlines, state.poses,
                state.nominal, options, watch.heard_by(state.recorder).observer, watch.stop,
                state.limits, forces,
            )  # fmt: skip
            return replace(
                state, poses=outcome.poses, ending=outcome.ending, levels=tuple(outcome.levels)
            )


def _with_colours(options: SolveOptions, state: RunState) -> SolveOptions:
    """Options whose losses see the items in colours."""
    job = state.job
    layout = Layout(job.container, job.items, state.poses, state.nominal)
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
