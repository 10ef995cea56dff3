"""Measures of a layout, and what of its promise does not hold: that is left out and named."""

from __future__ import annotations

from dataclasses import replace
from typing import final

import numpy as np

from packwork.metrics.certificate import Promise, broken, unclean
from packwork.metrics.measure import measure
from packwork.pipeline.plan.resolution import resolution_faults
from packwork.pipeline.result import find_unplaced
from packwork.pipeline.state import RunState
from packwork.pipeline.step import RunStep
from packwork.pipeline.watch import RunContext
from packwork.scene.layout import Layout
from packwork.steps.dress.line_weights import evened
from packwork.steps.dress.neighbours import same_kind_beside
from packwork.steps.left_out import left_out, named
from packwork.steps.shortfalls import specks


@final
class EvenLines(RunStep):
    """Line drawings of all sizes with lines of one width, and notices of those that keep theirs."""

    def run(self, state: RunState, watch: RunContext) -> RunState:
        """State whose drawings are thinner."""
        with state.job.clock.time("finish"):
            job = evened(state.job, state.poses)
        return replace(state, job=job, has_thinner_lines=job.items is not state.job.items)


@final
class Measure(RunStep):
    """Measures of the layout; without what cannot be certified."""

    def run(self, state: RunState, watch: RunContext) -> RunState:
        """State with a layout, its metrics and certificate."""
        job, plan = state.job, state.job.plan
        # Areas of drawings whose lines are thinner are in shares no more.
        is_as_weighed = not (state.has_thinner_lines or state.limits.binds)
        promise = Promise(plan.gap, plan.sizes == "shared" and is_as_weighed)
        with job.clock.time("measure"):
            seen = _measured(
                replace(state, promise=promise, kept=np.arange(len(job.items)), unplaced=())
            )
            if plan.is_exact and seen.faults:
                seen = _measured(_without_faulty(seen))
            layout, metrics = seen.measured
            unplaced = state.unplaced + seen.unplaced
            if not plan.is_exact:
                unplaced = find_unplaced(layout, state.limits)
            said = (*state.faults, *resolution_faults(seen.job, layout), *specks(layout))
        is_clean = not unclean(promise, layout, metrics.exact)
        certified = plan.is_exact and is_clean and len(layout.items) > 0
        return replace(
            seen,
            placed=len(job.items),
            unplaced=unplaced,
            faults=(*seen.faults, *said),
            certified=certified,
        )


@final
class CountBeside(RunStep):
    """Number of pairs of one kind that lie side by side, where they were not to."""

    def run(self, state: RunState, watch: RunContext) -> RunState:
        """State with that number."""
        layout, _ = state.measured
        if not state.limits.binds:
            return state
        with state.job.clock.time("measure"):
            return replace(state, beside=same_kind_beside(layout))


def _measured(state: RunState) -> RunState:
    """State with the layout of its items, and faults of geometry alone."""
    job = state.job
    layout = Layout(job.container, job.items, state.poses, job.weights)
    metrics = measure(layout)
    faults = broken(state.promise, layout, metrics.exact) if job.plan.is_exact else ()
    return replace(state, layout=layout, metrics=metrics, faults=tuple(faults))


def _without_faulty(state: RunState) -> RunState:
    """State without the items that keep the layout from its promise."""
    job, (layout, _) = state.job, state.measured
    held = [one.is_placed for one in job.asked]
    gone = left_out(layout, held, state.promise.least_gap(job.container.side))
    kept = np.setdiff1d(np.arange(len(job.items)), np.array(list(gone), dtype=np.int64))
    return replace(
        state,
        job=job.subset(kept),
        poses=state.poses.subset(kept),
        numbers=state.numbers[kept],
        kept=kept,
        unplaced=named(gone, layout, state.numbers),
        left_out=state.left_out + len(gone),
    )
