"""Objects of an open drawing by their ids, each as a document of its own.

A drawing program hands over the whole document and names what is chosen. What is read of an
object is in user units of the document's root, so that where it goes is a map of its own.
"""

from __future__ import annotations

import copy
import xml.etree.ElementTree as ET
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import reduce

from packwork.arrays import FloatArray
from packwork.errors import ReadError
from packwork.geometry import affine
from packwork.geometry.polygon import Region
from packwork.readers.gate.door import parse_xml, unpacked
from packwork.readers.options import ReadOptions
from packwork.readers.reading import reading_file
from packwork.readers.svg.container import inside_of_svg, tag_of
from packwork.readers.svg.item import item_of_svg
from packwork.readers.svg_syntax.coordinates import parse_length, parse_transform
from packwork.readers.svg_syntax.references import elements_by_id, referenced_ids
from packwork.scene.item import Item
from packwork.scene.notation import matrix_text

_PAGE = ("viewBox", "width", "height", "x", "y", "preserveAspectRatio")
_LINKS = ("{http://www.w3.org/1999/xlink}href", "href")


@dataclass(frozen=True, eq=False)
class DrawingObject:
    """One object of a drawing.

    ``name``: its id.
    ``document``: an SVG that shows nothing else, its units the root's user units.
    ``outer``: 2 x 3, from the units in which its ``transform`` stands to the root's.
    ``transform``: 2 x 3, its own.
    """

    name: str
    document: bytes
    outer: FloatArray
    transform: FloatArray

    @property
    def inner(self) -> FloatArray:
        """Map (2 x 3) from the units in it, as of a group, to the root's."""
        return affine.compose(self.outer, self.transform)

    def item(self) -> Item:
        """All that it covers, as one item, its white parts too."""
        reading = ReadOptions(keep_page=True)
        return item_of_svg(self.document, self.name, self.name, "fill", reading)

    def inside(self) -> Region:
        """All that it covers, as a container: of lines the inside, white paint as holes."""
        with reading_file(self.name):
            return inside_of_svg(self.document)


class OpenDrawing:
    """A whole drawing, whose objects go by their ids.

    Parameters
    ----------
    data
        Its SVG.

    Raises
    ------
    ReadError
        If it is none.

    Examples
    --------
    >>> drawing = OpenDrawing(
    ...     b'<svg><g transform="scale(2)"><rect id="a" width="3" height="1"/></g>'
    ...     b'<use id="b" href="#a"/></svg>'
    ... )
    >>> drawing.moved({"a": affine.similarity(4.0, 0.0, 0.0, 1.0)})
    {'a': 'matrix(1 0 0 1 2 0)', 'b': 'matrix(1 0 0 1 -2 0)'}
    """

    def __init__(self, data: bytes) -> None:
        with reading_file("the drawing"):
            self._root = parse_xml(unpacked(data))
        self._by_id = elements_by_id(self._root)
        self._parents = {child: parent for parent in self._root.iter() for child in parent}

    def object(self, name: str) -> DrawingObject:
        """The object of an id.

        Raises
        ------
        ReadError
            If there is none, or it stands in a drawing of its own units.
        """
        part = self._by_id.get(name)
        if part is None or part is self._root:
            raise ReadError(name, "is no object of the drawing")
        groups = self._groups(part)
        if any(tag_of(group) == "svg" for group in groups[1:]):
            raise ReadError(name, "stands in an <svg> inside the drawing; take it out of that")
        document = _document(groups, part, self._by_id)
        return DrawingObject(name, document, self._outer(part), _own(part))

    def moved(self, moves: Mapping[str, FloatArray]) -> dict[str, str]:
        """New ``transform`` of each object, by its id, after moves (2 x 3) in the root's units.

        Clones of what is moved stay where they are, unless they are moved too.
        """
        steps = {name: self._step(self._by_id[name], move) for name, move in moves.items()}
        new = {}
        for name, element in self._by_id.items():
            shown = _link(element).removeprefix("#") if tag_of(element) == "use" else ""
            if name not in steps and shown not in steps:
                continue
            own = affine.compose(steps.get(name, affine.identity()), _own(element))
            if shown in steps:
                x, y = (parse_length(element.get(axis), 0.0) or 0.0 for axis in "xy")
                aside = affine.similarity(x, y, 0.0, 1.0)
                undone = affine.compose(aside, affine.inverse(steps[shown]))
                own = affine.compose(own, affine.compose(undone, affine.inverse(aside)))
            new[name] = matrix_text(own)
        return new

    def _step(self, part: ET.Element, move: FloatArray) -> FloatArray:
        """A move in the units in which an object's ``transform`` stands."""
        outer = self._outer(part)
        return affine.compose(affine.inverse(outer), affine.compose(move, outer))

    def _groups(self, part: ET.Element) -> list[ET.Element]:
        """Groups that an element stands in, from the root on."""
        way = [part]
        while way[-1] is not self._root:
            way.append(self._parents[way[-1]])
        return way[:0:-1]

    def _outer(self, part: ET.Element) -> FloatArray:
        return reduce(affine.compose, map(_own, self._groups(part)), affine.identity())


def _own(element: ET.Element) -> FloatArray:
    return parse_transform(element.get("transform"))


def _document(
    groups: Sequence[ET.Element], part: ET.Element, by_id: dict[str, ET.Element]
) -> bytes:
    """The document with one part of what is drawn, and what that refers to, without a page."""
    inner = _framed(part)
    for group in reversed(groups):
        outer = ET.Element(group.tag, group.attrib)
        if group is groups[0]:
            styles = [style for style in group.iter() if tag_of(style) == "style"]
            outer.extend(styles)
            defs = ET.SubElement(outer, f"{group.tag.removesuffix('svg')}defs")
            users = [*styles, *groups, *part.iter()]
            defs.extend(map(_framed, _referenced(users, part, by_id)))
        outer.append(inner)
        inner = outer
    for key in _PAGE:
        inner.attrib.pop(key, None)
    return ET.tostring(inner, encoding="unicode").encode()


def _referenced(
    users: Sequence[ET.Element], part: ET.Element, by_id: dict[str, ET.Element]
) -> Iterator[ET.Element]:
    """Elements that are referred to, and what they refer to in turn, each once."""
    there = set(part.iter())
    waiting = list(users)
    while waiting:
        found = [by_id[name] for name in _names(waiting.pop()) if name in by_id]
        for target in found:
            if target not in there:
                there |= set(target.iter())
                waiting += target.iter()
                yield target


def _names(element: ET.Element) -> Iterator[str]:
    yield _link(element).removeprefix("#")
    yield from (name for _, name in referenced_ids(element))
    if tag_of(element) == "style":
        rules = ET.Element("style", rules=element.text or "")
        yield from (name for _, name in referenced_ids(rules))


def _link(element: ET.Element) -> str:
    return next((element.attrib[key] for key in _LINKS if key in element.attrib), "")


def _framed(element: ET.Element) -> ET.Element:
    """Copy of an element in which pictures of other files, which are not read, are their frames."""
    shown = copy.deepcopy(element)
    for image in shown.iter():
        if tag_of(image) == "image" and not _link(image).startswith("data:"):
            image.tag = image.tag.removesuffix("image") + "rect"
            for key in _LINKS:
                image.attrib.pop(key, None)
    return shown
