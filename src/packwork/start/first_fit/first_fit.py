"""The largest common size at which items, put one after another, all find a place.

First-fit decreasing, on pixels; among free places the one that touches most of what is
there already, be it an item or the edge ("touching perimeter": Lodi, Martello and Vigo 1999,
"Heuristic and metaheuristic approaches for a class of two-dimensional bin packing problems",
INFORMS Journal on Computing 11, 345-357, doi:10.1287/ijoc.11.4.345). Ours
places outlines of any form, at several angles, and repeats with the failed item earlier.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from packwork.arrays import BoolArray, FloatArray, IntArray
from packwork.forces.forces import FieldForce
from packwork.geometry.affine import similarity
from packwork.geometry.outline import Outline
from packwork.progress import Stop, never
from packwork.raster.coverage import TOUCHED
from packwork.scene.container import Container
from packwork.scene.pose import NO_LIMITS, Limits, Poses
from packwork.start.first_fit.occupancy import NOISE, Occupancy, Stencil, cut
from packwork.start.first_fit.preferences import Homes, KindPenalty
from packwork.start.first_poses import container_image
from packwork.start.places import allowed_pixels

Key: TypeAlias = tuple[Outline, float, float]
"""Which outline, its scale, its angle."""


@dataclass(frozen=True)
class Grain:
    """Resolution of the search for places and sizes. All tried.

    ``pixels_each``, ``least_px``, ``most_px``: pixels of the image's side for each item of a row of
    them, and its side at least and at most. More waste less room at the edges of pixels and take
    longer.
    ``reach``, ``most_fringe``: width of the fringe, pixels, in which taken pixels are counted, and
    how many of them are looked at. More tell better which place is best, up to a point, and take
    longer.
    ``first_share``: share of the container that the first try's items cover. Any other takes more
    tries.
    ``stride``, ``close``: factor between the first two sizes tried, squared with each one until one
    fits and one does not; and the factor between those two at which the search ends. Smaller finds
    more.
    """

    pixels_each: float
    least_px: int
    most_px: int
    reach: int
    most_fringe: int
    first_share: float
    stride: float
    close: float


TURNING = Grain(28, 280, 600, 3, 96, 0.45, 1.12, 1.02)
"""Of items that are tried at several angles, each of which takes as long as one item."""

ROUGH = Grain(28, 300, 600, 3, 96, 0.5, 1.06, 1.03)
"""Of items of one angle, to begin with."""

AFTER_ROUGH = Grain(60, 600, 600, 6, 300, 0.5, 1.02, 1.01)
"""Of the same, once a size is known that fits on the coarser image."""

UPRIGHT = Grain(17.5, 600, 1_000, 3, 96, 0.5, 1.06, 1.01)
"""Of so many items of one angle, few pixels each, that the coarser image says too little."""

MOST_ROUGH = 144
"""How many items begin on the coarser image. Larger begins many with a size far off. Chosen."""

FINER = 1.04
"""How much larger items fit on the fine image than on that one. Larger or smaller takes more tries.
Measured on five shapes."""

MOST_SIZES = 24
"""Sizes tried at most: should nothing fit at a tenth of the first, nothing will. Chosen."""

MOST_STRIDE = TURNING.stride
"""Factor between two sizes tried, at most. Derived: as wide as any begins."""

URGENCY = 2.0
"""Factor on the area by which items are ordered, for one that found no place. Chosen."""

FIRST = 1e6
"""The same of what is put before all others. Derived: no two items differ as much in area."""

LOOSE = (0.2, 0.1, 0.05, 0.02)
"""Shares of the items, the smallest, that are put where there is most room: the first with which
all still find a place. Beginning with 0.4 or 0.6 gives the same. Tried."""

PULL = 2.0
"""Score that an item gives for coming the canvas' side lower, at a strength of 1. 4 and 8 draw
nothing nearer. Tried."""


def first_fit(
    container: Container,
    outlines: Sequence[Outline],
    scales: FloatArray,
    angles: Sequence[FloatArray],
    rng: np.random.Generator,
    *,
    margin_cu: float = 0.0,
    slack: float = 0.0,
    attempts: int = 1,
    limits: Limits = NO_LIMITS,
    fields: Sequence[FieldForce] = (),
    kinds: IntArray | None = None,
    homes: Homes | None = None,
    stop: Stop = never,
) -> Poses | None:
    """Poses at which nothing overlaps, all items in proportion; None if none were found.

    ``outlines``: one per item, item units.
    ``scales``: ``(n,)``; all but those that limits hold are multiplied by one factor.
    ``angles``: for each item the angles that it may have, radians.
    ``margin_cu``: room that every item keeps round itself, canvas units.
    ``slack``: more of it, as a share of the item's extent: what later stages take it for may be as
    much wider.
    ``attempts``: orders tried for each size: the item that found no place comes earlier the next
    time. Of items of one angle, placed more closely, half as many; of many of those a quarter.
    ``fields``: forces that say where an item had better lie.
    ``kinds``: ``(n,)`` numbers of what is to be mixed: what lies there at any time has as much of
    each kind's area, as what is put later comes to lie elsewhere. None for the largest first.
    ``stop``: asked before each attempt; True ends the search with the best found so far.

    Examples
    --------
    >>> tile = Outline.from_rings([np.array([[-1.0, -1], [1, -1], [1, 1], [-1, 1]])])
    >>> wall = tile.mapped(similarity(50.0, 50.0, 0.0, 50.0))
    >>> container = Container("", "", wall, 100.0, 100.0)
    >>> upright = [np.zeros(1)] * 4
    >>> poses = first_fit(container, [tile] * 4, np.ones(4), upright, np.random.default_rng(0))
    >>> bool(48 < 2 * poses.scale[0] <= 50), len(set(zip(poses.x, poses.y)))
    (True, 4)
    """
    own = np.array([outline.area for outline in outlines])
    share = float((own * scales**2).sum()) / container.outline.area

    def fitting(grain: Grain) -> _Fitting:
        return _Fitting(
            grain, container, outlines, scales, angles, rng, margin_cu, slack, limits, fields,
            kinds, homes,
        )  # fmt: skip

    def first(grain: Grain) -> float:
        return math.sqrt(grain.first_share / share)

    if max(map(len, angles)) > 1:
        return fitting(TURNING).loosened(first(TURNING), attempts, stop)
    if len(outlines) > MOST_ROUGH:
        return fitting(UPRIGHT).loosened(first(UPRIGHT), -(-attempts // 4), stop)
    rough = fitting(ROUGH).largest(first(ROUGH), 1, stop)
    factor = first(AFTER_ROUGH) if rough is None else FINER * rough[0]
    return fitting(AFTER_ROUGH).loosened(factor, -(-attempts // 2), stop)


class _Fitting:
    """State that is the same for all sizes that are tried."""

    def __init__(
        self,
        grain: Grain,
        container: Container,
        outlines: Sequence[Outline],
        scales: FloatArray,
        angles: Sequence[FloatArray],
        rng: np.random.Generator,
        margin_cu: float,
        slack: float,
        limits: Limits,
        fields: Sequence[FieldForce],
        kinds: IntArray | None,
        homes: Homes | None,
    ) -> None:
        count = len(outlines)
        self._grain = grain
        side_px = round(grain.pixels_each * math.sqrt(count))
        side = int(np.clip(side_px, grain.least_px, grain.most_px))
        image, self._px_per_cu = container_image(container, side)
        self._inside: BoolArray = image > 1 - TOUCHED
        self._outlines, self._scales, self._angles = outlines, scales, angles
        self._margin_cu, self._slack = margin_cu, slack
        self._areas = np.array([outline.area for outline in outlines]) * scales**2
        self._urgency, self._kinds = self._areas, kinds
        if homes is not None:
            self._urgency = self._areas * np.where(homes.is_first, FIRST, 1.0)
        self._penalty: KindPenalty | None = None
        limits = limits if limits.binds else Limits.free(count)
        self._is_sized = limits.held[:, 3]
        self._pins = np.column_stack([limits.x, limits.y])
        self._noise = NOISE * rng.random(image.shape)
        self._fields = fields
        self._heights = heights_on(fields, image.shape, self._px_per_cu)
        self._near = None if homes is None else homes.points * self._px_per_cu
        self._pull = np.zeros(count) if homes is None else homes.pull
        self._homes = allowed_pixels(limits, image, self._px_per_cu)

    def largest(self, factor: float, attempts: int, stop: Stop) -> tuple[float, Poses] | None:
        """The largest factor found, beginning with one, and poses at it."""
        low, high, stride = 0.0, math.inf, self._grain.stride
        found: Poses | None = None
        for _ in range(MOST_SIZES):
            if stop() or high <= low * self._grain.close:
                break
            poses = self._put_all(factor, attempts, stop)
            if poses is None:
                high = factor
            else:
                low, found = factor, poses
            if found is None or high == math.inf:
                factor = high / stride if found is None else low * stride
                stride = min(stride**2, MOST_STRIDE)
            else:
                factor = math.sqrt(low * high)
        return found if found is None else (low, found)

    def loosened(self, factor: float, attempts: int, stop: Stop) -> Poses | None:
        """Poses at the largest factor found, the last and smallest where there is most room.

        What is left over is else one large void, where the last items would have come.
        """
        best = self.largest(factor, attempts, stop)
        if best is None:
            return None
        tight = best[1]
        stencils = self._stencils(tight.scale, stop)
        if stencils is None:
            return tight
        order = self._order(self._urgency)
        for share in LOOSE:
            found = self._put_in_order(order, tight.scale, stencils, round(share * len(order)))
            if isinstance(found, Poses):
                return found
        return tight

    def _put_all(self, factor: float, attempts: int, stop: Stop) -> Poses | None:
        scales = np.where(self._is_sized, self._scales, self._scales * factor)
        stencils = self._stencils(scales, stop)
        if stencils is None:
            return None
        urgency = self._urgency.copy()
        for attempt in range(attempts):
            if attempt and stop():
                break
            found = self._put_in_order(self._order(urgency), scales, stencils)
            if isinstance(found, Poses):
                # What made these fit will help larger ones, too.
                self._urgency = urgency
                return found
            urgency[found] *= URGENCY
        return None

    def _order(self, urgency: FloatArray) -> IntArray:
        """The most urgent first; of several kinds as much of each one's area at any time."""
        order = np.argsort(-urgency, kind="stable")
        if self._kinds is None:
            return order
        when = np.zeros(len(order))
        for kind in np.unique(self._kinds):
            own = order[self._kinds[order] == kind]
            areas = self._areas[own]
            when[own] = (np.cumsum(areas) - areas / 2) / areas.sum()
        return np.argsort(when * self._areas / urgency, kind="stable")

    def _put_in_order(
        self, order: IntArray, scales: FloatArray, stencils: dict[Key, Stencil], loose: int = 0
    ) -> Poses | int:
        """Poses of all items, or the first that found no place.

        The last of the order, ``loose`` of them, go where there is most room.
        """
        is_loose = np.isin(np.arange(len(order)), order[len(order) - loose :])
        occupancy = Occupancy(self._inside, self._grain.reach, self._grain.most_fringe)
        self._penalty = None if self._kinds is None else KindPenalty(self._inside, self._kinds)
        x, y, angle = np.zeros((3, len(scales)))
        poses = Poses(x, y, angle, scales)
        is_pinned: BoolArray = np.logical_not(np.isnan(self._pins).any(axis=1))
        for k in [*np.flatnonzero(is_pinned), *order[~is_pinned[order]]]:
            own = [(turn, stencils[self._key(k, scales[k], turn)]) for turn in self._angles[k]]
            if is_pinned[k]:
                turn, stencil = own[0]
                corner = np.rint(self._pins[k, ::-1] * self._px_per_cu) - stencil.origin
                row, column = int(corner[0]), int(corner[1])
            else:
                best = self._best(occupancy, int(k), [stencil for _, stencil in own], is_loose[k])
                if best is None:
                    return int(k)
                which, row, column = best
                turn, stencil = own[which]
            occupancy.take(stencil.mask, row, column)
            if self._penalty is not None:
                self._penalty.add(int(k), row + stencil.origin[0], column + stencil.origin[1])
            poses.x[k] = (column + stencil.origin[1]) / self._px_per_cu
            poses.y[k] = (row + stencil.origin[0]) / self._px_per_cu
            poses.angle[k] = turn
        poses.x[is_pinned], poses.y[is_pinned] = self._pins[is_pinned].T
        return poses

    def _best(
        self, occupancy: Occupancy, item: int, stencils: Sequence[Stencil], is_loose: bool
    ) -> tuple[int, int, int] | None:
        is_drawn = self._near is not None or any(one.strengths[item] for one in self._fields)
        is_everywhere = is_loose or self._homes[item] is not None or is_drawn
        worth = self._worth(item)
        field = occupancy.clearance.distances if is_loose else None
        tried = [occupancy.best_place(s, worth, is_everywhere, field) for s in stencils]
        found = [(*place, which) for which, place in enumerate(tried) if place is not None]
        if not found:
            return None
        _, row, column, which = max(found)
        return which, row, column

    def _worth(self, item: int) -> FloatArray:
        """Term of the score of each pixel that an item's origin may come to.

        Made when it is asked for: one image for each item would be gigabytes.
        """
        worth = self._noise if self._penalty is None else self._noise - self._penalty.at(item)
        for force, height in zip(self._fields, self._heights, strict=True):
            if force.strengths[item]:
                worth = worth - PULL * force.strengths[item] * height
        if self._near is not None:
            worth = worth - self._pull[item] * self._away(self._near[item], worth.shape)
        home = self._homes[item]
        if home is None:
            return worth
        held = np.full(worth.shape, -np.inf)
        held.ravel()[home] = worth.ravel()[home]
        return held

    def _away(self, point: FloatArray, shape: tuple[int, ...]) -> FloatArray:
        """Distance of all pixels from a point, over the image's longer side."""
        rows, columns = np.ogrid[: shape[0], : shape[1]]
        return np.asarray(np.hypot(rows - point[1], columns - point[0]) / max(shape))

    def _stencils(self, scales: FloatArray, stop: Stop) -> dict[Key, Stencil] | None:
        """Stencils of all items at all their angles, equal ones cut once; None if stopped."""
        found: dict[Key, Stencil] = {}
        for k, outline in enumerate(self._outlines):
            if stop():
                return None
            scale = float(scales[k])
            margin_px = (self._margin_cu + self._slack * outline.extent * scale) * self._px_per_cu
            for turn in self._angles[k]:
                key = self._key(k, scale, turn)
                if key not in found:
                    posed = outline.mapped(similarity(0.0, 0.0, turn, scale * self._px_per_cu))
                    found[key] = cut(posed, self._grain.reach, margin_px)
        return found

    def _key(self, item: int, scale: float, turn: float) -> Key:
        return self._outlines[item], float(scale), float(turn)


def heights_on(
    fields: Sequence[FieldForce],
    shape: tuple[int, ...],
    px_per_cu: float,
    corner_cu: tuple[float, float] = (0.0, 0.0),
) -> list[FloatArray]:
    """Heights of fields at all pixels, as shares of the image's longer side.

    ``corner_cu``: point of the canvas in the image's top left corner.
    """
    rows, columns = np.mgrid[: shape[0], : shape[1]]
    points = np.column_stack([columns.ravel(), rows.ravel()]) / px_per_cu + corner_cu
    side_cu = max(shape) / px_per_cu
    return [np.asarray(one.field(points)[0]).reshape(shape) / side_cu for one in fields]
