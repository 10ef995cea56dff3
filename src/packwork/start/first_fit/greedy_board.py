"""The image on which items are put one after another, each as large as it finds a place.

Looks at all places at once, on rows of bits, and takes the best: large items where the
container is wide, all others where they touch most of what is there already.
"""

from __future__ import annotations

import copy
import math
from collections.abc import Hashable, Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from packwork.arrays import BoolArray, FloatArray, IntArray
from packwork.fields.distance_transform import distance_inside, distance_to
from packwork.geometry.affine import similarity
from packwork.geometry.outline import Outline
from packwork.raster.coverage import TOUCHED
from packwork.scene.container import Container
from packwork.start.first_fit.kernels import row_bits
from packwork.start.first_fit.occupancy import (
    NOISE,
    REACH,
    Bits,
    NearestTaken,
    Occupancy,
    Stencil,
    covered,
    stencil_of,
)
from packwork.start.first_poses import container_image

PoseRow: TypeAlias = tuple[float, float, float, float]
"""x, y, angle, scale."""

PIXELS_EACH = 45
"""Pixels of the image's side for each item of a row of them. More waste less room between items and
take longer. Tried."""

LEAST_PX, MOST_PX = 700, 1_000
"""Sides of that image at least and at most. As above."""

CORNER = math.sqrt(0.5)
"""Pixels from the centre of one to its corner."""

GRAZED = 0.05
"""Pixels that an outline may reach into one that it does not count as touching, at its corners.
Derived from ``TOUCHED``: the leg of a right angle of that area."""

INWARD = 0.6
"""Score, beside the touched share of 0 to 1, for lying where the container is widest, of an item
of the first one's size while nothing lies there; less by as much as an item is smaller, and
as more is covered. Larger heaps large ones in the middle, smaller puts them at the edge. By eye."""

WIDE = 0.9
"""Clearance, as a share of the largest, from which on a place is one of the widest. Chosen."""

COVERED = 0.5
"""Share of the container, margins taken in, from which on nothing is drawn inwards. Chosen."""

DRAWN = 0.1
"""Such score from which places are judged that touch nothing, too. Smaller takes longer. Chosen."""

ROOMY = 2.0
"""Score of the place with most room for such items; what they touch, of 0 to 1, then says little.
Tried."""

FAR = 0.03
"""Distance from every item, as a share of the container's longer side, from which on a place is
bare: items that go where there is room go there first. As ``metrics`` count it."""


@dataclass(frozen=True, eq=False)
class Candidate:
    """An item that is to be put next.

    ``outline``: item units.
    ``step``: how many times the scale that the one before had, or might have had where it found no
    place, it may have; of the first, its scale.
    ``angles``: that it may have, radians, the preferred ones first: of those at which it fits in
    one size, the first is taken.
    ``apart``: room that it keeps, along and across itself, from those that were put before it, in
    item units: beside the margin of all.
    ``kind``: what it is a copy of: of places at one size it takes those beside others of its kind
    last. None for nothing.
    """

    outline: Outline
    step: float
    angles: Sequence[float] = (0.0,)
    apart: tuple[float, float] = (0.0, 0.0)
    kind: Hashable = None


@dataclass(frozen=True, eq=False)
class BoardPlace:
    """A place on the board for a candidate.

    ``mask``, ``row``, ``column``: pixels that it takes, and where the first of them lies.
    ``pose``: canvas units.
    ``is_beside``: whether it stands beside another of its kind there.
    """

    mask: BoolArray
    row: int
    column: int
    pose: PoseRow
    kind: Hashable
    is_beside: bool


def image_side(count: int, least: int = LEAST_PX, most: int = MOST_PX) -> int:
    """Pixels of the image's longer side for so many items.

    Examples
    --------
    >>> image_side(1), image_side(400), image_side(4_000)
    (700, 900, 1000)
    """
    return min(max(round(PIXELS_EACH * math.sqrt(count)), least), most)


NONE: IntArray = np.empty((0, 4), dtype=np.int64)


class _Kin:
    """Copies of one kind, ``spans`` ``(n, 4)``: first row and end, first column and end."""

    is_met = False
    """Whether there were only places beside one of them."""

    def __init__(self, spans: IntArray) -> None:
        self._spans = spans

    def keep_off(self, stencil: Stencil, free: Bits) -> None:
        """Clear places that leave no room for a line before a copy, unless there are no others."""
        if len(self._spans):
            self.is_met = not row_bits.keep_off(self._spans, *stencil.mask.shape, free)


def _inwards(clearance: FloatArray) -> FloatArray:
    """Depth of each pixel, 0 to 1: 1 in the middle of where the container is widest.

    Half of it for the room there, half for being near that middle: a long container is as wide
    all along.
    """
    widest = max(float(clearance.max()), 1.0)
    wide = np.argwhere(clearance >= WIDE * clearance.max())
    middle = wide[np.argmin(np.linalg.norm(wide - wide.mean(axis=0), axis=1))]
    rows, columns = np.ogrid[: clearance.shape[0], : clearance.shape[1]]
    away = np.hypot(rows - middle[0], columns - middle[1])
    farthest = max(float(away[clearance > 0].max(initial=0.0)), 1.0)
    return np.asarray((clearance / widest + 1 - away / farthest) / 2)


class GreedyBoard:
    """The image on which items are put one after another.

    ``count``: about how many items there are: the more, the finer the image.
    ``margin_cu``: room that every item keeps from others and from the edge, canvas units.
    ``side_px``: pixels of the longer side of the image; by their number where it is not given.
    """

    is_loose = False
    """Whether items now go where there is most room."""

    def __init__(
        self,
        container: Container,
        count: int,
        rng: np.random.Generator,
        margin_cu: float,
        side_px: int | None = None,
    ) -> None:
        side = side_px or image_side(count)
        image, self._px_per_cu = container_image(container, side)
        # Each item has half of the margin round itself, and so has the edge.
        self._reach = margin_cu / 2 * self._px_per_cu + GRAZED
        clearance = distance_inside(image > 1 - TOUCHED)
        self._inward = _inwards(clearance)
        self._noise = NOISE * rng.random(image.shape)
        # From a pixel's centre to its corner; the edge lies beyond the pixels that are inside.
        self._free = clearance >= self._reach + CORNER
        self._occupancy = Occupancy(self._free, REACH)
        self._room = self._left = int(self._free.sum())
        self._first = 0.0
        self._kinds = dict[Hashable, IntArray]()
        far_px = FAR * container.outline.extent * self._px_per_cu
        self._bareness = Bareness(self._free, far_px)

    @property
    def left(self) -> float:
        """Area that nothing has taken, canvas units."""
        return self._left / self._px_per_cu**2

    def emptied(self) -> GreedyBoard:
        """The same image before anything was put on it."""
        other = copy.copy(self)
        other._occupancy = Occupancy(self._free, REACH)
        other._left, other._first, other.is_loose = self._room, 0.0, False
        other._bareness = self._bareness.emptied()
        other._kinds = {}
        return other

    def lay(self, outline: Outline, kind: Hashable = None) -> None:
        """Take what an item covers that lies in place."""
        posed = outline.mapped(similarity(0.0, 0.0, 0.0, self._px_per_cu))
        mask, origin = covered(posed, self._reach, is_quick=True)
        self._take(mask, -origin[0], -origin[1], kind)

    def find(self, candidate: Candidate, sizes: Sequence[float]) -> BoardPlace | None:
        """Place of an item at the largest size at which it finds one; None if at none.

        Steps down the sizes double until one fits; the one between is sought by halves.
        """
        low, high, found = -1, 0, None
        while found is None:
            if high >= len(sizes):
                return None
            found = self._place(candidate, sizes[high])
            if found is None:
                last = high == len(sizes) - 1
                low, high = high, len(sizes) if last else min(max(2 * high, 1), len(sizes) - 1)
        while high - low > 1:
            middle = (low + high) // 2
            larger = self._place(candidate, sizes[middle])
            if larger is None:
                low = middle
            else:
                found, high = larger, middle
        return found

    def put(self, place: BoardPlace) -> None:
        """Take a place that was found."""
        self._take(place.mask, place.row, place.column, place.kind)
        self._first = self._first or place.pose[3]

    def _place(self, candidate: Candidate, scale: float) -> BoardPlace | None:
        """Best place of an item of that scale, at the first of its angles that has one."""
        field, pull, is_everywhere = self._drawn(scale)
        for angle in candidate.angles:
            posed = candidate.outline.mapped(similarity(0.0, 0.0, angle, scale * self._px_per_cu))
            if self._is_larger(posed):
                continue
            mask, origin = covered(posed, self._reach, is_quick=True)
            wide = self._with_room(mask, origin, candidate.apart, scale, angle)
            kin = _Kin(self._kinds.get(candidate.kind, NONE))
            found = self._occupancy.best_place(
                wide, self._noise, is_everywhere, field, pull, keep=kin.keep_off
            )
            if found is not None:
                _, top, left = found
                row, column = top + wide.origin[0], left + wide.origin[1]
                pose = column / self._px_per_cu, row / self._px_per_cu, angle, scale
                at = row - origin[0], column - origin[1]
                return BoardPlace(mask, *at, pose, candidate.kind, kin.is_met)
        return None

    def _with_room(
        self,
        mask: BoolArray,
        origin: tuple[int, int],
        apart: tuple[float, float],
        scale: float,
        angle: float,
    ) -> Stencil:
        """Stencil of pixels with the room that their item keeps along and across itself."""
        turned = np.abs([[np.cos(angle), np.sin(angle)], [np.sin(angle), np.cos(angle)]])
        across, down = np.rint(turned @ apart * scale * self._px_per_cu).astype(int).tolist()
        if across or down:
            mask = row_bits.spread(mask, down, across)
        return stencil_of(mask, (origin[0] + down, origin[1] + across), REACH)

    def _is_larger(self, outline_px: Outline) -> bool:
        left, top, right, bottom = outline_px.bounds
        height, width = self._occupancy.shape
        return bool(right - left > width or bottom - top > height)

    def _drawn(self, scale: float) -> tuple[FloatArray, float, bool]:
        """Field that draws an item of that scale, its weight, and whether it needs no contact."""
        if self.is_loose:
            away = self._bareness.away()
            if away is not None:
                return away, ROOMY / float(away.max()), True
            room = self._occupancy.clearance
            return room.distances, ROOMY / max(room.farthest, 1.0), True
        if not self._first:
            return self._inward, ROOMY, True
        covered = 1 - self._left / max(self._room, 1)
        inward = INWARD * min(scale / (self._first or scale), 1.0) * max(1 - covered / COVERED, 0)
        is_drawn = inward > DRAWN
        return self._inward, inward if is_drawn else 0.0, is_drawn

    def _take(self, mask: BoolArray, row: int, column: int, kind: Hashable) -> None:
        if kind is not None:
            span = [row, row + mask.shape[0], column, column + mask.shape[1]]
            self._kinds[kind] = np.append(self._kinds.get(kind, NONE), [span], axis=0)
        self._occupancy.take(mask, row, column)
        self._bareness.cover(mask, row, column)
        self._left -= int(mask.sum())


LEAST = 0.02
"""Share of the container that may be bare. Larger leaves limbs bare, smaller sees to single pixels
while larger gaps stay. Tried."""


class Bareness:
    """Bare places of a container: farther from every item than a reader takes for filled.

    ``free``: ``(rows, columns)`` the pixels that may be taken.
    ``far_px``: distance from which on a pixel is bare.

    Examples
    --------
    >>> bare = Bareness(np.ones((1, 9), dtype=bool), 3.0)
    >>> bare.cover(np.ones((1, 2), dtype=bool), 0, 0)
    >>> bare.away().tolist()
    [[0.0, 0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]]
    >>> bare.cover(np.ones((1, 1), dtype=bool), 0, 7)
    >>> bare.away() is None
    True
    """

    def __init__(self, free: BoolArray, far_px: float) -> None:
        self._free, self._far = free, far_px
        self._least = LEAST * np.count_nonzero(free)
        self._covered: BoolArray = np.zeros(free.shape, dtype=bool)
        self._away: NearestTaken | None = None
        self._is_filled = False

    def emptied(self) -> Bareness:
        """The same before anything was put there."""
        return Bareness(self._free, self._far)

    def away(self) -> FloatArray | None:
        """Pixels from each free pixel to the nearest item; None where nothing draws items."""
        if self._is_filled or not self._covered.any():
            return None
        if self._away is None:
            self._away = NearestTaken(np.where(self._free, distance_to(self._covered), 0.0))
        away = self._away.distances
        self._is_filled = not np.count_nonzero(away > self._far) > self._least
        return None if self._is_filled else away

    def cover(self, mask: BoolArray, row: int, column: int) -> None:
        """Note pixels of an item; what of them lies off the image is not kept."""
        top, left = max(row, 0), max(column, 0)
        inner = mask[top - row :, left - column :]
        seen = self._covered[top:, left:][: inner.shape[0], : inner.shape[1]]
        seen |= inner[: seen.shape[0], : seen.shape[1]]
        if self._away is not None:
            self._away.add(inner[: seen.shape[0], : seen.shape[1]], top, left)
