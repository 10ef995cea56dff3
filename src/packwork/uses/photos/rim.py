"""Items at the container's edge, shifted and enlarged until they cover it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import product
from typing import TypeAlias

import numpy as np
import numpy.typing as npt
import shapely

from packwork.arrays import BoolArray, FloatArray, IntArray
from packwork.geometry import affine
from packwork.geometry.outline import Outline
from packwork.geometry.overlay import buffered, intersection, union
from packwork.geometry.polygon import Region
from packwork.scene.pose import Poses

FACTORS = (1.02, 1.06, 1.15, 1.3)
SHIFTS = (0.02, 0.06, 0.15)
"""Enlargements, and ways as shares of an item's extent, that are tried. More cover more and take
longer. Tried."""

ROUNDS = 6
"""Times that all items are gone through at most. More change nothing that is seen. Tried."""

GAIN = 1e-3
"""Share of an item by which more of it has to be seen for a change to be made. Chosen."""

ShapeArray: TypeAlias = npt.NDArray[np.object_]

_NOTHING = shapely.Polygon()
_SIDES = tuple(product((-1, 0, 1), repeat=2))


def spread_to(
    window: Region,
    outlines: Sequence[Outline],
    poses: Poses,
    largest: FloatArray,
    may_move: BoolArray,
    gap: float,
    least: float,
) -> Poses:
    """Poses at which more of the items is seen in a window, which may hide parts of them.

    Behind the window's edge nothing is seen, so items may overlap there. None exceeds its
    ``largest`` scale; of each at least a share ``least`` has to be seen; ``gap`` is kept
    between what is seen.

    Examples
    --------
    >>> tile = Outline.from_rings([[[-1, -1], [1, -1], [1, 1], [-1, 1]]])
    >>> at, one = np.array([1.5]), np.ones(1)
    >>> window, poses = shapely.box(0, 0, 2.5, 2.5), Poses(at, at, 0 * at, one)
    >>> found = spread_to(window, [tile], poses, 2 * one, one > 0, 0.0, 0.3)
    >>> bool(found.scale[0] > 1.2)
    True
    """
    shapely.prepare(window)
    areas = np.array([outline.area for outline in outlines])
    pieces = [_seen(o.mapped(poses.matrix(k)).region, window) for k, o in enumerate(outlines)]
    seen = np.array(pieces, dtype=object)
    # What is hardly seen is left out later, and others may cover its place.
    seen[shapely.area(seen) < least * poses.scale**2 * areas] = _NOTHING
    loose = np.flatnonzero(may_move & ~shapely.is_empty(seen))
    changes, tried = np.zeros(len(seen), dtype=np.int64), dict[int, bytes]()
    for _ in range(ROUNDS):
        before = changes.sum()
        for k in loose.tolist():
            others = _within_reach(seen, k, outlines[k].extent * float(poses.scale[k]), gap)
            # Where nothing has changed round an item, no change of it does any better than then.
            known = np.concatenate([others, changes[others], changes[k : k + 1]]).tobytes()
            if tried.get(k) == known:
                continue
            rest = union(seen[others].tolist()) if len(others) else _NOTHING
            shapely.prepare(rest)
            most = seen[k].area * (1 + GAIN)
            for row in _tried(outlines[k], poses, k, float(largest[k])):
                area = float(areas[k] * row.scale[0] ** 2)
                if area <= most:
                    continue
                piece = _seen(outlines[k].mapped(row.matrix(0)).region, window)
                if piece.area <= most or piece.area < least * area:
                    continue
                if shapely.dwithin(rest, piece, gap):
                    continue
                most, seen[k] = piece.area, piece
                changes[k] += 1
                poses = poses.with_some(np.array([k]), row)
            if not changes[k] or known[-8:] == changes[k : k + 1].tobytes():
                tried[k] = known
        if changes.sum() == before:
            break
    return poses


def _seen(whole: Region, window: Region) -> Region:
    return whole if window.covers(whole) else intersection(whole, window)


def _within_reach(seen: ShapeArray, k: int, extent: float, gap: float) -> IntArray:
    """Items that item ``k`` may meet by any change that is tried."""
    reach = (FACTORS[-1] - 1 + SHIFTS[-1]) * extent
    near = buffered(seen[k], 2 * reach + gap)
    shapely.prepare(near)
    met = np.flatnonzero(shapely.intersects(near, seen))
    return np.asarray(met[met != k])


def _tried(outline: Outline, poses: Poses, k: int, largest: float) -> Iterator[Poses]:
    """Poses of item ``k``, shifted, and enlarged about corners, sides and its middle."""
    one = poses.subset(np.array([k]))
    matrix, scale = poses.matrix(k), float(poses.scale[k])
    low, high = np.reshape(outline.bounds, (2, 2))
    middle, half = (low + high) / 2, (high - low) / 2
    for side in _SIDES:
        corner = middle + half * side
        away = affine.apply(matrix, corner[None])[0] - affine.apply(matrix, middle[None])[0]
        for shift in SHIFTS if any(side) else ():
            yield replace(one, x=one.x + shift * away[0], y=one.y + shift * away[1])
    fitting = [factor for factor in FACTORS if scale * factor <= largest]
    for factor, side in product(fitting, _SIDES):
        fixed = affine.apply(matrix, (middle + half * side)[None])[0]
        fixed -= np.array([poses.x[k], poses.y[k]])
        x, y = one.x + (1 - factor) * fixed[0], one.y + (1 - factor) * fixed[1]
        yield replace(one, x=x, y=y, scale=one.scale * factor)
