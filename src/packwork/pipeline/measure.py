"""A layout, measured and compared with what was promised."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, replace
from typing import Any

import numpy as np

from packwork.arrays import IntArray
from packwork.metrics.certificate import Promise, broken
from packwork.metrics.measure import LayoutMetrics, measure
from packwork.pipeline.advice import advice
from packwork.pipeline.dress.colours import dressed
from packwork.pipeline.dress.line_weights import evened
from packwork.pipeline.dress.neighbours import same_kind_beside
from packwork.pipeline.job import Job
from packwork.pipeline.left_out import left_out, named, without_some
from packwork.pipeline.plan.resolution import resolution_faults
from packwork.pipeline.result import (
    Filling,
    Run,
    Unplaced,
    find_unplaced,
    manifest,
)
from packwork.pipeline.shortfalls import specks
from packwork.scene.layout import Layout
from packwork.scene.limits import Limits
from packwork.scene.pose import Poses
from packwork.solve.solver import Outcome


@dataclass(frozen=True, eq=False)
class Unmeasured:
    """A layout before it is measured, and what is known of it.

    Parameters
    ----------
    poses
        Of the job's items.
    method
        How the first places were found.
    limits
        What rules ask of single items; None if nothing.
    outcome
        Of the levels.
    unplaced
        Items that the exact finish could not place; None if there was none.
    filling
        How voids were filled, if they were.
    left_out
        Of the unplaced ones, how many are no longer among the job's items.
    pile
        How the items lie, if they were heaped.
    faults
        What else was asked and does not hold, a sentence each.
    numbers
        What the job's items are called by in ``unplaced``; None if by their places.
    """

    poses: Poses
    method: str
    limits: Limits | None
    outcome: Outcome
    unplaced: tuple[Unplaced, ...] | None
    filling: Filling | None = None
    left_out: int = 0
    pile: Mapping[str, Any] | None = None
    faults: tuple[str, ...] = ()
    numbers: IntArray | None = None


@dataclass(frozen=True, eq=False)
class _Measured:
    """A layout, what it is worth, and what of its promise does not hold."""

    layout: Layout
    metrics: LayoutMetrics
    faults: tuple[str, ...]

    @classmethod
    def of(cls, job: Job, poses: Poses, promise: Promise | None) -> _Measured:
        layout = Layout(job.container, job.items, poses, job.weights)
        metrics = measure(layout)
        faults = () if promise is None else broken(promise, layout, metrics.exact)
        return cls(layout, metrics, faults)


def measured(job: Job, found: Unmeasured) -> Run:
    """The run's result: of what cannot be certified, without it."""
    clock, limits = job.clock, found.limits
    is_exact = found.unplaced is not None
    placed_items = job.items
    with clock.time("finish"):
        job = evened(job, found.poses)
    # Areas of drawings whose lines are thinner are in shares no more.
    shares = job.plan.sizes == "shared" and limits is None and job.items is placed_items
    promise = Promise(job.plan.gap, shares) if is_exact else None
    total, numbers = len(job.items), found.numbers
    with clock.time("measure"):
        seen = _Measured.of(job, found.poses, promise)
        known = found.unplaced or ()
        kept: IntArray | None = None
        if promise is not None and seen.faults:
            names = np.arange(total) if numbers is None else numbers
            held = [one.is_placed for one in job.asked]
            gone = left_out(seen.layout, held, promise.least_gap(job.container.side))
            known += named(gone, seen.layout, names)
            job, kept = without_some(job, list(gone))
            seen = _Measured.of(job, found.poses.some(kept), promise)
        layout, metrics = seen.layout, seen.metrics
        if not is_exact:
            known = find_unplaced(layout, limits)
        unplaced = known + job.use.missing(total)
        faults = seen.faults + found.faults + resolution_faults(job, layout) + specks(layout)
        kinds = None if limits is None else limits.kinds
        kinds = kinds if kinds is None or kept is None else kinds[kept]
        beside = None if limits is None else same_kind_beside(layout, kinds)
    certified = promise is not None and not seen.faults and len(layout.items) > 0
    said = manifest(job, found.method, found.outcome, metrics, unplaced, beside)
    said |= {
        "certified": certified,
        "promised": None if promise is None else asdict(promise),
        "filling": None if found.filling is None else asdict(found.filling),
    }
    words = job.use.words_found()
    said["words"] = None if words is None else asdict(words)
    if found.pile is not None:
        said["pile"] = dict(found.pile)
    worn = dressed(job, layout)
    notes = job.use.notes(job, layout, worn)
    return Run(
        layout=replace(worn, manifest=said, notes=notes),
        metrics=metrics,
        seconds=clock.seconds,
        ending=found.outcome.ending,
        unplaced=unplaced,
        skipped=job.skipped,
        beside=beside,
        certified=certified,
        broken=faults,
        filling=found.filling,
        words=words,
        left_out=found.left_out + total - len(job.items),
        kept=kept,
        pile=found.pile,
        remarks=job.use.remarks(job),
        advice=advice(job, layout, metrics.seen),
    )
