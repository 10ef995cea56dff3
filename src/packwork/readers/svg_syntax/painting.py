"""Inherited paint properties of SVG, and whether they leave any ink."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field, replace

from packwork.geometry.polygon import FillRule
from packwork.readers.svg_syntax.lengths import parse_length

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
    width
        Full width, positive.
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

    Examples
    --------
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
        """Painting of an element inside this one.

        Parameters
        ----------
        attributes
            Of a clean element.
        diagonal
            What percentages of the stroke's width refer to.
        """
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

    Examples
    --------
    >>> [is_clear(c) for c in ("none", "#0000", "rgba(9,9,9,0.0)", "rgb(9,9,0)", "red")]
    [True, True, True, False, False]
    """
    if _CLEAR.fullmatch(colour.strip()) is None:
        return False
    return "(" not in colour or "/" in colour or colour.count(",") == _COMMAS


def opacity(text: str | None, otherwise: float) -> float:
    """Opacity from 0 to 1 as a number or in percent.

    Examples
    --------
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
