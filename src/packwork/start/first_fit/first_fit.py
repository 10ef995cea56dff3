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
from typing import TypeAlias

import numpy as np

from packwork.arrays import BoolArray, FloatArray, IntArray
from packwork.forces.forces import FieldForce
from packwork.geometry.affine import similarity
from packwork.geometry.outline import Outline
from packwork.geometry.simplify import grown
from packwork.progress import Stop, never
from packwork.scene.container import Container
from packwork.scene.limits import NO_LIMITS, Limits
from packwork.scene.pose import Poses
from packwork.start.allowed_pixels import allowed_pixels
from packwork.start.first_fit.kind_penalty import KindPenalty
from packwork.start.first_fit.occupancy import Occupancy
from packwork.start.first_fit.stencil import TOUCHED, Stencil, cut_all
from packwork.start.first_poses import container_image

Key: TypeAlias = tuple[int, float, float]
"""Which outline, its scale, its angle."""

PIXELS_EACH = 28
"""Pixels of the image's side for each item of a row of them. More waste less room at the
edges of pixels and take longer. Tried."""

LEAST_PX, MOST_PX = 280, 600
"""Sides of that image at least and at most. As above."""

REACH = 3
"""Width of the fringe, pixels, in which taken pixels are counted; 5 and 8 are no better. Tried."""

FIRST_SHARE = 0.45
"""Share of the container that the first try's items cover. Any other takes more tries."""

STRIDE, CLOSE = 1.12, 1.02
"""Factor between sizes tried until one fits and one does not, and the factor between those
two at which the search ends. Smaller finds more, which the finish would find as well. Chosen."""

MOST_SIZES = 24
"""Sizes tried at most: should nothing fit at a tenth of the first, nothing will. Chosen."""

SPARE = 1.15
"""How much wider a margin is drawn than needed, so that it need not be drawn anew. Chosen."""

URGENCY = 2.0
"""Factor on the area by which items are ordered, for one that found no place. Chosen."""

LOOSE = (0.2, 0.1, 0.05, 0.02)
"""Shares of the items, the smallest, that are put where there is most room: the first with which
all still find a place. Beginning with 0.4 or 0.6 gives the same. Tried."""

PULL = 2.0
"""Score that an item gives for coming the canvas' side lower, at a strength of 1. 4 and 8 draw
nothing nearer. Tried."""

NOISE = 0.01
"""Random part of a place's score, which is 0 to 1: it makes seeds differ. Chosen."""


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
    stop: Stop = never,
) -> Poses | None:
    """Poses at which nothing overlaps, all items in proportion; None if none were found.

    Parameters
    ----------
    container
        The region to fill.
    outlines
        One per item, item units.
    scales
        ``(n,)``; all but those that limits hold are multiplied by one factor.
    angles
        For each item the angles that it may have, radians.
    rng
        The only source of randomness.
    margin_cu
        Room that every item keeps round itself, canvas units.
    slack
        More of it, as a share of the item's extent: what later stages take it for may be
        as much wider.
    attempts
        Orders tried for each size: the item that found no place comes earlier the next time.
    limits
        Which items have to lie where.
    fields
        Forces that say where an item had better lie.
    kinds
        ``(n,)`` numbers of what is to be mixed: what lies there at any time has as much of each
        kind's area, as what is put later comes to lie elsewhere. None for the largest first.
    stop
        Asked before each attempt; True ends the search with the best found so far.

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
    fitting = _Fitting(
        container, outlines, scales, angles, rng, margin_cu, slack, limits, fields, kinds
    )
    return fitting.largest(math.sqrt(FIRST_SHARE / share), attempts, stop)


class _Fitting:
    """What stays the same for all sizes that are tried."""

    def __init__(
        self,
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
    ) -> None:
        count = len(outlines)
        side = int(np.clip(round(PIXELS_EACH * math.sqrt(count)), LEAST_PX, MOST_PX))
        image, self._px_per_cu = container_image(container, side)
        self._inside: BoolArray = image > 1 - TOUCHED
        self._outlines, self._scales, self._angles = outlines, scales, angles
        self._margin_cu, self._slack = margin_cu, slack
        self._wide: dict[int, tuple[float, Outline]] = {}
        self._areas = np.array([outline.area for outline in outlines]) * scales**2
        self._urgency, self._kinds = self._areas, kinds
        self._penalty: KindPenalty | None = None
        limits = limits if limits.binds else Limits.free(count)
        self._is_sized = limits.held[:, 3]
        self._pins = np.column_stack([limits.x, limits.y])
        self._noise = NOISE * rng.random(image.shape)
        self._fields = fields
        self._heights = _heights(fields, image.shape, self._px_per_cu)
        self._homes = allowed_pixels(limits, image, self._px_per_cu)

    def largest(self, factor: float, attempts: int, stop: Stop) -> Poses | None:
        """Poses at the largest factor found, beginning with one."""
        low, high = 0.0, math.inf
        found: Poses | None = None
        for _ in range(MOST_SIZES):
            if stop() or high <= low * CLOSE:
                break
            poses = self._put_all(factor, attempts, stop)
            if poses is None:
                high = factor
            else:
                low, found = factor, poses
            if found is None:
                factor = high / STRIDE
            elif high == math.inf:
                factor = low * STRIDE
            else:
                factor = math.sqrt(low * high)
        return found if found is None else self._loosened(found, stop)

    def _loosened(self, tight: Poses, stop: Stop) -> Poses:
        """The same sizes, the last and smallest where there is most room.

        What is left over is else one large void, where the last items would have come.
        """
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
        """Poses of all items at one size; None if not all found a place."""
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
        occupancy = Occupancy(self._inside, REACH)
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
            occupancy.take(stencil, row, column)
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
        """Which stencil of an item is to be put, and at what row and column."""
        is_everywhere = is_loose or self._homes[item] is not None or len(self._fields) > 0
        worth = self._worth(item)
        field = occupancy.clearance if is_loose else None
        tried = [occupancy.best_place(s, worth, is_everywhere, field) for s in stencils]
        found = [(*place, which) for which, place in enumerate(tried) if place is not None]
        if not found:
            return None
        _, row, column, which = max(found)
        return which, row, column

    def _worth(self, item: int) -> FloatArray:
        """What is added to the score of each pixel that an item's origin may come to.

        Made when it is asked for: one image for each item would be gigabytes.
        """
        worth = self._noise if self._penalty is None else self._noise - self._penalty.at(item)
        for force, height in zip(self._fields, self._heights, strict=True):
            if force.strengths[item]:
                worth = worth - PULL * force.strengths[item] * height
        home = self._homes[item]
        if home is None:
            return worth
        held = np.full(worth.shape, -np.inf)
        held.ravel()[home] = worth.ravel()[home]
        return held

    def _stencils(self, scales: FloatArray, stop: Stop) -> dict[Key, Stencil] | None:
        """Stencils of all items at all their angles, equal ones cut once; None if stopped."""
        wanted: dict[Key, Outline] = {}
        for k, outline in enumerate(self._outlines):
            if stop():
                return None
            scale = scales[k]
            for turn in self._angles[k]:
                key = self._key(k, scale, turn)
                if key not in wanted:
                    wide = self._with_margin(outline, float(scale))
                    wanted[key] = wide.mapped(similarity(0.0, 0.0, turn, scale * self._px_per_cu))
        return cut_all(wanted, REACH)

    def _with_margin(self, outline: Outline, scale: float) -> Outline:
        """The outline with its margin, or a little more: one that serves several sizes."""
        needed = self._margin_cu / scale + self._slack * outline.extent
        if needed == 0:
            return outline
        margin, wide = self._wide.get(id(outline), (0.0, outline))
        if not needed <= margin <= SPARE**2 * needed:
            wide = grown(outline, SPARE * needed)
            self._wide[id(outline)] = (SPARE * needed, wide)
        return wide

    def _key(self, item: int, scale: float, turn: float) -> Key:
        return id(self._outlines[item]), float(scale), float(turn)


def _heights(
    fields: Sequence[FieldForce], shape: tuple[int, ...], px_per_cu: float
) -> list[FloatArray]:
    """Heights of fields at all pixels, as shares of the canvas' longer side."""
    rows, columns = np.mgrid[: shape[0], : shape[1]]
    points = np.column_stack([columns.ravel(), rows.ravel()]) / px_per_cu
    side_cu = max(shape) / px_per_cu
    return [np.asarray(one.field(points)[0]).reshape(shape) / side_cu for one in fields]
