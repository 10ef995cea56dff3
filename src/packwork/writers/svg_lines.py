"""Nests as SVG: lines for a machine, in layers by what it does with them.

Layers are groups as Inkscape marks them, and each has a colour, by which programs for lasers and
plotters go. Every line stands in full, as long as that can be read again: many of them know no
``use``, and follow what is filled and what is not shown like all else.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from packwork.geometry import affine
from packwork.scene.item import FlatArt, Item, Label, PhotoArt
from packwork.scene.layout import Layout
from packwork.scene.line_art import CUT, CUT_COLOUR, ENGRAVE, ENGRAVED_COLOUR, LineArt
from packwork.scene.notation import (
    arc_path_data,
    attributes,
    finer_decimals,
    matrix_text,
    path_data,
    with_fresh_ids,
    xml_text,
)
from packwork.units import convert
from packwork.writers.promise import stated_weights
from packwork.writers.svg_symbols import item_ids, labelled

HAIRLINE_IN = 0.001
"""Width of all lines, inches: up to it drivers that print cut through, and do not engrave."""

NAMESPACE = ' xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape"'

MOST_IN_FULL = 10_000_000
"""Characters of all that is drawn beyond which lines to cut that are alike share one: half of what
is read. Chosen."""

SEEN = (
    "<style>@supports (vector-effect:non-scaling-stroke){@media screen{[data-lines=cut] path,"
    "path[data-lines],path[data-item]{vector-effect:non-scaling-stroke;stroke-width:1px}}}</style>"
)
"""Lets browsers show lines that are too thin to be seen. Inkscape, which would print them as wide,
knows no such conditions."""

EDGE_COLOUR, EDGE_SHARE = "#1a202c", 1e-3
"""Edges of parts in a picture: their width as a share of the sheet; thinner ones are faint."""


def edge_group(layout: Layout, digits: int) -> list[str]:
    """Edges of all items, for a picture."""
    width = f"{layout.container.side * EDGE_SHARE:.6g}"
    head = attributes({"fill": "none", "stroke": EDGE_COLOUR, "stroke-width": width})
    return [f"<g{head}>", *(f'<path d="{path_data(one, digits)}"/>' for one in layout.outlines),
            "</g>"]  # fmt: skip


def line_layers(
    layout: Layout, places: Sequence[tuple[str, int]], names: Sequence[str],
    promise: Mapping[str, str],
) -> list[str]:  # fmt: skip
    """Groups of what parts are painted with, of what is engraved, and on top of what is cut.

    Parameters
    ----------
    places
        Of each item its ``transform``, and digits after the point in its units.
    names
        What each is called.
    promise
        Attributes that say what was promised of all items.
    """
    ids, weights = item_ids(layout.items), stated_weights(layout)
    hair = convert(HAIRLINE_IN, "in", layout.container.unit)
    artwork, cut, engraved = list[str](), list[_CutPart](), defaultdict[str, list[str]](list)
    paths = dict[Item, str]()
    for k, (item, (place, digits)) in enumerate(zip(layout.items, places, strict=True)):
        art = item.art if isinstance(item.art, LineArt) else None
        matrix = affine.identity() if art is None else art.matrix
        digits += finer_decimals(matrix)
        scale = float(layout.poses.scale[k]) * abs(np.linalg.det(matrix[:, :2])) ** 0.5
        exactly = 17 if item.coarseness == 0.0 else 12
        within, width = "" if art is None else matrix_text(matrix, exactly), f"{hair / scale:.4g}"
        head = {"transform": place + within, "stroke-width": width}
        artwork += _painted(item, k + 1, ids[k], place)
        if item not in paths:
            arcs = "".join(arc_path_data(line, digits) for line in (art.cut if art else ()))
            paths[item] = path_data(item.ink, digits) if art is None else art.path or arcs
        own = {"id": ids[k], "data-name": names[k], "data-weight": weights[k]}
        cut.append(_CutPart(own, place, within, width, paths[item], item.label))
        marks = defaultdict[tuple[str, str], str](str)
        for line in () if art is None else art.engraved:
            marks[line.own_layer, line.own_colour] += arc_path_data(line, digits)
        for (layer, colour), path in marks.items():
            one = attributes({"data-item": ids[k], **head, "stroke": colour, "d": path})
            engraved[layer].append(f"<path{one}/>")
    layers = [_layer("artwork", "artwork", {}, artwork)] if artwork else []
    for number, (layer, drawn_lines) in enumerate(sorted(engraved.items()), start=1):
        stroke = {"fill": "none", "stroke": ENGRAVED_COLOUR}
        layers.append(_layer(f"{ENGRAVE}-{number}", layer, stroke, drawn_lines))
    stroke = {"fill": "none", "stroke": CUT_COLOUR, **promise}
    beside = sum(len(one) for drawn in (artwork, *engraved.values()) for one in drawn)
    is_in_full = beside + sum(len(one.path) for one in cut) <= MOST_IN_FULL
    shared, drawn = ([], [one.in_full for one in cut]) if is_in_full else _shared(cut)
    layers.append(_layer("items", CUT, stroke, drawn))
    return [SEEN, *shared, *(line for one in layers for line in one)]


@dataclass(frozen=True)
class _CutPart:
    """Attributes of a part, its place, the map of its drawing, width and path of its line."""

    own: Mapping[str, str]
    place: str
    within: str
    width: str
    path: str
    label: Label

    @property
    def in_full(self) -> str:
        drawn = self.drawn({**self.own, "transform": self.place + self.within})
        return labelled(drawn, self.label)

    def drawn(self, head: Mapping[str, str]) -> str:
        """Its line, with some attributes."""
        known = attributes({**head, "stroke-width": self.width})
        return f'<path{known} fill-rule="evenodd" d="{self.path}"/>'


def _shared(parts: Sequence[_CutPart]) -> tuple[list[str], list[str]]:
    """Definitions of lines, and of each part the one that it uses."""
    names, shapes, drawn = dict[tuple[str, ...], str](), list[str](), list[str]()
    for one in parts:
        key = (one.within, one.width, one.path)
        if key not in names:
            names[key] = f"shape-{len(names) + 1}"
            shapes.append(one.drawn(
                {"id": names[key], "data-lines": CUT, "transform": one.within}))  # fmt: skip
        head = {**one.own, "xlink:href": f"#{names[key]}", "transform": one.place}
        drawn.append(labelled(f"<use{attributes(head)}/>", one.label))
    return ["<defs>", *shapes, "</defs>"], drawn


def _layer(name: str, label: str, more: Mapping[str, str], drawn: list[str]) -> list[str]:
    kind = {"artwork": "artwork", "items": CUT}.get(name, ENGRAVE)
    head = attributes({"id": name, "data-lines": kind, **more})
    return [f"<g{head}{layer_attributes(label)}>", *drawn, "</g>"]


def layer_attributes(label: str) -> str:
    """Attributes by which Inkscape, and what goes by it, takes a group for a layer."""
    return f' inkscape:groupmode="layer" inkscape:label="{xml_text(label)}"'


def _painted(item: Item, number: int, name: str, place: str) -> list[str]:
    """Drawing painted on a part, beside its lines."""
    art = item.art.preview if isinstance(item.art, PhotoArt) else item.art
    if isinstance(art, FlatArt) or (isinstance(art, LineArt) and not art.is_painted):
        return []
    head = attributes({"data-item": name, "transform": place + matrix_text(art.matrix)})
    return [f"<g{head}>{with_fresh_ids(art.markup, f'-{number}')}</g>"]
