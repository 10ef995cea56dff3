"""Bottom-left placement of true outlines: one after another to where it lies low and touches most.

On pixels, as in :mod:`packwork.start.first_fit.first_fit`, but of given sizes and for any height:
B. Baker, E. Coffman and R. Rivest, "Orthogonal packings in two dimensions", SIAM Journal on
Computing 9 (1980), 846-855, doi:10.1137/0209064, go down, then left; ours weighs how low a place
is against how much of what is round it is taken.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from packwork.arrays import BoolArray, FloatArray, IntArray
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

SIDE_PX = 1_000
"""Pixels of the image's longer side, as far as ``LEAST_EACH`` and ``MOST_EACH`` allow. Tried."""

LEAST_EACH, MOST_EACH = 10.0, 28.0
"""Pixels of the side of the square of an item's mean area, at least and at most. More waste less
room at the edges of pixels and take longer. Tried."""

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


class Place(NamedTuple):
    """Free place of an item: its score, the corner of its box on the image, and its angle."""

    score: float
    row: int
    column: int
    angle: float


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
        each = math.sqrt(float(np.mean([one.area for one in falling.outlines] * scales**2)))
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
    ) -> Place | None:
        """Where an item lies best; None if nowhere.

        ``rows``, ``keep``: as of :meth:`Occupancy.best_place`.
        """
        kind = self._falling.outlines[item], float(self._falling.scales[item])
        if kind in self._full:
            return None
        found, worth = [], self.worth(item)
        for angle in self._falling.angles[item]:
            stencil = self.stencil(item, angle)
            place = self.occupancy.best_place(stencil, worth, rows=rows, keep=keep)
            if place is not None:
                found.append(Place(*place, float(angle)))
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

    def take(self, item: int, place: Place) -> None:
        """Put an item to its place."""
        stencil = self.stencil(item, place.angle)
        self.occupancy.take(stencil.mask, place.row, place.column)
        y, x = place.row + stencil.origin[0], place.column + stencil.origin[1]
        self.poses.x[item] = x / self.px_per_cu + self._corner[0]
        self.poses.y[item] = y / self.px_per_cu + self._corner[1]
        self.poses.angle[item] = place.angle
        if self._row_heights is not None:
            rows, columns = self._heights[0].shape
            here = self._heights[0][min(max(y, 0), rows - 1), min(max(x, 0), columns - 1)]
            self._top = max(self._top, float(here))

    def rows(self) -> tuple[int, int] | None:
        """Rows of pixels in which an item can touch what lies there; None for all."""
        if self._row_heights is None:
            return None
        near = np.flatnonzero(self._row_heights <= self._top + 2.0 * self._reach)
        first, last = int(near[0]) - self._reach_px, int(near[-1]) + self._reach_px
        return max(first, 0), min(last + 1, len(self._row_heights))

    def stencil(self, item: int, angle: float) -> Stencil:
        """Pixels that an item takes at an angle; cut once."""
        outline, scale = self._falling.outlines[item], float(self._falling.scales[item])
        key = outline, scale, float(angle)
        if key not in self._stencils:
            posed = outline.mapped(similarity(0.0, 0.0, key[2], scale * self.px_per_cu))
            margin_px = self._falling.margin_cu * self.px_per_cu
            self._stencils[key] = cut(posed, REACH, margin_px)
        return self._stencils[key]
