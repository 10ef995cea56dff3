"""Drawings in another colour, curves and all, or under a thin coat of one."""

from __future__ import annotations

import io
import xml.etree.ElementTree as ET
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TypeAlias

import numpy as np
from defusedxml.ElementTree import fromstring
from PIL import Image, UnidentifiedImageError

from packwork.geometry import affine
from packwork.geometry.outline import Outline
from packwork.scene.colour import ABSENT, css_colour, hex_colour
from packwork.scene.item import Art, FlatArt, Item, Original, PhotoArt, PictureArt, VectorArt
from packwork.scene.notation import matrix_text, with_fresh_ids

XLINK = "http://www.w3.org/1999/xlink"
_HREF = f"{{{XLINK}}}href"
ET.register_namespace("xlink", XLINK)

_COLOURFUL = frozenset(
    {"image", "linearGradient", "radialGradient", "pattern", "marker", "mask", "filter", "style"}
)
"""Elements whose colours do not stand in their fill and stroke alone."""

_UNDRAWN = frozenset({"defs", "symbol", "clipPath"})
_SHAPES = frozenset(
    {"path", "rect", "circle", "ellipse", "line", "polyline", "polygon", "text", "tspan"}
)
_PAINTS = ("fill", "stroke", "color")
_FIRST = {"fill": "black", "stroke": "none", "color": "black"}
_REFERRING = ("currentcolor", "inherit")

_SOLID = 128
"""Opacity from which a pixel's colour counts; fainter ones are soft edges. Chosen."""

_SAME = 24
"""How far channels of pixels of one colour may lie apart: what JPEG-born pictures and soft
edges leave. Larger takes shaded drawings for flat ones. Chosen."""

_Rgb: TypeAlias = tuple[int, ...]


def has_one_colour(art: Art) -> bool:
    """Whether all that is drawn has one and the same colour.

    Examples
    --------
    >>> place = np.eye(2, 3)
    >>> has_one_colour(VectorArt('<g fill="red"><path d="M0 0h9v9z"/></g>', place))
    True
    >>> has_one_colour(VectorArt('<g fill="red"><path stroke="blue" d="M0 0h9v9"/></g>', place))
    False
    """
    if isinstance(art, FlatArt):
        return True
    if isinstance(art, PhotoArt):
        return False
    if isinstance(art, PictureArt):
        return _is_flat_picture(art)
    root = tree_of(art.markup)
    if any(element.tag in _COLOURFUL for element in root.iter()):
        return False
    named = {element.get("id"): element for element in root.iter()}
    try:
        return len(set(_channels(root, _FIRST, named))) == 1
    except ValueError:  # a paint that is no colour
        return False


ALIKE = 1 / 6
"""Chance that two items are different drawings of one colour, from which these run together.
Derived: of six neighbours one is like the item."""


def run_together(items: Sequence[Item]) -> bool:
    """Whether many neighbours are different drawings of one colour, which then look as one.

    Examples
    --------
    >>> from packwork.readers.builtin import builtin_item
    >>> run_together([builtin_item("star"), builtin_item("star")])
    False
    """
    drawings = Counter(item.art for item in items)
    colours = Counter[tuple[int, int, int, int]]()
    copies = 0
    for art, count in drawings.items():
        if (colour := one_colour(art)) is not None:
            colours[colour] += count
            copies += count * (count - 1)
    alike = sum(count * (count - 1) for count in colours.values()) - copies
    return 0 < alike >= ALIKE * len(items) * (len(items) - 1)


def one_colour(art: Art) -> tuple[int, int, int, int] | None:
    """Channels of what is drawn in one colour; None for any other drawing.

    Examples
    --------
    >>> one_colour(VectorArt('<g fill="red" opacity="0.4"><path d="M0 0h9v9z"/></g>', np.eye(2, 3)))
    (255, 0, 0, 102)
    """
    if isinstance(art, FlatArt):
        return css_colour(art.fill)
    if not isinstance(art, VectorArt) or not has_one_colour(art):
        return None
    root = tree_of(art.markup)
    named = {element.get("id"): element for element in root.iter()}
    red, green, blue = next(_channels(root, _FIRST, named))[:3]
    opacity = next((e.get("opacity") for e in root.iter() if e.get("opacity")), None)
    return red, green, blue, round(255 * float(opacity or 1))


def recoloured(item: Item, colour: str) -> Item:
    """Item in one colour: a drawing of one colour keeps its curves, any other its ink alone.

    ``colour``: ``#rrggbb``, or ``#rrggbbaa`` with opacity.

    Examples
    --------
    >>> from packwork.geometry.outline import Outline
    >>> ink = Outline.from_rings([[[-1, -1], [2, -1], [-1, 2]]])
    >>> art = VectorArt('<path d="M0 0h9v9z" stroke="#000"/>', np.eye(2, 3))
    >>> recoloured(Item("tri", "", ink, ink, art), "#ff0000").art.markup
    '<g color="#ff0000" fill="#ff0000"><path d="M0 0h9v9z" stroke="#ff0000" /></g>'
    """
    if not isinstance(item.art, VectorArt) or not has_one_colour(item.art):
        return replace(item, art=FlatArt(colour))
    root = tree_of(item.art.markup)
    channels = css_colour(colour)
    solid = hex_colour(channels)
    for element in root.iter():
        for paint in _PAINTS:
            if element.get(paint, "none").strip().lower() not in (*ABSENT, *_REFERRING):
                element.set(paint, solid)
    # What says nothing of its own inherits from here.
    root.attrib |= {"color": solid, "fill": solid}
    if channels[3] < 255:
        root.set("opacity", f"{channels[3] / 255:.3g}")
    markup = ET.tostring(root, encoding="unicode")
    # The same drawing in another colour has other shapes under the same names.
    return replace(item, art=replace(item.art, markup=with_fresh_ids(markup, f"-{colour[1:]}")))


def tree_of(markup: str) -> ET.Element:
    """Elements of a fragment, in one group."""
    tree: ET.Element = fromstring(f'<g xmlns:xlink="{XLINK}">{markup}</g>')
    return tree


def _channels(
    element: ET.Element, inherited: Mapping[str, str], named: Mapping[str | None, ET.Element]
) -> Iterator[_Rgb]:
    """Colours of all that an element draws; what ``use`` shows inherits from there."""
    own = {
        paint: value if (value := element.get(paint, "inherit")) != "inherit" else inherited[paint]
        for paint in _PAINTS
    }
    if element.tag in _SHAPES:
        for paint in ("fill", "stroke"):
            value = own["color"] if own[paint].strip().lower() == "currentcolor" else own[paint]
            if value.strip().lower() not in ABSENT:
                yield css_colour(value)[:3]
    if element.tag == "use":
        target = named.get(element.get(_HREF, "")[1:])
        if target is not None:
            yield from _channels(target, own, named)
    for child in element:
        if child.tag not in _UNDRAWN:
            yield from _channels(child, own, named)


def _is_flat_picture(art: PictureArt) -> bool:
    try:
        with Image.open(io.BytesIO(art.png)) as picture:
            pixels = np.asarray(picture.convert("RGBA")).reshape(-1, 4)
    except (OSError, ValueError, UnidentifiedImageError, Image.DecompressionBombError):
        return False
    solid = pixels[pixels[:, 3] >= _SOLID, :3]
    return len(solid) > 0 and bool((np.ptp(solid.astype(np.int64), axis=0) <= _SAME).all())


def with_own_art(item: Item, before: Item) -> Item:
    """An item in other colours, which knows how it was drawn before any was put on it."""
    return replace(item, own_art=before.own_art or before.art)


def in_own_colours(item: Item) -> Item:
    """An item as it was drawn before any colour was put on it."""
    return item if item.own_art is None else replace(item, art=item.own_art, own_art=None)


@dataclass(frozen=True, eq=False)
class TintedOriginal:
    """A photograph on disk under a coat of colour, opened anew each time it is printed.

    ``ink``: what is coated, item units.
    ``colour``, ``share``: ``#rrggbb``, and its opacity.
    """

    original: Original
    ink: Outline
    colour: str
    share: float

    def printed(self, px_per_unit: float) -> VectorArt:
        """The photograph with that many pixels per item unit, coated."""
        return coated(self.original.printed(px_per_unit), self.ink, self.colour, self.share)


def tinted_photo(item: Item, colour: str, share: float) -> Item:
    """A photograph under a coat of ``colour`` of that opacity; what is no photograph as it is."""
    art = item.art
    if not isinstance(art, PhotoArt):
        return item
    preview = coated(art.preview, item.ink, colour, share)
    return replace(
        item, art=PhotoArt(preview, TintedOriginal(art.original, item.ink, colour, share))
    )


def coated(art: VectorArt, ink: Outline, colour: str, share: float) -> VectorArt:
    """A drawing with ``ink`` (item units) in a colour of that opacity over it."""
    rings = "".join(
        "M" + " ".join(f"{v:.6g}" for v in ring.ravel().tolist()) + "Z" for ring in ink.rings
    )
    back = matrix_text(affine.inverse(art.matrix))
    coat = (
        f'<path transform="{back}" fill="{colour}" fill-opacity="{share:.3g}"'
        f' fill-rule="evenodd" d="{rings}"/>'
    )
    return replace(art, markup=art.markup + coat)
