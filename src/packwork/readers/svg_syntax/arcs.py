"""Elliptical arcs to cubics, by the construction of SVG 1.1, appendix F.6."""

from __future__ import annotations

import math
from typing import TypeAlias

Point: TypeAlias = tuple[float, float]
Step: TypeAlias = tuple[Point, Point, Point]
"""Two handles and the end of a cubic; it begins where the one before it ended."""

ARC_STEP_RAD = math.pi / 8
"""Widest arc drawn as one cubic: it is then within 7e-8 of the radius. Derived."""

_FLATTEST = 1e-9
"""Radius as a share of the chord or of the coordinates, whichever is larger, below which an arc
is a line: no digits are left."""


def arc_cubics(
    start: Point, end: Point, axes: tuple[float, float, float], large: float, sweep: float
) -> list[Step]:
    """Cubics along the arc from ``start`` to ``end``; none if the two are the same.

    Parameters
    ----------
    axes
        Both radii, grown where they are too short, and the turn of the first in degrees.
    large, sweep
        The two flags of path data, 0 or 1.

    Examples
    --------
    >>> len(arc_cubics((0.0, 0.0), (2.0, 0.0), (1, 1, 0), 0, 1))
    8
    """
    rx, ry = abs(axes[0]), abs(axes[1])
    if start == end:
        return []
    reach = max(math.dist(start, end), *map(abs, (*start, *end)))
    if min(rx, ry) <= _FLATTEST * reach:
        return [(start, end, end)]
    cosine, sine = math.cos(math.radians(axes[2])), math.sin(math.radians(axes[2]))

    def to_circle(p: Point) -> Point:
        return (cosine * p[0] + sine * p[1]) / rx, (cosine * p[1] - sine * p[0]) / ry

    def to_plane(p: Point) -> Point:
        u, v = rx * p[0], ry * p[1]
        return cosine * u - sine * v, sine * u + cosine * v

    steps = _unit_arc(to_circle(start), to_circle(end), bool(large), bool(sweep))
    plane = [(to_plane(a), to_plane(b), to_plane(c)) for a, b, c in steps]
    return [*plane[:-1], (plane[-1][0], plane[-1][1], end)]


def circle_cubics(centre: Point, radius: float, begin_rad: float, span_rad: float) -> list[Step]:
    """Cubics of equal angle along a circular arc.

    Examples
    --------
    >>> len(circle_cubics((0.0, 0.0), 1.0, 0.0, 2 * math.pi))
    16
    """
    count = max(1, math.ceil(abs(span_rad) / ARC_STEP_RAD - 1e-9))
    step = span_rad / count
    reach = 4 / 3 * math.tan(step / 4) * radius
    steps = []
    for k in range(count):
        a, b = begin_rad + k * step, begin_rad + (k + 1) * step
        xa, ya = centre[0] + radius * math.cos(a), centre[1] + radius * math.sin(a)
        xb, yb = centre[0] + radius * math.cos(b), centre[1] + radius * math.sin(b)
        first = (xa - reach * math.sin(a), ya + reach * math.cos(a))
        steps.append((first, (xb + reach * math.sin(b), yb - reach * math.cos(b)), (xb, yb)))
    return steps


def _unit_arc(start: Point, end: Point, large: bool, sweep: bool) -> list[Step]:
    """Arc between two points on a circle of radius 1, or larger if they are too far."""
    (u0, v0), (u1, v1) = start, end
    half = math.dist(start, end) / 2
    radius = max(1.0, half)
    rise = math.sqrt(radius**2 - half**2) * (-1 if large == sweep else 1) / (2 * half)
    cu, cv = (u0 + u1) / 2 - rise * (v1 - v0), (v0 + v1) / 2 + rise * (u1 - u0)
    begin = math.atan2(v0 - cv, u0 - cu)
    span = (math.atan2(v1 - cv, u1 - cu) - begin) % (2 * math.pi)
    return circle_cubics((cu, cv), radius, begin, span if sweep else span - 2 * math.pi)
