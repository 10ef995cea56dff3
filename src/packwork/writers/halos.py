"""Items that contrast too little with the background: which, better backgrounds, and halos."""

from __future__ import annotations

import functools
import hashlib
import io
from collections.abc import Hashable, Sequence
from dataclasses import replace
from importlib.metadata import version
from typing import TypeAlias

import numpy as np
import numpy.typing as npt
from PIL import Image

from packwork.arrays import BoolArray, FloatArray, IntArray
from packwork.fields.morphology import eroded
from packwork.folders import Store
from packwork.phrasing import enumerated, number_of
from packwork.scene.colour import hex_colour, parse_colour
from packwork.scene.contrast import light_of, oklabs_of_light
from packwork.scene.item import FlatArt, Item, PhotoArt, VectorArt
from packwork.scene.layout import Layout
from packwork.scene.swatch import small_png
from packwork.writers.options import HaloChoice
from packwork.writers.svg_symbols import shape_key

PAPER = "#ffffff"
"""What a clear background is taken for."""

ALIKE = 0.115
"""Difference of two colours (Oklab) below which one is hardly seen on the other. Larger blames
pale yellow on white, smaller passes a grey ghost, and navy lines on black. By eye, of emoji."""

FLARE = 0.02
"""Light of the room on the screen, of its white's: by it near blacks are alike, which Oklab alone
tells apart. Larger calls black on slate faint (the 0.05 of WCAG 2), smaller passes black on
``#222222``. By eye."""

MOST_ALIKE = 0.5
"""Share of an item's edge that may be so before the whole is hard to see. Chosen by eye."""

EDGE_PX = 2
"""Width of what counts as the edge in the small picture that is looked at. Chosen."""

MOST_DRAWINGS = 300
"""Different drawings that are looked at, the largest first: each takes some milliseconds."""

GROUNDS = ("#ffffff", "#f4ecd8", "#f0cf95", "#c99a6b", "#2f3e55", "#12181f")
"""Backgrounds that may be proposed, from light to dark. Chosen by eye."""

RIMS = ("#5f6b7a", "#f4f1ea")
"""Colours of halos: that which differs more from the background is taken. Chosen by eye."""

_SOLID = 128

FORM = 1
"""Number of the way in which edges are looked at; a new one forgets all."""

ByteArray: TypeAlias = npt.NDArray[np.uint8]

STORE = Store("edges", 20_000_000)
"""Colours of the edges of drawings that were looked at before, by what is drawn: some 2 kB each."""


def faint_items(layout: Layout, background: str | None) -> tuple[Item, ...]:
    """Items of a layout, each drawing once, whose edges are like the background.

    Words are made to be read anyway, photographs are as they are, and where a picture is behind it
    decides: none of these is looked at.
    """
    if layout.container.backdrop is not None:
        return ()
    ground = _ground(background)
    return tuple(one for one, edge in _edges(layout) if _is_faint(edge, ground))


def haloed(layout: Layout, choice: HaloChoice, background: str | None) -> Layout:
    """Layout whose items have halos as chosen; those that they have stay."""
    if choice == "none" or layout.container.backdrop is not None:
        return layout
    faint = {_look(item) for item in faint_items(layout, background)}
    ground = _ground(background)
    rim = max(RIMS, key=lambda colour: float(np.linalg.norm(_ground(colour) - ground)))
    items = tuple(
        replace(item, halo=item.halo or rim) if choice == "all" or _look(item) in faint else item
        for item in layout.items
    )
    return replace(layout, items=items)


def faint_message(layout: Layout, background: str | None) -> str:
    """One sentence that names items hard to see, and what would do; empty if there are none."""
    faint = faint_items(layout, background)
    if not faint:
        return ""
    keys = {_look(item) for item in faint}
    count = sum(_look(item) in keys for item in layout.items)
    shown = enumerated(list(dict.fromkeys(item.name for item in faint)))
    ground = "white" if background is None else background
    better = _better_ground(layout, background)
    instead = "" if better is None else f"--background '{better}' or "
    many = number_of(count, "item is", "items are")
    return f"{many} hardly to be seen on {ground} ({shown}); {instead}--halo faint would show them"


def _better_ground(layout: Layout, background: str | None) -> str | None:
    """The nearest background on which nothing is hard to see, if there is one."""
    own = _ground(background)
    edges = [edge for _, edge in _edges(layout)]
    for colour in sorted(GROUNDS, key=lambda c: abs(float(_ground(c)[0] - own[0]))):
        if not any(_is_faint(edge, _ground(colour)) for edge in edges):
            return colour
    return None


def _edges(layout: Layout) -> list[tuple[Item, FloatArray]]:
    """Each drawing once, the largest first, with the colours of its edge (Oklab)."""
    found: dict[tuple[Hashable, str], Item] = {}
    order = np.argsort(-layout.areas, kind="stable")
    for item in (layout.items[k] for k in order):
        if item.text is None and not isinstance(item.art, PhotoArt) and not item.halo:
            found.setdefault(_look(item), item)
    looked = list(found.values())[:MOST_DRAWINGS]
    edges = [(item, _edge(item)) for item in looked]
    return [(item, edge) for item, edge in edges if len(edge)]


def _look(item: Item) -> tuple[Hashable, str]:
    """Same for items that are drawn alike, in one colour."""
    return shape_key(item), item.art.fill if isinstance(item.art, FlatArt) else ""


def _edge(item: Item) -> FloatArray:
    """``(n, 3)`` colours along an item's edge, as seen; none if they cannot be told."""
    if isinstance(item.art, FlatArt):
        red, green, blue, opacity = parse_colour("fill", item.art.fill)
        return _seen(np.array([[red, green, blue]]))[: 1 if opacity >= _SOLID else 0]
    key = _edge_key(item.art, item.ink.bounds) if isinstance(item.art, VectorArt) else None
    kept = None if key is None else STORE.get(key)
    edge = _looked_at(item) if kept is None else np.frombuffer(kept, np.uint8).reshape(-1, 3)
    if key is not None and kept is None:
        STORE.put(key, edge.tobytes())
    return _seen(edge)


def _seen(rgb: ByteArray | IntArray) -> FloatArray:
    """``(n, 3)`` colours, 0 to 255, as they are seen in a room with light (Oklab)."""
    return oklabs_of_light((light_of(rgb / 255) + FLARE) / (1.0 + FLARE))


def _looked_at(item: Item) -> ByteArray:
    """``(n, 3)`` colours of the edge of a small picture, 0 to 255; none without one."""
    png = small_png(item)
    if png is None:
        return np.zeros((0, 3), np.uint8)
    with Image.open(io.BytesIO(png)) as picture:
        pixels = np.asarray(picture.convert("RGBA"))
    solid: BoolArray = np.pad(pixels[..., 3] >= _SOLID, 1)
    inner = eroded(solid, EDGE_PX)
    return np.asarray(pixels[(solid & ~inner)[1:-1, 1:-1]][:, :3])


def _edge_key(art: VectorArt, bounds: tuple[float, float, float, float]) -> str:
    """All that the colours of a drawing's edge depend on."""
    drawn = repr((art.markup, np.asarray(art.matrix).tolist(), bounds))
    how = FORM, *_versions(), _SOLID, EDGE_PX
    return f"{how!r} {hashlib.sha256(drawn.encode()).hexdigest()}"


@functools.cache
def _versions() -> tuple[str, str]:
    """Of what draws the small picture."""
    return version("packwork"), version("resvg_py")


def _is_faint(edge: Sequence[FloatArray] | FloatArray, ground: FloatArray) -> bool:
    away = np.linalg.norm(np.asarray(edge) - ground, axis=1)
    return bool((away < ALIKE).mean() > MOST_ALIKE)


def _ground(background: str | None) -> FloatArray:
    red, green, blue, opacity = parse_colour("background", background or PAPER)
    solid = hex_colour((red, green, blue)) if opacity >= _SOLID else PAPER
    channels = parse_colour("background", solid)[:3]
    return np.asarray(_seen(np.array([channels]))[0])
