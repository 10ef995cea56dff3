"""A layout, measured and compared with what was promised."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, field, replace
from typing import Any

import numpy as np

from packwork.arrays import IntArray
from packwork.metrics.certificate import Promise, broken, unclean
from packwork.metrics.measure import LayoutMetrics, measure
from packwork.pipeline.advice import advice
from packwork.pipeline.dress.colours import dressed
from packwork.pipeline.dress.line_weights import evened
from packwork.pipeline.dress.neighbours import same_kind_beside
from packwork.pipeline.dress.recognised import unrecognised
from packwork.pipeline.film.recorder import Recorder
from packwork.pipeline.film.with_track import with_track
from packwork.pipeline.job import Job
from packwork.pipeline.left_out import left_out, named, without_some
from packwork.pipeline.placed import Placed
from packwork.pipeline.plan.resolution import resolution_faults
from packwork.pipeline.result import (
    Filling,
    Run,
    Unplaced,
    find_unplaced,
    manifest,
    plain,
)
from packwork.pipeline.shortfalls import shortfalls, specks
from packwork.scene.layout import Layout
from packwork.scene.limits import Limits
from packwork.scene.pose import Poses
from packwork.solve.solver import Outcome


@dataclass(frozen=True, eq=False, kw_only=True)
class Unmeasured:
    """A layout before it is measured, and what is known of it.

    Parameters
    ----------
    job
        Its items are those that are in the layout.
    poses
        Of these.
    method
        How the first places were found.
    outcome
        Of the levels.
    numbers
        ``(n,)`` what these items are called by, in steps and in ``unplaced``.
    asked_for
        The job of those that were asked for.
    recorder
        Recorded the way of the items.
    limits
        What rules ask of single items.
    unplaced
        Items that the exact finish could not place.
    filling
        How voids were filled, if they were.
    left_out
        Of the unplaced ones, how many are no longer among the job's items.
    pile
        How the items lie; empty unless they were heaped.
    faults
        What else was asked and does not hold, a sentence each.
    """

    job: Job
    poses: Poses
    method: str
    outcome: Outcome
    numbers: IntArray
    asked_for: Job
    recorder: Recorder
    limits: Limits
    unplaced: tuple[Unplaced, ...] = ()
    filling: Filling | None = None
    left_out: int = 0
    pile: Mapping[str, Any] = field(default_factory=dict)
    faults: tuple[str, ...] = ()

    @property
    def keeps_apart(self) -> bool:
        """Whether items of one kind were not to lie side by side."""
        return self.limits.binds and self.job.plan.keeps_apart

    @classmethod
    def of(cls, placed: Placed) -> Unmeasured:
        """What was placed along the common road."""
        job, start = placed.job, placed.start
        short = shortfalls(job, start.nominal, placed.exact) if job.plan.is_exact else ()
        return cls(
            job=job,
            poses=placed.poses,
            method=start.method,
            outcome=placed.outcome,
            numbers=placed.numbers,
            asked_for=placed.asked_for,
            recorder=placed.recorder,
            limits=start.limits,
            filling=placed.filling,
            faults=short,
        )


@dataclass(frozen=True, eq=False)
class _Measured:
    """A layout, what it is worth, and what of its promise does not hold.

    Parameters
    ----------
    job
        Of the layout's items.
    kept
        ``(n,)`` which of the items that were placed these are.
    left_out
        The others.
    """

    job: Job
    kept: IntArray
    layout: Layout
    metrics: LayoutMetrics
    faults: tuple[str, ...]
    left_out: tuple[Unplaced, ...] = ()

    @classmethod
    def of(cls, job: Job, kept: IntArray, poses: Poses, promise: Promise) -> _Measured:
        layout = Layout(job.container, job.items, poses, job.weights)
        metrics = measure(layout)
        faults = broken(promise, layout, metrics.exact) if job.plan.is_exact else ()
        return cls(job, kept, layout, metrics, faults)

    @classmethod
    def certifiable(cls, job: Job, found: Unmeasured, promise: Promise) -> _Measured:
        """The layout without what keeps it from its promise."""
        seen = cls.of(job, np.arange(len(job.items)), found.poses, promise)
        if not seen.faults:
            return seen
        held = [one.is_placed for one in job.asked]
        gone = left_out(seen.layout, held, promise.least_gap(job.container.side))
        rest, kept = without_some(job, list(gone))
        said = named(gone, seen.layout, found.numbers)
        return replace(cls.of(rest, kept, found.poses.some(kept), promise), left_out=said)


def measured(found: Unmeasured) -> Run:
    """The run's result: of what cannot be certified, without it."""
    is_exact, clock, total = found.job.plan.is_exact, found.job.clock, len(found.job.items)
    with clock.time("finish"):
        job = evened(found.job, found.poses)
    # Areas of drawings whose lines are thinner are in shares no more.
    is_as_weighed = job.items is found.job.items and not found.limits.binds
    promise = Promise(job.plan.gap, job.plan.sizes == "shared" and is_as_weighed)
    with clock.time("measure"):
        seen = _Measured.certifiable(job, found, promise)
        job, layout, metrics = seen.job, seen.layout, seen.metrics
        known = found.unplaced + seen.left_out
        if not is_exact:
            known = find_unplaced(layout, found.limits)
        unplaced = known + job.use.missing(total)
        faults = seen.faults + found.faults + resolution_faults(job, layout) + specks(layout)
        beside = same_kind_beside(layout) if found.keeps_apart else None
    # Geometry alone: other wishes that are not met stand under "broken".
    is_clean = not unclean(promise, layout, metrics.exact)
    certified = is_exact and is_clean and len(layout.items) > 0
    words = job.use.words_found(layout)
    said = manifest(job, found.method, found.outcome, metrics, unplaced, beside)
    said |= {"certified": certified, "promised": asdict(promise) if is_exact else None}
    said |= {"filling": plain(found.filling), "words": plain(words)}
    if found.pile:
        said["pile"] = dict(found.pile)
    with clock.time("measure"):
        worn = dressed(job, layout)
    if worn.ground:
        said["ground"] = worn.ground
    whole = replace(worn, manifest=said, notes=job.use.notes(job, layout, worn))
    return Run(
        layout=with_track(whole, found.recorder, found.numbers[seen.kept], found.asked_for),
        metrics=metrics,
        seconds=clock.seconds,
        ending=found.outcome.ending,
        unplaced=unplaced,
        kept=seen.kept,
        skipped=job.skipped,
        beside=beside,
        certified=certified,
        broken=faults,
        filling=found.filling,
        words=words,
        left_out=found.left_out + total - len(job.items),
        pile=found.pile,
        remarks=job.use.remarks(job),
        advice=(*advice(job, layout, metrics.seen), *unrecognised(job, worn)),
    )
