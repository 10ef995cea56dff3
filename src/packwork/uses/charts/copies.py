"""A copy of the container for each group, filled one by one, then all at one scale.

Bars, whose groups are filled one after another too, share the common part of it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from packwork.arrays import FloatArray, IntArray
from packwork.compaction.arrangement import find_conflicts
from packwork.compaction.options import HAIR
from packwork.geometry import affine
from packwork.geometry.outline import Outline
from packwork.pipeline.findings import Unplaced
from packwork.pipeline.job import Job
from packwork.pipeline.plan.limits import check_padding
from packwork.pipeline.state import RunContext, RunState, run_steps
from packwork.progress import Observer, Step, Stop
from packwork.recipe import Effort
from packwork.scene.container import Container
from packwork.scene.pose import Poses
from packwork.solve.solver import LevelReport
from packwork.steps.finish import finished, unfinished
from packwork.steps.starts import fits_first
from packwork.uses.charts.layout import Chart
from packwork.uses.collage import jamming, placing

ALMOST = 0.999
"""Share of the least scale so far from which a group is not tried any harder. Larger tries groups
of one mark twice for nothing. Chosen."""

SHARE_DIGITS = 12
"""Digits of shares that tell marks apart. Chosen."""


@dataclass(frozen=True, eq=False)
class _Filled:
    """One group in its copy, in the units of the canvas, the copy's corner at the origin."""

    own: IntArray
    offset: FloatArray
    placed: RunState
    scale: float


def fill_copies(job: Job, chart: Chart, pattern: Container, context: RunContext) -> Grouped:
    """Marks of each group in its copy, at the largest scale at which all groups fit.

    Each group is packed as tightly as it goes; the tightest gives the scale, and marks of all
    others shrink in place.
    """
    single = _single(job, chart, pattern)
    rooms = [_room(cell.room, single) if chart.regions else single for cell in chart.cells]
    for room, own in zip(rooms, chart.members, strict=True):
        check_padding(room, job.plan.gap, len(own), " of a group")
    zero = np.zeros(len(job.items))
    poses, before = Poses(zero, zero, zero, zero), np.arange(0)
    groups: list[_Filled] = []
    known: dict[tuple[Outline | float, ...], RunState] = {}
    found = zip(chart.cells, rooms, chart.members, strict=True)
    pairs = [
        (np.array(cell.room.bounds[:2]) - room.outline.bounds[:2], room, own)
        for cell, room, own in found
        if len(own)
    ]
    # The fullest first: its scale tells when others need no more effort.
    fullest = int(np.argmax([job.weights[own].sum() / room.outline.area for _, room, own in pairs]))
    for offset, room, own in [pairs[fullest], *pairs[:fullest], *pairs[fullest + 1 :]]:
        steps = GroupSteps(context.observer, poses, before, own, offset)
        part = _part(job, room, own, len(job.items) - len(before))
        found_before = known.get(_alike(part))
        if found_before is None:
            group = _filled(part, own, offset, groups, RunContext(steps, context.stop))
        else:
            group = _as_before(part, own, offset, found_before, steps)
        groups.append(group)
        known[_alike(part)] = group.placed
        poses = poses.with_some(own, moved(group.placed.poses, offset))
        before = np.concatenate([before, own])
    common, *others = sorted(group.scale for group in groups)
    tightest = min(groups, key=lambda group: group.scale)
    unplaced: list[Unplaced] = []
    for group in groups:
        at_scale, faults = _at_scale(group, common, context.stop)
        poses = poses.with_some(group.own, moved(at_scale, group.offset))
        unplaced += faults
    method = groups[0].placed.method
    all_marks = np.arange(len(job.items))
    levels = [level for placed in known.values() for level in placed.levels]
    return Grouped(
        poses, all_marks, job.container, method, tuple(unplaced), levels,
        fullest=chart.read.group_of[tightest.own[0]], larger=(others or [common])[0] / common,
    )  # fmt: skip


def _filled(
    part: Job,
    own: IntArray,
    offset: FloatArray,
    before: Sequence[_Filled],
    context: RunContext,
) -> _Filled:
    """One group, filled as hard as it takes to be no tighter than those before."""
    efforts: list[Effort] = [part.plan.effort]
    if before and part.plan.epochs is None and part.plan.effort != "draft":
        efforts = ["draft", part.plan.effort]
    for effort in efforts:
        tried = part.replanned(effort=effort)
        steps = jamming(tried) or placing(tried, suits_first_fit=fits_first(tried))
        placed = run_steps(steps, RunState.of(tried), context)
        scale = float(np.median(placed.poses.scale / unit_scales(part)))
        is_clean = placed.is_clean or not part.plan.is_exact
        least = ALMOST * min((one.scale for one in before), default=np.inf)
        if context.stop() or (is_clean and scale >= least):
            break
    return _Filled(own, offset, placed, scale)


def _alike(part: Job) -> tuple[Outline | float, ...]:
    """The same for groups of the same marks, all as large for each other, in rooms of one shape."""
    shares = (part.weights / part.weights.max()).round(SHARE_DIGITS).tolist()
    return (part.container.outline, *(item.outline for item in part.items), *shares)


def _as_before(
    part: Job, own: IntArray, offset: FloatArray, before: RunState, steps: GroupSteps
) -> _Filled:
    """A group whose marks lie as those of another, which are alike."""
    placed = replace(before, job=part)
    steps.on_step(settled_step(placed.poses))
    scale = float(np.median(placed.poses.scale / unit_scales(part)))
    return _Filled(own, offset, placed, scale)


def _single(job: Job, chart: Chart, pattern: Container) -> Container:
    """The container as large as its copies are, on a canvas of its own."""
    scale = chart.cells[0].room.extent / pattern.outline.extent
    return replace(
        pattern,
        outline=pattern.outline.mapped(affine.similarity(0.0, 0.0, 0.0, scale)),
        width=pattern.width * scale,
        height=pattern.height * scale,
        unit=job.container.unit,
    )


def _room(outline: Outline, single: Container) -> Container:
    """A part of a map on a canvas of its own."""
    left, top, right, bottom = outline.bounds
    moved = outline.mapped(affine.similarity(-left, -top, 0.0, 1.0))
    return replace(single, outline=moved, width=right - left, height=bottom - top)


def _part(job: Job, single: Container, own: Sequence[int] | IntArray, left: int) -> Job:
    """One group as a job of its own; its padding is in units, as shares are of other canvases.

    It shares the time with the ``left`` marks of itself and the groups after it.
    """
    plan = replace(job.plan, gap=job.plan.gap + HAIR * job.container.side)
    if plan.seconds is not None:
        used = sum(job.clock.seconds.values())
        plan = replace(plan, seconds=used + max(plan.seconds - used, 0.0) * len(own) / left)
    return replace(job.subset(own), plan=plan, container=single, is_recorded=False)


def _at_scale(group: _Filled, common: float, stop: Stop) -> tuple[Poses, list[Unplaced]]:
    """Poses at the common scale, and marks that are in conflict there."""
    placed, job = group.placed, group.placed.job
    poses = replace(placed.poses, scale=unit_scales(job) * common)
    # What was in conflict at its own size is told, and not tried again.
    if placed.is_clean:
        # Smaller ones stay clear of each other, but for those that lay in others' bays.
        outlines = job.solid_outlines
        gap = job.plan.gap
        if find_conflicts(job.container, outlines, poses, gap):
            fixed = job.replanned(sizes="fixed")
            placed = finished(replace(placed, job=fixed, poses=poses), RunContext(stop=stop))
            poses = placed.poses
    faults = [replace(one, index=int(group.own[one.index])) for one in unfinished(placed)]
    return poses, faults


@dataclass(frozen=True, eq=False)
class Grouped:
    """All groups of a chart in their places, and the container of several parts that they fill.

    ``fullest``: the group that gives all their scale; ``larger``: by how much without it.
    """

    poses: Poses
    kept: IntArray
    container: Container
    method: str
    unplaced: tuple[Unplaced, ...]
    levels: list[LevelReport] = field(default_factory=list)
    fullest: int = 0
    larger: float = 1.0


class GroupSteps:
    """Passes steps of one group on, moved to its place, the groups before it beside it."""

    def __init__(
        self,
        observer: Observer,
        poses: Poses,
        before: IntArray,
        own: IntArray,
        offset: FloatArray,
    ) -> None:
        self._observer, self._poses, self._before = observer, poses, before
        self._own, self._offset = own, offset
        self.every = observer.every

    def on_step(self, step: Step) -> None:
        """Tell of all that are there."""
        own = self._own if step.ids is None else self._own[step.ids]
        there = np.concatenate([self._before, own])
        all_of_them = self._poses.with_some(own, moved(step.poses, self._offset))
        begun, share = len(self._before), len(self._own)
        progress = (begun + share * step.progress) / len(self._poses)
        self._observer.on_step(
            replace(step, poses=all_of_them.subset(there), ids=there, progress=progress)
        )


def settled_step(poses: Poses) -> Step:
    """The one step of marks whose places were known at once."""
    nothing = (0.0, 0.0, 0.0)
    return Step(0, 1, 0, 0, 1.0, poses, lambda: nothing, is_finish=True, stage="finish")


def moved(poses: Poses, offset: FloatArray) -> Poses:
    """Poses somewhere else.

    Examples
    --------
    >>> one = np.ones(1)
    >>> moved(Poses(one, one, one, one), np.array([2.0, 0.0])).x.tolist()
    [3.0]
    """
    return replace(poses, x=poses.x + offset[0], y=poses.y + offset[1])


def unit_scales(job: Job) -> FloatArray:
    """``(n,)`` scales at which areas of marks are their weights."""
    own = np.array([item.outline.area for item in job.items])
    return np.asarray(np.sqrt(job.weights / own))
