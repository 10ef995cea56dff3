"""Bottom-left placement of true outlines: one after another to where it lies low and touches most.

On pixels, as in :mod:`packwork.start.first_fit.first_fit`, but of given sizes and for any height:
B. Baker, E. Coffman and R. Rivest, "Orthogonal packings in two dimensions", SIAM Journal on
Computing 9 (1980), 846-855, doi:10.1137/0209064, go down, then left; ours weighs how low a place
is against how much of what is round it is taken. From its place on pixels each goes down exactly,
as far as it is free, so that what pixels leave between items does not add up.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from typing import NamedTuple

import numpy as np

from packwork.arrays import BoolArray, FloatArray, IntArray
from packwork.compaction.arrangement import FINE, Detail
from packwork.compaction.kernels import distances, slide
from packwork.compaction.options import HAIR
from packwork.forces.forces import FieldForce
from packwork.geometry.affine import similarity
from packwork.geometry.outline import Outline
from packwork.progress import Stop
from packwork.raster.coverage import TOUCHED
from packwork.scene.container import Container
from packwork.scene.pose import Poses
from packwork.start.first_fit.first_fit import heights_on
from packwork.start.first_fit.occupancy import NOISE, REACH, Bits, Occupancy, Stencil, cut
from packwork.start.first_poses import container_image
from packwork.threads import at_once

SIDE_PX = 1_000
"""Pixels of the image's longer side, as far as ``LEAST_EACH`` and ``MOST_EACH`` allow. Tried."""

LEAST_EACH, MOST_EACH = 10.0, 28.0
"""Pixels of the side of the square of an item's mean area, at least and at most. More waste less
room at the edges of pixels and take longer. Tried."""

ROUGH = 0.02
"""Tolerance of the outlines that go down exactly, shares of an item's extent: that of the settling
that follows."""

AWAY = 1e3
"""Where items wait, in sides of the container's box: far from all others. Chosen."""

STEP, HALVINGS = 0.1, 3
"""First step on the way down from a place on pixels, sides of an item's square, and how often it is
halved. Tried."""

WAYS = np.array(
    [(aside, turn) for aside in (0.0, 0.8, -0.8, 1.2, -1.2) for turn in (0.0, 1.0, -1.0)]
)
"""Steps that are tried in this order: rad off the way down, and turns. Tried."""

STRAIGHT = WAYS[WAYS[:, 1] == 0.0]
"""Those that keep the angle."""

PULL = 1.0
"""Score, of 1 for a place that touches others all round, for lying lower by the side of an item's
square. Larger packs looser, smaller lets towers grow along walls. Tried."""


@dataclass(frozen=True, eq=False)
class Falling:
    """Items that are put one after another.

    ``angles``: for each item those that it may have, radians; the same ones are drawn once.
    ``order``: ``(n,)`` indices of items, in which they come.
    ``fields``: forces whose heights count.
    """

    outlines: Sequence[Outline]
    scales: FloatArray
    angles: Sequence[FloatArray]
    order: IntArray
    fields: Sequence[FieldForce]
    margin_cu: float
    is_free: BoolArray
    """``(n,)`` which may have any angle, and so turn on their way down."""

    @property
    def side(self) -> float:
        """Side of the square of an item's mean area, canvas units."""
        return math.sqrt(float(np.mean([one.area for one in self.outlines] * self.scales**2)))


def lowest_fit(
    container: Container, falling: Falling, rng: np.random.Generator, stop: Stop
) -> tuple[Poses, IntArray]:
    """Poses at which nothing overlaps, and the items ``(m,)`` that found a place, as they came."""
    board = FallingBoard(container, falling, rng)
    found = list[int]()
    for item in falling.order:
        if stop():
            break
        place = board.best(int(item), board.rows()) or board.best(int(item))
        if place is not None:
            board.take(int(item), place)
            found.append(int(item))
    return board.poses, np.array(found, dtype=np.int64)


class FreePlace(NamedTuple):
    """Free place of an item: its score, the corner of its box on the image, and its angle."""

    score: float
    row: int
    column: int
    angle: float


class _Exact:
    """Outlines of what lies on a board, among which one more goes down as far as it is free."""

    def __init__(
        self, container: Outline, falling: Falling, corner_cu: tuple[float, float]
    ) -> None:
        count = len(falling.scales)
        self._falling, self._corner = falling, np.array(corner_cu)
        x, y, angle = np.zeros((3, count))
        poses = Poses(x, y, angle, falling.scales)
        detail = Detail(falling.outlines, container, poses).covers(FINE).covers(ROUGH)
        left, top, right, bottom = container.bounds
        # All wait far away.
        places = np.tile([left - AWAY * (right - left + bottom - top), 0.0, 0.0, 0.0], (count, 1))
        self._board = detail.arrangement(places).board
        areas = [one.area for one in falling.outlines] * falling.scales**2
        self._step = STEP * math.sqrt(float(np.mean(areas)))
        # Without a gap nothing would be too near.
        self._gap = max(2 * falling.margin_cu, HAIR * self._step)

    def slid(self, item: int, place: FloatArray) -> FloatArray:
        """``(3,)`` x, y and angle of an item that went down from such a place, which is free."""
        point, one = (place[:2] + self._corner)[None], np.array([item])
        distances.put(self._board, one, np.append(place, 0.0)[None])
        slopes = [
            force.strengths[item] * force.field(point)[1][0] for force in self._falling.fields
        ]
        slope = np.sum(slopes, axis=0) if slopes else np.zeros(2)
        if slope.any():
            down = -slope / np.hypot(*slope)
            ways = WAYS if self._falling.is_free[item] else STRAIGHT
            slide.slide(self._board, one, down, ways, self._step, HALVINGS, self._gap)
        return self._board.places[item, :3].copy()


class FallingBoard:
    """A container as pixels, and the poses of what lies on it.

    ``corner_cu``: point of the canvas in the image's top left corner; the container is moved there.
    """

    def __init__(
        self,
        container: Container,
        falling: Falling,
        rng: np.random.Generator,
        corner_cu: tuple[float, float] = (0.0, 0.0),
    ) -> None:
        self._falling, self._corner = falling, corner_cu
        scales, fields = falling.scales, falling.fields
        each = falling.side
        px_each = np.clip(SIDE_PX / container.side * each, LEAST_EACH, MOST_EACH)
        self.resolution = math.ceil(px_each / each * container.side)
        image, self.px_per_cu = container_image(container, self.resolution)
        inside: BoolArray = image > 1 - TOUCHED
        self.occupancy = Occupancy(inside, REACH)
        self._noise = NOISE * rng.random(image.shape)
        unit = container.side / each
        heights = heights_on(fields, image.shape, self.px_per_cu, corner_cu)
        self._heights = [unit * one for one in heights]
        self._strongest = max((float(np.abs(one.strengths).max()) for one in fields), default=1.0)
        self._exact = _Exact(container.outline, falling, corner_cu)
        self._stencils: dict[tuple[Outline, float, float], Stencil] = {}
        self._full = set[tuple[Outline, float]]()
        self._pulls, self._worth = np.zeros(len(fields)), self._noise
        x, y, angle = np.zeros((3, len(scales)))
        self.poses = Poses(x, y, angle, scales)
        self._reach = float(np.max([one.radius for one in falling.outlines] * scales)) / each
        self._reach_px = math.ceil(self._reach * each * self.px_per_cu)
        # Of one force on all alike, no place far above all that lies is the best.
        self._row_heights = None
        if len(fields) == 1 and fields[0].strengths.min() == self._strongest:
            self._row_heights = np.where(inside, self._heights[0], np.inf).min(axis=1)
            self._top = float(self._row_heights.min())

    def best(
        self,
        item: int,
        rows: tuple[int, int] | None = None,
        keep: Callable[[Stencil, Bits], None] | None = None,
    ) -> FreePlace | None:
        """Best free place of an item; None if it has none.

        ``rows``, ``keep``: as of :meth:`Occupancy.best_place`.
        """
        kind = self._falling.outlines[item], float(self._falling.scales[item])
        if kind in self._full:
            return None
        angles = self._falling.angles[item].tolist()
        look = partial(self.occupancy.best_place, worth=self.worth(item), rows=rows, keep=keep)
        places = at_once(look, [(self.stencil(item, angle),) for angle in angles])
        found = [FreePlace(*p, a) for p, a in zip(places, angles, strict=True) if p is not None]
        if rows is None and not found:
            self._full.add(kind)
        return max(found, default=None)

    def worth(self, item: int) -> FloatArray:
        """``(rows, columns)`` what it is worth to an item that its origin comes to a pixel."""
        pulls = np.array([one.strengths[item] for one in self._falling.fields])
        if (pulls != self._pulls).any():
            drawn = PULL / self._strongest * pulls
            self._pulls, self._worth = pulls, self._noise - np.tensordot(drawn, self._heights, 1)
        return self._worth

    def take(self, item: int, place: FreePlace) -> None:
        """Put an item to its place, and from there as far down as it is free."""
        x, y, angle = self._exact.slid(item, self.origin(item, place))
        column, row = math.floor(x * self.px_per_cu), math.floor(y * self.px_per_cu)
        off_px = x * self.px_per_cu - column, y * self.px_per_cu - row
        stencil = self._cut(item, angle, off_px)
        self.occupancy.take(stencil.mask, row - stencil.origin[0], column - stencil.origin[1])
        self.poses.x[item], self.poses.y[item] = x + self._corner[0], y + self._corner[1]
        self.poses.angle[item] = angle
        if self._row_heights is not None:
            rows, columns = self._heights[0].shape
            here = self._heights[0][min(max(row, 0), rows - 1), min(max(column, 0), columns - 1)]
            self._top = max(self._top, float(here))

    def origin(self, item: int, place: FreePlace) -> FloatArray:
        """``(3,)`` x and y on the image, canvas units, of an item at a place, and its angle."""
        origin = self.stencil(item, place.angle).origin
        corner = np.array([place.column + origin[1], place.row + origin[0]])
        return np.append(corner / self.px_per_cu, place.angle)

    def rows(self) -> tuple[int, int] | None:
        """Rows of pixels in which an item can touch what lies there; None for all."""
        if self._row_heights is None:
            return None
        near = np.flatnonzero(self._row_heights <= self._top + 2.0 * self._reach)
        first, last = int(near[0]) - self._reach_px, int(near[-1]) + self._reach_px
        return max(first, 0), min(last + 1, len(self._row_heights))

    def stencil(self, item: int, angle: float) -> Stencil:
        """Pixels that an item takes at an angle; cut once."""
        key = self._falling.outlines[item], float(self._falling.scales[item]), float(angle)
        if key not in self._stencils:
            self._stencils[key] = self._cut(item, angle)
        return self._stencils[key]

    def _cut(self, item: int, angle: float, off_px: tuple[float, float] = (0.0, 0.0)) -> Stencil:
        scale = float(self._falling.scales[item]) * self.px_per_cu
        posed = self._falling.outlines[item].mapped(similarity(*off_px, angle, scale))
        return cut(posed, REACH, self._falling.margin_cu * self.px_per_cu)
