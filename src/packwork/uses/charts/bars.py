"""Bar charts of marks: each group's marks in rows or fallen into a bar, all at one scale."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from packwork.arrays import IntArray
from packwork.compaction.options import HAIR
from packwork.errors import RecipeError
from packwork.forces.field import Direction
from packwork.forces.forces import FieldForce, Forces
from packwork.geometry.outline import Outline
from packwork.pipeline.findings import Unplaced
from packwork.pipeline.job import Job
from packwork.pipeline.state import RunContext
from packwork.progress import NOBODY, Observer, Stop
from packwork.readers.tables.cells import MISSING, as_number, cell_text
from packwork.scene.container import Container
from packwork.scene.pose import Poses
from packwork.settle.pile import Arrival, SettleOptions, pile
from packwork.steps.finish import gap_with_bulge
from packwork.steps.place import first_angles
from packwork.uses.charts.copies import (
    Grouped,
    GroupSteps,
    moved,
    settled_step,
    unit_scales,
)
from packwork.uses.charts.isotype import are_in_rows, in_rows
from packwork.uses.charts.layout import (
    COVER,
    SNUG_SHARE,
    Cell,
    Chart,
    is_alike_and_round,
    joined_rooms,
    rows_in_hollows,
)
from packwork.uses.charts.marks import ChartRead

NEAR_FULL = 0.95
"""Share of the height at hand that the highest bar has at least, unless its widest mark bounds the
scale. Larger takes more trials. Chosen."""

TRIALS = 6
"""Scales that are tried for the largest group, and for all. More come nearer to the full height.
Chosen."""

BACK = 0.997
"""Factor on a scale that would just do: heaps of another scale lie otherwise. Chosen."""

ABOVE = 3.0
"""Room over a bar in which marks have their first places, in bars' heights. Chosen."""

SLACK = 1e-3
"""What a bar is wider than just that. Smaller lets no mark in, larger lets rows shift. Tried."""

GRID = 0.35
"""Room that the search for first places loses at the walls, in the mean radius of a heap's marks:
it looks on a grid of 16 to their diameter. Derived, and tried."""

DOWN = np.pi / 2


def fill_bars(job: Job, chart: Chart, context: RunContext) -> Grouped:
    """Heaps side by side, at the largest scale at which the highest has room.

    Equal upright marks lie in rows. Marks of one colour lie together, the most frequent one at
    the bottom; colours that are numbers ascend.
    """
    if are_in_rows(job, chart):
        return _in_rows(job, chart, context.observer)
    heaps = _Heaps(job, chart, context.stop)
    scale = heaps.scale_of_the_largest()
    for _ in range(TRIALS):
        poses, kept = heaps.all_at(scale, context.observer)
        over = heaps.highest(poses, kept)
        if over <= 1 or context.stop():
            break
        scale *= BACK / np.sqrt(over)
    heaped = [own[np.isin(own, kept)] for own in heaps.members]
    left = np.setdiff1d(np.arange(len(job.items)), kept)
    unplaced = tuple(
        Unplaced(job.items[k].name, int(k), "there was no room left for it") for k in left
    )
    container = _as_high(job, heaps.cells, heaped, poses, heaps.gap(scale))
    return Grouped(poses, kept, container, "lowest", unplaced)


def _in_rows(job: Job, chart: Chart, observer: Observer) -> Grouped:
    """Equal upright marks in rows, shown bar by bar."""
    poses, before = in_rows(job, chart, _ranks(job, chart)), np.arange(0)
    for own in chart.members:
        steps = GroupSteps(observer, poses, before, own, np.zeros(2))
        steps.on_step(settled_step(poses.subset(own)))
        before = np.concatenate([before, own])
    gap = gap_with_bulge(job, before, poses.scale)
    container = _as_high(job, chart.cells, chart.members, poses, gap)
    return Grouped(poses, np.sort(before), container, "rows", ())


def _as_high(
    job: Job, cells: Sequence[Cell], members: Sequence[IntArray], poses: Poses, gap: float
) -> Container:
    """The container whose bars are as high as what is in them."""
    rooms = [
        _cut(cell, [job.items[k].outline.mapped(poses.matrix(int(k))) for k in own], gap)
        for cell, own in zip(cells, members, strict=True)
    ]
    outline = joined_rooms([room for room in rooms if room is not None])
    return replace(job.container, outline=outline)


class _Heaps:
    """Heaps of all groups at any scale."""

    def __init__(self, job: Job, chart: Chart, stop: Stop) -> None:
        self._job, self._stop = job, stop
        self.cells, self.members = chart.cells, chart.members
        self._units = unit_scales(job)
        self._outlines = job.solid_outlines
        self._angles = first_angles(job, np.random.default_rng(job.plan.seed))
        self._ranks = _ranks(job, chart)
        self._measured()
        self.cells, self._snug = _snug(job, chart.read, self.cells, self.members)
        self._width, self._height, self._free = self._measured()

    def gap(self, scale: float) -> float:
        """Distance that marks keep."""
        all_marks = np.arange(len(self._units))
        return gap_with_bulge(self._job, all_marks, self._units * scale)

    def _measured(self) -> tuple[float, float, float]:
        """Width and height of bars, and the width between their walls that marks may take."""
        left, top, right, bottom = self.cells[0].room.bounds
        free = right - left - 2 * (self.gap(0.0) + 2 * HAIR * self._job.container.side)
        if free <= 0:
            raise RecipeError(
                "padding", "leaves no room between the walls of a bar; use a smaller one"
            )
        return right - left, bottom - top, free

    def scale_of_the_largest(self) -> float:
        """Scale at which the group of the largest sum fills its bar."""
        sums = [float(self._job.weights[own].sum()) for own in self.members]
        largest = int(np.argmax(sums))
        if self._snug is not None:
            return self._snug
        widest = self._widest_scale()
        scale = min(np.sqrt(COVER * self._width * self._height / sums[largest]), widest)
        best = 0.0
        for _ in range(TRIALS):
            poses, kept = self._heap(largest, scale, NOBODY)
            over = self._over(self.members[largest][kept], poses.subset(kept))
            if over <= 1:
                best = max(best, scale)
            if NEAR_FULL <= over <= 1 or self._stop() or (over < 1 and scale == widest):
                break
            scale = min(scale * BACK / np.sqrt(over), widest)
        return best or scale

    def all_at(self, scale: float, observer: Observer) -> tuple[Poses, IntArray]:
        """Poses of all marks, and which of them have a place."""
        zero = np.zeros(len(self._units))
        poses, kept = Poses(zero, zero, self._angles, self._units * scale), np.arange(0)
        for k, own in enumerate(self.members):
            if len(own) == 0:
                continue
            steps = GroupSteps(observer, poses, kept, own, np.zeros(2))
            heap, placed = self._heap(k, scale, steps)
            poses = poses.with_some(own, self._centred(k, heap, placed))
            kept = np.concatenate([kept, own[placed]])
        return poses, np.sort(kept)

    def highest(self, poses: Poses, kept: IntArray) -> float:
        """Height of the highest heap of marks ``kept`` ``(m,)``, over that of the bars."""
        return self._over(kept, poses.subset(kept))

    def _over(self, items: IntArray, poses: Poses) -> float:
        tops = [
            self._job.items[k].outline.mapped(poses.matrix(row)).bounds[1]
            for row, k in enumerate(items)
        ]
        foot = self.cells[0].room.bounds[3]
        return (foot - min(tops, default=foot)) / self._height

    def _heap(self, group: int, scale: float, steps: Observer) -> tuple[Poses, IntArray]:
        """One group at rest in its bar, and which of its marks have a place."""
        own = self.members[group]
        left, top, right, foot = self.cells[group].room.bounds
        job = self._job
        room = Outline.box(left, foot - ABOVE * (foot - top), right, foot)
        container = Container("bar", "none", room, job.container.width, job.container.height)
        middle = np.full(len(own), (left + right) / 2)
        begin = Poses(middle, np.full(len(own), foot), self._angles[own], self._units[own] * scale)
        down = FieldForce(Direction(DOWN), np.ones(len(own)))
        forces = Forces([down], [], np.zeros(len(own), dtype=np.int64), job.container.side)
        rotation = job.plan.rotation
        options = SettleOptions(
            gap_cu=self.gap(scale),
            turning=not rotation.is_still,
            turn_limit=rotation.limit,
            seed=job.plan.seed,
        )
        heap = pile(
            container, [self._outlines[k] for k in own], begin, forces, options,
            arrival=Arrival(ranks=self._ranks[own]), observer=steps, stop=self._stop,
        )  # fmt: skip
        return heap.poses, heap.placed

    def _centred(self, group: int, heap: Poses, placed: IntArray) -> Poses:
        """A heap in the middle of its bar, as far as it is narrower: one mark under its number."""
        outlines = [
            self._outlines[self.members[group][k]].mapped(heap.matrix(int(k))) for k in placed
        ]
        left = min((outline.bounds[0] for outline in outlines), default=0.0)
        right = max((outline.bounds[2] for outline in outlines), default=0.0)
        return moved(heap, np.array([self.cells[group].middle - (left + right) / 2, 0.0]))

    def _widest_scale(self) -> float:
        """Largest scale at which each mark fits between the walls, however it is turned."""
        radii = np.array([outline.radius for outline in self._outlines]) * self._units
        needs = [
            2 * radii[own].max() + GRID * radii[own].mean() for own in self.members if len(own)
        ]
        return self._free / float(max(needs))


def _snug(
    job: Job, read: ChartRead, cells: Sequence[Cell], groups: Sequence[IntArray]
) -> tuple[tuple[Cell, ...], float | None]:
    """Bars as wide as some and a half of marks that are all alike and round, and their scale.

    Rows of them then lie in the hollows of the rows below, in all bars alike, so that heights tell
    numbers. Bars as they are, and no scale, for all other marks.
    """
    if not is_alike_and_round(read):
        return tuple(cells), None
    _, top, _, foot = cells[0].room.bounds
    gap = gap_with_bulge(job, np.arange(1), np.zeros(1)) + 2 * HAIR * job.container.side
    most = max(len(own) for own in groups)
    across, distance = rows_in_hollows(most, SNUG_SHARE * cells[0].width, foot - top, gap)
    half = (distance * (across + 0.5) + gap) * (1 + SLACK) / 2
    fitted = tuple(
        replace(cell, room=Outline.box(cell.middle - half, top, cell.middle + half, foot))
        for cell in cells
    )
    unit = float(unit_scales(job)[0]) * job.items[0].outline.radius
    return fitted, (distance - gap) / (2 * unit)


def _ranks(job: Job, chart: Chart) -> IntArray:
    """``(n,)`` which marks come first, and so lie lowest."""
    read, column = chart.read, chart.options.color_by
    if read.is_ramp and column is not None:
        numbers = np.array([as_number(row.get(column)) for row in read.rows])
        return np.asarray(np.argsort(np.argsort(numbers, kind="stable"), kind="stable"))
    names, by = read.colour_of, chart.options.mark_by
    if names is None:
        names = tuple("" if by is None else cell_text(row.get(by)).casefold() for row in read.rows)
    frequent = [name for name, _ in Counter(names).most_common()]
    named = sorted(frequent, key=lambda name: name == MISSING)
    order = {name: k for k, name in enumerate(named)}
    return np.array([order[name] for name in names], dtype=np.int64)


def _cut(cell: Cell, outlines: list[Outline], gap: float) -> Cell | None:
    """A bar as high as its heap; None if there is none."""
    if not outlines:
        return None
    left, _, right, foot = cell.room.bounds
    top = min(outline.bounds[1] for outline in outlines) - 1.5 * gap
    return replace(cell, room=Outline.box(left, top, right, foot))
