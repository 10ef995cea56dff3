"""Smaller copies put into the voids of a finished layout, round by round."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import TypeAlias, final

import numpy as np
import shapely

from packwork.arrays import FloatArray, IntArray
from packwork.finish.finish import finish
from packwork.finish.options import FinishOptions
from packwork.finish.shrink import admit_fillers
from packwork.geometry.outline import Outline
from packwork.pipeline.findings import Filling, Sentence
from packwork.pipeline.plan.copies import ItemRules
from packwork.pipeline.state import RunContext, RunState, RunStep
from packwork.progress import Observer, Stop, until_over
from packwork.scene.item import Item
from packwork.scene.pose import Poses
from packwork.solve.outlines import stand_ins
from packwork.start.angles_and_sizes import nearest_allowed
from packwork.start.voids import SECTORS, copies_for_voids
from packwork.steps.finish import Closing, gap_with_bulge, scale_ranges, without

ROUNDS = {"draft": 4, "normal": 8, "best": 16}
"""Linear programmes of each item after each round of fillers, by effort. Measured in
docs/benchmarks/quality.md."""

MORE, AT_LEAST = 0.4, 30
"""Copies tried in a round, as a share of those that lie there, and at least. Fewer in a round
fill a little better and take longer. Tried."""

WORTHWHILE = 2e-4
"""Share of the container that a round has to gain for another to follow. Smaller adds specks
one by one. Chosen."""

MOST_ITEMS = 1_000
"""Items in all unless ``max_items`` says otherwise: what a person waits for. Chosen."""

MOST_WORK = {"draft": 2e10, "normal": 6e10, "best": 2.5e11}
"""Work of all rounds together, by effort: pairs of corners of items whose boxes meet, once for each
time that they are looked at. Larger lets items of many corners that lie in each other's boxes take
minutes, smaller ends before voids are full. Measured: 1.2 to 2.7 ns of the processor each; 60 icons
in a cat come to 280 items at draft in 5e9, 70 at normal effort to 438 in 1.2e10, where 93 % asked
for are not covered yet."""

IMAGE_WORK = 1.5e8
"""What looking for voids in an image counts in a round. Measured: 0.7 to 0.9 s."""

STYLE = frozenset({"color", "link", "title"})
"""What of the rules about an item holds for the smaller copies of it too."""


FillerScales: TypeAlias = Callable[
    [RunState, FloatArray, FloatArray], tuple[FloatArray, FloatArray]
]
"""Smallest and largest scale of each sort of filler, ``(m,)`` each, from those that the plan
gives."""


def as_planned(
    state: RunState, smallest: FloatArray, largest: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """The scales that the plan gives."""
    del state
    return smallest, largest


@final
class FillVoids(RunStep):
    """Smaller copies put into voids until the coverage asked for is reached or nothing fits.

    Each round finds the voids in an image, puts copies where they fit, and lets all items
    that may yield grow and make room in exact geometry. Where sizes are data or rules
    hold items, only the fillers move.
    """

    share = 1.0

    def __init__(self, scales: FillerScales = as_planned) -> None:
        self._scales = scales

    def run(self, state: RunState, context: RunContext) -> RunState:
        """State with fillers among its items; what was placed stays."""
        job, context = state.job, context.part(0.0, 1.0, "gaps").heard_by(state.recorder)
        with job.clock.time("gaps"):
            stop = until_over(context.stop, job.seconds_left(1.0))
            filling = _Filling(state, self._scales, context.observer, stop)
            ending = filling.filled() if state.is_clean else Sentence.NOT_CLEAN
            return filling.result(ending)


class _Filling:
    """State of one gap filling between its rounds."""

    def __init__(
        self, state: RunState, scales: FillerScales, observer: Observer, stop: Stop
    ) -> None:
        job, voids = state.job, state.job.plan.voids
        self._state, self._job, self._voids = state, job, voids
        self._observer, self._stop, self._rounds = observer, stop, 0
        self._sorts = job.fillers
        self._shapes = stand_ins([item.outline for item in self._sorts], job.plan.outline)
        self._rng = np.random.default_rng(job.plan.seed)
        self._first = len(job.items)
        self.poses, self.added = state.poses, list[int]()
        self._ids, self._tried = np.arange(self._first), self._first
        self._originals = job.solid_outlines
        self._yields = job.plan.sizes == "free" and not state.limits.binds
        self._ranges = scale_ranges(state)
        own = np.array([outline.area for outline in self._shapes])
        extents = np.array([outline.extent for outline in self._shapes])
        # No filler outgrows what is a fair share for the items of before.
        fair = np.sqrt(job.container.outline.area / self._first / own)
        self._smallest, self._largest = scales(state, voids.smallest / extents, fair)
        self._gap = gap_with_bulge(job, np.arange(self._first), self._ranges[1])
        self._work = 0.0

    def filled(self) -> Sentence:
        """Fill voids round by round; why the last round was the last."""
        voids, effort = self._voids, self._job.plan.effort
        while (before := self.coverage()) < voids.enough:
            room = (voids.most or MOST_ITEMS) - len(self.poses)
            if room <= 0:
                return Sentence.MOST_ITEMS
            if self._stop():
                return Sentence.FILLING_STOPPED
            if self._work > MOST_WORK[effort]:
                return Sentence.FILLING_TOO_LONG
            self._work += IMAGE_WORK
            count = min(max(AT_LEAST, round(MORE * len(self.poses))), room)
            if self._let_in(count) == 0 or self._grow() - before < WORTHWHILE:
                return Sentence.NO_VOID
        return Sentence.COVERED

    def coverage(self) -> float:
        """Share of the container that the items cover; none overlap."""
        own = np.array([outline.area for outline in self._all_outlines()])
        return float((own * self.poses.scale**2).sum()) / self._job.container.outline.area

    def result(self, ending: Sentence) -> RunState:
        """Layout that was placed, with all that was put into voids."""
        job = self._job
        own = dict(zip(job.items, job.asked, strict=True))
        by_name = dict(zip((item.name for item in job.items), job.asked, strict=True))
        new = [self._sorts[k] for k in self.added]
        asked = [_styled(own.get(i) or by_name.get(i.name, ItemRules())) for i in new]
        said = ending.of(
            target=100 * (self._voids.target or 0.0),
            count=len(self.poses),
            remedy="fewer corners" if job.plan.effort == "best" else "a higher --effort",
            smallest=self._voids.smallest,
            unit=job.container.unit,
        )
        filling = Filling(len(new), said, self.coverage(), self._voids.target)
        return joined_by(self._state, new, asked, self.poses, self._ids, filling)

    def _let_in(self, count: int) -> int:
        """Put copies into voids; how many found a place."""
        container, rotation = self._job.container, self._job.plan.rotation
        outlines = self._all_outlines()
        placed = [outline.mapped(self.poses.matrix(k)) for k, outline in enumerate(outlines)]
        turns = 2 * np.pi * np.arange(SECTORS) / SECTORS
        nearest = nearest_allowed(turns, rotation.limit, rotation.choices)
        fillers = copies_for_voids(
            container,
            placed,
            self._shapes,
            np.abs(np.angle(np.exp(1j * (nearest - turns)))) <= np.pi / SECTORS,
            most=count,
            smallest=self._smallest,
            largest=self._largest,
            gap=self._gap,
            rng=self._rng,
        )
        angle = nearest_allowed(fillers.poses.angle, rotation.limit, rotation.choices)
        poses = self.poses.followed_by(replace(fillers.poses, angle=angle))
        shapes = [*outlines, *(self._shapes[k] for k in fillers.sort)]
        self._work += corner_pairs(shapes, poses)
        stay, poses = admit_fillers(container, shapes, poses, len(fillers.sort), self._gap)
        here = np.array([*self.added, *fillers.sort], dtype=np.int64)[
            stay[self._first :] - self._first
        ]
        large = poses.scale[self._first :] >= self._smallest[here]
        kept = np.append(np.arange(self._first), self._first + np.flatnonzero(large))
        arrived = int(large.sum()) - len(self.added)
        ids = self._tried + np.arange(len(fillers.sort))
        self._ids = np.append(self._ids, ids)[stay][kept]
        self._tried += len(ids)
        self.poses, self.added = poses.subset(kept), [int(k) for k in here[large]]
        return arrived

    def _grow(self) -> float:
        """Let all that may yield grow and make room; the coverage then."""
        plan, container = self._job.plan, self._job.container
        outlines, (smallest, largest) = self._all_outlines(), self._all_ranges()
        movers = np.arange(0 if self._yields else self._first, len(outlines))
        self._work += ROUNDS[plan.effort] * corner_pairs(outlines, self.poses)
        walls = [outlines[k].mapped(self.poses.matrix(k)) for k in range(movers[0])]
        result = finish(
            replace(container, outline=without(container.outline, walls)),
            [outlines[k] for k in movers],
            self.poses.subset(movers),
            FinishOptions(
                gap_cu=self._gap,
                smallest=tuple(np.minimum(smallest, self.poses.scale)[movers].tolist()),
                largest=tuple(np.maximum(largest, self.poses.scale)[movers].tolist()),
                turning=not plan.rotation.is_still,
                turn_limit=None if plan.rotation.is_still else plan.rotation.limit,
                rounds=ROUNDS[plan.effort],
                refining=True,
            ),
            self._closing(movers),
            self._stop,
        )
        if result.clean:
            self.poses = self.poses.with_some(movers, result.poses)
        return self.coverage()

    def _closing(self, movers: IntArray) -> Closing:
        # The number of rounds is not known beforehand: each takes half of the bar that is left.
        begun, self._rounds = 1.0 - 0.5**self._rounds, self._rounds + 1
        context = RunContext(self._observer).part(begun, 1.0 - 0.5**self._rounds)
        return Closing(context.observer, self.poses, movers, context.observer.every, self._ids)

    def _all_outlines(self) -> list[Outline]:
        return [*self._originals, *(self._shapes[k] for k in self.added)]

    def _all_ranges(self) -> tuple[FloatArray, FloatArray]:
        smallest, largest = self._ranges
        return (
            np.append(smallest, self._smallest[self.added]),
            np.append(largest, self._largest[self.added]),
        )


def joined_by(
    state: RunState,
    new: Sequence[Item],
    asked: Sequence[ItemRules],
    poses: Poses,
    numbers: IntArray,
    filling: Filling,
) -> RunState:
    """State with items that were put between: their poses come last."""
    job = state.job
    grown = replace(
        job,
        items=(*job.items, *new),
        asked=(*job.asked, *asked),
        weights=np.append(job.weights, np.zeros(len(new))),
    )
    return replace(
        state,
        job=grown,
        nominal=np.append(state.nominal, poses.scale[len(job.items) :]),
        limits=state.limits.joined_by(len(new)),
        poses=poses,
        filling=filling,
        numbers=numbers,
    )


def corner_pairs(outlines: Sequence[Outline], poses: Poses) -> float:
    """Pairs of corners of items whose boxes meet: what it takes to look at all of them once.

    Examples
    --------
    >>> tile = Outline.from_rings([[[-1, -1], [1, -1], [1, 1], [-1, 1]]])
    >>> row = Poses(np.array([0.0, 1.5, 9.0]), np.zeros(3), np.zeros(3), np.ones(3))
    >>> corner_pairs([tile] * 3, row)
    16.0
    """
    boxes = np.array([o.mapped(poses.matrix(k)).bounds for k, o in enumerate(outlines)])
    corners = np.array([len(outline.points) for outline in outlines], dtype=np.float64)
    regions = shapely.box(*boxes.T)
    first, second = shapely.STRtree(regions).query(regions)
    return float((corners[first] * corners[second])[first < second].sum())


def _styled(asked: ItemRules) -> ItemRules:
    """Parts of rules on how an item looks and where it leads."""
    return ItemRules(values={key: value for key, value in asked.values.items() if key in STYLE})
