"""Layouts read back from SVG files: the drawings as they will be seen.

Every distinct drawing goes through the gate and is followed anew, finer than when it was
placed, and each copy is put where its transform says. Only of drawings that had to be
traced the file's own word is taken: tracing them again would give another outline.
"""

from __future__ import annotations

import base64
import binascii
import math
import operator
import xml.etree.ElementTree as ET
from collections.abc import Sequence
from typing import final

import numpy as np
import shapely

from packwork.arrays import FloatArray
from packwork.geometry import affine
from packwork.geometry.outline import Outline
from packwork.geometry.overlay import union
from packwork.geometry.polygon import Region, silhouette
from packwork.phrasing import number_of
from packwork.readers.cache import followed_once
from packwork.readers.gate.door import parse_xml
from packwork.readers.layouts.arts import LINK, Arts, labelled, place_and_art
from packwork.readers.layouts.assembly import (
    FoundItem,
    FoundSheet,
    assembled,
    sound_gap,
    sound_outline,
    sound_weight,
)
from packwork.readers.layouts.foreign_svg import (
    OWN,
    group_named,
    is_of_lines,
    loose_items,
    strange,
    tag,
)
from packwork.readers.layouts.lettering import LetteringOutlines, bare, lettering_path
from packwork.readers.layouts.marks import LineParts
from packwork.readers.layouts.paths import is_placed_exactly, is_straight, polygon_of
from packwork.readers.layouts.sheet import (
    backdrop_of,
    drawing_of,
    ground_of,
    limits_of,
    notes_of,
    tile_of,
    with_halos,
)
from packwork.readers.layouts.tampering import examined
from packwork.readers.layouts.walls import pen_of, walls_of
from packwork.readers.pictures.decode import decode_picture
from packwork.readers.pictures.silhouette import ART_PX, outline_of_cut_out
from packwork.readers.reading import UnfitError
from packwork.readers.regions import SPECK, clean_union
from packwork.readers.svg.container import stated_unit
from packwork.readers.svg.drawing import read_drawing
from packwork.readers.svg_syntax.coordinates import parse_length, parse_transform, view_box
from packwork.scene.item import FlatArt, Item
from packwork.scene.layout import Layout
from packwork.units import Unit, convert

MEASURED_FLATTENING = 1e-6
"""Largest distance of a curve from its chords, as a share of the canvas. Chosen: a tenth of
the finest gap that a finish keeps."""

_SPECK = 1.5 * SPECK
"""Specks that are passed over: somewhat larger ones than where items are read, as one that was
left out there may seem larger when it is followed more finely."""

_SAME = 1e-9
_SPACE = "{http://www.w3.org/2000/svg}"
_NOT_OURS = "as packwork writes it; give an SVG of ours, or the layout saved as .geojson"


def layout_of_svg(data: bytes, name: str, *, outlines_only: bool = False) -> Layout:
    """Layout of an SVG's bytes, its outlines those of the drawings in it.

    Of drawings that only a rendering tells (text, masks) the file holds the outline that was
    placed; embedded pictures are followed as they were when they were read. With
    ``outlines_only`` items are plain.

    Examples
    --------
    >>> wall = '<g id="container" display="none"><path d="M0 0h9v9h-9z"/></g>'
    >>> tile = '<path data-name="tile" transform="translate(2)" d="M0 1h4v4h-4z"/>'
    >>> text = f'<svg viewBox="0 0 9 9">{wall}<g id="items">{tile}</g></svg>'
    >>> layout = layout_of_svg(text.encode(), "tiles.svg")
    >>> layout.outlines[0].bounds, layout.items[0].name
    ((2.0, 1.0, 6.0, 5.0), 'tile')
    """
    root = parse_xml(data)
    width, height, unit, scale = _canvas(root)
    items, walls = group_named(root, "items"), group_named(root, "container")
    elements, place = (list(items), _place(items)) if items is not None else loose_items(root)
    drawn = [_drawn(element) for element in elements]
    if not drawn and (items is None or walls is None):
        raise UnfitError(f"has no group named items at its top, {_NOT_OURS}")
    drawings = _Drawings(root, drawn, max(width, height) / scale, of_lines=is_of_lines(items))
    sources = [drawings.source(one) for one in drawn]
    backdrop = group_named(root, "backdrop")
    parts = LineParts(root, convert(1.0, "px", unit) / scale) if is_of_lines(items) else None
    painted = [] if parts is None else parts.artwork
    looked_at = [*sources, *painted, *([] if backdrop is None else [backdrop])]
    arts = Arts(root, data, [] if outlines_only else looked_at)
    # Other programs move a whole group by a transform of its own.
    to_canvas = affine.similarity(0.0, 0.0, 0.0, scale)
    to_items = affine.compose(to_canvas, place)
    said = items.attrib if items is not None and walls is not None else {}
    gap, is_kept = said.get("data-gap"), said.get("data-holes") == "keep"
    walled = to_canvas if walls is None else affine.compose(to_canvas, _place(walls))
    page = shapely.box(0, 0, width, height)
    container = page if walls is None else _placed(drawings.wall(walls), walled)
    found = [
        _outline_of(drawings, one, to_items, is_kept)
        if outlines_only
        else _found(drawings, arts, parts, one, number, to_items, is_kept)
        for number, one in enumerate(zip(elements, drawn, sources, strict=True), start=1)
    ]
    changed, unseen = (
        ([], [])
        if outlines_only
        else examined(root, data, drawn, sources, container, (width, height))
    )
    is_in_full = parts is None and all(map(operator.is_, sources, drawn))
    ids = [one.get("id", "") for one in drawn]
    sheet = FoundSheet(
        width=width,
        height=height,
        unit=unit,
        container=container,
        gap=None if gap is None else sound_gap(gap),
        areas_in_shares=said.get("data-in-shares") == "true",
        items=found,
        on_trust=(*drawings.on_trust, *unseen, *([] if parts is None else parts.on_trust)),
        walls=None if walls is None else walls_of(walls, walled),
        pen=None if walls is None else pen_of(walls, _size(walled)),
        tile=tile_of(root),
        backdrop=None if outlines_only else backdrop_of(root, arts, to_canvas),
        notes=notes_of(root, to_canvas),
        said={
            "ground": ground_of(root),
            "recipe": limits_of(said),
            **({} if parts is None else {"nest": {"rotate": said.get("data-rotate", "none")}}),
            "drawing": drawing_of(root, is_in_full and arts.texts < len(drawn)),
            "changed": [*changed, *([] if parts is None else parts.changes(ids))],
            "not_kept": _not_kept(root, items, arts.texts),
        },
    )
    layout = assembled(sheet, (walls is not None and walls.get("data-name")) or name)
    return layout if outlines_only else with_halos(root, layout)


@final
class _Drawings:
    """Regions of the drawings of one file, each followed once, as its largest copy needs."""

    def __init__(
        self, root: ET.Element, drawn: Sequence[ET.Element], side: float, *, of_lines: bool
    ) -> None:
        # Of one id the first counts, as in browsers.
        self._by_id = {e.get("id"): e for e in reversed([*root.iter()]) if e.get("id")}
        self._side, self._of_lines = side, of_lines
        self._regions: dict[ET.Element, Region] = {}
        self._largest: dict[ET.Element, float] = {}
        self._outlines: dict[ET.Element, Outline] = {}
        self._letterings = LetteringOutlines(_SPECK)
        self._stated = 0
        groups = [group_named(root, name) for name in ("items", "container")]
        self._is_exact = all(one is None or not one.get("transform") for one in groups)
        self.places = {one: place_and_art(self.source(one), one)[0] for one in drawn}
        """Maps (2 x 3) from each item's units to where it lies."""
        for one, place in self.places.items():
            source = self.source(one)
            self._largest[source] = max(_size(place), self._largest.get(source, 0.0))

    def wall(self, group: ET.Element) -> Region:
        """Region of the container's paths, shown or not."""
        paths = [_path(e.get("d", "")) for e in group if tag(e) == "path"]
        if not paths:
            raise UnfitError(f"has no path in the group named container, {_NOT_OURS}")
        found = self._followed(paths, 1.0)
        outline = sound_outline(found, "the container")
        self._is_exact &= all(is_straight(p) and is_placed_exactly(p, p, outline) for p in paths)
        return found

    def is_straight(self, drawn: ET.Element, outline: Outline) -> bool:
        """Whether a drawing, as all walls, is a path without curves, and nothing but that is told.

        Its paint may have no stroke, but where it is a line to cut. ``outline``: its own units.
        """
        source = self.source(drawn)
        is_stroked = not self._of_lines and {"stroke", "style", "class"} & source.attrib.keys()
        is_plain = self._is_exact and not is_stroked and is_straight(source)
        return is_plain and is_placed_exactly(source, drawn, outline)

    @property
    def on_trust(self) -> tuple[str, ...]:
        """Sentences about all that was not seen but taken from the file's words."""
        if self._stated == 0:
            return ()
        return (
            f"outlines of {number_of(self._stated, 'drawing')} are those that the file states "
            "(data-outline)",
        )

    def item(self, drawn: ET.Element) -> Region:
        """Region of one item that shows, in its own units."""
        source = self.source(drawn)
        if source not in self._regions:
            own = place_and_art(source, drawn)[1]
            self._regions[source] = self._ink(source, own, self._largest[source])
        return self._regions[source]

    def outline(self, drawn: ET.Element, keeps_holes: bool) -> Outline:
        """The outline of one item, in its own units."""
        source = self.source(drawn)
        if source not in self._outlines:
            own = place_and_art(source, drawn)[1]
            found = self._lettering(source, own, self._largest[source], keeps_holes)
            if found is None:
                ink = self.item(drawn)
                found = Outline.from_region(ink if keeps_holes else silhouette(ink))
            self._outlines[source] = found
        return self._outlines[source]

    def _lettering(
        self, source: ET.Element, own: FloatArray, size: float, keeps_holes: bool
    ) -> Outline | None:
        """Outline of what is drawn as letters are, in its own units; None of all others."""
        is_drawn = not self._of_lines and tag(source) != "image"
        if not is_drawn or "data-bays" in source.attrib or "data-outline" in source.attrib:
            return None
        path = lettering_path(bare(source))
        if path is None or not (size := size * _size(own)) > 0 or not np.linalg.det(own[:, :2]) > 0:
            return None
        found = self._letterings.outline(*path, self._finest(size), keeps_holes=keeps_holes)
        return None if found is None else found.mapped(own)

    def _finest(self, size: float) -> float:
        """Largest distance of a curve from its chords, for a copy of that size, in its units.

        A power of two, so that what is kept serves other layouts.
        """
        return 2.0 ** math.floor(math.log2(MEASURED_FLATTENING * self._side / size))

    def source(self, drawn: ET.Element) -> ET.Element:
        """The element that draws an item: itself, or what it uses."""
        if tag(drawn) != "use":
            return drawn
        source = self._by_id.get((drawn.get("href") or drawn.get(LINK) or "").removeprefix("#"))
        if source is None or tag(source) == "use":
            raise UnfitError(f"has an item that shows nothing, {_NOT_OURS}")
        return source

    def _ink(self, source: ET.Element, own: FloatArray, size: float) -> Region:
        if "data-outline" in source.attrib:
            self._stated += 1
            # Letters of a font may overlap, so non-zero; rings of outlines turn either way.
            path = _path(source.attrib["data-outline"], "nonzero")
            return _placed(self._followed([path], size * _size(own)), own)
        if self._of_lines:
            if tag(source) != "path":
                raise UnfitError(f"has an item that is no line to cut, {_NOT_OURS}")
            seen = self._followed([_path(source.get("d", ""))], size * _size(own))
        elif tag(source) == "image":
            seen = _picture(source)
        else:
            seen = self._followed([bare(source)], size * _size(own))
        if "data-bays" in source.attrib:
            # No matter of trust: whatever is added makes the item larger.
            bays = self._followed([_path(source.attrib["data-bays"])], size * _size(own))
            seen = union([seen, bays])
        return _placed(seen, own)

    def _followed(self, elements: list[ET.Element], size: float) -> Region:
        """Region that elements paint, in their own units, fine enough for a copy of that size."""
        if not size > 0:
            raise UnfitError(f"has an item without any size, {_NOT_OURS}")
        polygon = polygon_of(elements[0]) if len(elements) == 1 else None
        if polygon is not None:
            return polygon
        document = ET.Element(f"{_SPACE}svg")
        document.extend(elements)
        finest = self._finest(size)
        return followed_once(
            ET.tostring(document),
            finest,
            lambda data: clean_union(read_drawing(data, tolerance=finest).ink.body, speck=_SPECK),
        )


def _found(
    drawings: _Drawings, arts: Arts, parts: LineParts | None,
    element: tuple[ET.Element, ET.Element, ET.Element], number: int, to_canvas: FloatArray,
    keeps_holes: bool,
) -> FoundItem:  # fmt: skip
    outer, drawn, source = element
    label, ink = labelled(outer, drawn), drawings.item(drawn)
    item = (
        arts.item(number, drawn, source, label, ink, keeps_holes=keeps_holes)
        if parts is None
        else parts.item(drawn, source, label, ink, arts, keeps_holes=keeps_holes)
    )
    place = affine.compose(to_canvas, drawings.places[drawn])
    weight = sound_weight(drawn.get("data-weight", "1"))
    return FoundItem(item.name, item, weight, place, drawings.is_straight(drawn, item.outline))


def _outline_of(
    drawings: _Drawings, element: tuple[ET.Element, ET.Element, ET.Element],
    to_canvas: FloatArray, keeps_holes: bool,
) -> FoundItem:  # fmt: skip
    """An item of which nothing but its outline is known."""
    drawn = element[1]
    name = drawn.get("data-name", "item")
    outline = drawings.outline(drawn, keeps_holes)
    place = affine.compose(to_canvas, drawings.places[drawn])
    weight = sound_weight(drawn.get("data-weight", "1"))
    item = Item(name, name, outline, outline, FlatArt())
    return FoundItem(name, item, weight, place, drawings.is_straight(drawn, outline))


def _not_kept(root: ET.Element, items: ET.Element | None, texts: int) -> list[str]:
    """Sentences about drawings beside the items that an edit does not write again."""
    words = number_of(texts, "word that is text there is", "words that are text there are")
    curves = [f"{words} curves from now on"] if texts else []
    cut = group_named(root, "cut")
    if cut is not None and not {"data-line", "data-kiss"} & cut.attrib.keys():
        return ["its cut lines are not kept", *curves]
    others = 0 if items is None else strange(root, OWN | {"cut"})
    many = number_of(others, "drawing beside its items is", "drawings beside its items are")
    return [*([f"{many} not kept"] if others else []), *curves]


def _place(element: ET.Element) -> FloatArray:
    return parse_transform(element.get("transform"))


def _size(matrix: FloatArray) -> float:
    """Largest singular value: by how much lengths grow at most."""
    (a, b, _), (c, d, _) = matrix.tolist()
    return (math.hypot(a + d, c - b) + math.hypot(a - d, b + c)) / 2


def _drawn(element: ET.Element) -> ET.Element:
    if tag(element) == "a" and "transform" in element.attrib:
        raise UnfitError(f"has a link that moves its item, {_NOT_OURS}")
    is_wrapping = tag(element) == "a" or (tag(element) == "g" and not element.attrib)
    inside = [child for child in element if tag(child) != "title"]
    return inside[0] if is_wrapping and len(inside) == 1 else element


def _canvas(root: ET.Element) -> tuple[float, float, Unit, float]:
    """Width and height in canvas units, the unit, and canvas units to a unit of the file."""
    view = view_box(root)
    if tag(root) != "svg" or view is None or view[:2] != (0.0, 0.0):
        raise UnfitError(f"has no canvas, {_NOT_OURS}")
    unit = stated_unit(root) or "px"
    width_px = parse_length(root.get("width"), 0.0)
    scale = 1.0 if not width_px else convert(width_px, "px", unit) / view[2]
    # A canvas in its own unit is as long in numbers; what differs by rounding is the same.
    scale = 1.0 if abs(scale - 1.0) < _SAME else scale
    return scale * view[2], scale * view[3], unit, scale


def _picture(image: ET.Element) -> Region:
    """Region of an embedded picture, in the units of its element."""
    _, _, encoded = (image.get(LINK) or image.get("href") or "").partition("base64,")
    try:
        picture = decode_picture(base64.b64decode(encoded, validate=True), ART_PX)
    except (binascii.Error, ValueError):
        raise UnfitError(f"has an item whose picture is none, {_NOT_OURS}") from None
    ink = outline_of_cut_out(picture.pixels)
    return shapely.transform(ink, lambda points: points * picture.unit)


def _path(data: str, rule: str = "evenodd") -> ET.Element:
    return ET.Element(f"{_SPACE}path", {"d": data, "fill-rule": rule})


def _placed(region: Region, matrix: FloatArray) -> Region:
    return shapely.transform(region, lambda points: affine.apply(matrix, points))
