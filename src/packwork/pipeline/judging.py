"""A result, measured and compared with what was promised."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, replace
from typing import Any

from packwork.metrics.certificate import Promise, broken
from packwork.metrics.measure import measure
from packwork.pipeline.advising import advice, remarks
from packwork.pipeline.beside import same_kind_beside
from packwork.pipeline.dressing import dressed
from packwork.pipeline.job import Job
from packwork.pipeline.legend import legend_notes
from packwork.pipeline.mark_labels import mark_labels
from packwork.pipeline.outcome import (
    Filling,
    Run,
    Unplaced,
    find_unplaced,
    manifest,
    undrawn,
    words_found,
)
from packwork.scene.layout import Layout
from packwork.scene.limits import Limits
from packwork.scene.pose import Poses
from packwork.solve.solver import Outcome


@dataclass(frozen=True, eq=False)
class Judged:
    """What a run has come to.

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


def judged(job: Job, found: Judged) -> Run:
    """The run's result."""
    recipe, clock, limits = job.recipe, job.clock, found.limits
    is_exact = found.unplaced is not None
    layout = Layout(job.container, job.items, found.poses, job.weights)
    with clock.time("measure"):
        metrics = measure(layout)
        unplaced = found.unplaced or ()
        if not unplaced and not (is_exact and metrics.exact.is_clean):
            unplaced = find_unplaced(layout, limits)
        unplaced += undrawn(job)
        shares = recipe.sizes == "shared" and limits is None
        promise = Promise(recipe.padding_cu(job.container), shares) if is_exact else None
        faults = () if promise is None else broken(promise, layout, metrics.exact)
        faults += found.faults
        beside = None if limits is None else same_kind_beside(layout, limits.kinds)
    certified = promise is not None and not faults and not unplaced
    said = manifest(job, found.method, found.outcome, metrics, unplaced, beside)
    said |= {
        "certified": certified,
        "promised": None if promise is None else asdict(promise),
        "filling": None if found.filling is None else asdict(found.filling),
    }
    words = words_found(job)
    said["words"] = None if words is None else asdict(words)
    if found.pile is not None:
        said["pile"] = dict(found.pile)
    worn = dressed(job, layout)
    notes = (*mark_labels(job, worn), *legend_notes(job, layout))
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
        left_out=found.left_out,
        pile=found.pile,
        remarks=remarks(job),
        advice=advice(job, layout, metrics.seen),
    )
