"""Advice that would make a poor result a good one."""

from __future__ import annotations

from dataclasses import replace
from typing import final

import numpy as np

from packwork.metrics.pixel import ShapeMetrics
from packwork.pipeline.job import Job
from packwork.pipeline.plan.counts import items_needed, lines_width
from packwork.pipeline.plan.plan import VoidPlan
from packwork.pipeline.run import RunContext, RunStep
from packwork.pipeline.state import RunState

MOST_BARE = 0.05
"""Share of the container far from any item from which its shape is said not to show. Larger
passes a cat without its tail, smaller blames a heart of twelve icons. By eye, of 40 layouts."""

LEAST_SHAPE = 0.8
"""Overlap of container and closed layout below which the same is said. Larger blames a heart of
twelve icons (0.88), smaller passes a guitar without its head (0.72). By eye, of 40 layouts."""

ITEMS_REACH = 0.85
"""Share of a container that smaller copies of items come to cover. Larger is not always reached,
and then counts as not met. Tried."""

CLEARLY_MORE = 1.15
"""How many times as many items must be needed for more of them to be the advice. Chosen."""


@final
class Advise(RunStep):
    """Advice on a layout that does not show the container's shape."""

    def run(self, state: RunState, watch: RunContext) -> RunState:
        """State with the advice."""
        layout, metrics = state.measured
        said = advice(state.job, len(layout.items), metrics.seen)
        return replace(state, advice=(*state.advice, *said))


def advice(job: Job, count: int, seen: ShapeMetrics) -> tuple[str, ...]:
    """Advice on a poor layout of ``count`` items, in a sentence; or nothing."""
    if seen.bare <= MOST_BARE and seen.shape >= LEAST_SHAPE:
        return ()
    remedy = _wider(job) or job.use.remedy(job) or _remedy(job, count)
    return (f"{_poor(seen)}; {remedy}",)


def _wider(job: Job) -> str | None:
    """Advice where the container is but lines; None where it is more."""
    width = lines_width(job.container)
    if width is None:
        return None
    what = f"it is lines {width:.2g} {job.container.unit} wide"
    return f"{what}; wider ones, or what they enclose, would show"


def _poor(seen: ShapeMetrics) -> str:
    """Parts of the shape that do not show."""
    if seen.bare_parts > 1:
        return f"{seen.bare_parts} of the container's {seen.parts} parts are empty"
    if seen.bare > MOST_BARE:
        return f"{100 * seen.bare:.0f} % of the container lies far from any item"
    return f"the container's shape shows to {100 * seen.shape:.0f} % only"


def _remedy(job: Job, count: int) -> str:
    """Remedy for a shape that does not show, in the words of the options."""
    plan = job.plan
    needed = items_needed(job.container, plan.sizes, plan.size_ratio).count
    if plan.sizes == "free" and needed > CLEARLY_MORE * count:
        return f"-n {needed} would show it"
    if plan.sizes == "fixed":
        return "--sizes free would show it"
    if plan.sizes == "shared":
        needed = max(items_needed(job.container, "free", plan.size_ratio).count, count)
        return f"--sizes free -n {needed} would show it"
    return smaller_copies(plan.voids, ITEMS_REACH)


def smaller_copies(voids: VoidPlan, reach: float) -> str:
    """Advice about what fills voids.

    Parameters
    ----------
    reach
        Share of the container that such copies come to cover.
    """
    if voids.target is None:
        return f"--target-coverage {reach:g}, smaller copies in the voids, would show it"
    if voids.most is not None:
        return f"--max-items {np.ceil(2 * voids.most):.0f} would show more of it"
    return "--smallest 0.3%, smaller copies yet, would show more of it"
