"""SVG fragments of clean drawings that can be embedded in any other document."""

from __future__ import annotations

import copy
import hashlib
import re
import xml.etree.ElementTree as ET
from dataclasses import dataclass

from packwork.arrays import FloatArray
from packwork.geometry import affine
from packwork.readers.gate.door import link_declaration, parse_untrusted, serialised, uses_links
from packwork.readers.svg_syntax.coordinates import Page
from packwork.readers.svg_syntax.references import elements_by_id, rename_references
from packwork.readers.svg_syntax.vocabulary import GRADIENTS
from packwork.scene.item import VectorArt

_OWN_TO_ROOT = frozenset(
    {"x", "y", "width", "height", "viewBox", "preserveAspectRatio", "overflow", "id"}
)
_PERCENT = re.compile(r"\s*[-+.\d]+%\s*")
_RELATIVE = frozenset({"offset", "font-size"}) | {
    f"{kind}-opacity" for kind in ("fill", "stroke", "stop")
}


def vector_art(
    root: ET.Element, page: Page | None, *, is_cut: bool, place: FloatArray
) -> VectorArt:
    """Fragment of a clean drawing, its ids unlike those of any other drawing.

    Parameters
    ----------
    is_cut
        Whether the page cuts into the drawing, so that the fragment has to as well.
    place
        2 x 3 map from CSS pixels to the item's own units.

    Examples
    --------
    >>> root = ET.fromstring('<svg><path d="M0 0h9v9z"/></svg>')
    >>> vector_art(root, None, is_cut=False, place=affine.identity()).markup
    '<path d="M0 0h9v9z"/>'
    """
    drawing = copy.deepcopy(root)
    _make_ids_unique(drawing)
    if any("mix-blend-mode" in element.get("style", "") for element in drawing.iter()):
        # What blends, blends with the drawing's own, not with what lies below it elsewhere.
        drawing.set("style", "isolation:isolate")
    matrix = place
    if page is not None and (is_cut or _has_percentages(drawing)):
        drawing.attrib |= {"width": repr(page.width), "height": repr(page.height)}
        drawing.attrib["overflow"] = "hidden" if is_cut else "visible"
        _move_looks_inside(drawing)
        return VectorArt(_with_links(drawing), matrix)
    if page is not None:
        matrix = affine.compose(place, page.matrix)
    return VectorArt(_plain_fragment(drawing), matrix)


def kept_art(markup: str, place: FloatArray, *, is_traced: bool = False) -> VectorArt:
    """Art of a fragment out of a file of ours: as it is if the gate has nothing to change in it.

    Parameters
    ----------
    place
        2 x 3 map from the fragment's units to the item's own.

    Raises
    ------
    UnfitError
        If it is no drawing.

    Examples
    --------
    >>> kept_art('<path d="M0 0h9v9z" />', affine.identity()).markup
    '<path d="M0 0h9v9z" />'
    >>> kept_art('<path onclick="a()" d="M0 0h9v9z"/>', affine.identity()).markup
    '<path d="M0 0h9v9z"/>'
    """
    name, value = link_declaration()
    links = f' {name}="{value}"'
    root = parse_untrusted(
        f'<svg xmlns="http://www.w3.org/2000/svg"{links}>{markup}</svg>'.encode()
    )
    plain = markup.replace(links, "").replace(" />", "/>")
    if "".join(serialised(child) for child in root) == plain:
        return VectorArt(markup, place, is_traced)
    made = vector_art(root, None, is_cut=False, place=place)
    return VectorArt(made.markup, place, is_traced)


@dataclass(frozen=True, eq=False)
class KeptOriginal:
    """A photograph out of a file of ours: with all the pixels that it has there."""

    art: VectorArt

    def printed(self, px_per_unit: float) -> VectorArt:
        """The photograph, whatever is asked."""
        return self.art


def _plain_fragment(drawing: ET.Element) -> str:
    """Children of the root, in a group if the root says how they look."""
    drawing.tag = "g"
    drawing.attrib = {k: v for k, v in drawing.attrib.items() if k not in _OWN_TO_ROOT}
    if drawing.attrib or uses_links(drawing):
        return _with_links(drawing)
    return "".join(serialised(child) for child in drawing)


def _move_looks_inside(drawing: ET.Element) -> None:
    """Put all that the root says of looks and place on a group in it, in place.

    Transforms and clips of an inner ``<svg>`` are in the units of what it stands in.
    """
    looks = {k: v for k, v in drawing.attrib.items() if k not in _OWN_TO_ROOT}
    if not looks:
        return
    group = ET.Element("g", looks)
    group.extend(list(drawing))
    drawing[:] = [group]
    drawing.attrib = {k: v for k, v in drawing.attrib.items() if k in _OWN_TO_ROOT}


def _with_links(drawing: ET.Element) -> str:
    if uses_links(drawing):
        name, value = link_declaration()
        drawing.set(name, value)
    return serialised(drawing)


def _make_ids_unique(drawing: ET.Element) -> None:
    """Number the ids behind a hash of the content, in place."""
    names = elements_by_id(drawing)
    if not names:
        return
    digest = hashlib.sha256(serialised(drawing).encode()).hexdigest()[:10]
    new_names = {old: f"p{digest}-{k}" for k, old in enumerate(names)}
    for element in drawing.iter():
        rename_references(element, new_names.__getitem__)


def _has_percentages(drawing: ET.Element) -> bool:
    """Whether lengths refer to the page, which a fragment does not have."""
    return any(
        name not in _RELATIVE and _PERCENT.fullmatch(value)
        for element in drawing.iter()
        if element is not drawing and not _is_relative(element)
        for name, value in element.attrib.items()
    )


def _is_relative(element: ET.Element) -> bool:
    """Whether the element's percentages refer to the shape that uses it."""
    is_paint = element.tag in GRADIENTS | {"stop", "pattern", "mask", "filter"}
    return is_paint and "userSpaceOnUse" not in element.attrib.values()
