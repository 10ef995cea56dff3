"""Everything of an SVG of ours beside its items: ground, picture behind, halos, labels and keys."""

from __future__ import annotations

import json
import math
import re
import xml.etree.ElementTree as ET
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from packwork.arrays import FloatArray
from packwork.geometry import affine
from packwork.geometry.lattice import HALF_DROP, SQUARE
from packwork.readers.layouts.arts import Arts
from packwork.readers.layouts.foreign_svg import group_named, tag
from packwork.readers.reading import UnfitError
from packwork.readers.svg.art import KeptOriginal
from packwork.readers.svg_syntax.coordinates import parse_transform
from packwork.readers.svg_syntax.path_data import parse_path
from packwork.scene.colour import css_colour, hex_colour, known_colour
from packwork.scene.container import Backdrop
from packwork.scene.item import Item, PhotoArt
from packwork.scene.layout import Layout, Note

BESIDE = 0.02
"""Largest distance of a halo's middle from that of its item, in sides of the canvas: more than
rounding, less than items are apart. Chosen."""

_PATH = re.compile(r"[MmZzLlHhVvCcSsQqTtAaeE\d\s+.,-]*")
_LIMITS = {"rotate": "data-rotate", "sizes": "data-sizes", "size_ratio": "data-size-ratio"}


def tile_of(root: ET.Element) -> str | None:
    """Way in which the sheet of a tile repeats; None if it is no tile.

    Examples
    --------
    >>> tile_of(ET.fromstring('<svg><g id="container" data-tile="half-drop"/></svg>'))
    'half-drop'
    """
    wall = group_named(root, "container")
    said = None if wall is None else wall.get("data-tile")
    return said if said in {SQUARE, HALF_DROP} else None


def drawing_of(root: ET.Element, is_in_full: bool) -> dict[str, Any]:
    """Options by which a file like this one is drawn, those alone that are not the usual ones.

    Examples
    --------
    >>> root = ET.fromstring('<svg><g id="container"/><g id="cut" data-line="outlines"/></svg>')
    >>> drawing_of(root, is_in_full=True)
    {'flatten': True, 'show_container': True, 'cut': 'outlines'}
    """
    found: dict[str, Any] = {"flatten": True} if is_in_full else {}
    wall, cut = group_named(root, "container"), group_named(root, "cut")
    if wall is not None and wall.get("display") != "none":
        found["show_container"] = True
    if cut is not None and cut.get("data-line") in {"outlines", "silhouette"}:
        found["cut"] = cut.get("data-line")
    if cut is not None and cut.get("data-kiss"):
        found["kiss_cut"] = cut.get("data-kiss")
    return found


def limits_of(said: Mapping[str, str]) -> dict[str, Any]:
    """Limits of turns and sizes that a run had, and how its words were set, as its recipe says it.

    Examples
    --------
    >>> limits_of({"data-rotate": "none", "data-words": '{"case":"upper"}'})
    {'rotate': 'none', 'words': {'case': 'upper'}}
    """
    found: dict[str, Any] = {key: said[name] for key, name in _LIMITS.items() if name in said}
    try:
        if "size_ratio" in found:
            found["size_ratio"] = float(found["size_ratio"])
        if "data-words" in said:
            found["words"] = dict(json.loads(said["data-words"]))
    except (ValueError, TypeError, RecursionError):
        raise UnfitError("states limits of sizes, or words, in another form than ours") from None
    return found


def ground_of(root: ET.Element) -> str:
    """Colour behind everything, ``#rrggbb`` or ``#rrggbbaa``; empty if there is none.

    Examples
    --------
    >>> ground_of(ET.fromstring('<svg><rect id="background" fill="#ff0000"/></svg>'))
    '#ff0000'
    """
    rect = next((e for e in root if tag(e) == "rect" and e.get("id") == "background"), None)
    if rect is None:
        return ""
    try:
        channels = css_colour(rect.get("fill", ""))
        opacity = min(max(float(rect.get("fill-opacity", "1")), 0.0), 1.0)
        return hex_colour((*channels[:3], round(channels[3] * opacity)))
    except ValueError:
        return ""


def backdrop_of(root: ET.Element, arts: Arts, to_canvas: FloatArray) -> Backdrop | None:
    """The picture behind all; None if there is none."""
    group = group_named(root, "backdrop")
    if group is None or len(group) == 0:
        return None
    art = arts.fragment(group)
    matrix = affine.compose(to_canvas, parse_transform(group.get("transform")))
    return Backdrop(PhotoArt(art, KeptOriginal(art)), matrix)


def notes_of(root: ET.Element, to_canvas: FloatArray) -> tuple[Note, ...]:
    """Labels on items and letters beside them."""
    found = []
    for name in ("labels", "legend"):
        group = group_named(root, name)
        for element in () if group is None else group:
            titles = [child.text or "" for child in element if tag(child) == "title"]
            path = next((one for one in element.iter() if tag(one) == "path"), None)
            if path is None:
                continue
            data, fill = path.get("d", ""), path.get("fill", "#000000")
            # Written as they are, so nothing else may stand in them.
            if not _PATH.fullmatch(data) or not known_colour(fill):
                raise UnfitError(f"has a {name[:5]} that is no path of one colour")
            place = affine.compose(to_canvas, parse_transform(path.get("transform")))
            found.append(Note(data, place, fill, "".join(titles), name == "labels"))
    return tuple(found)


def with_halos(root: ET.Element, layout: Layout) -> Layout:
    """The layout, its items with the rims that they have in a file, which draws them in order."""
    group = group_named(root, "halos")
    drawn = [] if group is None else [e for e in group if tag(e) == "path"]
    if not drawn:
        return layout
    items, inks = list(layout.items), layout.inks
    made: dict[tuple[Item, str], Item] = {}
    k = 0
    for path in drawn:
        middle = _middle(path.get("d", ""))
        while k < len(items) and not _is_near(middle, inks[k].bounds, layout.container.side):
            k += 1
        if k == len(items):
            break
        halo, item = path.get("fill", ""), items[k]
        if not known_colour(halo):
            raise UnfitError(f"has a halo of the colour {halo[:20]!r}")
        items[k] = made.setdefault((item, halo), replace(item, halo=halo))
        k += 1
    return replace(layout, items=tuple(items))


def _middle(data: str) -> FloatArray:
    """Middle of a path's box; no number of a path that draws nothing."""
    points = [piece.segments.reshape(-1, 2) for piece in parse_path(data)]
    drawn = np.concatenate([*points, np.zeros((0, 2))])
    if len(drawn) == 0:
        return np.full(2, np.inf)
    return np.asarray((drawn.min(axis=0) + drawn.max(axis=0)) / 2)


def _is_near(middle: FloatArray, bounds: Sequence[float], side: float) -> bool:
    left, top, right, bottom = bounds
    own = (left + right) / 2, (top + bottom) / 2
    return math.dist(middle, own) <= BESIDE * side
