"""Outlines of the items as levels see them: stand-ins, no finer than pixels, in one array."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from packwork.arrays import FloatArray, IntArray
from packwork.geometry.affine import stretched
from packwork.geometry.outline import Outline, joined
from packwork.geometry.simplify import closed, grown, hull, simplified
from packwork.scene.pose import Poses
from packwork.solve import _kernels
from packwork.solve.options import OutlineChoice


def stand_ins(outlines: Sequence[Outline], choice: OutlineChoice) -> list[Outline]:
    """Outlines for the stages to see: the true ones, or their convex hulls, one for all copies.

    >>> dart = Outline.from_rings([[[0.0, 0], [4, 2], [0, 4], [1, 2]]])
    >>> first, second = stand_ins([dart, dart], "hull")
    >>> len(first.points), first is second
    (3, True)
    """
    if choice == "exact":
        return list(outlines)
    known: dict[Outline, Outline] = {}
    for outline in outlines:
        if outline not in known:
            known[outline] = hull(outline)
    return [known[outline] for outline in outlines]


DETAIL_PX = 0.12
"""Outlines are simplified to this many pixels of the level: larger is faster and lets
items overlap by as much, smaller costs edges that no pixel sees. Tried."""

CLEFT_PX = 0.26
"""Clefts narrower than twice this many pixels of the level are closed. Larger keeps
items out of each other's bays, smaller lets thin limbs cross and lock. Tried."""

MARGIN_RUNGS = 8
"""Steps of size, to a factor of two, within which copies share one outline with its margin. Larger
makes thousands of outlines for thousands of marks, smaller makes margins wrong by more than 9 %;
the exact finish keeps them in full. Chosen."""


@dataclass(frozen=True, eq=False)
class OutlineCache:
    """Outlines that were simplified before, kept with those that they were made of."""

    shaped: dict[tuple[Outline, float], Outline] = field(default_factory=dict)
    made: dict[tuple[Outline, int], Outline] = field(default_factory=dict)
    given_back: dict[tuple[Outline, float], Outline] = field(default_factory=dict)


def simplify_for_level(
    outlines: Sequence[Outline],
    poses: Poses,
    px_per_cu: float,
    margin_cu: float = 0.0,
    before: OutlineCache | None = None,
) -> list[Outline]:
    """Outlines simplified to a level's pixels in the shape and size of their poses.

    A pixel and a margin are as wide as high on the canvas, so an item that is stretched gets its
    detail and its margin stretched; the result is in item units all the same. ``margin_cu``:
    outlines are grown by this much all round; ``before``: what was made for the same level and
    margin.

    >>> half = np.array([[-8.0, -8], [8, -8], [8, 8], [-8, 8]])
    >>> one = np.ones(1)
    >>> wide = Poses(one, one, 0 * one, one, 4 * one)
    >>> (seen,) = simplify_for_level([Outline.from_rings([half])], wide, 99.0, margin_cu=1.0)
    >>> [round(v, 2) for v in seen.bounds]
    [-8.5, -10.0, 8.5, 10.0]
    """
    # Items within a factor of two of one shape share one outline, as sizes do; but a
    # margin has the same width whatever the shape.
    ratios = poses.stretch if margin_cu > 0 else 2.0 ** np.rint(np.log2(poses.stretch))
    before = before or OutlineCache()
    shaped = _stretched_once(outlines, ratios, before.shaped)
    seen = simplify_at_scales(shaped, poses.scale, px_per_cu, margin_cu, before.made)
    return _stretched_once(seen, 1 / ratios, before.given_back)


def simplify_at_scales(
    outlines: Sequence[Outline],
    scales: FloatArray,
    px_per_cu: float,
    margin_cu: float = 0.0,
    known: dict[tuple[Outline, int], Outline] | None = None,
) -> list[Outline]:
    """Outlines simplified to a level's pixels; copies of about one size are made once.

    What a level cannot resolve must not lock items into each other: clefts are closed first, so
    that coarse levels work on something near the hull. ``known``: what was made before.
    """
    done = {} if known is None else known
    seen = []
    for outline, scale in zip(outlines, scales, strict=True):
        # Items whose pixels are within a factor of two share one outline, but a margin
        # is as wide on small items as on large ones, nearly.
        size = math.log2(1 / (px_per_cu * scale))
        rung = round(size)
        key = (outline, rung if margin_cu == 0 else round(size * MARGIN_RUNGS))
        if key not in done:
            done[key] = _simplify(outline, 2.0**rung, margin_cu / scale)
        seen.append(done[key])
    return seen


def _simplify(outline: Outline, pixel: float, margin: float) -> Outline:
    """One outline at a level whose pixel is ``pixel`` item units."""
    # Half the tolerance before closing, which is slow on many points, half after.
    rough = simplified(outline, 0.5 * DETAIL_PX * pixel)
    return simplified(closed(grown(rough, margin), CLEFT_PX * pixel), 0.5 * DETAIL_PX * pixel)


def _stretched_once(
    outlines: Sequence[Outline], ratios: FloatArray, done: dict[tuple[Outline, float], Outline]
) -> list[Outline]:
    result = []
    for outline, ratio in zip(outlines, ratios.tolist(), strict=True):
        key = (outline, ratio)
        if key not in done:
            done[key] = outline if ratio == 1.0 else outline.mapped(stretched(ratio))
        result.append(done[key])
    return result


class Ensemble:
    """Points of all items, placed by poses, and gradients gathered back to poses.

    >>> square = Outline.from_rings([np.array([[-1, -1], [1, -1], [1, 1], [-1, 1.0]])])
    >>> two = Ensemble([square, square])
    >>> one = np.ones(2)
    >>> two.place(Poses(np.array([1.0, 4.0]), one, 0 * one, one), 10.0)[[0, 4]].tolist()
    [[0.0, 0.0], [30.0, 0.0]]
    """

    def __init__(self, outlines: Sequence[Outline]) -> None:
        self._own, self.ring_starts = joined(outlines)
        counts = [len(o.points) for o in outlines]
        self._item_starts: IntArray = np.cumsum([0, *counts], dtype=np.int64)
        self._rings_before: IntArray = np.cumsum([0] + [len(o.starts) - 1 for o in outlines])[:-1]
        self._points = np.empty_like(self._own)
        self._by_pose = np.zeros((len(outlines), 5))

    def place(self, poses: Poses, px_per_cu: float) -> FloatArray:
        """Points in pixels, ``(n, 2)``; a buffer that the next call reuses."""
        _kernels.place(
            self._own, self._item_starts, poses.x, poses.y, poses.angle, poses.scale,
            poses.stretch, px_per_cu, self._points,
        )  # fmt: skip
        return self._points

    def gather(self, gradient: FloatArray, poses: Poses, px_per_cu: float) -> FloatArray:
        """Pose gradients from the gradients of the points last placed.

        Returns ``(items, 5)``: by x and y (per canvas unit), angle (rad), log scale and log
        stretch; a buffer that the next call reuses.
        """
        _kernels.gather(
            self._points, gradient, self._item_starts, poses.x, poses.y, poses.angle,
            px_per_cu, self._by_pose,
        )  # fmt: skip
        return self._by_pose

    def per_item(self, per_ring: FloatArray) -> FloatArray:
        """Sums ``(items,)`` of numbers ``(rings,)`` over each item's rings, in their unit."""
        return np.asarray(np.add.reduceat(per_ring, self._rings_before))

    def per_ring(self, per_item: FloatArray) -> FloatArray:
        """Rows ``(rings, m)``, each ring's its item's, of ``(items, m)``."""
        counts = np.diff(np.append(self._rings_before, len(self.ring_starts) - 1))
        return np.repeat(per_item, counts, axis=0)
