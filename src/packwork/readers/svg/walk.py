"""A clean drawing to its painted shapes: groups, transforms, ``use``, viewports, steady strokes.

Non-scaling strokes (``vector-effect``) are made as wide as on the drawing's own page; from then on
they scale with the item.
"""

from __future__ import annotations

import xml.etree.ElementTree as ET
from dataclasses import dataclass, replace

import numpy as np
import shapely
from shapely.geometry import Polygon

from packwork.arrays import FloatArray
from packwork.geometry import affine
from packwork.geometry.overlay import intersection
from packwork.geometry.polygon import Region
from packwork.readers.reading import UnfitError
from packwork.readers.svg_syntax.coordinates import (
    PLAIN_VIEWPORT,
    Page,
    Viewport,
    parse_length,
    parse_transform,
    root_viewport,
    view_box,
    view_matrix,
)
from packwork.readers.svg_syntax.painted import Clip, Painted, Painting, PlacedText, opacity
from packwork.readers.svg_syntax.path_data import MAX_SEGMENTS, SubPath
from packwork.readers.svg_syntax.references import elements_by_id, paint_server
from packwork.readers.svg_syntax.shapes import diagonal, shape_pieces
from packwork.readers.svg_syntax.vocabulary import HREF, NEVER_DRAWN, SHAPES


def painted_shapes(root: ET.Element, page: Page | None, most: int = MAX_SEGMENTS) -> list[Painted]:
    """Shapes of a clean drawing that leave ink, in painting order, of at most ``most`` segments.

    >>> root = ET.fromstring('<svg><circle r="3"/><path d="M0 0h1" fill="none"/></svg>')
    >>> len(painted_shapes(root, None))
    1
    """
    return _walked(root, page, most).painted


def placed_texts(root: ET.Element, page: Page | None) -> list[PlacedText]:
    """Every text element of a clean drawing that is drawn in its own place.

    >>> root = ET.fromstring('<svg><g transform="scale(2)"><text>a</text></g></svg>')
    >>> [(text.matrix[0, 0].item(), len(text.above)) for text in placed_texts(root, None)]
    [(2.0, 2)]
    """
    return _walked(root, page).texts


def _walked(root: ET.Element, page: Page | None, most: int = MAX_SEGMENTS) -> _Walk:
    """Walk through the whole of a clean drawing."""
    walk = _Walk(root, most)
    if page is None:
        frame = _Surroundings(affine.identity(), Painting(), PLAIN_VIEWPORT)
    else:
        window = shapely.box(0, 0, page.width, page.height)
        frame = _Surroundings(page.matrix, Painting(), root_viewport(root, page), window)
    if not walk.is_hidden(root):
        walk.visit_children(root, walk.framed(root, frame))
    return walk


@dataclass(frozen=True, eq=False)
class _Surroundings:
    """Surroundings of an element that act on it."""

    matrix: FloatArray
    painting: Painting
    viewport: Viewport
    window: Region | None = None
    clips: tuple[Clip, ...] = ()
    is_repeated: bool = False


class _Walk:
    """Visits a tree and collects what it paints."""

    def __init__(self, root: ET.Element, most: int) -> None:
        self.painted: list[Painted] = []
        self.texts: list[PlacedText] = []
        self._by_id = elements_by_id(root)
        self._parents = {child: parent for parent in root.iter() for child in parent}
        self._known: dict[tuple[ET.Element, Viewport], list[SubPath]] = {}
        self._known_clips: dict[tuple[ET.Element, bytes, Viewport], Clip] = {}
        self._known_paintings: dict[ET.Element, Painting] = {}
        self._segments, self._most = 0, most

    def visit(self, element: ET.Element, frame: _Surroundings) -> None:
        """Collect what one element paints inside its frame."""
        if element.tag in NEVER_DRAWN or self.is_hidden(element):
            return
        inner = self.framed(element, frame)
        if element.tag in SHAPES:
            self._paint(element, inner)
        elif element.tag == "use":
            self._follow(element, inner)
        elif element.tag == "text":
            self._place(element, inner)
        elif element.tag == "svg":
            self._enter_viewport(element, element, inner)
        else:
            self.visit_children(element, inner)

    def visit_children(self, element: ET.Element, frame: _Surroundings) -> None:
        """Collect what the children paint."""
        for child in element:
            self.visit(child, frame)

    def is_hidden(self, element: ET.Element) -> bool:
        """Whether neither the element nor anything inside it shows."""
        return element.get("display") == "none" or opacity(element.get("opacity"), 1.0) == 0

    def framed(self, element: ET.Element, frame: _Surroundings) -> _Surroundings:
        """Frame with the element's own transform, properties and clip."""
        if not element.attrib:
            return frame
        matrix = frame.matrix
        if "transform" in element.attrib:
            matrix = affine.compose(matrix, parse_transform(element.get("transform")))
        if element.tag == "use":
            # Its place is part of its transform: clips move with it.
            x = parse_length(element.get("x"), frame.viewport[0]) or 0.0
            y = parse_length(element.get("y"), frame.viewport[1]) or 0.0
            matrix = affine.compose(matrix, affine.similarity(x, y, 0.0, 1.0))
        painting = frame.painting.inherited(element.attrib, diagonal(frame.viewport))
        inner = replace(frame, matrix=matrix, painting=painting)
        clip = self._clip(element, inner)
        return inner if clip is None else replace(inner, clips=(*inner.clips, clip))

    def _paint(self, element: ET.Element, frame: _Surroundings) -> None:
        if not (frame.painting.has_fill or frame.painting.has_stroke):
            return
        pieces = self._pieces(element, frame.viewport)
        if pieces:
            self.painted.append(
                Painted(pieces, frame.matrix, frame.painting, frame.window, element, frame.clips)
            )

    def _pieces(self, element: ET.Element, viewport: Viewport) -> list[SubPath]:
        key = (element, viewport)
        if key not in self._known:
            self._known[key] = shape_pieces(element, viewport)
        pieces = self._known[key]
        self._segments += sum(len(piece.segments) for piece in pieces)
        if self._segments > self._most:
            raise UnfitError(f"has more than {self._most:,} path segments; simplify it")
        return pieces

    def _place(self, text: ET.Element, frame: _Surroundings) -> None:
        if frame.is_repeated:
            return
        above: list[ET.Element] = []
        parent = self._parents.get(text)
        while parent is not None:
            above.append(parent)
            parent = self._parents.get(parent)
        self.texts.append(PlacedText(text, frame.matrix, frame.viewport, tuple(above[::-1])))

    def _clip(self, element: ET.Element, frame: _Surroundings) -> Clip | None:
        """Clip of an element whose own frame is known; one that is used again is shared."""
        target = self._by_id.get(paint_server(element.get("clip-path", "")) or "")
        if target is None:
            return None
        key = (target, frame.matrix.tobytes(), frame.viewport)
        if key not in self._known_clips:
            painting = self._inherited_painting(target)
            own = replace(frame, painting=painting, window=None, clips=())
            inside = self.framed(target, own)
            shapes = [shape for child in target for shape in self._stencils(child, inside)]
            self._known_clips[key] = Clip(tuple(shapes))
        return self._known_clips[key]

    def _stencils(self, element: ET.Element, frame: _Surroundings) -> list[Painted]:
        """Shapes, if any, that a child of a clip path cuts out, whatever their paints."""
        if element.get("display") == "none":
            return []
        inner = self.framed(element, frame)
        if element.tag == "use":
            target = self._target(element)
            return [] if target is None else self._stencils(target, inner)
        if element.tag not in SHAPES or not inner.painting.is_visible:
            return []
        pieces = self._pieces(element, inner.viewport)
        painting = Painting(fill_rule=inner.painting.clip_rule)
        if not pieces:
            return []
        return [Painted(pieces, inner.matrix, painting, None, element, inner.clips)]

    def _inherited_painting(self, element: ET.Element) -> Painting:
        """Painting that an element inherits where it stands, not from what refers to it."""
        parent = self._parents.get(element)
        if parent is None:
            return Painting()
        if parent not in self._known_paintings:
            above = self._inherited_painting(parent)
            self._known_paintings[parent] = above.inherited(parent.attrib, 0.0)
        return self._known_paintings[parent]

    def _target(self, use: ET.Element) -> ET.Element | None:
        return self._by_id.get(use.get(HREF, "")[1:])

    def _follow(self, use: ET.Element, frame: _Surroundings) -> None:
        target, moved = self._target(use), replace(frame, is_repeated=True)
        if target is None:
            return
        if target.tag in {"symbol", "svg"} and not self.is_hidden(target):
            self._enter_viewport(target, use, self.framed(target, moved))
        else:
            self.visit(target, moved)

    def _enter_viewport(self, element: ET.Element, sized: ET.Element, frame: _Surroundings) -> None:
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
        matrix = affine.compose(place, inner)
        nested = replace(frame, matrix=matrix, viewport=viewport, window=window)
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
    return box if window is None else intersection(window, box)


EFFECT, STEADY = "vector-effect", "non-scaling-stroke"

_EVEN = 1e-9
"""Difference of the two stretches of a map, as a share, from which its circles are ellipses."""


def scale_steady_strokes(root: ET.Element, page: Page | None) -> None:
    """Draw lines of constant width as plain ones, in place.

    A shape that is used several times is as its first use has it.

    >>> text = '<g transform="scale(4)"><path vector-effect="non-scaling-stroke" {}/></g>'
    >>> line = text.format('d="M0 0h9" stroke="red" stroke-width="2"')
    >>> root = ET.fromstring(f"<svg>{line}</svg>")
    >>> scale_steady_strokes(root, None)
    >>> root[0][0].get("stroke-width"), root[0][0].get("vector-effect")
    ('0.5', None)
    """
    steady = {element for element in root.iter() if element.get(EFFECT) == STEADY}
    shapes = painted_shapes(root, page) if steady else []
    for element in root.iter():
        element.attrib.pop(EFFECT, None)
    for shape in shapes:
        if shape.element in steady:
            steady.remove(shape.element)
            if shape.painting.has_stroke:
                _settle(shape)


def _settle(shape: Painted) -> None:
    element, pen = shape.element, shape.painting.pen
    stretches = np.linalg.svd(shape.matrix[:, :2], compute_uv=False)
    if stretches[1] <= 0:
        return
    factor = 1.0
    if stretches[0] - stretches[1] <= _EVEN * stretches[0]:
        factor = 1 / float(stretches[0])
    else:
        _straighten(shape)
    element.set("stroke-width", f"{factor * pen.width:.12g}")
    if pen.dashes:
        element.set("stroke-dasharray", " ".join(f"{factor * d:.12g}" for d in pen.dashes))
        element.set("stroke-dashoffset", f"{factor * pen.dash_offset:.12g}")


def _straighten(shape: Painted) -> None:
    """Write a shape as a path in CSS pixels, brought there by what undoes its map."""
    element = shape.element
    own = parse_transform(element.get("transform"))
    back = affine.compose(own, affine.inverse(shape.matrix))
    data = " ".join(_written(piece.placed(shape.matrix)) for piece in shape.pieces)
    for name in ("x", "y", "width", "height", "cx", "cy", "r", "rx", "ry", "points"):
        element.attrib.pop(name, None)
    element.tag = "path"
    element.set("d", data)
    element.set("transform", f"matrix({' '.join(f'{v:.12g}' for v in back.T.ravel())})")


def _written(piece: SubPath) -> str:
    numbers = " ".join(f"{v:.12g}" for v in piece.segments[:, 1:].ravel())
    curves = f"C{numbers}" if numbers else ""
    return "M{:.12g} {:.12g}".format(*piece.start) + curves + ("z" if piece.is_closed else "")
