"""Exact finish of a run: items pinned in place first, then those of zones, then all others."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import final

import numpy as np

from packwork.arrays import FloatArray, IntArray
from packwork.compaction.options import HAIR
from packwork.errors import ShapeError
from packwork.finish.finish import Finished, finish
from packwork.finish.options import FinishOptions
from packwork.finish.shrink import separate_pinned
from packwork.forces.forces import NO_FORCES
from packwork.geometry.outline import Outline
from packwork.geometry.overlay import difference, union
from packwork.phrasing import number_of
from packwork.pipeline.findings import Finding, Sentence, Unplaced
from packwork.pipeline.job import Job
from packwork.pipeline.plan.limits import check_found, job_leanings
from packwork.pipeline.state import LEVELS, RunContext, RunState, RunStep
from packwork.progress import Observer, Step, until_over
from packwork.scene.item import bulge_between
from packwork.scene.pose import Limits, Poses
from packwork.solve.solver import scale_bounds
from packwork.steps.measure import reason
from packwork.steps.warm_start import needs_no_levels

TRIALS = {"draft": 0, "normal": 3, "best": 40}
"""Turns and exchanges tried for each item, by effort: 2 ms each. More fill better, ever less
so. Measured in docs/benchmarks/quality.md and decision 0030."""

MOST_TRIALS = {"draft": 0, "normal": 2_500, "best": 20_000}
"""Such trials at most: what a person waits for must not grow with the items for ever. With 2,250,
three containers of 1,000 items end at a mean LC of 0.8126, with 3,000 at 0.8142. Measured."""

MANY, MOST_OF_MANY = 2_000, {"draft": 0, "normal": 1_500, "best": 20_000}
"""Items above which there are so many at most: each trial then gains little of the whole.
Measured in decision 0022."""

TRIALS_SHARE = 0.6
"""Share of the time left, where one was given, after which no more is tried. Chosen."""

NOTED = 1.01
"""How many times smaller than free sizes go an item is that is told of. Larger hides what may be
seen, smaller tells of what nobody sees. Chosen."""

DWARF = 3.0
"""How many times smaller than free sizes go an item may be and still count as placed: one line
tells of such. Larger passes specks, smaller fails runs of a thousand icons for one long wordmark
that can well be seen. Chosen by eye."""

LEAST_KEPT = 0.9
"""Share of its scale that an item keeps where a clean layout is to grow. Larger leaves large ones
less to grow by, smaller makes the small ones dwarfs, whose lines then set the width of all.
Chosen."""

ROUNDING = 1e-6
"""Share of its size by which an item may be smaller than asked. Derived, far above rounding."""

PRESSING = frozenset(
    {
        "containment",
        "overlap",
        "filling",
        "evenness",
        "paper-containment",
        "paper-evenness",
        "area-shares",
        "apart",
    }
)
"""Losses that have no say in which room stays free."""


@final
@dataclass(frozen=True, kw_only=True)
class Finish(RunStep):
    """Exact finish: separation, compaction and trials on the true outlines.

    Parameters
    ----------
    may_fail
        Whether a padding that most items find no room with is no error.
    """

    share = 1.0 - LEVELS
    may_fail: bool = False

    def run(self, state: RunState, context: RunContext) -> RunState:
        """State with exact poses near those of the levels."""
        job = state.job
        with job.clock.time("finish"):
            found = finished(state, context)
            if job.plan.gap and not (self.may_fail or job.plan.stays or context.stop()):
                check_found(job.container, job.plan.gap, found.conflicts, len(found.poses))
            return found


def finished(state: RunState, context: RunContext, *, grows: bool = False) -> RunState:
    """State with exact poses near those it has, of the true outlines.

    Items pinned in place stay as they are and count as wall. Those that a zone holds come
    first, in their zone; all others take what is left. Where a time was given, the rounds
    end with it; what they have then is clean too.

    Parameters
    ----------
    grows
        Whether the poses are clean, and are to be larger: none gets much smaller then.
    """
    job, poses, context = state.job, state.poses, context.heard_by(state.recorder)
    outlines, limits, whole = job.solid_outlines, state.limits, job.container.outline
    # What is to stay where it was is not pushed on.
    forces = NO_FORCES if job.plan.stays else state.forces
    until = until_over(context.stop, job.seconds_left(1.0))
    is_enough = until_over(context.stop, job.seconds_left(TRIALS_SHARE))
    allowed, largest = scale_ranges(state)
    smallest = np.maximum(allowed, LEAST_KEPT * poses.scale) if grows else allowed
    results: list[tuple[IntArray, Finished]] = []
    before = poses
    done = np.flatnonzero(limits.groups < 0)
    if len(done):
        gap = gap_with_bulge(job, done, largest[done]) + HAIR * job.container.side
        kept = replace(limits, smallest=smallest, largest=largest)
        poses = separate_pinned(job.container, outlines, poses, kept, done, gap)
    for group in [*range(1, limits.groups.max(initial=0) + 1), 0]:
        items = np.flatnonzero(limits.groups == group)
        if len(items) == 0:
            continue
        region = limits.zones[group - 1].outline if group else whole
        if len(done):
            walls = [outlines[k].mapped(poses.matrix(int(k))) for k in done]
            region = without(region, walls)
        result = finish(
            replace(job.container, outline=region),
            [outlines[k] for k in items],
            poses.subset(items),
            _options(state, items, smallest[items], largest[items]),
            Closing(context.observer, poses, items, context.observer.every),
            until,
            is_enough,
            forces.subset(items) if forces.acts else NO_FORCES,
        )
        poses = poses.with_some(items, result.poses)
        results.append((items, result))
        done = np.append(done, items)
    if limits.binds and job.plan.sizes == "shared":
        poses = _one_factor(before, poses, limits)
    conflicts = [one.numbered(items) for items, result in results for one in result.conflicts]
    undersized = [int(items[k]) for items, result in results for k in result.undersized]
    real, small = dwarfs_told_apart(job, allowed, poses, undersized)
    return replace(state, poses=poses, conflicts=tuple(conflicts), undersized=real, small=small)


def dwarfs_told_apart(
    job: Job, smallest: FloatArray, poses: Poses, undersized: Sequence[int]
) -> tuple[tuple[int, ...], Finding | None]:
    """Items that are really too small, and those a little smaller than usual.

    The range of free sizes is a default, not an option that was given, unless a rule sizes an item.
    """
    real: list[int] = []
    small: list[int] = []
    short = smallest / poses.scale
    for k in undersized:
        is_asked = "scale" in job.asked[k].values or "size" in job.asked[k].pin
        if short[k] > 1 + ROUNDING:
            (real if is_asked or short[k] > DWARF else small).append(k)
    small = [k for k in small if short[k] > NOTED]
    if not small:
        return tuple(real), None
    worst = max(small, key=lambda k: short[k])
    values = {
        "many": number_of(len(small), "item is", "items are"),
        "ratio": job.plan.size_ratio,
        "worst": job.items[worst].name,
        "percent": 100 * (1 - 1 / short[worst]),
    }
    return tuple(real), Finding(Sentence.SMALL, values)


def _one_factor(before: Poses, poses: Poses, limits: Limits) -> Poses:
    """Poses in which all groups have grown alike: as much as the one that grew least."""
    is_free = ~limits.held[:, 3]
    common = np.min(poses.scale / before.scale, where=is_free, initial=np.inf)
    return replace(poses, scale=np.where(is_free, before.scale * common, poses.scale))


def scale_ranges(state: RunState) -> tuple[FloatArray, FloatArray]:
    """Smallest and largest scale of each item, ``(n,)`` each."""
    job, poses, limits = state.job, state.poses, state.limits
    options = job.plan.solve_options()
    smallest, largest = scale_bounds(state.nominal, poses.scale, options, limits)
    if any(loss not in PRESSING for loss in job.plan.losses):
        # Room that a loss of one's own keeps free must not be grown into.
        largest = np.minimum(largest, poses.scale)
    # Items of a zone come first: they may not grow over those that come later.
    early = limits.groups > 0
    least = np.minimum(largest, np.maximum(poses.scale, smallest))
    return smallest, np.where(early, least, largest)


def _options(
    state: RunState, items: IntArray, smallest: FloatArray, largest: FloatArray
) -> FinishOptions:
    job, limits = state.job, state.limits
    plan, rotation = job.plan, job.plan.rotation
    turning, limit = not rotation.is_still, rotation.limit
    leans = job_leanings(job) if plan.leans else np.zeros(len(job.items))
    if limits.binds:
        # One bound for all of a group: the narrowest that a rule gives.
        turning = turning and bool(np.isnan(limits.angle[items]).all())
        narrowest = float(limits.turn_limit[items].min())
        limit = narrowest if np.isfinite(narrowest) else None
    # Put together so closely, items have nowhere to go; only where all grow by the smallest, trials
    # make room.
    is_settled = state.is_tight and plan.effort != "best"
    # What goes on from an earlier layout keeps its order, unless much effort is asked for.
    is_refined = state.is_tight and state.is_warm_start
    keeps_order = plan.stays or (state.is_warm_start and plan.effort != "best")
    return FinishOptions(
        gap_cu=gap_with_bulge(job, items, largest),
        sizes="free" if plan.sizes == "graded" else plan.sizes,
        smallest=tuple(smallest.tolist()),
        largest=tuple(largest.tolist()),
        turning=turning,
        turn_limit=limit if turning else None,
        leans=tuple(leans[items].tolist()) if turning and leans.any() else None,
        trials=0
        if keeps_order or (is_settled and plan.sizes != "shared")
        else trials_for(job, len(items)),
        relieving=not is_settled,
        refining=(plan.stays and needs_no_levels(job)) or is_refined or state.is_only_refined,
        staying=plan.stays or is_refined,
        exchanging=(job.target is None or len(job.seated) == 0) and not job.plan.keeps_order,
        keeps_order=job.plan.keeps_order,
        seed=plan.seed,
    )


def trials_for(job: Job, count: int) -> int:
    """Number of turns and exchanges that are tried for ``count`` items.

    None where a trial could undo what was asked: copies kept apart, which of two is larger,
    or what a user-defined loss keeps free.
    """
    plan = job.plan
    is_ranked = plan.sizes == "free" and np.ptp(job.weights) > 0
    if plan.keeps_apart or is_ranked or any(loss not in PRESSING for loss in plan.losses):
        return 0
    each = TRIALS[plan.effort] * plan.trial_factor
    return min(each * count, (MOST_OF_MANY if count > MANY else MOST_TRIALS)[plan.effort])


def without(whole: Outline, walls: Sequence[Outline]) -> Outline:
    """A region less the items that stand in it."""
    if not walls:
        return whole
    solid = union([wall.region for wall in walls])
    try:
        return Outline.from_region(difference(whole.region, solid))
    except ShapeError:
        return whole


def gap_with_bulge(job: Job, items: IntArray, largest: FloatArray) -> float:
    """Gap between outlines that leaves the one asked for between curves.

    Those may come nearer than the polygons that stand for them.

    Parameters
    ----------
    largest
        ``(m,)`` how large they may become.
    """
    return job.plan.gap + bulge_between([job.items[k] for k in items], largest)


def unfinished(state: RunState) -> tuple[Unplaced, ...]:
    """Items that are still in conflict, or smaller than they may be, and why."""
    job, found = state.job, dict[int, str]()
    for conflict in state.conflicts:
        found.setdefault(conflict.item, reason(conflict, job.items, job.container.unit))
    for k in state.undersized:
        found.setdefault(k, Sentence.TOO_SMALL.of())
    return tuple(Unplaced(job.items[k].name, k, found[k]) for k in sorted(found))


@dataclass
class Closing:
    """Passes steps of some items on as those of a last level of all.

    Parameters
    ----------
    ids
        What all items are called by, as in ``Step``.
    """

    observer: Observer
    poses: Poses
    items: IntArray
    every: int
    ids: IntArray | None = None

    def on_step(self, step: Step) -> None:
        """Tell the run's observer."""
        poses = self.poses.with_some(self.items, step.poses)
        self.observer.on_step(
            replace(step, poses=poses, is_finish=True, ids=self.ids, stage="finish")
        )
