"""Levels: coarse-to-fine optimisation in image space, from first poses."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any, final

from packwork.pipeline.job import Job
from packwork.pipeline.plan.limits import job_leanings, padded
from packwork.pipeline.plan.own_losses import in_colours, sees_colours
from packwork.pipeline.state import LEVELS, RunContext, RunState, RunStep
from packwork.recipe.presets import DEFAULT, FEWER_EPOCHS, LEAST_COARSE_PX, refined_levels
from packwork.scene.layout import Layout
from packwork.solve.options import SolveOptions
from packwork.solve.solver import solve
from packwork.steps.appearance import colours_seen
from packwork.steps.assign_by_embedding import with_similarity_bond
from packwork.steps.warm_start import calmed, with_homes

LEVELS_SHARE = 0.6
"""Share of the time left after the start that the levels may take; the finish, measuring
and writing need the rest. Chosen."""


@final
class Levels(RunStep):
    """Levels of the solver, coarse to fine; none where items already lie beside each other."""

    share = LEVELS

    def run(self, state: RunState, context: RunContext) -> RunState:
        """State with the poses that the levels found."""
        job, forces = state.job, state.forces
        if state.is_tight:
            return state
        with job.clock.time("levels"):
            options = _solve_options(job)
            if job.plan.losses and sees_colours(job.plan.losses):
                options = _with_colours(options, state)
            if state.is_warm_start:
                options = calmed(options)
            if job.plan.stays:
                forces = with_homes(state)
            elif job.vectors is not None:
                forces = with_similarity_bond(job, forces)
            gap = job.plan.gap
            outcome = solve(
                padded(job.container, gap) if gap else job.container,
                job.solid_outlines, state.poses,
                state.nominal, options, context.heard_by(state.recorder).observer, context.stop,
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
    if job.plan.keeps_order:
        options = options.model_copy(update={"relocating": False, "exchanging": False})
    if plan.leans and (leans := job_leanings(job)).any():
        options = options.model_copy(update={"leans": tuple(leans.tolist())})
    if plan.levels or plan.preset is not DEFAULT:
        return options
    levels = refined_levels(options.levels, container.side, container.outline.area, len(job.items))
    changes: dict[str, Any] = {"levels": levels}
    pitch_px = math.sqrt(container.outline.area / len(job.items)) * levels[0] / container.side
    if pitch_px < LEAST_COARSE_PX and options.shares:
        changes = {"levels": levels[1:], "shares": options.shares[1:]}
        if plan.epochs is None:
            changes["epochs"] = round(FEWER_EPOCHS * options.epochs)
    return options.model_copy(update=changes)
