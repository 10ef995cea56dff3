"""Outlines of paths made of a few closed contours, as words are: what recurs is followed once.

The same letter stands in thousands of words, each time at another place. Contours whose boxes meet
are one glyph; glyphs that differ by a shift are followed and cut from each other once.
"""

from __future__ import annotations

import copy
import math
import re
import xml.etree.ElementTree as ET
from collections.abc import Sequence
from dataclasses import dataclass
from typing import final

import numpy as np
import shapely

from packwork.arrays import FloatArray
from packwork.geometry.bezier import FLATTENING
from packwork.geometry.distance import snap_rounded
from packwork.geometry.outline import Outline, joined
from packwork.geometry.polygon import FillRule, Region, polygon_parts, silhouette
from packwork.readers.budget.crossings import MAX_CROSSINGS, Allowance
from packwork.readers.layouts.foreign_svg import tag
from packwork.readers.svg.ink import filled
from packwork.readers.svg_syntax.coordinates import MAX_COORDINATE
from packwork.readers.svg_syntax.path_data import parse_path
from packwork.readers.svg_syntax.shapes import flattened_all

MOST_CONTOURS = 400
"""Contours of a path that is followed so. All boxes are compared with each other: larger takes
time with its square. A hundred letters have two hundred."""

LONGEST = 100_000
"""Characters of such a path. Longer ones are drawings, of which seldom a part recurs."""

COARSEST = 4 * FLATTENING
"""Largest distance of a curve from its chords, as a share of a path's extent, however small a copy
is: as coarse as the outlines of words are (``readers.fonts.lettering.MOST_COARSE``)."""

APART = 1e-6
"""Share of a path's extent by which boxes are apart, so that rings in them keep clear of each other
(``geometry.distance.STEP`` is finer)."""

_NUMBER = r"-?\d++(?:\.\d++)?+"
_PAIR = rf" ?{_NUMBER}(?:[ ,]|(?=-)){_NUMBER}"
_CONTOURS = re.compile(
    rf"(?:M{_PAIR}(?:L{_PAIR}|Q{_PAIR}[ ,]?{_PAIR}|C{_PAIR}[ ,]?{_PAIR}[ ,]?{_PAIR})*+Z)++"
)
_COMMAND = re.compile(r"[A-Z]")
_PLACING = frozenset({"transform", "data-bays"})
_FLAT_PAINT = re.compile(r"#[0-9a-fA-F]{6}")
_GROUP = frozenset({"id", "color", "fill"})
_PATH = frozenset({"id", "d", "fill", "fill-rule"})


def bare(source: ET.Element) -> ET.Element:
    """A drawing's element without what tells of its place.

    Examples
    --------
    >>> bare(ET.fromstring('<g id="a" transform="scale(2)"/>')).attrib
    {'id': 'a'}
    """
    found = copy.copy(source)
    found.attrib = {key: v for key, v in source.attrib.items() if key not in _PLACING}
    return found


def lettering_path(element: ET.Element) -> tuple[str, FillRule] | None:
    """Path data and fill rule of an element that is one path in one opaque colour, else None.

    Groups about it may name colours, nothing more.

    Examples
    --------
    >>> group = ET.fromstring('<g color="#000000"><path fill="#aa0000" d="M0 0L4 0L4 4Z"/></g>')
    >>> lettering_path(group)
    ('M0 0L4 0L4 4Z', 'nonzero')
    """
    fill = None
    while tag(element) == "g" and len(element) == 1 and element.attrib.keys() <= _GROUP:
        fill = element.get("fill", fill)
        element = element[0]
    data, rule = element.get("d", ""), element.get("fill-rule", "nonzero")
    if not (tag(element) == "path" and len(element) == 0 and element.attrib.keys() <= _PATH):
        return None
    # A path without a colour is black.
    if not _FLAT_PAINT.fullmatch(element.get("fill", fill or "#000000")):
        return None
    rules: dict[str, FillRule] = {"nonzero": "nonzero", "evenodd": "evenodd"}
    return (data, rules[rule]) if rule in rules else None


@final
@dataclass(frozen=True, eq=False)
class _Glyph:
    """Outlines about the first point of all; ``speck`` is the least area of a ring."""

    ink: Outline
    silhouette: Outline
    speck: float


@final
class LetteringOutlines:
    """Outlines of paths of one file, each glyph followed once.

    ``speck`` is the share of a path's area from which a ring counts.
    """

    def __init__(self, speck: float) -> None:
        self._speck = speck
        self._glyphs: dict[tuple[object, ...], _Glyph | None] = {}

    def outline(
        self, data: str, rule: FillRule, tolerance: float, *, keeps_holes: bool
    ) -> Outline | None:
        """Outline of a path's data in its own units, or None: to be followed as drawings are.

        ``tolerance`` is the largest distance of a curve from its chords. None of what is no chain
        of lines and curves that are closed, of specks, and of what is too large.

        Examples
        --------
        >>> two = "M0 0L4 0L4 4L0 4ZM1 1L1 3L3 3L3 1ZM10 0L14 0L14 4L10 4Z"
        >>> found = LetteringOutlines(1e-6).outline(two, "nonzero", 0.1, keeps_holes=True)
        >>> found.area, len(found.rings)
        (28.0, 3)
        """
        contours = _contours(data)
        if contours is None:
            return None
        boxes = np.array([[*c.points.min(axis=0), *c.points.max(axis=0)] for c in contours])
        extent = float(max(boxes[:, 2:].max(axis=0) - boxes[:, :2].min(axis=0)))
        if not 0 < extent < MAX_COORDINATE:
            return None
        # By powers of two, so that letters of words of other lengths are the same.
        finest = min(tolerance, 2.0 ** math.floor(math.log2(COARSEST * extent)))
        groups = _meeting(boxes, APART * extent)
        parts: list[Outline] = []
        area, speck = 0.0, math.inf
        for group in groups:
            members = [contours[k] for k in group]
            origin = members[0].points[0]
            shifted = [(one.commands, one.points - origin) for one in members]
            key = (rule, finest, *((names, points.tobytes()) for names, points in shifted))
            if key not in self._glyphs:
                self._glyphs[key] = _followed(shifted, rule, finest)
            glyph = self._glyphs[key]
            if glyph is None:
                return None
            area, speck = area + glyph.ink.area, min(speck, glyph.speck)
            shape = glyph.ink if keeps_holes else glyph.silhouette
            parts.append(Outline(shape.points + origin, shape.starts))
        return Outline(*joined(parts)) if speck > self._speck * area else None


@final
@dataclass(frozen=True, eq=False)
class _Contour:
    """Commands of a closed contour, and the points ``(n, 2)`` that they go by, in their order."""

    commands: str
    points: FloatArray


def _contours(data: str) -> list[_Contour] | None:
    if len(data) > LONGEST or not _CONTOURS.fullmatch(data):
        return None
    whole = data[1:].split("M")
    if len(whole) > MOST_CONTOURS:
        return None
    found = []
    for text in whole:
        numbers = _COMMAND.sub(" ", text).replace("-", " -").replace(",", " ").split()
        points = np.array(numbers, dtype=np.float64).reshape(-1, 2)
        found.append(_Contour("".join(_COMMAND.findall(text)), points))
    return found


def _meeting(boxes: FloatArray, least: float) -> list[list[int]]:
    """Indices of boxes ``(n, 4)`` that are joined by some that are nearer than ``least``."""
    low, high = boxes[:, :2] - least, boxes[:, 2:]
    meet = ((low[:, None] <= high[None]) & (low[None] <= high[:, None])).all(axis=2)
    group = np.arange(len(boxes))
    while True:
        lowest = np.where(meet, group[None], len(boxes)).min(axis=1)
        if (lowest == group).all():
            break
        group = lowest
    return [np.flatnonzero(group == one).tolist() for one in np.unique(group)]


def _followed(
    contours: Sequence[tuple[str, FloatArray]], rule: FillRule, tolerance: float
) -> _Glyph | None:
    pieces = [piece for one in contours for piece in parse_path(_text(*one))]
    rings = flattened_all(pieces, tolerance)
    inked = filled(rings, rule, Allowance(MAX_CROSSINGS))
    if inked.is_empty:
        return None
    region = snap_rounded(inked)
    parts = polygon_parts(region)
    if not parts:
        return None
    return _Glyph(
        Outline.from_region(region), Outline.from_region(silhouette(region)), _smallest(parts)
    )


def _smallest(parts: Sequence[Region]) -> float:
    """Area of the smallest part or hole."""
    rings = shapely.get_rings(np.array(parts, dtype=object))
    return float(min(*shapely.area(parts), *shapely.area(shapely.polygons(rings))))


def _text(commands: str, points: FloatArray) -> str:
    """Path data of a contour."""
    pairs = iter(points.tolist())
    taken = {"L": 1, "Q": 2, "C": 3, "Z": 0}
    drawn = "M{!r} {!r}".format(*next(pairs))
    for name in commands:
        drawn += name + " ".join("{!r} {!r}".format(*next(pairs)) for _ in range(taken[name]))
    return drawn
