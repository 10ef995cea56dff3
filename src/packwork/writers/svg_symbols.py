"""Items as SVG elements: what each draws, its colours, its id, link and tooltip."""

from __future__ import annotations

import base64
import re
from collections.abc import Callable, Hashable, Iterable, Mapping, Sequence
from dataclasses import replace

import shapely

from packwork.geometry import affine
from packwork.geometry.outline import Outline
from packwork.geometry.overlay import difference
from packwork.geometry.polygon import polygon_parts, silhouette, silhouette_area
from packwork.scene.colour import Colour, css_colour, hex_colour
from packwork.scene.item import FlatArt, Item, Label, PhotoArt, PictureArt, VectorArt
from packwork.scene.layout import Layout, Note
from packwork.scene.notation import (
    attributes,
    finer_decimals,
    matrix_text,
    path_data,
    sound_text,
    xml_text,
)

LEAST_BAY = 1e-6
"""Share of an item's area below which a bay is rounding. Larger leaves out what can be measured,
smaller makes files longer for nothing. Chosen, as the specks of readers."""


def shape_key(item: Item) -> Hashable:
    """Same key for items whose definition can be shared.

    Flat items share by ink alone, so that marks of many colours cost one path.
    """
    return item.ink if isinstance(item.art, FlatArt) else item.art


def largest_scales(layout: Layout, key_of: Callable[[Item], Hashable]) -> dict[Hashable, float]:
    """Largest scale of all copies that have one key, in the order of the layout.

    Examples
    --------
    >>> from packwork.scene.layout import blank
    >>> largest_scales(blank(), shape_key)
    {}
    """
    found: dict[Hashable, float] = {}
    scales = layout.poses.axis_scales.max(axis=1).tolist()
    for item, scale in zip(layout.items, scales, strict=True):
        found[key_of(item)] = max(found.get(key_of(item), 0.0), scale)
    return found


def fill_attributes(channels: Colour) -> dict[str, str]:
    """Attributes of a colour; opacity is written apart, as few tools read ``#rrggbbaa``.

    Examples
    --------
    >>> fill_attributes((255, 0, 0, 51))
    {'fill': '#ff0000', 'fill-opacity': '0.2'}
    """
    opacity = "" if channels[3] == 255 else f"{channels[3] / 255:.3g}"
    return {"fill": hex_colour(channels), "fill-opacity": opacity}


def paint(item: Item) -> dict[str, str]:
    """Attributes that colour one copy; arts with colours of their own need none."""
    if not isinstance(item.art, FlatArt):
        return {}
    try:
        return fill_attributes(css_colour(item.art.fill))
    except ValueError:
        return {"fill": item.art.fill}


def element(item: Item, own: Mapping[str, str], place: str, digits: int) -> str:
    """Element that draws an item.

    ``own`` are attributes of this element: its id, its colour. ``place`` is a ``transform`` from
    the item's units to wherever it goes, or empty. ``digits`` come after the point for ink, in the
    item's units.

    Examples
    --------
    >>> from packwork.geometry.outline import Outline
    >>> ink = Outline.from_rings([[[-1, -1], [2, -1], [-1, 2]]])
    >>> element(Item("tri", "", ink, ink, FlatArt()), {"id": "a"}, "scale(2)", 3)
    '<path id="a" transform="scale(2)" fill-rule="evenodd" d="M-1 -1 2 -1 -1 2Z"/>'
    """
    art = item.art.preview if isinstance(item.art, PhotoArt) else item.art
    told = _unseen_outline(item, art, digits)
    if isinstance(art, VectorArt):
        head = attributes({**own, **told, "transform": place + matrix_text(art.matrix)})
        return f"<g{head}>{art.markup}</g>"
    if isinstance(art, PictureArt):
        head = attributes({**own, **told, "transform": place + matrix_text(art.matrix)})
        return f"<image{head}{_picture(art)}/>"
    head = attributes({**own, **told, "transform": place})
    return f'<path{head} fill-rule="evenodd" d="{path_data(item.ink, digits)}"/>'


def _unseen_outline(
    item: Item, art: FlatArt | VectorArt | PictureArt, digits: int
) -> dict[str, str]:
    """Part of an item's outline that its drawing does not show, in the units of its markup."""
    matrix = affine.identity() if isinstance(art, FlatArt) else art.matrix
    digits, back = digits + finer_decimals(matrix), affine.inverse(matrix)
    if not isinstance(art, FlatArt) and art.is_traced:
        # What is traced again comes out a little otherwise: the file holds what was placed.
        return {"data-outline": path_data(item.outline.mapped(back), digits)}
    bays = _filled_bays(item)
    return {} if bays is None else {"data-bays": path_data(bays.mapped(back), digits)}


def _filled_bays(item: Item) -> Outline | None:
    """Bays of a drawing that count as its own, for their mouths are all but closed.

    Whether they do is near a limit: followed again, a mouth may come out on its other side.
    """
    if item.outline.has_holes or item.is_filled_ink:
        return None
    # Of copies: what regions take does not stay in memory.
    outline, ink = replace(item.outline).region, replace(item.ink).region
    least = LEAST_BAY * outline.area
    if silhouette_area(ink) > outline.area - least:
        return None
    seen = silhouette(ink)
    bays = [part for part in polygon_parts(difference(outline, seen)) if part.area > least]
    return Outline.from_region(shapely.MultiPolygon(bays)) if bays else None


def _picture(art: PictureArt) -> str:
    data = base64.b64encode(art.png).decode("ascii")
    return (
        f' width="{art.width}" height="{art.height}" preserveAspectRatio="none"'
        f' xlink:href="data:image/png;base64,{data}"'
    )


ID_LENGTH = 60
"""Characters of a name that an id keeps. Chosen."""

_NOT_IN_IDS = re.compile(r"[^\w]+")
_OURS = re.compile(
    r"(item|shape)-\d+(-\d+)?|items|container|background|artwork|engrave-\d+|labels|legend|leaving(-\d+)?|p[0-9a-f]{10}-.*"
)
"""Ids that a document of ours may hold anyway, those of drawings among them."""


def item_ids(items: Sequence[Item]) -> list[str]:
    """One id per item, all unlike: ``item-3`` by its number, or made of a name of its own.

    Examples
    --------
    >>> from packwork.geometry.outline import Outline
    >>> from packwork.scene.item import FlatArt
    >>> ink = Outline.from_rings([[[-1, -1], [2, -1], [-1, 2]]])
    >>> plain = Item("star", "", ink, ink, FlatArt())
    >>> ours = Item("star", "", ink, ink, FlatArt(), Label(name="R & D"))
    >>> item_ids([plain, ours, ours])
    ['item-1', 'R-D', 'R-D-2']
    """
    taken: set[str] = set()
    found = []
    for number, item in enumerate(items, start=1):
        base = _as_id(item.label.name)
        choice = f"item-{number}" if not base else _free(base, taken)
        taken.add(choice)
        found.append(choice)
    return found


def labelled(drawn: str, label: Label) -> str:
    """An item's element with its tooltip, inside its link; as it is if it has neither."""
    title = f"<title>{xml_text(label.title)}</title>" if label.title else ""
    if label.link:
        return f"<a{attributes({'href': label.link})}>{title}{drawn}</a>"
    return f"<g>{title}{drawn}</g>" if title else drawn


def _as_id(name: str) -> str:
    word = _NOT_IN_IDS.sub("-", sound_text(name)).strip("-")[:ID_LENGTH]
    if not word or (word[0].isalpha() and not _OURS.fullmatch(word)):
        return word
    return f"item-named-{word}"


def _free(base: str, taken: Iterable[str]) -> str:
    choice, count = base, 1
    while choice in taken:
        count += 1
        choice = f"{base}-{count}"
    return choice


def note_groups(layout: Layout) -> list[str]:
    """Labels on items, then letters and keys beside them."""
    labels = [_note(note) for note in layout.notes if note.is_on_item]
    beside = [_note(note) for note in layout.notes if not note.is_on_item]
    return [
        *(['<g id="labels" pointer-events="none">', *labels, "</g>"] if labels else []),
        *(['<g id="legend">', *beside, "</g>"] if beside else []),
    ]


def _note(note: Note) -> str:
    place = {"transform": matrix_text(note.matrix), "fill": note.fill}
    path = f'<path{attributes(place)} fill-rule="evenodd" d="{note.path}"/>'
    # What lies on an item is said by that one's own title.
    title = f"<title>{xml_text(note.says)}</title>" if note.says and not note.is_on_item else ""
    return f"<g>{title}{path}</g>" if title else path
