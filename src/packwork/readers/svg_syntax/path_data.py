"""SVG path data and elliptical arcs to cubics; errors end the path, as the specification says."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from packwork.arrays import FloatArray
from packwork.geometry import affine
from packwork.readers.reading import UnfitError, spend
from packwork.readers.svg_syntax.coordinates import (
    MAX_COORDINATE,
    NUMBER,
    checked,
    parse_numbers,
    refuse_not_finite,
)

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

    ``axes`` are both radii, grown where they are too short, and the turn of the first in degrees;
    ``large`` and ``sweep`` the two flags of path data, 0 or 1.

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


_SEGMENT_NS, _COUNTED = 1.5e4, 1_000
"""For reading a segment of a path, and how many are spent at once. Measured."""

MAX_SEGMENTS = 500_000
"""Segments of one drawing, repeats by ``use`` counted. Larger takes longer than a reader may,
smaller refuses files of ours: a container of 200,000 curves is written as more lines. Chosen."""

_COMMAND = re.compile(r"([MmZzLlHhVvCcSsQqTtAa])([^MmZzLlHhVvCcSsQqTtAa]*)")
_SEPARATOR = r"[\s,]*+"
_NUMBER = re.compile(NUMBER)
_PLAIN = re.compile(rf"(?:[ \t\r\n\f,]*+{NUMBER})*+[ \t\r\n\f,]*+")
"""Numbers and what parts them, nothing else: what almost all commands have."""
_ARC = re.compile(
    rf"{_SEPARATOR}({NUMBER}){_SEPARATOR}({NUMBER}){_SEPARATOR}({NUMBER})"
    rf"{_SEPARATOR}([01]){_SEPARATOR}([01]){_SEPARATOR}({NUMBER}){_SEPARATOR}({NUMBER})"
)
_ARITY = {"m": 2, "l": 2, "h": 1, "v": 1, "c": 6, "s": 4, "q": 4, "t": 2, "a": 7, "z": 0}

Cubic = tuple[Point, Point, Point, Point]


@dataclass(frozen=True, eq=False)
class SubPath:
    """One connected piece of a path.

    Parameters
    ----------
    segments
        ``(k, 4, 2)`` control points of cubics; straight lines are cubics too. With
        ``k = 0`` it is a closed single point, which only round and square caps show.
    is_closed
        Whether it ends with ``z``; the closing line is not among the segments.
    """

    segments: FloatArray
    start: Point
    is_closed: bool

    def placed(self, matrix: FloatArray) -> SubPath:
        """The piece under a map ``(2, 3)``."""
        (x, y) = affine.apply(matrix, np.array([self.start]))[0].tolist()
        segments = affine.apply(matrix, self.segments.reshape(-1, 2)).reshape(-1, 4, 2)
        return SubPath(segments, (x, y), self.is_closed)


def parse_path(data: str) -> list[SubPath]:
    """Pieces of a path up to the first error in its data.

    >>> [(len(p.segments), p.is_closed) for p in parse_path("M0 0h4v4z m9 9l1 1 oops")]
    [(2, True), (1, False)]
    """
    pen = PathBuilder()
    for name, args in _calls(data):
        if pen.at is None and name not in "Mm":
            break
        pen.draw(name, args)
        if pen.count and pen.count % _COUNTED == 0:
            spend(_COUNTED * _SEGMENT_NS, "has more path segments than can be followed")
        if pen.count > MAX_SEGMENTS:
            raise UnfitError(f"has a path of more than {MAX_SEGMENTS:,} segments; simplify it")
    return pen.finished()


def _calls(data: str) -> Iterator[tuple[str, list[float]]]:
    """Commands with one set of arguments each, up to the first error."""
    place = 0
    for match in _COMMAND.finditer(data):
        if data[place : match.start()].strip(" \t\r\n\f,"):
            break
        name, text = match.groups()
        place = match.end()
        args, is_whole = _arguments(name, text)
        size = _ARITY[name.lower()]
        if size == 0:
            yield name, []
        for first in range(0, len(args) - size + 1, size) if size else ():
            yield _repeated(name) if first else name, args[first : first + size]
        if not is_whole or (size and (not args or len(args) % size)):
            place = match.start()
            break
    refuse_not_finite(data[place:])


def _repeated(name: str) -> str:
    """Command that further arguments stand for: lines after a move."""
    return {"m": "l", "M": "L"}.get(name, name)


def _arguments(name: str, text: str) -> tuple[list[float], bool]:
    """Arguments before the first error, and whether there was none."""
    if name not in "Aa":
        if _PLAIN.fullmatch(text):
            plain = [float(number) for number in _NUMBER.findall(text)]
            if not plain or (max(plain) <= MAX_COORDINATE and min(plain) >= -MAX_COORDINATE):
                return plain, True
        numbers = parse_numbers(text)
        return numbers, not re.sub(rf"{NUMBER}|[\s,]", "", text)
    found: list[float] = []
    place = 0
    while match := _ARC.match(text, place):
        found += [checked(float(group)) for group in match.groups()]
        place = match.end()
    refuse_not_finite(text[place:])
    return found, not text[place:].strip(" \t\r\n\f,")


class PathBuilder:
    """Draws segments; the one place that knows where the current point is."""

    def __init__(self) -> None:
        self.at: Point | None = None
        self.count = 0
        self._start: Point = (0.0, 0.0)
        self._segments: list[Cubic] = []
        self._handle: Point | None = None
        self._last = ""
        self._pieces: list[SubPath] = []

    def draw(self, name: str, args: list[float]) -> None:
        """Do one command with one set of arguments."""
        kind, x, y = name.lower(), *(self.at or (0.0, 0.0))
        if name.islower():
            args = _absolute(kind, args, x, y)
        handle = self._handle if self._last in _SMOOTH_AFTER.get(kind, "") else None
        self._handle = None
        _DRAWN_BY[kind](self, args, handle)
        self._last = kind

    def move(self, args: list[float], _: Point | None = None) -> None:
        """Begin a new piece."""
        self._end_piece(is_closed=False)
        self.at = self._start = (checked(args[0]), checked(args[1]))

    def line(self, args: list[float], _: Point | None = None) -> None:
        """Straight line to a point."""
        (x0, y0), (x1, y1) = self._here(), (args[0], args[1])
        third = ((2 * x0 + x1) / 3, (2 * y0 + y1) / 3)
        self._add(third, ((x0 + 2 * x1) / 3, (y0 + 2 * y1) / 3), (x1, y1))

    def cubic(self, args: list[float], _: Point | None = None) -> None:
        """Cubic Bezier by two handles and an end."""
        self._handle = (args[2], args[3])
        self._add((args[0], args[1]), (args[2], args[3]), (args[4], args[5]))

    def close(self, _args: list[float], _: Point | None = None) -> None:
        """End the piece where it began; what follows starts there too."""
        self._end_piece(is_closed=True)
        self.at = self._start

    def finished(self) -> list[SubPath]:
        """All pieces drawn."""
        self._end_piece(is_closed=False)
        return self._pieces

    def _horizontal(self, args: list[float], _: Point | None) -> None:
        self.line([args[0], self._here()[1]])

    def _vertical(self, args: list[float], _: Point | None) -> None:
        self.line([self._here()[0], args[0]])

    def _smooth_cubic(self, args: list[float], handle: Point | None) -> None:
        self.cubic([*self._mirrored(handle), *args])

    def _quadratic(self, args: list[float], _: Point | None) -> None:
        (x0, y0), (qx, qy, x1, y1) = self._here(), args
        first = (x0 + 2 / 3 * (qx - x0), y0 + 2 / 3 * (qy - y0))
        self._add(first, (x1 + 2 / 3 * (qx - x1), y1 + 2 / 3 * (qy - y1)), (x1, y1))
        self._handle = (qx, qy)

    def _smooth_quadratic(self, args: list[float], handle: Point | None) -> None:
        self._quadratic([*self._mirrored(handle), *args], None)

    def _arc(self, args: list[float], _: Point | None) -> None:
        rx, ry, turn, large, sweep, x, y = args
        for first, second, end in arc_cubics(self._here(), (x, y), (rx, ry, turn), large, sweep):
            self._add(first, second, end)

    def _mirrored(self, handle: Point | None) -> Point:
        (x, y) = self._here()
        return (2 * x - handle[0], 2 * y - handle[1]) if handle else (x, y)

    def _here(self) -> Point:
        return self.at or (0.0, 0.0)

    def _add(self, first: Point, second: Point, end: Point) -> None:
        self._segments.append((self._here(), first, second, end))
        self.count += 1
        self.at = (checked(end[0]), checked(end[1]))

    def _end_piece(self, *, is_closed: bool) -> None:
        if self._segments or (is_closed and self.at is not None):
            segments = np.array(self._segments, dtype=np.float64).reshape(-1, 4, 2)
            self._pieces.append(SubPath(segments, self._start, is_closed))
        self._segments = []


_DRAWN_BY: dict[str, Callable[[PathBuilder, list[float], Point | None], None]] = {
    "m": PathBuilder.move,
    "l": PathBuilder.line,
    "h": PathBuilder._horizontal,
    "v": PathBuilder._vertical,
    "c": PathBuilder.cubic,
    "s": PathBuilder._smooth_cubic,
    "q": PathBuilder._quadratic,
    "t": PathBuilder._smooth_quadratic,
    "a": PathBuilder._arc,
    "z": PathBuilder.close,
}
_SMOOTH_AFTER = {"s": "cs", "t": "qt"}


def _absolute(kind: str, args: list[float], x: float, y: float) -> list[float]:
    if kind == "h":
        return [args[0] + x]
    if kind == "v":
        return [args[0] + y]
    if kind == "a":
        return [*args[:5], args[5] + x, args[6] + y]
    return [value + (y if k % 2 else x) for k, value in enumerate(args)]
