"""Items that cover the container's edge and are cut at its line."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import TypeAlias, final

import numpy as np

from packwork.arrays import FloatArray, IntArray
from packwork.errors import RecipeError
from packwork.geometry import affine
from packwork.geometry.outline import Outline
from packwork.geometry.overlay import buffered, intersection, union
from packwork.metrics.certificate import HAIR
from packwork.pipeline.findings import Filling, Sentence, Unplaced
from packwork.pipeline.job import Job
from packwork.pipeline.plan.copies import ItemRules
from packwork.pipeline.plan.counts import items_needed
from packwork.pipeline.plan.limits import check_padding
from packwork.pipeline.plan.plan import NO_VOIDS, void_plan
from packwork.pipeline.recorder import Recorder
from packwork.pipeline.state import RunContext, RunState, RunStep, run_steps, share_of
from packwork.progress import Observer, Step
from packwork.recipe import Recipe
from packwork.scene.container import Container
from packwork.scene.item import Item
from packwork.scene.layout import Layout
from packwork.scene.pose import Poses
from packwork.scene.track import SCALE, Track, numbers_of, poses_of
from packwork.steps.shortfalls import CLEARLY_MORE
from packwork.units import parse_length
from packwork.uses.cutting import Cut, cut
from packwork.uses.photos.rim import spread_to

DEPTHS = (0.45, 0.35, 0.25, 0.1, 0.0)
"""Widths by which the container is grown before items are placed, over the side of a typical
item, one after another until no item is lost: at the last all lie inside before they are spread.
Larger leaves less of the edge bare and cuts more off the items there, smaller the other way round.
Tried by eye."""

ANOTHER_TRY = 0.3
"""Share of the bar that is kept for another such try. Larger leaps at the end of a run that needs
none, smaller crawls through one that does. Chosen."""

EVEN_RATIO = 1.5
"""Largest ``size_ratio`` at which items are placed before they are spread over the edge. Larger
puts small ones there, which are lost, smaller covers less. Tried."""

LEAST_SEEN = 1 / 3
"""Share of an item that has to be seen once it is cut: an item of less is left out. Larger loses
items, smaller leaves slivers of them. Chosen."""

MOST_BARE_EDGE = 0.15
"""Share of the container's line that may be bare and is not told of. Larger passes letters with
bites in them, smaller tells of specks. Chosen by eye."""

EDGE_REACH = 2e-3
"""Distance within which an item covers the line, as a share of the canvas. Larger passes gaps that
are seen, smaller counts those that are kept for rounding. Chosen."""

CLEARANCE = 3 * HAIR
"""Least gap between what is cut and the container's line, as a share of the canvas: what is
certified, and room for the rounding of files. Derived."""


_HELD = {"region", "scale"}
"""What rules ask of items that are not moved towards the edge."""


@dataclass(frozen=True, eq=False)
class Cropped:
    """Items cut at the container's line: those of which enough is seen, numbered by ``kept``.

    ``centres`` ``(n, 2)`` are their centroids in the units of the whole items, whose poses
    ``whole`` are on the grown canvas.
    """

    job: Job
    poses: Poses
    kept: IntArray
    centres: FloatArray
    whole: Poses


def crops(recipe: Recipe) -> bool:
    """Whether items are cut at the container's line."""
    if recipe.photos is None or recipe.photos.edge != "crop":
        return False
    others = {
        "words are read whole; use --edge inside": recipe.words is not None,
        "needs a container's edge, and a tile has none; use --edge inside": recipe.tile is not None,
        "needs --finish exact: the cut is certified": recipe.finish != "exact",
        "enlarges photos at the edge; use --sizes free": recipe.sizes != "free",
        "has no --picture; use --edge inside": recipe.picture is not None,
        "cannot go on from an earlier layout; leave out --start FILE": (
            recipe.layout_file is not None
        ),
    }
    for why, is_so in others.items():
        if is_so:
            raise RecipeError("edge", f"crop {why}")
    return True


def with_room(job: Job, share: float) -> tuple[Job, float]:
    """The job in a container grown all round by a share of a typical item, and by how much.

    The canvas grows as much, so all lies that much further right and down.
    """
    container = job.container
    check_padding(container, job.plan.gap, len(job.items))
    outline = container.outline
    depth = share * float(np.sqrt(outline.area / max(len(job.items), 1)))
    grown = Outline.from_region(buffered(outline.region, depth, join_style="mitre", mitre_limit=2))
    into = affine.similarity(depth, depth, 0.0, 1.0)
    room = replace(
        container,
        outline=grown.mapped(into),
        width=container.width + 2 * depth,
        height=container.height + 2 * depth,
        backdrop=None,
        walls=None,
    )
    regions = tuple(
        replace(one, zone=replace(one.zone, outline=one.zone.outline.mapped(into)))
        for one in job.regions
    )
    asked = tuple(_moved(one, container, depth) for one in job.asked)
    plan = replace(
        job.plan,
        size_ratio=min(job.plan.size_ratio, EVEN_RATIO),
        # Shares of a canvas are lengths of this one.
        gap=job.recipe.padding_cu(room),
        voids=void_plan(job.recipe, room) if job.plan.voids.fills else NO_VOIDS,
    )
    return replace(job, plan=plan, container=room, regions=regions, asked=asked), depth


def _moved(one: ItemRules, container: Container, depth: float) -> ItemRules:
    wholes = {"x": container.width, "y": container.height, "size": container.side}
    pin = dict(one.pin)
    for key in wholes.keys() & pin.keys():
        length = parse_length(str(pin[key]), container.unit, wholes[key])
        pin[key] = length if key == "size" else length + depth
    return replace(one, pin=pin)


class Back:
    """Passes steps on as they lie on the canvas that was asked for."""

    def __init__(self, observer: Observer, depth: float) -> None:
        self.every = observer.every
        self._observer, self._depth = observer, depth

    def on_step(self, step: Step) -> None:
        """Tell of a step."""
        self._observer.on_step(replace(step, poses=_back(step.poses, self._depth)))


def _back(poses: Poses, depth: float) -> Poses:
    return replace(poses, x=poses.x - depth, y=poses.y - depth)


def cropped(asked: Job, placed: Job, poses: Poses, largest: FloatArray, depth: float) -> Cropped:
    """Items of a grown container, fillers among them, cut at the line of the one asked for."""
    container = asked.container
    gap = asked.plan.gap + CLEARANCE * container.side
    window = buffered(container.outline.region, -gap, join_style="mitre")
    poses = spread_to(
        window,
        [item.outline for item in placed.items],
        _back(poses, depth),
        largest,
        np.array([not (one.pin or one.values.keys() & _HELD) for one in placed.asked]),
        gap,
        LEAST_SEEN,
    )
    cuts: dict[int, Cut] = {}
    for k, item in enumerate(placed.items):
        whole = item.outline.mapped(poses.matrix(k))
        if window.covers(whole.region):
            cuts[k] = Cut(item, (0.0, 0.0), 1.0)
            continue
        found = cut(item, poses.matrix(k), window, f"edge-{k + 1}")
        if found is not None and found.share >= LEAST_SEEN:
            cuts[k] = found
    gone = sorted(set(range(len(placed.items))) - cuts.keys())
    kept = np.setdiff1d(np.arange(len(placed.items)), gone)
    job = placed.subset(kept)
    centres = np.reshape([cuts[int(k)].centre for k in kept], (-1, 2))
    job = replace(
        job,
        plan=asked.plan,
        container=container,
        regions=asked.regions,
        items=tuple(cuts[int(k)].item for k in kept),
    )
    rows = numbers_of(poses.subset(kept))[None]
    return Cropped(job, poses_of(_recentred(rows, centres)[0]), kept, centres, _back(poses, -depth))


def followed(track: Track, found: Cropped, which: IntArray, depth: float) -> Track:
    """Track of whole items as that of what is seen of them; ``which`` ``(m,)`` of those kept."""
    numbers = track.numbers.copy()
    numbers[:, :, :2] -= depth
    return Track(track.times, _recentred(numbers, found.centres[which]))


def _recentred(numbers: FloatArray, centres: FloatArray) -> FloatArray:
    """Numbers of poses of items whose origin has moved to ``centres``, which stay in place."""
    x, y, angle, scale, stretch = np.moveaxis(numbers, -1, 0)
    wide, high = scale * np.sqrt(stretch), scale / np.sqrt(stretch)
    right, down = wide * centres[:, 0], high * centres[:, 1]
    moved = numbers.copy()
    moved[:, :, 0] = x + np.cos(angle) * right - np.sin(angle) * down
    moved[:, :, 1] = y + np.sin(angle) * right + np.cos(angle) * down
    moved[:, :, SCALE] = scale
    return moved


Listed: TypeAlias = Callable[[Job], Sequence[RunStep]]
"""Steps that place the items of a job."""


@final
class CropAtEdge(RunStep):
    """Items that cover the container's edge, cut at its line; none is lost if that can be."""

    def __init__(self, job: Job, listed: Listed) -> None:
        self._listed = listed
        self.share = share_of(listed(job))

    def run(self, state: RunState, context: RunContext) -> RunState:
        """State of those items of which enough is seen."""
        job, tries = state.job, []
        for number, share in enumerate(DEPTHS):
            room, depth = with_room(job, share)
            # The number of tries is not known beforehand.
            turn = context.part(1 - ANOTHER_TRY**number, 1 - ANOTHER_TRY ** (number + 1))
            turn = replace(turn, observer=Back(turn.observer, depth))
            solved = run_steps(self._listed(room), RunState.of(room), turn)
            # Photos were placed at more even sizes than they may have: the rest is for the edge.
            is_bound = solved.limits.binds
            spare = 1.0 if is_bound else job.plan.size_ratio / room.plan.size_ratio
            found = cropped(job, solved.job, solved.poses, solved.largest * spare, depth)
            gone = lost(found, solved)
            tries.append((gone, solved, found, depth))
            if not gone or context.stop() or job.plan.seconds is not None:
                break
        gone, solved, found, depth = min(tries, key=lambda one: len(one[0]))
        recorder: Recorder | None = solved.recorder
        if recorder is not None:
            recorder = CutRecorder(recorder, found, solved.numbers, depth)
        return replace(
            solved,
            job=found.job,
            poses=found.poses,
            unplaced=gone,
            filling=refilled(solved, found),
            left_out=len(gone),
            numbers=solved.numbers[found.kept],
            recorder=recorder,
        )


class CutRecorder(Recorder):
    """Way of whole items, on a canvas grown by ``depth``, as that of what is seen of them."""

    def __init__(self, whole: Recorder, found: Cropped, numbers: IntArray, depth: float) -> None:
        super().__init__()
        self._whole, self._found, self._numbers, self._depth = whole, found, numbers, depth

    def track(
        self, poses: Poses, ids: IntArray | None = None, items: Sequence[Item] | None = None
    ) -> Track:
        """The way of those that are in the layout, called ``ids``."""
        found = self._found
        called = self._numbers[found.kept]
        which = np.arange(len(called)) if ids is None else np.flatnonzero(np.isin(called, ids))
        rows = found.kept[which]
        track = self._whole.track(found.whole.subset(rows), self._numbers[rows], items)
        return followed(track, found, which, self._depth)


@final
class AdviseOnEdge(RunStep):
    """Advice on a container's line much of which no photo covers, if more of them would do."""

    def run(self, state: RunState, context: RunContext) -> RunState:
        """State with the advice, unless there is one on the shape."""
        layout, _ = state.measured
        plan = state.job.plan
        needed = items_needed(layout.container, "free", plan.size_ratio).count
        is_told = any(said.sentence is Sentence.POOR_SHAPE for said in state.findings)
        if is_told or needed <= CLEARLY_MORE * len(layout.items):
            return state
        bare = bare_edge(layout, plan.gap)
        if bare <= MOST_BARE_EDGE:
            return state
        return state.with_finding(Sentence.BARE_EDGE, percent=100 * bare, count=needed)


def bare_edge(layout: Layout, gap: float) -> float:
    """Share of the container's line that has no item within the gap and a little more."""
    container = layout.container
    reach = gap + EDGE_REACH * container.side
    line = container.outline.region.boundary
    near = union([buffered(outline.region, reach) for outline in layout.outlines])
    return 1.0 - float(intersection(line, near).length / line.length)


def lost(found: Cropped, placed: RunState) -> tuple[Unplaced, ...]:
    """Items, fillers not among them, of which too little would be seen."""
    items, ids, given = placed.job.items, placed.numbers, len(placed.asked_for.items)
    gone = np.setdiff1d(np.arange(len(items)), found.kept)
    reason = "less than a third of it would lie in the container; --edge inside places it whole"
    return tuple(Unplaced(items[k].name, int(ids[k]), reason) for k in gone if ids[k] < given)


def refilled(placed: RunState, found: Cropped) -> Filling | None:
    """Report on filling voids, in the container that was asked for."""
    if placed.filling is None:
        return None
    areas = np.array([item.outline.area for item in found.job.items]) * found.poses.scale**2
    covered = float(areas.sum()) / found.job.container.outline.area
    added = int((placed.numbers[found.kept] >= len(placed.asked_for.items)).sum())
    return replace(placed.filling, added=added, covered=covered)
