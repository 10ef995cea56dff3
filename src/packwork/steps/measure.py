"""Measures of a layout, and what of its promise does not hold: that is left out and named."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import final

import numpy as np

from packwork.compaction.arrangement import Conflict
from packwork.metrics.certificate import Promise, broken, unclean
from packwork.metrics.measure import measure
from packwork.metrics.violations import Violation, violations, violations_on_torus
from packwork.phrasing import number_of
from packwork.pipeline.findings import Finding, Sentence, Unplaced
from packwork.pipeline.plan.counts import LEAST, items_needed
from packwork.pipeline.plan.resolution import coarser, photo_pixels
from packwork.pipeline.result import find_unplaced
from packwork.pipeline.state import RunContext, RunState, RunStep
from packwork.scene.item import Item
from packwork.scene.layout import Layout
from packwork.steps.shortfalls import specks


def left_out(layout: Layout, held: Sequence[bool], gap: float) -> dict[int, str]:
    """Items without which nothing meets or sticks out, and what was wrong with each.

    Of two that meet, the one that more others meet goes; of two alike, the smaller one, but
    none that is held in place.

    Parameters
    ----------
    held
        Whether each item has a place that was asked for.
    gap
        What the rest has to keep, canvas units.
    """
    container = layout.container
    if container.lattice is not None:
        wrong = violations_on_torus(layout.outlines, container.lattice, gap)
    else:
        wrong = violations(layout.outlines, container.outline, gap)
    unit = container.unit
    reasons = {one.item: reason(one, layout.items, unit) for one in wrong if one.other is None}
    areas = layout.areas
    pairs = [one for one in wrong if one.other is not None]
    while pairs := [one for one in pairs if not {one.item, one.other} & reasons.keys()]:
        ends = np.array([(one.item, one.other) for one in pairs], dtype=np.int64)
        met = np.bincount(ends.ravel(), minlength=len(areas))
        worst = min(np.unique(ends).tolist(), key=lambda k: (held[k], -met[k], areas[k], k))
        met_by = next(one for one in pairs if worst in (one.item, one.other))
        reasons[worst] = reason(met_by, layout.items, unit, worst)
    return reasons


def reason(
    one: Conflict | Violation, items: Sequence[Item], unit: str, item: int | None = None
) -> str:
    """Reason why an item and another one, or the container's edge, are in conflict.

    Parameters
    ----------
    item
        Of which of the two it is said; None for the first.
    """
    other = one.other if item in {None, one.item} else one.item
    area, name = one.overlap_cu2, "the container's edge" if other is None else items[other].name
    if area <= 0:
        return Sentence.TOO_NEAR.of(gap=one.gap_cu, unit=unit, other=name)
    if other is None:
        return Sentence.STICKS_OUT.of(area=area, unit=unit)
    return Sentence.OVERLAPS.of(other=name, area=area, unit=unit)


@final
class Measure(RunStep):
    """Measures of the layout; without what cannot be certified."""

    def run(self, state: RunState, context: RunContext) -> RunState:
        """State with a layout, its metrics and certificate."""
        job, plan = state.job, state.job.plan
        # Areas of drawings whose lines are thinner are in shares no more.
        is_as_weighed = not (state.has_thinner_lines or state.limits.binds)
        promise = Promise(plan.gap, plan.sizes == "shared" and is_as_weighed)
        with job.clock.time("measure"):
            seen = _measured(
                replace(state, promise=promise, kept=np.arange(len(job.items)), unplaced=())
            )
            if plan.is_exact and seen.findings:
                seen = _measured(_without_faulty(seen))
            layout, metrics = seen.measured
            unplaced = state.unplaced + seen.unplaced
            if not plan.is_exact:
                unplaced = find_unplaced(layout, state.limits)
            found = (*seen.findings, *state.findings, *specks(layout))
        is_clean = not unclean(promise, layout, metrics.exact)
        certified = plan.is_exact and is_clean and len(layout.items) > 0
        return replace(
            seen,
            placed=len(job.items),
            unplaced=unplaced,
            findings=found,
            certified=certified,
        )


def _measured(state: RunState) -> RunState:
    """State with the layout of its items, and findings of geometry alone."""
    job = state.job
    layout = Layout(job.container, job.items, state.poses, job.weights)
    metrics = measure(layout)
    faults = broken(state.promise, layout, metrics.exact) if job.plan.is_exact else ()
    found = tuple(Finding(Sentence.BROKEN, {"fault": one}) for one in faults)
    return replace(state, layout=layout, metrics=metrics, findings=found)


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
        unplaced=tuple(
            Unplaced(layout.items[k].name, int(state.numbers[k]), gone[k]) for k in sorted(gone)
        ),
        left_out=state.left_out + len(gone),
    )


@final
class TellCoarse(RunStep):
    """A finding of photographs that are coarser than ``least_dpi`` asks all the same."""

    def run(self, state: RunState, context: RunContext) -> RunState:
        """State with the finding, if there are any."""
        (layout, _), least = state.measured, state.job.plan.least_dpi
        short = [] if least is None else coarser(photo_pixels(layout), least)
        if not short:
            return state
        return state.with_finding(
            Sentence.COARSE,
            many=number_of(len(short), "picture has", "pictures have"),
            least=least,
            photo=short[0].photo,
            ppi=short[0].ppi,
        )


@final
@dataclass(frozen=True)
class RemarkCount(RunStep):
    """A finding of the number of items that the run chose.

    Parameters
    ----------
    by_width
        Whether it is told for what: how wide the parts are that such items reach into. It is not
        where other bounds gave the number.
    """

    by_width: bool = True

    def run(self, state: RunState, context: RunContext) -> RunState:
        """State with the remark."""
        job, many = state.job, number_of(len(state.job.items), "item")
        needed = items_needed(job.container, job.plan.sizes, job.plan.size_ratio)
        if self.by_width and LEAST < needed.count == len(job.items):
            unit = job.container.unit
            return state.with_finding(
                Sentence.COUNT_BY_WIDTH, many=many, width=needed.width_cu, unit=unit
            )
        return state.with_finding(Sentence.COUNT, many=many)
