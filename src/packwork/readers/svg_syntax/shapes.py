"""SVG's basic shapes to the same pieces of cubics that paths are made of."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from collections.abc import Callable, Sequence

import numpy as np

from packwork.arrays import FloatArray
from packwork.geometry.bezier import MAX_STEPS
from packwork.readers.reading import UnfitError
from packwork.readers.svg_syntax.coordinates import Viewport, parse_length, parse_numbers
from packwork.readers.svg_syntax.path_data import MAX_SEGMENTS, SubPath, circle_cubics, parse_path


def diagonal(viewport: Viewport) -> float:
    """Length to which percentages refer that are neither of widths nor of heights."""
    return math.hypot(*viewport) / math.sqrt(2)


def shape_pieces(element: ET.Element, viewport: Viewport) -> list[SubPath]:
    """Pieces of one clean shape element in its own units; none if it does not show.

    >>> box = ET.Element("rect", {"width": "50%", "height": "4"})
    >>> shape_pieces(box, (10.0, 10.0))[0].segments[0, 3].tolist()
    [5.0, 0.0]
    """
    return _PIECES_OF[element.tag](element, viewport)


def flattened(piece: SubPath, tolerance: float) -> FloatArray:
    """Polyline ``(n, 2)`` within ``tolerance`` of a piece, not closed by repetition."""
    return flattened_all([piece], tolerance)[0]


def flattened_all(pieces: Sequence[SubPath], tolerance: float) -> list[FloatArray]:
    """Polylines of several pieces at once, which is faster than one by one.

    >>> [len(line) for line in flattened_all(parse_path("M0 0h4v4z M9 9h1"), 0.1)]
    [3, 2]
    """
    if not pieces:
        return []
    cubics = np.concatenate([piece.segments for piece in pieces])
    counts = np.minimum(step_counts(cubics, tolerance), MAX_STEPS).astype(np.int64)
    ends = np.cumsum(counts)
    curve = np.repeat(np.arange(len(counts)), counts)
    step = np.arange(1, len(curve) + 1) - (ends - counts)[curve]
    t = (step / counts[curve])[:, None]
    s = 1 - t
    p0, p1, p2, p3 = cubics[curve].swapaxes(0, 1)
    points = s**3 * p0 + 3 * s * s * t * p1 + 3 * s * t * t * p2 + t**3 * p3
    cuts = np.concatenate([[0], ends])[np.cumsum([len(piece.segments) for piece in pieces])]
    parts = np.split(points, cuts[:-1])
    return [
        np.concatenate([np.array([piece.start]), part])
        for piece, part in zip(pieces, parts, strict=True)
    ]


def step_counts(cubics: FloatArray, tolerance: float) -> FloatArray:
    """Chords that each of ``(k, 4, 2)`` cubics needs, from the bound in ``bezier``.

    >>> step_counts(parse_path("M0 0h4 c0 8 8 8 8 0")[0].segments, 0.1).tolist()
    [1.0, 10.0]
    """
    bends = np.hypot(*np.moveaxis(np.diff(cubics, n=2, axis=1), 2, 0)).max(axis=1, initial=0.0)
    # A straight line's handles lie at its thirds but for rounding.
    steps = np.ceil(np.sqrt(0.75 * bends / tolerance) - 1e-9)
    return np.asarray(np.maximum(steps, 1.0))


def _path(element: ET.Element, _: Viewport) -> list[SubPath]:
    return parse_path(element.get("d", ""))


def _rectangle(element: ET.Element, viewport: Viewport) -> list[SubPath]:
    x, y, width, height = (
        parse_length(element.get(name), viewport[k % 2]) or 0.0
        for k, name in enumerate(("x", "y", "width", "height"))
    )
    if width <= 0 or height <= 0:
        return []
    rx = parse_length(element.get("rx"), viewport[0])
    ry = parse_length(element.get("ry"), viewport[1])
    rx = max(0.0, rx if rx is not None else ry or 0.0)
    ry = max(0.0, ry if ry is not None else rx)
    rx, ry = min(rx, width / 2), min(ry, height / 2)
    if rx == 0 or ry == 0:
        return _polygon_through([(x, y), (x + width, y), (x + width, y + height), (x, y + height)])
    arc = f"a{rx!r} {ry!r} 0 0 1"
    return parse_path(
        f"M{x + rx!r} {y!r} h{width - 2 * rx!r} {arc}{rx!r} {ry!r} v{height - 2 * ry!r} "
        f"{arc}{-rx!r} {ry!r} h{2 * rx - width!r} {arc}{-rx!r} {-ry!r} "
        f"v{2 * ry - height!r} {arc}{rx!r} {-ry!r}z"
    )


def _circle(element: ET.Element, viewport: Viewport) -> list[SubPath]:
    radius = parse_length(element.get("r"), diagonal(viewport)) or 0.0
    return _ellipse_at(element, viewport, radius, radius)


def _ellipse(element: ET.Element, viewport: Viewport) -> list[SubPath]:
    rx = parse_length(element.get("rx"), viewport[0])
    ry = parse_length(element.get("ry"), viewport[1])
    return _ellipse_at(element, viewport, *((rx or ry or 0.0), (ry or rx or 0.0)))


def _ellipse_at(element: ET.Element, viewport: Viewport, rx: float, ry: float) -> list[SubPath]:
    if rx <= 0 or ry <= 0:
        return []
    cx = parse_length(element.get("cx"), viewport[0]) or 0.0
    cy = parse_length(element.get("cy"), viewport[1]) or 0.0
    steps = np.array(circle_cubics((0.0, 0.0), 1.0, 0.0, 2 * math.pi))
    steps[-1, 2] = (1.0, 0.0)
    starts = np.roll(steps[:, 2:], 1, axis=0)
    cubics = np.concatenate([starts, steps], axis=1) * (rx, ry) + (cx, cy)
    return [SubPath(cubics, (cx + rx, cy), is_closed=True)]


def _line(element: ET.Element, viewport: Viewport) -> list[SubPath]:
    x1, y1, x2, y2 = (
        parse_length(element.get(name), viewport[k % 2]) or 0.0
        for k, name in enumerate(("x1", "y1", "x2", "y2"))
    )
    return _pieces_through([(x1, y1), (x2, y2)], is_closed=False)


def _polyline(element: ET.Element, _: Viewport) -> list[SubPath]:
    return _pieces_through(points_of(element), is_closed=False)


def _polygon(element: ET.Element, _: Viewport) -> list[SubPath]:
    return _polygon_through(points_of(element))


def points_of(element: ET.Element) -> list[tuple[float, float]]:
    """Corners of a polygon or a polyline, in its own units.

    >>> points_of(ET.Element("polyline", {"points": "0 0 2,1.5"}))
    [(0.0, 0.0), (2.0, 1.5)]
    """
    numbers = parse_numbers(element.get("points"))
    if len(numbers) > 2 * MAX_SEGMENTS:
        raise UnfitError(f"has a polygon of more than {MAX_SEGMENTS:,} points; simplify it")
    return list(zip(numbers[::2], numbers[1::2], strict=False))


def _polygon_through(points: list[tuple[float, float]]) -> list[SubPath]:
    return _pieces_through(points, is_closed=True)


def _pieces_through(points: list[tuple[float, float]], *, is_closed: bool) -> list[SubPath]:
    if len(points) < 2:
        return []
    corners = np.array(points)
    shares = np.arange(4)[:, None, None] / 3
    lines = corners[:-1] * (1 - shares) + corners[1:] * shares
    return [SubPath(np.swapaxes(lines, 0, 1), points[0], is_closed)]


_PIECES_OF: dict[str, Callable[[ET.Element, Viewport], list[SubPath]]] = {
    "path": _path,
    "rect": _rectangle,
    "circle": _circle,
    "ellipse": _ellipse,
    "line": _line,
    "polyline": _polyline,
    "polygon": _polygon,
}
