"""Advice on the parts of a nest that may do with fewer sheets than a search found."""

from __future__ import annotations

from collections.abc import Sequence, Set

import numpy as np
import shapely

from packwork.arrays import FloatArray
from packwork.geometry.outline import Outline
from packwork.geometry.polygon import Region
from packwork.phrasing import number_of
from packwork.separation.shapes import Floats
from packwork.separation.strip import WorkBound
from packwork.uses.nest_work import more_than
from packwork.uses.nested import NestedSheet, SheetPart

REACHED = 0.75
"""Share of sheets that parts of most shapes cover, their gaps counted to them. Larger advises less
often, smaller where more time gains nothing. Chosen."""

EASE = 1e-3
"""Share of a sheet's sides that the search needs to find parts that fill it to its edges; of a
sixth of it, it found two of three."""


def advice_on_sheets(
    found: Sequence[NestedSheet], parts: Sequence[SheetPart], gap: float, edge: float,
    work: WorkBound,
) -> tuple[str, ...]:  # fmt: skip
    """A sentence where all parts may do with fewer sheets, the first ones; nothing elsewhere.

    Parameters
    ----------
    found
        The sheets that are taken, of finite length.
    parts
        All kinds of them, with their angles.
    gap, edge
        Distance of parts, and of parts to the edge, in the sheets' unit.
    work
        What the search was allowed.
    """
    grounds = [one.layout.container.outline.region for one in found]
    regions = [outline.region for one in found for outline in one.layout.outlines]
    if len(grounds) < 2 or not regions:
        return ()
    room = np.cumsum(shapely.area(grounds))
    taken = float(shapely.area(regions).sum() + gap / 2.0 * shapely.length(regions).sum())
    turned = {part.item.outline for part in parts if _may_turn(part.angles)}
    full = _filled_to_the_edge(found, grounds, turned, gap, edge)
    if full < len(grounds):
        ground = found[0].layout.container
        larger = "x".join(f"{(1.0 + EASE) * side:.6g}" for side in (ground.width, ground.height))
        return (
            f"{number_of(len(grounds), 'sheet')}; their parts fill {_number(full)} to the edge: "
            f"a thousandth more room ({larger}{ground.unit}) may do with {full}",
        )
    fewer = max(
        int(np.searchsorted(REACHED * room, taken)) + 1,
        _that_exclude_each_other(_radii(found), max(grounds, key=shapely.area).bounds),
    )
    if fewer >= len(grounds):
        return ()
    share = float(shapely.area(regions).sum()) / float(room[fewer - 1])
    return (
        f"{number_of(len(grounds), 'sheet')}; their parts cover {100 * share:.0f} % of "
        f"{_number(fewer)}: "
        f"more time may do with {fewer} ({more_than(work)})",
    )


def _filled_to_the_edge(
    found: Sequence[NestedSheet], grounds: Sequence[Region], turned: Set[Outline], gap: float,
    edge: float,
) -> int:  # fmt: skip
    """Number of equal rectangles that rows of all parts fill to the edge; that of all elsewhere.

    Parts are as large as their bounds at angles at which they lie; those of ``turned`` may lie
    across, too.
    """
    width, height = (float(side) for side in shapely.bounds(grounds[0])[2:])
    if not all(ground.equals(shapely.box(0.0, 0.0, width, height)) for ground in grounds):
        return len(grounds)
    names = [
        (item.outline, float(scale))
        for one in found
        for item, scale in zip(one.layout.items, one.layout.poses.scale, strict=True)
    ]
    bounds = np.array([outline.bounds for one in found for outline in one.layout.outlines])
    sides = bounds[:, 2:] - bounds[:, :2] + gap
    best, sheet = len(grounds), np.array([width, height])
    for across in (0, 1):
        # Each kind as it lies lowest, then as it lies highest.
        for sign in (1.0, -1.0):
            flat = dict[tuple[Outline, float], FloatArray]()
            for name, lies in zip(names, sides, strict=True):
                side = lies
                if name[0] in turned and sign * (lies[across] - lies[1 - across]) > 0.0:
                    side = lies[::-1]
                if name not in flat or sign * side[across] < sign * flat[name][across]:
                    flat[name] = side
            lying = np.array([flat[name] for name in names])[:, [across, 1 - across]]
            tight, ample = (
                _sheets_in_rows(lying, (1.0 + ease) * sheet[[across, 1 - across]] - 2 * edge + gap)
                for ease in (-EASE, EASE)
            )
            if ample < tight:
                best = min(best, ample)
    return best


def _may_turn(angles: tuple[float, ...] | None) -> bool:
    """Whether each angle has one a quarter of a turn from it, in radians.

    >>> [_may_turn(angles) for angles in (None, (0.0, np.pi), (np.pi, np.pi / 2))]
    [True, False, True]
    """
    if angles is None:
        return True
    apart = np.subtract.outer(angles, angles)
    return bool((np.abs(np.cos(apart)).min(axis=1) < 1e-9).all())


def _sheets_in_rows(sides: FloatArray, sheet: FloatArray) -> int:
    """Number of sheets that rectangles take in rows, the highest first.

    >>> _sheets_in_rows(np.array([[20.0, 30.0]] * 5), np.array([40.0, 60.0]))
    2
    """
    count, top, row, along = 1, 0.0, 0.0, 0.0
    for height, width in sides[np.lexsort(sides.T[::-1])[::-1]].tolist():
        if height > sheet[0] or width > sheet[1]:
            return len(sides) + 1
        if row == 0.0 or along + width > sheet[1]:
            top, row, along = top + row, height, 0.0
            if top + height > sheet[0]:
                count, top = count + 1, 0.0
        along += width
    return count


def _number(count: int) -> str:
    return "one" if count == 1 else f"{count}"


def _radii(found: Sequence[NestedSheet]) -> Floats:
    """``(n,)`` of the largest circle in each part, the largest first."""
    own = dict[tuple[Outline, float], float]()
    radii = list[float]()
    for one in found:
        for item, scale, outline in zip(
            one.layout.items, one.layout.poses.scale, one.layout.outlines, strict=True
        ):
            key = (item.outline, float(scale))
            if key not in own:
                own[key] = float(shapely.maximum_inscribed_circle(outline.region).length)
            radii.append(own[key])
    return np.sort(radii)[::-1]


def _that_exclude_each_other(radii: Floats, bounds: tuple[float, float, float, float]) -> int:
    """Number of the largest parts no two of which have room on one sheet.

    Two circles of a rectangle have their centres apart by its sides less both radii, at most.

    >>> _that_exclude_each_other(np.array([30.0, 30.0, 30.0, 5.0]), (0, 0, 100, 100))
    3
    """
    x0, y0, x1, y1 = bounds
    both = radii[:-1] + radii[1:]
    room = np.hypot(np.maximum(x1 - x0 - both, 0.0), np.maximum(y1 - y0 - both, 0.0))
    return int(np.argmin(np.append(room < both, False))) + 1
