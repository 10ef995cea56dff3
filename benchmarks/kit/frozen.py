"""The frozen set: four containers by formula, the same 100 icons, seeds 0 to 2.

Every figure of this project that speaks of "the frozen set" comes from here. Do not
change it; add another set beside it.
"""

from __future__ import annotations

from itertools import cycle, islice

import numpy as np
import shapely

from packwork.geometry.outline import Outline
from packwork.geometry.simplify import simplified
from packwork.readers.builtin import builtin_item
from packwork.scene.container import Container
from packwork.scene.item import Item

SIDE = 600.0
COUNT = 100
ICONS = (
    "balloon", "bird", "boat", "bolt", "butterfly", "cactus", "carrot", "cat", "cherry", "donut",
    "fish", "flower", "guitar", "icecream", "key", "leaf", "moon", "mushroom", "pear", "ribbon",
    "rocket", "smile", "spiral", "sunburst", "teacup", "tree", "tulip", "twig", "umbrella",
    "valentine", "wave", "whale",
)  # fmt: skip
"""Named one by one: icons that are bundled later do not change the set."""

SEEDS = (0, 1, 2)


def round_container() -> Container:
    """A disc of radius 0.46 of the canvas."""
    disc = shapely.Point(300, 300).buffer(276, quad_segs=128)
    return Container("round", "frozen", Outline.from_region(disc), SIDE, SIDE)


def concave_container() -> Container:
    """A five-lobed flower: r = 205 + 75 cos 5 a, concave between its petals."""
    a = np.linspace(0, 2 * np.pi, 720, endpoint=False)
    r = 205 + 75 * np.cos(5 * a - np.pi / 2)
    points = np.column_stack([300 + r * np.cos(a), 300 + r * np.sin(a)])
    return Container("concave", "frozen", Outline.from_rings([points]), SIDE, SIDE)


def thin_container() -> Container:
    """A tube of width 80 along a sine wave of two and a half turns."""
    t = np.linspace(0, 1, 600)
    spine = np.column_stack([75 + 450 * t, 300 + 200 * np.sin(2.5 * 2 * np.pi * t + np.pi / 2)])
    tube = shapely.LineString(spine).buffer(40, quad_segs=64)
    return Container("thin", "frozen", Outline.from_region(tube), SIDE, SIDE)


def letter_container() -> Container:
    """A slab letter Z with strokes of 150."""
    points = [
        (40, 40), (560, 40), (560, 190), (270, 410), (560, 410), (560, 560),
        (40, 560), (40, 410), (330, 190), (40, 190),
    ]  # fmt: skip
    return Container("letter", "frozen", Outline.from_region(shapely.Polygon(points)), SIDE, SIDE)


CONTAINERS = (round_container, concave_container, thin_container, letter_container)


def items() -> list[Item]:
    """The 100 items: 32 bundled icons in the order of their names, in turn."""
    return list(islice(cycle(map(builtin_item, ICONS)), COUNT))


def outlines_of(edges: int) -> list[Outline]:
    """Outlines of the 100 items, simplified to about ``edges`` edges in all."""
    exact = [item.outline for item in items()]
    low, high = 1e-5, 1.0
    for _ in range(30):
        middle = (low * high) ** 0.5
        found = _simplified(exact, middle)
        if sum(len(o.points) for o in found) > edges:
            low = middle
        else:
            high = middle
    return _simplified(exact, high)


def _simplified(outlines: list[Outline], share: float) -> list[Outline]:
    known: dict[int, Outline] = {}
    for outline in outlines:
        if id(outline) not in known:
            known[id(outline)] = simplified(outline, share * outline.extent)
    return [known[id(outline)] for outline in outlines]
