"""Slits between parts that belong together, closed: a morphological closing of their edges."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import shapely

from packwork.geometry.outline import Outline
from packwork.geometry.overlay import buffered, difference, intersection, union
from packwork.geometry.polygon import Region, polygon_parts
from packwork.readers.options import GAPS_AUTO, GAPS_NONE
from packwork.readers.reading import notice
from packwork.scene.container import Container
from packwork.units import parse_length

SLIT = 0.002
"""Width of the slits that are closed unless another is given, as a share of the container's
extent: 1.2 px of 600. Larger closes thin channels that were drawn, smaller leaves the seams of
maps. Tried on maps of states and countries."""

LONG = 10.0
"""Length of a slit, in widths, from which it is one though it parts nothing: shorter ones are
the tips of notches. Larger leaves open seams, smaller fills notches. Chosen."""

LEAST_SHARE = 1e-4
"""Share of the container's area below which slits are left as they are: too little to be seen.
Chosen."""

MOST_POINTS = 300_000
"""Vertices of a container whose slits are looked for. More take minutes. Chosen."""

MOST_DENSE = 0.5
"""Area within the slits' width of the edges, counted edge by edge, as a share of the bounds, up
to which slits are looked for. Larger takes minutes on hairs and spirals, smaller leaves slits of
fine maps. Tried."""

MOST_FINE = 12.0
"""Vertices within a slit's width of a vertex, on average, up to which slits are looked for. Larger
takes minutes on fine stairs, smaller leaves slits of what is drawn finely. Tried."""

_WELD = 1e-3
_LEAST = 1e-3


def closed_slits(container: Container, asked: str) -> Container:
    """Container whose slits are closed, which is said: ``auto``, ``none`` or up to a width.

    Examples
    --------
    >>> import numpy as np
    >>> halves = [[[0, 0], [4, 0], [4, 9], [0, 9]], [[4.01, 0], [9, 0], [9, 9], [4.01, 9]]]
    >>> outline = Outline.from_rings([np.array(half, float) for half in halves])
    >>> tile = Container("a", "a", outline, 9.0, 9.0)
    >>> len(closed_slits(tile, "auto").outline.rings), len(closed_slits(tile, "none").outline.rings)
    (1, 2)
    """
    outline = container.outline
    if asked == GAPS_NONE:
        return container
    is_auto = asked == GAPS_AUTO
    width = (
        SLIT * outline.extent if is_auto else parse_length(asked, container.unit, container.side)
    )
    if width <= 0:
        return container
    if len(outline.points) > MOST_POINTS:
        notice(f"has {len(outline.points):,} points, so its slits were not looked for")
        return container
    before = outline.region
    left, top, right, bottom = outline.bounds
    if before.length * width > MOST_DENSE * (right - left) * (bottom - top):
        notice("is all edges, so its slits were not looked for")
        return container
    if _fineness(outline, width) > MOST_FINE:
        notice("is drawn far more finely than its slits would be wide, so they were not looked for")
        return container
    after = without_slits(before, width, is_auto=is_auto)
    if after is before:
        return container
    share = (after.area - before.area) / before.area
    notice(
        f"its slits of up to {width:.3g} {container.unit} were closed ({share:.2%} of its area); "
        "--close-gaps none keeps them"
    )
    return replace(container, outline=Outline.from_region(after))


def without_slits(region: Region, width: float, *, is_auto: bool) -> Region:
    """Region with what lies between edges that face each other within a width; outer edges stay.

    With ``is_auto`` it is left alone if nothing of that parts it or is long: notches are not
    slits.
    """
    style = {"join_style": "mitre", "mitre_limit": 2.0}
    grown = buffered(region, width / 2, **style)
    closing = buffered(grown, -width / 2, **style)
    filled = [
        part for part in polygon_parts(difference(closing, region)) if part.area > _LEAST * width**2
    ]
    if not filled:
        return region
    # A little wider than they are, or rounding would leave hairs on both sides.
    wider = buffered(shapely.MultiPolygon(filled), _WELD * width, **style)
    allowed = union([region, closing])
    closed = union([region, intersection(wider, allowed)])
    is_long = max(part.length for part in filled) > 2 * LONG * width
    is_little = closed.area - region.area < LEAST_SHARE * region.area
    if is_auto and (is_little or not (is_long or _seams(closed) < _seams(region))):
        return region
    return closed


def _fineness(outline: Outline, width: float) -> float:
    """Vertices in the same cell of a width, on average."""
    cells = np.floor(outline.points / width).astype(np.int64)
    _, counts = np.unique(cells, axis=0, return_counts=True)
    return float((counts**2).sum() / len(cells))


def _seams(region: Region) -> int:
    return sum(1 + len(part.interiors) for part in polygon_parts(region))
