"""Items out of the drawings of an SVG of ours: each in its own colours and units."""

from __future__ import annotations

import base64
import binascii
import copy
import re
import xml.etree.ElementTree as ET
from collections.abc import Mapping, Set
from dataclasses import dataclass
from typing import final
from xml.parsers import expat

import numpy as np

from packwork.arrays import FloatArray
from packwork.errors import RecipeError, ShapeError
from packwork.geometry import affine
from packwork.geometry.outline import Outline
from packwork.geometry.polygon import Region, silhouette
from packwork.readers.gate.door import parse_untrusted
from packwork.readers.layouts.assembly import sound_outline
from packwork.readers.layouts.foreign_svg import tag
from packwork.readers.pictures.decode import opened
from packwork.readers.reading import UnfitError
from packwork.readers.svg.art import KeptOriginal, kept_art, vector_art
from packwork.readers.svg_syntax.coordinates import parse_transform
from packwork.scene.colour import css_colour, hex_colour
from packwork.scene.item import FlatArt, Item, Label, PhotoArt, PictureArt, VectorArt

_START = re.compile(rb"""<[^<>"']*(?:"[^"]*"[^<>"']*|'[^']*'[^<>"']*)*>""")
_ENCODED = re.compile(rb"""^\s*<\?xml[^>]*encoding\s*=\s*["'](?!utf-8["'])""", re.IGNORECASE)


def inner_texts(data: bytes, wanted: Set[int]) -> dict[int, str]:
    """Text between the tags of elements, by their number in the document's order, the root 0.

    Nothing for a document that is not in UTF-8, or declares entities. It has to have been
    parsed before, so that it is known to be harmless.

    Examples
    --------
    >>> inner_texts(b'<svg><g a="1>0"> <path/></g><g/></svg>', {1, 3})
    {1: ' <path/>', 3: ''}
    """
    if _ENCODED.match(data) or b"<!ENTITY" in data or data.startswith((b"\xff", b"\xfe", b"\xef")):
        return {}
    found: dict[int, str] = {}
    open_: list[int | None] = []
    count = 0
    parser = expat.ParserCreate()

    def begin(_name: str, _attributes: dict[str, str]) -> None:
        nonlocal count
        tag = _START.match(data, parser.CurrentByteIndex) if count in wanted else None
        open_.append(None if tag is None else tag.end())
        if tag is not None:
            found[count] = ""
            numbers.append(count)
        count += 1

    def end(_name: str) -> None:
        start, stop = open_.pop(), parser.CurrentByteIndex
        if start is not None:
            # An empty element ends where it begins.
            found[numbers.pop()] = data[start:stop].decode("utf-8") if stop >= start else ""

    numbers: list[int] = []
    parser.StartElementHandler, parser.EndElementHandler = begin, end
    try:
        parser.Parse(data, True)
    except (expat.ExpatError, UnicodeDecodeError):
        return {}
    return found


LINK = "{http://www.w3.org/1999/xlink}href"
"""The older name of ``href``, which our files use."""

_SPACE = "{http://www.w3.org/2000/svg}"
_PLACE = re.compile(
    r"(translate\([^()]*\)(?:rotate\([^()]*\))?(?:scale\([^()]*\))?)(matrix\([^()]*\))?"
)
_RINGS = re.compile(r"(?:M[-+.\d ]+Z)+")
_PHOTO = re.compile(
    r'(?:<clipPath id="[^"]*"><path clip-rule="evenodd" d="[^"]*"/></clipPath>)?'
    r'(?:<path fill="[^"]*" d="[^"]*"/>)?(?:<g clip-path="[^"]*">)?<image [^<>]*/>(?:</g>)?'
)
_ID = re.compile(r'\bid="([^"]*)"')
_STYLED_FILL = re.compile(r"(?:^|;)\s*(fill|fill-opacity)\s*:\s*([^;]+)")

OWN_IDS = re.compile(r"item-\d+|(?:use|path|g|image|text|a)-?\d+(?:-\d+)*")
"""Ids that say no more than that there is an item: ours, and those other programs give."""

_NOT_DRAWN = frozenset({"id", "transform", LINK, "href"})
_PLAIN = frozenset({"id", "transform", "d", "fill-rule", "fill", "fill-opacity", "style"})
_OF_PICTURES = frozenset(
    {"id", "transform", "width", "height", "preserveAspectRatio", "href", LINK}
)


def place_and_art(source: ET.Element, drawn: ET.Element) -> tuple[FloatArray, FloatArray]:
    """Maps (2 x 3) of one copy: from its item's units to where it lies, from its markup's to those.

    ``source`` is the element that draws, ``drawn`` the one among the items: the same for a full
    copy.

    Examples
    --------
    >>> whole = ET.Element("g", {"transform": "translate(5 7)scale(2)matrix(3 0 0 3 0 1)"})
    >>> place, art = place_and_art(whole, whole)
    >>> place[:, 2].tolist(), art[:, 2].tolist()
    ([5.0, 7.0], [0.0, 1.0])
    """
    text = drawn.get("transform")
    if source is not drawn:
        return parse_transform(text), parse_transform(source.get("transform"))
    parts = _PLACE.fullmatch(text or "")
    if parts is None:
        return parse_transform(text), affine.identity()
    return parse_transform(parts[1]), parse_transform(parts[2])


def outline_of_path(data: str, like: Region) -> Outline | None:
    """The very rings of a path that we wrote; None if it is of other form, or another region.

    Examples
    --------
    >>> import shapely
    >>> square = shapely.box(0, 0, 2, 2)
    >>> outline_of_path("M0 0 2 0 2 2 0 2Z", square).points.tolist()[1]
    [2.0, 0.0]
    >>> outline_of_path("M0 0h2v2h-2z", square) is None
    True
    """
    if not _RINGS.fullmatch(data):
        return None
    try:
        rings = [np.array(ring.split(), dtype=np.float64) for ring in data[1:-1].split("ZM")]
        outline = Outline.from_rings([ring.reshape(-1, 2) for ring in rings])
        is_same = abs(outline.area - like.area) <= _SAME_AREA * like.area
        return outline if is_same and outline.region.is_valid else None
    except (ValueError, ShapeError):
        return None


_SAME_AREA = 1e-4


@dataclass(frozen=True, eq=False)
class _Drawing:
    """A definition in an item's units; no art where copies colour its ink."""

    outline: Outline
    ink: Outline
    art: VectorArt | PictureArt | PhotoArt | None


@final
class Arts:
    """Items of one file; copies of one drawing that look the same are one item."""

    def __init__(self, root: ET.Element, data: bytes, sources: list[ET.Element]) -> None:
        wanted = set(sources)
        numbers = {n: one for n, one in enumerate(root.iter()) if one in wanted}
        texts = inner_texts(data, numbers.keys())
        self._inside = {numbers[n]: text for n, text in texts.items()}
        self._drawings: dict[tuple[object, ...], _Drawing] = {}
        self._items: dict[tuple[object, ...], Item] = {}
        self.texts = 0
        """Items that are text in the file, and curves from now on."""

    def item(
        self, count: int, drawn: ET.Element, source: ET.Element, label: Label, ink: Region,
        *, keeps_holes: bool,
    ) -> Item:  # fmt: skip
        """One item."""
        name = drawn.get("data-name", "item")
        drawing = self._drawing(count, drawn, source, ink, name, keeps_holes)
        fill = "" if drawing.art is not None else _fill(drawn, source)
        id_ = drawn.get("id", "")
        if id_ and "data-name" in drawn.attrib and not OWN_IDS.fullmatch(id_):
            label = Label(name, label.link, label.title)
        key = (drawing, name, fill, label)
        if key not in self._items:
            art = drawing.art or FlatArt(fill)
            self._items[key] = Item(name, name, drawing.outline, drawing.ink, art, label)
        return self._items[key]

    def text(self, element: ET.Element | None) -> str:
        """Text between the tags of an element; empty of none."""
        return "" if element is None else self._inside.get(element, "")

    def fragment(self, element: ET.Element) -> VectorArt:
        """Art of what stands in a group, in the group's own units."""
        return self._vector(element, self.text(element), affine.identity(), is_traced=False)

    def _drawing(
        self, count: int, drawn: ET.Element, source: ET.Element, ink: Region, name: str,
        keeps_holes: bool,
    ) -> _Drawing:  # fmt: skip
        text = self.text(source)
        if source is drawn:
            text = _renamed(text, count)
        matrix = place_and_art(source, drawn)[1]
        told = (source.get("data-outline", ""), source.get("data-bays", ""))
        own = (source.get("d", ""), source.get(LINK, ""), repr(matrix.tolist()))
        same = None if text or source.get("d") or source.get(LINK) else source
        key = (tag(source), text, *own, *told, same, _look(source, drawn))
        if key not in self._drawings:
            self._drawings[key] = self._read(
                drawn, source, text, matrix, ink, f"item {count} ({name})", keeps_holes
            )
        return self._drawings[key]

    def _read(
        self, drawn: ET.Element, source: ET.Element, text: str, matrix: FloatArray, ink: Region,
        what: str, keeps_holes: bool,
    ) -> _Drawing:  # fmt: skip
        seen = sound_outline(ink, what)
        outline = seen if keeps_holes else Outline.from_region(silhouette(ink))
        stated = source.get("data-outline")
        if stated is not None:
            written = outline_of_path(stated, outline.mapped(affine.inverse(matrix)).region)
            outline = outline if written is None else written.mapped(matrix)
            seen = outline
        others = {k for k in source.attrib if not k.startswith("data-")}
        is_text = tag(source) == "g" and any(tag(child) == "text" for child in source)
        if _is_flat(drawn, source):
            flat = outline_of_path(source.get("d", ""), ink)
            same = flat is not None and np.allclose(matrix, affine.identity(), rtol=0, atol=0)
            return _Drawing(outline, flat if same and flat is not None else seen, None)
        if is_text and stated is not None and "fill" in source.attrib:
            self.texts += 1
            fill = {k: v for k, v in source.attrib.items() if k in {"fill", "fill-opacity"}}
            path = ET.Element(f"{_SPACE}path", fill | {"d": stated})
            return _Drawing(outline, seen, _cleaned(path, matrix, is_traced=False))
        is_traced = stated is not None
        if tag(source) == "image" and others <= _OF_PICTURES:
            found = _picture(source, matrix, is_traced)
            if found is not None:
                return _Drawing(outline, seen, found)
        if tag(source) == "g" and others <= {"id", "transform"}:
            art = self._vector(source, text, matrix, is_traced=is_traced)
            is_photo = is_traced and _PHOTO.fullmatch(art.markup)
            return _Drawing(outline, seen, PhotoArt(art, KeptOriginal(art)) if is_photo else art)
        return _Drawing(outline, seen, _cleaned(_whole(drawn, source), matrix, is_traced=is_traced))

    def _vector(
        self, group: ET.Element, text: str, matrix: FloatArray, *, is_traced: bool
    ) -> VectorArt:
        """Art of a group, to the byte where the gate lets it pass."""
        if text:
            try:
                return kept_art(text, matrix, is_traced=is_traced)
            except UnfitError:
                # Such as prefixes that are declared outside.
                pass
        bare = copy.copy(group)
        bare.attrib = {}
        return _cleaned(bare, matrix, is_traced=is_traced)


def labelled(outer: ET.Element, drawn: ET.Element) -> Label:
    """Link and tooltip about an item's element."""
    if outer is drawn:
        return Label()
    link = outer.get("href", outer.get(LINK, "")) if tag(outer) == "a" else ""
    title = next((child.text or "" for child in outer if tag(child) == "title"), "")
    try:
        return Label(link=link, title=title)
    except RecipeError as error:
        raise UnfitError(f"has an item whose {error}") from None


def _renamed(text: str, count: int) -> str:
    """Markup whose ids, and what refers to them, end in no number of a copy."""
    names = {found[1] for found in _ID.finditer(text)}
    if not names or not all(name.endswith(f"-{count}") for name in names):
        return text
    longest = sorted(names, key=len, reverse=True)
    uses = re.compile(rf'(\bid="|#)({"|".join(map(re.escape, longest))})(?![\w.:-])')
    return uses.sub(lambda found: found[1] + found[2].removesuffix(f"-{count}"), text)


def _look(source: ET.Element, drawn: ET.Element) -> str:
    """Paint that a stranger's element adds to a drawing; empty for ours."""
    if _is_flat(drawn, source):
        return "flat"
    own = {k: v for k, v in drawn.attrib.items() if k not in _NOT_DRAWN and k[:5] != "data-"}
    return repr(sorted(own.items())) if source is not drawn else str(own.get("style", ""))


def _paint(drawn: ET.Element, source: ET.Element) -> Mapping[str, str]:
    found: dict[str, str] = {}
    for element in (source, drawn):
        found |= {k: element.attrib[k] for k in ("fill", "fill-opacity") if k in element.attrib}
        found |= {k: v.strip() for k, v in _STYLED_FILL.findall(element.get("style", ""))}
    return found


def _is_flat(drawn: ET.Element, source: ET.Element) -> bool:
    """True for a path that is filled with one colour, and no more."""
    if tag(source) != "path" or {k for k in source.attrib if k[:5] != "data-"} - _PLAIN:
        return False
    said = {part.partition(":")[0].strip() for one in (drawn, source)
            for part in one.get("style", "").split(";") if part.strip()}  # fmt: skip
    own = {k for k in drawn.attrib if not k.startswith("data-")} - _PLAIN - {LINK, "href"}
    if own or not said <= {"fill", "fill-opacity"}:
        return False
    try:
        return css_colour(_paint(drawn, source).get("fill", "black"))[3] > 0
    except ValueError:
        return False


def _fill(drawn: ET.Element, source: ET.Element) -> str:
    paint = _paint(drawn, source)
    channels = css_colour(paint.get("fill", "black"))
    try:
        opacity = round(channels[3] * min(max(float(paint.get("fill-opacity", "1")), 0.0), 1.0))
    except ValueError:
        opacity = channels[3]
    return hex_colour((*channels[:3], opacity))


def _whole(drawn: ET.Element, source: ET.Element) -> ET.Element:
    """An element of any form, without its place and with the paint of the copy."""
    own = copy.copy(source)
    own.attrib = {k: v for k, v in source.attrib.items() if k not in {"id", "transform"}}
    if source is drawn:
        return own
    paint = {k: v for k, v in drawn.attrib.items() if k not in _NOT_DRAWN and k[:5] != "data-"}
    group = ET.Element(f"{_SPACE}g", paint)
    group.append(own)
    return group


def _cleaned(element: ET.Element, matrix: FloatArray, *, is_traced: bool) -> VectorArt:
    document = ET.Element(f"{_SPACE}svg")
    document.append(element)
    root = parse_untrusted(ET.tostring(document))
    art = vector_art(root, None, is_cut=False, place=matrix)
    return VectorArt(art.markup, matrix, is_traced)


def _picture(image: ET.Element, matrix: FloatArray, is_traced: bool) -> PictureArt | None:
    """An embedded PNG; None for any other picture."""
    _, _, encoded = (image.get(LINK) or image.get("href") or "").partition("base64,")
    try:
        data = base64.b64decode(encoded, validate=True)
        with opened(data) as picture:
            size = picture.size
            is_png = picture.format == "PNG"
    except (binascii.Error, ValueError):
        return None
    stated = image.get("width", ""), image.get("height", "")
    if not is_png or stated != (str(size[0]), str(size[1])):
        return None
    return PictureArt(data, *size, matrix, is_traced)
