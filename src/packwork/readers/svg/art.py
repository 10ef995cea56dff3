"""SVG fragments of clean drawings that can be embedded in any other document.

Outlines are computed from shapes or traced; what viewers paint is another computation, with
clips, viewports and filters of its own. Where the two differ, an item would lie over its
neighbours though its outline does not. So each drawing is painted once, its outline punched out,
and what it paints beyond is cut off.
"""

from __future__ import annotations

import contextlib
import copy
import hashlib
import math
import re
import xml.etree.ElementTree as ET
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from packwork.arrays import FloatArray
from packwork.geometry import affine
from packwork.geometry.outline import Outline
from packwork.raster.drawing import drawn_png
from packwork.readers.budget.rendering import FILTER, Work
from packwork.readers.gate.door import link_declaration, parse_untrusted, serialised, uses_links
from packwork.readers.pictures.decode import decode_picture
from packwork.readers.reading import TooRichError, UnfitError, notice
from packwork.readers.svg_syntax.coordinates import Page
from packwork.readers.svg_syntax.painted import Painted, whole_box
from packwork.readers.svg_syntax.references import elements_by_id, rename_references
from packwork.readers.svg_syntax.vocabulary import GRADIENTS
from packwork.scene.item import VectorArt
from packwork.scene.notation import decimals, matrix_text, path_data

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

    ``is_cut`` says whether the page cuts into it; ``place`` maps (2 x 3) CSS pixels to the item's
    own units.

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

    ``place`` maps (2 x 3) the fragment's units to the item's own.

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


OUTLINE_PX = 400
"""Pixels of the outline's longer side. Half of one beyond the outline is let pass."""

FAINT, SOLID, SOLID_TRACED = 0.1, 0.3, 0.6
"""Opacity that counts as paint in four pixels together, and in one: softened edges leave up
to .15 in single ones. Of what is traced the outline lies where the picture is half opaque. Tried
on 400 px of icons and maps."""

MARGIN, FARTHEST = 0.25, 25.0
"""What is looked at around the outline, and how far what shapes reach is followed, as shares of its
longer side. Chosen."""

SIDES_PX = (OUTLINE_PX * 3 // 4, OUTLINE_PX * 3 // 2)
"""Longer sides of pictures of it with what is around: where the first shows nothing, there is
nothing."""

FILTERED, PATTERN = f"{FILTER}=", "<pattern"
"""Marks of art with filters, and with patterns."""

TURNS = (33.0, 143.0, 250.0)
"""Angles at which art with filters or patterns is looked at too, in degrees. Chosen."""

_FINEST = 1e-3
"""Of a pixel, to which the outline is written down."""

Box = tuple[float, float, float, float]
"""Left, top, right and bottom in the item's own units."""


def whole_reach(shapes: Sequence[Painted], place: FloatArray) -> Box | None:
    """Box round all shapes, those outside of the page among them, placed by a 2 x 3 map."""
    boxes = np.array([whole_box(shape, is_safe=True) for shape in shapes])
    if not len(boxes) or not np.isfinite(boxes).all():
        return None
    low, high = boxes[:, :2].min(axis=0), boxes[:, 2:].max(axis=0)
    corners = affine.apply(place, np.array([low, high, (low[0], high[1]), (high[0], low[1])]))
    return (*corners.min(axis=0).tolist(), *corners.max(axis=0).tolist())


def within_outline(
    arts: Iterable[VectorArt], outline: Outline, reach: Box | None, work: Work
) -> VectorArt:
    """The first of some arts of a drawing that paints nothing beyond its outline; else one cut.

    ``reach`` is the box of what its shapes reach, also where no page shows them.
    """
    art = None
    with contextlib.suppress(TooRichError):
        for art in arts:
            if not paints_beyond(art, outline, reach, work):
                return art
    assert art is not None  # noqa: S101 - there is one at least
    notice("what it paints beyond its outline is cut off")
    art = cut_by_outline(art, outline)
    with contextlib.suppress(TooRichError):
        if paints_beyond(art, outline, reach, work):
            raise UnfitError("paints beyond its outline, whatever is cut off; save it as plain SVG")
    return art


def paints_beyond(art: VectorArt, outline: Outline, reach: Box | None, work: Work) -> bool:
    """Whether art leaves paint outside an outline, by more than half a pixel of 400.

    >>> square, work = Outline.box(0, 0, 10, 10), Work(1, 0)
    >>> inside = VectorArt('<rect width="10" height="10"/>', affine.identity())
    >>> beside = VectorArt('<rect width="10" height="10"/><path d="M12 0h1v9h-1z"/>', inside.matrix)
    >>> [paints_beyond(art, square, None, work) for art in (inside, beside)]
    [False, True]
    """
    if any(mark in art.markup for mark in (FILTERED, PATTERN)):
        # Renderers apply these to pixels, clips too: how depends on how the item is turned.
        turns = [affine.similarity(0.0, 0.0, math.radians(angle), 1.0) for angle in TURNS]
        return any(
            _is_beyond(
                replace(art, matrix=affine.compose(turn, art.matrix)),
                outline.mapped(turn),
                None,
                work,
            )
            for turn in turns
        ) or _is_beyond(art, outline, reach, work)
    return _is_beyond(art, outline, reach, work)


def _is_beyond(art: VectorArt, outline: Outline, reach: Box | None, work: Work) -> bool:
    left, top, right, bottom = outline.bounds
    margin = MARGIN * max(right - left, bottom - top)
    near = (left - margin, top - margin, right + margin, bottom + margin)
    views = [near] if reach is None else list(dict.fromkeys([near, _wider(near, reach)]))
    return any(
        all(_is_painted(art, outline, view, side, work) for side in SIDES_PX) for view in views
    )


def _wider(near: Box, reach: Box) -> Box:
    """Box round both, but no farther than is looked."""
    far = FARTHEST * max(near[2] - near[0], near[3] - near[1])
    left, top = (max(min(near[k], reach[k]), near[k] - far) for k in (0, 1))
    right, bottom = (min(max(near[k], reach[k]), near[k] + far) for k in (2, 3))
    return left, top, right, bottom


def cut_by_outline(art: VectorArt, outline: Outline) -> VectorArt:
    """Art clipped to the outline.

    >>> art = VectorArt('<rect width="20" height="10"/>', affine.identity())
    >>> square = Outline.box(0, 0, 10, 10)
    >>> paints_beyond(cut_by_outline(art, square), square, None, Work(1, 0))
    False
    """
    stencil = outline.mapped(affine.inverse(art.matrix))
    data = path_data(stencil, decimals(_FINEST * stencil.extent / OUTLINE_PX))
    name = f"p{hashlib.sha256((art.markup + data).encode()).hexdigest()[:10]}-cut"
    clip = f'<clipPath id="{name}"><path d="{data}" clip-rule="evenodd"/></clipPath>'
    return replace(art, markup=f'{clip}<g clip-path="url(#{name})">{art.markup}</g>')


def _is_painted(art: VectorArt, outline: Outline, view: Box, side: int, work: Work) -> bool:
    """Whether a picture of the art without its outline shows anything."""
    left, top, width, height = view[0], view[1], view[2] - view[0], view[3] - view[1]
    side = work.side(side, max(width, height))
    work.spend(side, max(width, height))
    unit = max(width, height) / side
    columns, rows = max(1, round(width / unit)), max(1, round(height / unit))
    box = f'x="{left!r}" y="{top!r}" width="{columns * unit!r}" height="{rows * unit!r}"'
    data, spared = path_data(outline, decimals(_FINEST * unit)), outline.extent / OUTLINE_PX
    links, space = link_declaration()
    document = (
        f'<svg xmlns="http://www.w3.org/2000/svg" {links}="{space}" width="{columns}" '
        f'height="{rows}" viewBox="{left!r} {top!r} {columns * unit!r} {rows * unit!r}">'
        f'<mask id="beyond" maskUnits="userSpaceOnUse" {box}><rect {box} fill="#fff"/>'
        f'<path d="{data}" fill-rule="evenodd" stroke="#000" stroke-width="{spared!r}"/></mask>'
        f'<g mask="url(#beyond)"><g transform="{matrix_text(art.matrix)}">'
        f"{art.markup}</g></g></svg>"
    )
    try:
        picture = drawn_png(document)
    except ValueError as error:
        raise UnfitError(f"cannot be rendered ({error}); save it as plain SVG") from None
    opacity = decode_picture(picture, max(columns, rows)).pixels[:, :, 3] / 255
    if opacity.max() > (SOLID_TRACED if art.is_traced else SOLID):
        return True
    together = np.minimum(opacity[1:], opacity[:-1])
    together = np.minimum(together[:, 1:], together[:, :-1])
    # The smaller a picture, the more of an edge lies in each pixel.
    return not art.is_traced and bool((together > FAINT * SIDES_PX[1] / side).any())
