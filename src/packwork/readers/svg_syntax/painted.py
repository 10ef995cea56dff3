"""Paint properties of SVG, and shapes, clips and texts as a walk through a drawing finds them."""

from __future__ import annotations

import math
import re
import xml.etree.ElementTree as ET
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TypeAlias

import numpy as np
import shapely

from packwork.arrays import FloatArray
from packwork.geometry import affine
from packwork.geometry.polygon import FillRule, Region
from packwork.readers.reading import UnfitError
from packwork.readers.svg_syntax.coordinates import MAX_COORDINATE, Viewport, parse_length
from packwork.readers.svg_syntax.path_data import SubPath

_CLEAR = re.compile(
    r"none|transparent|#[0-9a-f]{3}0|#[0-9a-f]{6}00"
    r"|(?:rgb|hsl)a?\([^()]*[,/]\s*[-+]?(?:0+(?:\.0*)?|\.0+)%?\s*\)",
    re.IGNORECASE,
)
_INHERITED = frozenset(
    {"fill", "stroke", "color", "visibility", "fill-opacity", "stroke-opacity"}
    | {"fill-rule", "clip-rule", "stroke-width", "stroke-linecap", "stroke-linejoin"}
    | {"stroke-miterlimit", "stroke-dasharray", "stroke-dashoffset"}
)
_COMMAS = 3
"""Commas that a colour needs for its last number to be its opacity."""
_WORDS = {
    "stroke-linecap": ("butt", "round", "square"),
    "stroke-linejoin": ("miter", "round", "bevel", "miter-clip", "arcs"),
}


@dataclass(frozen=True)
class StrokeStyle:
    """Pen of a line, in the units of the line.

    Parameters
    ----------
    cap, join
        SVG's words.
    miter_limit
        Largest ratio of a mitre's length to the width.
    dashes
        Lengths of dashes and gaps in turn, an even number of them; none for a solid line.
    dash_offset
        Where in that pattern a line begins.
    """

    width: float = 1.0
    cap: str = "butt"
    join: str = "miter"
    miter_limit: float = 4.0
    dashes: tuple[float, ...] = ()
    dash_offset: float = 0.0

    @property
    def longest_gap(self) -> float:
        """Length of the longest gap between dashes, caps not counted."""
        return max(self.dashes[1::2], default=0.0)


@dataclass(frozen=True)
class Painting:
    """Inherited properties that decide where ink goes.

    >>> Painting().inherited({"fill": "none", "stroke": "#123"}, 1.0).has_stroke
    True
    """

    fill: str = "black"
    stroke: str = "none"
    color: str = "black"
    fill_opacity: float = 1.0
    stroke_opacity: float = 1.0
    fill_rule: FillRule = "nonzero"
    clip_rule: FillRule = "nonzero"
    pen: StrokeStyle = field(default_factory=StrokeStyle)
    is_visible: bool = True

    @property
    def has_fill(self) -> bool:
        """Whether the inside is painted."""
        return self._is_ink(self.fill, self.fill_opacity)

    @property
    def has_stroke(self) -> bool:
        """Whether the line is painted."""
        return self.pen.width > 0 and self._is_ink(self.stroke, self.stroke_opacity)

    def inherited(self, attributes: Mapping[str, str], diagonal: float) -> Painting:
        """Painting of a clean element inside this one; strokes' percentages are of ``diagonal``."""
        set_here = {
            k: v for k, v in attributes.items() if k in _INHERITED and v not in {"inherit", ""}
        }
        if not set_here:
            return self
        return replace(
            self,
            fill=set_here.get("fill", self.fill),
            stroke=set_here.get("stroke", self.stroke),
            color=set_here.get("color", self.color),
            fill_opacity=opacity(set_here.get("fill-opacity"), self.fill_opacity),
            stroke_opacity=opacity(set_here.get("stroke-opacity"), self.stroke_opacity),
            fill_rule=_fill_rule(set_here.get("fill-rule"), self.fill_rule),
            clip_rule=_fill_rule(set_here.get("clip-rule"), self.clip_rule),
            pen=_pen(set_here, self.pen, diagonal),
            is_visible=set_here.get("visibility", "visible" if self.is_visible else "hidden")
            not in {"hidden", "collapse"},
        )

    def _is_ink(self, paint: str, paint_opacity: float) -> bool:
        colour = self.color if paint.lower() == "currentcolor" else paint
        return self.is_visible and paint_opacity > 0 and not is_clear(colour)


def is_clear(colour: str) -> bool:
    """Whether a colour leaves nothing to be seen.

    >>> [is_clear(c) for c in ("none", "#0000", "rgba(9,9,9,0.0)", "rgb(9,9,0)", "red")]
    [True, True, True, False, False]
    """
    if _CLEAR.fullmatch(colour.strip()) is None:
        return False
    return "(" not in colour or "/" in colour or colour.count(",") == _COMMAS


def opacity(text: str | None, otherwise: float) -> float:
    """Opacity from 0 to 1 as a number or in percent.

    >>> opacity("50%", 1.0), opacity(None, 1.0), opacity("-1", 1.0)
    (0.5, 1.0, 0.0)
    """
    number = parse_length(text, 1.0)
    return otherwise if number is None else min(max(number, 0.0), 1.0)


def _fill_rule(word: str | None, otherwise: FillRule) -> FillRule:
    rules: dict[str | None, FillRule] = {"nonzero": "nonzero", "evenodd": "evenodd"}
    return rules.get(word, otherwise)


def _pen(attributes: Mapping[str, str], pen: StrokeStyle, diagonal: float) -> StrokeStyle:
    width = parse_length(attributes.get("stroke-width"), diagonal)
    limit = parse_length(attributes.get("stroke-miterlimit"), 1.0)
    offset = parse_length(attributes.get("stroke-dashoffset"), diagonal)
    dashes = attributes.get("stroke-dasharray")
    return StrokeStyle(
        width=pen.width if width is None else max(width, 0.0),
        cap=_word(attributes, "stroke-linecap", pen.cap),
        join=_word(attributes, "stroke-linejoin", pen.join),
        miter_limit=pen.miter_limit if limit is None else max(limit, 1.0),
        dashes=pen.dashes if dashes is None else _pattern(dashes, diagonal),
        dash_offset=pen.dash_offset if offset is None else offset,
    )


def _pattern(text: str, diagonal: float) -> tuple[float, ...]:
    """Dashes and gaps, an even number of them; none if they make no pattern."""
    lengths = [parse_length(word, diagonal) for word in text.replace(",", " ").split()]
    if any(length is None or length < 0 for length in lengths):
        return ()
    pattern = tuple(length for length in lengths if length is not None)
    if sum(pattern[1::2] if len(pattern) % 2 == 0 else pattern) == 0:
        return ()
    return pattern if len(pattern) % 2 == 0 else pattern * 2


def _word(attributes: Mapping[str, str], name: str, otherwise: str) -> str:
    word = attributes.get(name, otherwise)
    return word if word in _WORDS[name] else otherwise


@dataclass(frozen=True, eq=False)
class Painted:
    """One shape that leaves ink.

    Parameters
    ----------
    pieces
        In the shape's own units.
    matrix
        2 x 3 map from those to CSS pixels.
    window
        What the page and viewports show of it, in CSS pixels; None if all.
    clips
        Clip paths, each of which cuts it.
    """

    pieces: list[SubPath]
    matrix: FloatArray
    painting: Painting
    window: Region | None
    element: ET.Element
    clips: tuple[Clip, ...] = ()

    @cached_property
    def bounds(self) -> tuple[float, float, float, float]:
        """Left, top, right and bottom of all starts, handles and ends, in CSS pixels."""
        placed = self._control_points
        (left, top), (right, bottom) = placed.min(axis=0).tolist(), placed.max(axis=0).tolist()
        return left, top, right, bottom

    @cached_property
    def lengths(self) -> tuple[float, float]:
        """Way from point to point across and down, all pieces together, in CSS pixels."""
        across, down = np.abs(np.diff(self._control_points, axis=0)).sum(axis=0).tolist()
        return across, down

    @cached_property
    def _control_points(self) -> FloatArray:
        points = [piece.segments.reshape(-1, 2) for piece in self.pieces]
        points.append(np.array([piece.start for piece in self.pieces]))
        return affine.apply(self.matrix, np.concatenate(points))


@dataclass(frozen=True, eq=False)
class Clip:
    """A clip path where it is used: it lets through what lies inside any of its shapes."""

    shapes: tuple[Painted, ...]


@dataclass(frozen=True, eq=False)
class PlacedText:
    """One text element where it stands, not where a ``use`` repeats it.

    Parameters
    ----------
    matrix
        2 x 3 map from its own units to CSS pixels.
    viewport
        What its percentages refer to.
    above
        What it stands in, outermost first.
    """

    element: ET.Element
    matrix: FloatArray
    viewport: Viewport
    above: tuple[ET.Element, ...]


Box: TypeAlias = tuple[float, float, float, float]
"""Left, top, right and bottom in CSS pixels."""


def drawing_box(shapes: Iterable[Painted]) -> Box | None:
    """Box round control points and pens that can show; None if nothing can."""
    boxes = [box for shape in shapes if (box := shown_box(shape)) is not None]
    if not boxes:
        return None
    lefts, tops, rights, bottoms = zip(*boxes, strict=True)
    return min(lefts), min(tops), max(rights), max(bottoms)


def shown_box(shape: Painted, *, is_safe: bool = False) -> Box | None:
    """Box of what can show of one shape: cut by its windows and clips.

    ``is_safe`` holds the farthest corners that the pen may draw.
    """
    box: Box | None = whole_box(shape, is_safe=is_safe)
    if shape.window is not None:
        if shape.window.is_empty:
            return None
        box = _common(box, shape.window.bounds)
    for clip in shape.clips:
        box = _common(box, drawing_box(clip.shapes))
    return box


def whole_box(shape: Painted, *, is_safe: bool = False) -> Box:
    """Box of one shape's control points and half its pen's width, uncut.

    ``is_safe`` holds the farthest corners that the pen may draw, which hardly ever are drawn.
    """
    left, top, right, bottom = shape.bounds
    margin = 0.0
    if shape.painting.has_stroke:
        pen = shape.painting.pen
        reach = max(math.sqrt(2), pen.miter_limit) if is_safe else 1.0
        margin = stretch(shape.matrix) * reach * pen.width / 2
    box = (left - margin, top - margin, right + margin, bottom + margin)
    if not all(abs(side) <= MAX_COORDINATE for side in box) and not is_safe:
        raise UnfitError(f"reaches beyond {MAX_COORDINATE:g} px; give it a smaller scale")
    return box


def is_inside(window: Region, box: Box) -> bool:
    """Whether a box lies within a region."""
    left, top, right, bottom = window.bounds
    if not (left <= box[0] and top <= box[1] and box[2] <= right and box[3] <= bottom):
        return False
    return bool(shapely.covers(window, shapely.box(*box)))


def stretch(matrix: FloatArray) -> float:
    """Greater singular value of a 2 x 3 map: the largest factor by which it lengthens.

    >>> import numpy as np
    >>> stretch(np.array([[0.0, -3.0, 5.0], [2.0, 0.0, 7.0]]))
    3.0
    """
    (a, c, _), (b, d, _) = matrix.tolist()
    return math.hypot(a + d, b - c) / 2 + math.hypot(a - d, b + c) / 2


def _common(box: Box | None, other: Box | None) -> Box | None:
    if box is None or other is None:
        return None
    left, top = max(box[0], other[0]), max(box[1], other[1])
    right, bottom = min(box[2], other[2]), min(box[3], other[3])
    return (left, top, right, bottom) if right >= left and bottom >= top else None
