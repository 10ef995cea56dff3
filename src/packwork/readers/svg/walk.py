"""A clean drawing to its painted shapes: groups, transforms, ``use`` and viewports."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from dataclasses import dataclass, replace

import numpy as np
import shapely
from shapely.geometry import Polygon

from packwork.arrays import FloatArray
from packwork.geometry import affine
from packwork.geometry.polygon import Region
from packwork.readers.gate.references import elements_by_id
from packwork.readers.gate.sanitise import HREF
from packwork.readers.gate.vocabulary import NEVER_DRAWN, SHAPES
from packwork.readers.svg.lengths import MAX_COORDINATE, parse_length, parse_numbers
from packwork.readers.svg.painting import Painting, opacity
from packwork.readers.svg.path_data import MAX_SEGMENTS, SubPath
from packwork.readers.svg.shapes import Viewport, diagonal, shape_pieces
from packwork.readers.svg.transforms import parse_transform, view_matrix
from packwork.readers.unfit import UnfitError

PLAIN_VIEWPORT: Viewport = (100.0, 100.0)
"""What percentages refer to in a drawing that states no size."""


@dataclass(frozen=True, eq=False)
class Page:
    """The rectangle of a drawing that viewers show, in CSS pixels from the origin.

    Parameters
    ----------
    width, height
        Its size.
    matrix
        2 x 3 map from the root's user units to CSS pixels.
    """

    width: float
    height: float
    matrix: FloatArray


@dataclass(frozen=True, eq=False)
class Painted:
    """One shape that leaves ink.

    Parameters
    ----------
    pieces
        In the shape's own units.
    matrix
        2 x 3 map from those to CSS pixels.
    painting
        How it is filled and stroked.
    window
        What shows of it, in CSS pixels; None if all does.
    """

    pieces: list[SubPath]
    matrix: FloatArray
    painting: Painting
    window: Region | None


def read_page(root: ET.Element) -> Page | None:
    """Page of a clean ``<svg>``; None if it states neither its size nor a ``viewBox``.

    Raises
    ------
    UnfitError
        If the page or its ``viewBox`` has no area.

    Examples
    --------
    >>> page = read_page(ET.Element("svg", {"viewBox": "0 0 24 12", "width": "1in"}))
    >>> page.width, page.height, page.matrix[0, 0].item()
    (96.0, 48.0, 4.0)
    """
    view = view_box(root)
    width, height = (_absolute(root.get(name)) for name in ("width", "height"))
    if view is not None:
        if width is None:
            width = view[2] if height is None else height * view[2] / view[3]
        if height is None:
            height = width * view[3] / view[2]
    if width is None or height is None:
        return None
    if min(width, height) <= 0 or max(width, height) > MAX_COORDINATE:
        raise UnfitError(f"has a page of {width:g} x {height:g} px; give it a width and a height")
    fit = root.get("preserveAspectRatio", "")
    matrix = view_matrix(view, width, height, fit) if view else affine.identity()
    return Page(width, height, matrix)


def view_box(element: ET.Element) -> tuple[float, float, float, float] | None:
    """Left, top, width and height of a ``viewBox``, if the element has one.

    Raises
    ------
    UnfitError
        If it has no area.

    Examples
    --------
    >>> view_box(ET.Element("svg", {"viewBox": "0,0,2,1"}))
    (0.0, 0.0, 2.0, 1.0)
    """
    numbers = parse_numbers(element.get("viewBox"))
    if len(numbers) != 4:
        return None
    left, top, width, height = numbers
    if min(width, height) <= 0:
        raise UnfitError(f"has a viewBox of {width:g} x {height:g}; give it a width and a height")
    return left, top, width, height


def painted_shapes(root: ET.Element, page: Page | None) -> list[Painted]:
    """Every shape of a clean drawing that leaves ink, in painting order.

    Raises
    ------
    UnfitError
        If numbers are not finite or absurd, or there are too many segments.

    Examples
    --------
    >>> root = ET.fromstring('<svg><circle r="3"/><path d="M0 0h1" fill="none"/></svg>')
    >>> len(painted_shapes(root, None))
    1
    """
    walk = _Walk(root)
    view = view_box(root)
    if page is None:
        frame = _Frame(affine.identity(), Painting(), PLAIN_VIEWPORT, None)
    else:
        viewport = (view[2], view[3]) if view else (page.width, page.height)
        window = shapely.box(0, 0, page.width, page.height)
        frame = _Frame(page.matrix, Painting(), viewport, window)
    if not walk.is_hidden(root):
        walk.visit_children(root, walk.framed(root, frame))
    return walk.painted


def _absolute(text: str | None) -> float | None:
    """A page's side; a share of an unknown window is none."""
    return None if text is not None and "%" in text else parse_length(text, 0.0)


@dataclass(frozen=True, eq=False)
class _Frame:
    """What surrounds an element."""

    matrix: FloatArray
    painting: Painting
    viewport: Viewport
    window: Region | None


class _Walk:
    """Visits a tree and collects what it paints."""

    def __init__(self, root: ET.Element) -> None:
        self.painted: list[Painted] = []
        self._by_id = elements_by_id(root)
        self._known: dict[tuple[ET.Element, Viewport], list[SubPath]] = {}
        self._segments = 0

    def visit(self, element: ET.Element, frame: _Frame) -> None:
        """Collect what one element paints inside its frame."""
        if element.tag in NEVER_DRAWN or self.is_hidden(element):
            return
        inner = self.framed(element, frame)
        if element.tag in SHAPES:
            self._paint(element, inner)
        elif element.tag == "use":
            self._follow(element, inner)
        elif element.tag == "svg":
            self._enter_viewport(element, element, inner)
        else:
            self.visit_children(element, inner)

    def visit_children(self, element: ET.Element, frame: _Frame) -> None:
        """Collect what the children paint."""
        for child in element:
            self.visit(child, frame)

    def is_hidden(self, element: ET.Element) -> bool:
        """Whether neither the element nor anything inside it shows."""
        return element.get("display") == "none" or opacity(element.get("opacity"), 1.0) == 0

    def framed(self, element: ET.Element, frame: _Frame) -> _Frame:
        """Frame with the element's own transform and properties."""
        own = parse_transform(element.get("transform"))
        painting = frame.painting.inherited(element.attrib, diagonal(frame.viewport))
        return replace(frame, matrix=affine.compose(frame.matrix, own), painting=painting)

    def _paint(self, element: ET.Element, frame: _Frame) -> None:
        if not (frame.painting.has_fill or frame.painting.has_stroke):
            return
        key = (element, frame.viewport)
        if key not in self._known:
            self._known[key] = shape_pieces(element, frame.viewport)
        pieces = self._known[key]
        self._segments += sum(len(piece.segments) for piece in pieces)
        if self._segments > MAX_SEGMENTS:
            raise UnfitError(f"has more than {MAX_SEGMENTS:,} path segments; simplify it")
        if pieces:
            self.painted.append(Painted(pieces, frame.matrix, frame.painting, frame.window))

    def _follow(self, use: ET.Element, frame: _Frame) -> None:
        target = self._by_id.get(use.get(HREF, "")[1:])
        if target is None:
            return
        x = parse_length(use.get("x"), frame.viewport[0]) or 0.0
        y = parse_length(use.get("y"), frame.viewport[1]) or 0.0
        shift = affine.similarity(x, y, 0.0, 1.0)
        moved = replace(frame, matrix=affine.compose(frame.matrix, shift))
        if target.tag in {"symbol", "svg"} and not self.is_hidden(target):
            self._enter_viewport(target, use, self.framed(target, moved))
        else:
            self.visit(target, moved)

    def _enter_viewport(self, element: ET.Element, sized: ET.Element, frame: _Frame) -> None:
        """Visit a nested ``svg`` or a ``symbol``; ``sized`` says how large it is."""
        x, y, width, height = self._viewport(element, sized, frame.viewport)
        if width <= 0 or height <= 0:
            return
        view = view_box(element)
        fit = element.get("preserveAspectRatio", "")
        inner = view_matrix(view, width, height, fit) if view else affine.identity()
        place = affine.compose(frame.matrix, affine.similarity(x, y, 0.0, 1.0))
        window = frame.window
        if element.get("overflow") not in {"visible", "auto"} and (view or element.tag == "svg"):
            window = _narrowed(window, place, width, height)
        viewport = (view[2], view[3]) if view else (width, height)
        nested = _Frame(affine.compose(place, inner), frame.painting, viewport, window)
        self.visit_children(element, nested)

    def _viewport(
        self, element: ET.Element, sized: ET.Element, outer: Viewport
    ) -> tuple[float, float, float, float]:
        """Left, top, width and height of a nested viewport; a ``use`` has moved already."""
        sides = []
        for k, name in enumerate(("width", "height")):
            own = parse_length(element.get(name), outer[k]) if element.tag == "svg" else None
            asked = parse_length(sized.get(name), outer[k])
            stated = own if asked is None else asked
            sides.append(outer[k] if stated is None else stated)
        x = parse_length(element.get("x"), outer[0]) if element.tag == "svg" else None
        y = parse_length(element.get("y"), outer[1]) if element.tag == "svg" else None
        return x or 0.0, y or 0.0, sides[0], sides[1]


def _narrowed(window: Region | None, place: FloatArray, width: float, height: float) -> Region:
    corners = np.array([(0.0, 0.0), (width, 0.0), (width, height), (0.0, height)])
    box = Polygon(affine.apply(place, corners))
    return box if window is None else shapely.intersection(window, box)
