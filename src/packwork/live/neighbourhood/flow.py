"""Flow: epochs of the solver from where a layout is, on those items alone that a gesture reaches.

The levels of a run (Wang and Lu 2025, see :mod:`packwork.solve.solver`) on a part of the items:
all others stand still, and are taken off the room that there is to fill.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
import shapely

from packwork.arrays import BoolArray, IntArray
from packwork.geometry.outline import Outline
from packwork.geometry.overlay import prepared, valid
from packwork.live.document import Document
from packwork.live.neighbourhood.allowance import ranges
from packwork.live.neighbourhood.caches import LevelCache
from packwork.live.neighbourhood.contacts import RINGS, ContactGraph, others_near
from packwork.raster.coverage import Rasteriser
from packwork.scene.pose import Limits, Poses
from packwork.solve.free_space import FreeSpace
from packwork.solve.level import Level, RepeatingLevel
from packwork.solve.motion import Motion
from packwork.solve.options import ImageLossFunction, SolveOptions
from packwork.solve.outlines import Ensemble

FADE = 0.6
"""Factor on the steps of an item for each ring that it is away. Larger moves far items more,
smaller leaves all to the nearest. Chosen."""

LINGER = 60
"""Epochs that an item goes on after the last gesture was near, and before a settle: what lies under
what was dropped has to get out of its way. Fewer leave gaps and more to be shrunk, more stir long
trails. Tried."""

REVIEW = 5
"""Epochs after which it is looked anew which items are reached. More are faster and react later.
Chosen."""

PIXELS = 12.0
"""Pixels across the usual item at the level at which something is moved. Larger is finer and
slower. Chosen."""

FINER = 1.6
"""The same over that, in the last of the epochs after a gesture. Chosen."""

CALM_SHARE = 0.5
"""Share of :data:`LINGER` that is left from which on it is finer. Chosen."""

COARSEST, FINEST = 100, 800
"""Levels at which flow works, px on the longer side. Chosen."""

RUNGS = 3
"""Levels to a factor of two. More fit the items better, and each has to be made first. Chosen."""

SIZE_STEP = 0.008
"""Longest change of the logarithm of size in an epoch. Larger shrinks what is only passed by.
Tried."""

STEP = 0.06
"""Longest move in an epoch, in sides of the square that has the usual item's area. Larger gets
faster out of the way and trembles: with 0.12 ten times as often, and covers no more. Tried."""

UNSEEN_STEP = 0.12
"""The same in a settle, of which no frame is shown. Shorter makes more smaller. Tried."""

CALMEST = 0.1
"""Factor on steps in the last of those epochs: items come to rest. Larger trembles, smaller gets
nowhere. Chosen."""

WEIGHTS: Mapping[str | ImageLossFunction, float] = {
    "containment": 12.0, "overlap": 12.0, "filling": 1.0
}  # fmt: skip
"""Of the losses. With 200 in place of 12 a gesture among 100 icons costs 1.4 % of the coverage,
with 60 1.1 %, with 20 and 8 0.8 to 0.9 %: what shrinks at once does not grow back. Tried."""

HARDENING = 3.0
"""By how much losses but filling grow before a settle. Larger shrinks more, smaller leaves more
overlap. Tried."""

RECALL = 12.0
"""Weight of what calls items back into the container; as above."""


class Flow:
    """The present document, with buffers and moments of the solver between the frames of a session.

    Nothing that takes long is done before :meth:`begin`.
    """

    def __init__(self, document: Document, levels: LevelCache | None = None) -> None:
        self.document = document
        """As it is now: its poses are those that the flow moves."""
        self._levels = levels or LevelCache()
        self._contacts: ContactGraph | None = None
        self._region = document.container
        self._reset(document.held)

    @property
    def is_begun(self) -> bool:
        """Whether anything has been touched."""
        return self._contacts is not None

    @property
    def contacts(self) -> ContactGraph:
        """Contact graph of the items, as of the last :meth:`review`."""
        if self._contacts is None:
            raise AssertionError("a flow begins before its neighbours are asked for")
        return self._contacts

    def begin(self, held: BoolArray | None = None) -> None:
        """Have the neighbours known, unless they are; ``held`` as for :meth:`turn_to`."""
        if self._contacts is None:
            self._contacts = ContactGraph(self.document, self._levels)
            self.turn_to(self.document, self.document.held if held is None else held)

    def turn_to(self, document: Document, held: BoolArray) -> None:
        """Go on with another document; nothing moves until something is activated.

        ``held``: ``(n, 3)`` what of each item no epoch changes, as :attr:`Document.held`.
        """
        self.document = document
        if self._contacts is not None:
            self._contacts = self._contacts.turned_to(document)
            self._region = self._levels.region(document.container, document.options.padding)
        self._reset(held)

    def _reset(self, held: BoolArray) -> None:
        count, document = len(self.document), self.document
        self._strict = held
        self._scale = document.poses.scale
        self._left = np.zeros(count, dtype=np.int64)
        self._given: IntArray = np.zeros(0, dtype=np.int64)
        self._active: IntArray = np.zeros(0, dtype=np.int64)
        self._working: tuple[Level, Motion] | None = None
        self._is_ahead = False
        self._is_held: BoolArray = np.zeros((0, 3), dtype=bool)
        self._since = 0
        self._hardness = 1.0
        self._may: IntArray | None = None
        self._ring: IntArray = np.zeros(count, dtype=np.int64)
        side = document.container.side
        self._share = float(np.sqrt(np.median(document.areas))) if count else side
        stretch = np.sqrt(document.poses.stretch)
        radii = np.array([item.outline.radius for item in document.items])
        self._radii = radii * np.maximum(stretch, 1 / stretch)
        self.moved: BoolArray = np.zeros(count, dtype=bool)
        """``(n,)`` which items were given other places, or have flowed, since the last turn."""

    @property
    def resolution(self) -> int:
        """Pixels of the level: the usual item is resolved, finer once nothing is moved."""
        is_calm = 0 < int(self._left.max(initial=0)) <= LINGER * CALM_SHARE
        return self._rung(FINER if is_calm and self._may is None else 1.0)

    @property
    def _step(self) -> float:
        """Longest move in an epoch, canvas units."""
        return (STEP if self._may is None else UNSEEN_STEP) * self._share

    def _rung(self, finer: float) -> int:
        """Pixels of a level so many times finer than the usual one, or about that."""
        pixels = finer * PIXELS * self.document.container.side / self._share
        # What a level sees is kept: few levels are made anew.
        rung = round(RUNGS * np.log2(max(pixels, 1.0) / COARSEST))
        return int(np.clip(round(COARSEST * 2 ** (rung / RUNGS)), COARSEST, FINEST))

    def make_ready(self) -> None:
        """Have levels seen before the hand comes: nothing that is asked for depends on it."""
        self.begin()
        for finer in (1.0, FINER):
            resolution = self._rung(finer)
            self._levels.free_space(self._region, resolution)
            self._seen_of(np.arange(len(self.document)), resolution)

    @property
    def is_at_rest(self) -> bool:
        """Whether nothing would move."""
        return not self._left.any()

    def make_way(self, items: IntArray) -> None:
        """Have items ``(m,)`` stay where the document has them by now: the others make room."""
        is_known, poses = np.array_equal(items, self._given), self.document.poses
        self._given = items
        self.moved[items] = True
        self.contacts.follow(items, poses)
        _, mine, theirs = np.intersect1d(items, self._active, return_indices=True)
        if is_known and self._working is not None and len(mine) == len(items):
            self._working[1].put(theirs, poses.subset(items[mine]))
        else:
            self._since = REVIEW
        self._reach(items, RINGS, LINGER)

    def hold(self, items: IntArray) -> None:
        """Keep items ``(m,)`` where they are, and no others: what the hand has put there."""
        self._given = items
        self._since = REVIEW

    def activate(self, items: IntArray) -> None:
        """Let items ``(m,)`` flow, and those beside them."""
        self._reach(items, 1, LINGER)
        self._since = REVIEW

    def project_inside(self, items: IntArray) -> None:
        """Put those of items ``(m,)`` whose middles lie outside to the nearest place inside."""
        region = prepared(valid(self._region.outline.region))
        poses = self.document.poses
        x, y = poses.x.copy(), poses.y.copy()
        for k in items:
            if self._strict[k, 0] or shapely.intersects_xy(region, x[k], y[k]):
                continue
            way = shapely.shortest_line(region, shapely.Point(x[k], y[k]))
            x[k], y[k] = shapely.get_coordinates(way)[0]
            self.moved[k] = True
        self.document = self.document.with_poses(replace(poses, x=x, y=y))
        self.contacts.follow(items, self.document.poses)
        self._since = REVIEW

    def set_rules(self, document: Document, held: BoolArray) -> None:
        """Go on with other rules, names or colours, of the same outlines; ``held`` as above."""
        now, ruling = self.document, ("smallest", "largest", "options")
        are_same = all(getattr(document, name) is getattr(now, name) for name in ruling)
        if not are_same or not np.array_equal(held, self._strict):
            self._since = REVIEW
        self.document, self._strict = document, held

    def review(self) -> None:
        """Bring the neighbours up to date."""
        self.contacts.follow(np.flatnonzero(self.moved), self.document.poses)

    def run(self, epochs: int, resolution: int | None = None) -> None:
        """Run some epochs; at rest none does anything."""
        resolution = resolution or self.resolution
        for _ in range(epochs):
            self._epoch(resolution)
        self._write_back()

    def raise_overlap_weight(self, epochs: int, items: IntArray) -> None:
        """Run some epochs of items ``(m,)`` in which overlap counts ever more, as a run's last."""
        self._left[:] = 0
        self._left[items] = epochs
        self._may = items
        self._since = LINGER
        resolution = self.resolution
        for done in range(epochs):
            self._hardness = HARDENING ** (done / epochs)
            self._epoch(resolution)
        self._write_back()
        self._hardness, self._may = 1.0, None

    def bring_in(self) -> None:
        """Have all lie on the canvas: of what repeats, in its cell."""
        poses = self.document.container.brought_in(self.document.poses)
        if poses is not self.document.poses:
            self.document, self._working = self.document.with_poses(poses), None

    def put_back(self, items: IntArray, poses: Poses) -> None:
        """Have items ``(m,)`` be where they were before they flowed; ``poses`` of these."""
        document = self.document
        self.document = document.with_poses(document.poses.with_some(items, poses))
        self.moved[items] = False
        self._left[items] = 0
        self.contacts.follow(items, self.document.poses)
        self._since = REVIEW

    def _epoch(self, resolution: int) -> None:
        """Move what is active a step; the document is told by :meth:`_write_back`."""
        if self.is_at_rest:
            return
        working = self._working
        is_due = self._since >= (REVIEW if self._may is None else LINGER)
        if working is None or working[0].resolution != resolution or is_due:
            working = self._rebuilt(resolution)
        level, motion = working
        weights = {k: w if k == "filling" else w * self._hardness for k, w in WEIGHTS.items()}
        weights["evenness"] = self.document.options.evenness
        gradient = level.gradient(motion.poses, weights, RECALL * self._hardness)
        motion.follow(gradient, max(int(self._left.max()) / LINGER, CALMEST))
        self._since += 1
        self._left = np.maximum(self._left - 1, 0)
        self._is_ahead = True

    def _write_back(self) -> None:
        """Give the document the poses to which epochs have moved its items."""
        if self._is_ahead and self._working is not None:
            self.document = self.document.with_poses(self._kept(self._working[1].poses))
        self._is_ahead = False

    def _kept(self, moved: Poses) -> Poses:
        """All poses after those that are active have moved; what is held, bit for bit as it was."""
        active, held, poses = self._active, self._is_held, self.document.poses
        before = poses.subset(active)
        columns = {"x": held[:, 0], "y": held[:, 0], "angle": held[:, 1], "scale": held[:, 2]}
        kept = {n: np.where(m, getattr(before, n), getattr(moved, n)) for n, m in columns.items()}
        return poses.with_some(active, replace(before, **kept))

    def _reach(self, items: IntArray, most: int, left: int) -> None:
        """Have what is within some rings of items ``(m,)`` go on for so many epochs at least."""
        if len(self._active):
            self.contacts.follow(self._active, self.document.poses)
        found = self.contacts.rings(items, most)
        self._ring = np.where(reached := found >= 0, found, self._ring)
        self._left[reached] = np.maximum(self._left[reached], left)

    def _rebuilt(self, resolution: int) -> tuple[Level, Motion]:
        self._write_back()
        self._since = 0
        if len(self._given) and self._may is None:
            self._reach(self._given, RINGS, int(self._left.max()))
        before, was, document = self._working, self._active, self.document
        active = np.flatnonzero(self._left)
        if self._may is not None:
            active = np.intersect1d(active, self._may)
        self._active = active
        held = self._strict[active] | np.isin(active, self._given)[:, None]
        # What may not move is a wall to a settle: turned or sized here, it could not be mended.
        self._is_held = held | held[:, :1]
        some, side = document.poses.subset(active), document.container.side
        level = self._level(active, resolution)
        motion = Motion(some, some.scale, side, self._options(), self._limits(active))
        motion.pace = FADE ** self._ring[active].astype(np.float64)
        if before is not None:
            _, mine, theirs = np.intersect1d(active, was, return_indices=True)
            motion.copy_moments(before[1], mine, theirs)
        self.moved[active] = True
        self._working = (level, motion)
        return self._working

    def _seen_of(self, items: IntArray, resolution: int) -> list[Outline]:
        document = self.document
        outlines = [document.items[k].outline for k in items]
        px_per_cu, margin = resolution / document.container.side, document.options.padding / 2
        return self._levels.outlines(outlines, document.poses.subset(items), px_per_cu, margin)

    def _level(self, active: IntArray, resolution: int) -> Level:
        """Level of items that are active, in the room that those which stand still leave free."""
        document = self.document
        container, seen = document.container, self._seen_of(active, resolution)
        if (lattice := container.lattice) is None:
            return Level(container, seen, resolution, free_space=self._room(active, resolution))
        still = np.setdiff1d(np.arange(len(document)), active)
        stood = self._seen_of(still, resolution)
        outlines = self._seen_of(np.arange(len(document)), resolution)
        radii = np.array([outline.radius for outline in outlines]) * document.poses.scale
        largest = float(radii.max())
        standing = RepeatingLevel(container, lattice, stood, resolution, largest)
        taken = standing.density(document.poses.subset(still)) if len(still) else None
        return RepeatingLevel(container, lattice, seen, resolution, largest, taken=taken)

    def _room(self, active: IntArray, resolution: int) -> FreeSpace:
        """Room that the items that stand still leave free."""
        free_space = self._levels.free_space(self._region, resolution)
        if len(still := self._met(active)) == 0:
            return free_space
        ensemble = Ensemble(self._seen_of(still, resolution))
        rasteriser = Rasteriser(free_space.room.shape)
        poses = self.document.poses.subset(still)
        points = ensemble.place(poses, resolution / self.document.container.side)
        rasteriser.sweep(points, ensemble.ring_starts)
        return free_space.less(rasteriser.density())

    def _met(self, active: IntArray) -> IntArray:
        """Items that stand still and what is active may meet till the next review, ``(m,)``."""
        document, epochs = self.document, REVIEW if self._may is None else LINGER
        moved = epochs * self._step + document.options.padding
        # Evenness sees gaps at any distance.
        margin = np.inf if document.options.evenness else moved
        radii = self._radii * document.poses.scale * np.exp(SIZE_STEP * epochs)
        return others_near(document.poses, radii, active, margin)

    def _limits(self, active: IntArray) -> Limits:
        document, held = self.document, self._is_held
        some = document.poses.subset(active)
        turns = document.options.rotation.farthest
        bounds = document.smallest[active], document.largest[active]
        smallest, largest = ranges(self._scale[active], self._ring[active])
        smallest, largest = np.clip(smallest, *bounds), np.clip(largest, *bounds)
        return replace(
            Limits.free(len(active)),
            x=np.where(held[:, 0], some.x, np.nan),
            y=np.where(held[:, 0], some.y, np.nan),
            angle=np.where(held[:, 1], some.angle, np.nan),
            turn_limit=np.where(held[:, 1], np.inf, np.maximum(turns, np.abs(some.angle))),
            smallest=np.where(held[:, 2], some.scale, np.minimum(smallest, some.scale)),
            largest=np.where(held[:, 2], some.scale, np.maximum(largest, some.scale)),
        )

    def _options(self) -> SolveOptions:
        options = self.document.options
        return SolveOptions(
            sizes="free" if options.sizes == "free" else "fixed",
            size_ratio=100,
            turn_rate=0.08 if options.turns else 0.0,
            position_rate=min(self._step / self.document.container.side, 1.0),
            size_rate=SIZE_STEP,
            margin=options.padding / 2,
        )
