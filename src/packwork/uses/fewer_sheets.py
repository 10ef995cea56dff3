"""Advice on the parts of a nest that may do with fewer sheets than a search found."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import shapely

from packwork.geometry.outline import Outline
from packwork.phrasing import number_of
from packwork.separation.shapes import Floats
from packwork.separation.strip import WorkBound
from packwork.uses.nest_work import more_than
from packwork.uses.nested import NestedSheet

REACHED = 0.75
"""Share of sheets that parts of most shapes cover, their gaps counted to them. Larger advises less
often, smaller where more time gains nothing. Chosen."""

FULL = 0.97
"""Share of sheets from which on parts tile them, their gaps counted to them: shapes that do not
never cover so much. Chosen."""

EASE = 1e-3
"""Share of a sheet's sides that the search needs to find such a tiling; of a sixth of it, it found
two of three."""


def advice_on_sheets(
    found: Sequence[NestedSheet], gap: float, work: WorkBound
) -> tuple[str, ...]:  # fmt: skip
    """A sentence where all parts may do with fewer sheets, the first ones; nothing elsewhere.

    Parameters
    ----------
    found
        The sheets that are taken, of finite length.
    gap
        Distance of parts, in the sheets' unit.
    work
        What the search was allowed.
    """
    grounds = [one.layout.container.outline.region for one in found]
    regions = [outline.region for one in found for outline in one.layout.outlines]
    if len(grounds) < 2 or not regions:
        return ()
    room = np.cumsum(shapely.area(grounds))
    taken = float(shapely.area(regions).sum() + gap / 2.0 * shapely.length(regions).sum())
    full = int(np.searchsorted((1.0 + 1e-9) * room, taken)) + 1
    if full < len(grounds) and taken >= FULL * room[full - 1]:
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
