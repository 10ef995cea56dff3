"""Agreement of a PDF with the SVG that it was made of, each path in its place.

Both are lists of paths in painting order. A path of the PDF is one of the SVG if the two lie
nowhere farther apart than a tolerance, have the same pen and are cut by the same clips. Where
curves are cut into the same pieces their control points are compared, which no points of these
are farther apart than; else points of each with the other's line.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, final

import numpy as np
import shapely

from packwork.arrays import FloatArray
from packwork.geometry.overlay import buffered, intersection
from packwork.geometry.polygon import Region, region
from packwork.readers.gate.door import parse_xml
from packwork.readers.layouts.arts import LINK
from packwork.readers.layouts.foreign_svg import tag
from packwork.readers.reading import UnfitError
from packwork.readers.svg.walk import painted_shapes
from packwork.readers.svg_syntax.coordinates import Page, read_page
from packwork.readers.svg_syntax.painted import Box, Clip, Painted, is_inside
from packwork.readers.svg_syntax.path_data import SubPath
from packwork.readers.svg_syntax.shapes import flattened_all
from packwork.readers.svg_syntax.vocabulary import HREF

_MOST_SEGMENTS = 10_000_000
"""Segments of one layout, repeats counted. Larger takes minutes. Chosen."""

_AHEAD = 64
"""Paths of the SVG among which one of the PDF is looked for. Larger takes longer where much
differs, smaller loses the way after as many that paint nothing. Chosen."""

_FLAT = 1e-9
"""Width over length of a path below which its fill paints nothing."""

_FINER = 4
"""Chords of a curve are as many times nearer to it than the tolerance."""

_SHARES = np.linspace(0.0, 1.0, 9)[:, None]
_SAMPLED = np.hstack([
    (1 - _SHARES) ** 3, 3 * _SHARES * (1 - _SHARES) ** 2, 3 * _SHARES**2 * (1 - _SHARES), _SHARES**3
])  # fmt: skip
"""Nine points of a cubic, as sums of its four."""


@dataclass(frozen=True, kw_only=True)
class Differences:
    """Paths that a PDF alone has, and those of the SVG that it lacks."""

    strange: Sequence[Painted]
    missing: Sequence[Painted]


def shapes_of_svg(data: bytes) -> tuple[Page, list[Painted]]:
    """Page of an SVG of ours, and what it paints; pictures are their frames.

    Examples
    --------
    >>> page, shapes = shapes_of_svg(b'<svg viewBox="0 0 9 9"><path d="M1 1h2v2z"/></svg>')
    >>> page.width, shapes[0].bounds
    (9.0, (1.0, 1.0, 3.0, 3.0))
    """
    root = parse_xml(data)
    for element in root.iter():
        element.tag = tag(element)
        link = element.attrib.pop(LINK, None)
        if element.tag == "image":
            element.tag = "rect"
        elif link is not None:
            element.attrib[HREF] = link
    page = read_page(root)
    if page is None:
        raise UnfitError("states no size")
    whole = shapely.box(0, 0, page.width, page.height)
    shapes = painted_shapes(root, page, _MOST_SEGMENTS)
    # What lies beyond the sheet is seen nowhere.
    return page, [replace(s, window=None) if whole.equals(s.window) else s for s in shapes]


def differences(svg: Sequence[Painted], pdf: Sequence[Painted], tolerance: float) -> Differences:
    """Paths of an SVG and of a PDF that have no like within a distance, CSS pixels.

    Examples
    --------
    >>> _, one = shapes_of_svg(b'<svg viewBox="0 0 9 9"><path d="M1 1h2v2z"/></svg>')
    >>> _, other = shapes_of_svg(b'<svg viewBox="0 0 9 9"><path d="M1 1.1h2v2z"/></svg>')
    >>> [len(differences(one, other, reach).strange) for reach in (0.01, 0.2)]
    [1, 0]
    """
    cuts: dict[Clip, _Lines] = {}
    ahead = (part for shape in svg for part in _parts(shape, tolerance, cuts))
    waiting: list[_Part] = []
    strange = []
    for part in (part for shape in pdf for part in _parts(shape, tolerance, cuts)):
        found = next((k for k, one in enumerate(waiting) if part.is_like(one)), None)
        while found is None and len(waiting) < _AHEAD and (one := next(ahead, None)) is not None:
            found = len(waiting) if part.is_like(one) else None
            waiting.append(one)
        if found is None:
            strange.append(part.shape)
        else:
            waiting.pop(found)
    missing = [part.shape for part in (*waiting, *ahead) if part.shows]
    return Differences(strange=strange, missing=missing)


def _parts(shape: Painted, tolerance: float, cuts: dict[Clip, _Lines]) -> Iterator[_Part]:
    lines = _Lines([piece.placed(shape.matrix) for piece in shape.pieces], tolerance)
    own = [_cut(clip, tolerance, cuts) for clip in _all_clips(shape)]
    kinds = [True] * shape.painting.has_fill + [False] * shape.painting.has_stroke
    return (_Part(shape, lines, own, is_filled=kind) for kind in kinds)


def _all_clips(shape: Painted) -> Iterator[Clip]:
    for clip in shape.clips:
        yield clip
        for one in clip.shapes:
            yield from _all_clips(one)


def _cut(clip: Clip, tolerance: float, cuts: dict[Clip, _Lines]) -> _Lines:
    if clip not in cuts:
        pieces = [piece.placed(one.matrix) for one in clip.shapes for piece in one.pieces]
        cuts[clip] = _Lines(pieces, tolerance)
    return cuts[clip]


@final
class _Lines:
    """Pieces in place, CSS pixels, and what lies near them."""

    def __init__(self, pieces: Sequence[SubPath], tolerance: float) -> None:
        self.pieces = [piece for piece in pieces if len(piece.segments)]
        self.tolerance = tolerance

    def is_near(self, other: _Lines) -> bool:
        """Whether neither has a point that is farther from the other than the tolerance."""
        if self._form == other._form:
            apart = self.controls - other.controls
            if np.hypot(apart[:, 0], apart[:, 1]).max(initial=0.0) <= self.tolerance:
                return True
        if not (self.pieces and other.pieces):
            return False
        return bool(
            np.abs(np.subtract(self._drawn.bounds, other._drawn.bounds)).max() <= self.tolerance
            and shapely.dwithin(self._drawn, other._points, self.tolerance).all()
            and shapely.dwithin(other._drawn, self._points, self.tolerance).all()
        )

    def region(self) -> Region:
        """Region that they surround."""
        return region(flattened_all(self.pieces, self.tolerance / _FINER))

    @cached_property
    def controls(self) -> FloatArray:
        """Control points of all segments, ``(n, 2)``."""
        segments = [piece.segments.reshape(-1, 2) for piece in self.pieces]
        return np.concatenate([np.zeros((0, 2)), *segments])

    @cached_property
    def _form(self) -> list[tuple[int, bool]]:
        return [(len(piece.segments), piece.is_closed) for piece in self.pieces]

    @cached_property
    def _drawn(self) -> Any:
        lines = flattened_all(self.pieces, self.tolerance / _FINER)
        closed = [
            np.concatenate([line, line[:1]]) if piece.is_closed else line
            for line, piece in zip(lines, self.pieces, strict=True)
        ]
        drawn = shapely.MultiLineString(closed)
        shapely.prepare(drawn)
        return drawn

    @cached_property
    def _points(self) -> Any:
        return shapely.points(_SAMPLED @ self.controls.reshape(-1, 4, 2))


@final
class _Part:
    """The fill or the stroke of a shape."""

    def __init__(
        self, shape: Painted, lines: _Lines, cuts: Sequence[_Lines], *, is_filled: bool
    ) -> None:
        self.shape = shape
        self._lines, self._cuts, self._is_filled = lines, cuts, is_filled

    def is_like(self, other: _Part) -> bool:
        """Whether it, of a PDF, paints the same as one of an SVG, or less."""
        return (
            self._is_filled == other._is_filled
            and (self._has_rule_of(other) if self._is_filled else self._has_pen_of(other))
            and self._lines.is_near(other._lines)
            and all(any(own.is_near(cut) for own in self._cuts) for cut in other._cuts)
            and self._is_within(other)
        )

    @property
    def shows(self) -> bool:
        """Whether it leaves paint, of an SVG."""
        controls, window = self._lines.controls, self.shape.window
        if not len(controls) or any(not cut.pieces for cut in self._cuts):
            return False
        if window is not None and not shapely.intersects(window, shapely.box(*self._box)):
            return False
        sizes = np.linalg.svd(controls - controls[0], compute_uv=False)
        return bool(sizes[-1] > _FLAT * sizes[0] if self._is_filled else sizes[0] > 0)

    def _has_rule_of(self, other: _Part) -> bool:
        rules = {self.shape.painting.fill_rule, other.shape.painting.fill_rule}
        return len(rules) == 1 or len(self._lines.pieces) == 1

    def _has_pen_of(self, other: _Part) -> bool:
        one, two = self.shape.painting.pen, other.shape.painting.pen
        is_bent = two.join in {"round", "bevel"}
        # A mitre reaches as many times half the width.
        reach = 1.0 if is_bent else one.miter_limit
        apart = reach * float(np.linalg.norm(self._nib - other._nib, 2))
        own, its = (
            math.sqrt(abs(np.linalg.det(part.shape.matrix[:, :2]))) for part in (self, other)
        )
        return (
            apart <= self._lines.tolerance
            and one.cap == two.cap
            and one.join == (two.join if is_bent else "miter")
            and (is_bent or math.isclose(one.miter_limit, two.miter_limit, rel_tol=1e-5))
            and len(one.dashes) == len(two.dashes)
            and np.allclose(own * np.array(one.dashes), its * np.array(two.dashes), rtol=1e-5)
        )

    @cached_property
    def _nib(self) -> FloatArray:
        """Half the pen in place: the symmetric part of the map that makes it of a circle."""
        left, sizes, _ = np.linalg.svd(self.shape.matrix[:, :2])
        return np.asarray(left * (sizes * self.shape.painting.pen.width / 2) @ left.T)

    def _is_within(self, other: _Part) -> bool:
        """Whether it shows no more than viewports of the SVG let through."""
        window, box = other.shape.window, self._box
        if window is None or is_inside(window, box):
            return True
        shown = shapely.box(*box)
        for cut in self._cuts:
            shown = intersection(shown, cut.region())
        slack = buffered(window, self._lines.tolerance, join_style="mitre")
        return bool(shown.area == 0 or shapely.covers(slack, shown))

    @property
    def _box(self) -> Box:
        """Box that holds all of it, mitres too."""
        pen = self.shape.painting.pen
        half = 0.0 if self._is_filled else pen.miter_limit * float(np.linalg.norm(self._nib, 2))
        left, top, right, bottom = self.shape.bounds
        return left - half, top - half, right + half, bottom + half
