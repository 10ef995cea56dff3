"""A second set, on which nothing was tuned: built-in and made-up containers, made-up items."""

from __future__ import annotations

import numpy as np
import shapely

from benchmarks.kit.frozen import SIDE
from packwork.arrays import FloatArray
from packwork.geometry.outline import Outline
from packwork.readers.container import read_container
from packwork.scene.container import Container
from packwork.scene.item import FlatArt, Item

COUNT = 60
BUILT_IN = ("bear", "guitar", "usa")


def containers() -> list[Container]:
    """Three built-in ones and a blob."""
    blob = Outline.from_rings([300 + 200 * _blob(np.random.default_rng(11), 400)])
    return [*map(read_container, BUILT_IN), Container("blob", "others", blob, SIDE, SIDE)]


def items() -> list[Item]:
    """Blobs, convex polygons and stars in turn, all different."""
    rng = np.random.default_rng(7)
    makers = (_blob, _convex, _star)
    return [_item(f"{makers[k % 3].__name__[1:]}-{k}", makers[k % 3](rng)) for k in range(COUNT)]


def _item(name: str, points: FloatArray) -> Item:
    polygon = shapely.Polygon(points)
    moved = shapely.affinity.translate(polygon, -polygon.centroid.x, -polygon.centroid.y)
    outline = Outline.from_region(moved)
    return Item(name, "others", outline, outline, FlatArt())


def _blob(rng: np.random.Generator, points: int = 80) -> FloatArray:
    """A closed curve of a few waves round a circle."""
    angle = np.linspace(0, 2 * np.pi, points, endpoint=False)
    radius = np.ones(points)
    for wave in range(2, 6):
        radius += rng.uniform(0, 0.3) / wave * np.cos(wave * angle + rng.uniform(0, 2 * np.pi))
    return _round(angle, radius)


def _convex(rng: np.random.Generator) -> FloatArray:
    """The hull of a few points, up to three times as long as wide."""
    cloud = rng.normal(size=(9, 2)) * [1.0, rng.uniform(0.33, 1.0)]
    return np.asarray(shapely.MultiPoint(cloud).convex_hull.exterior.coords)[:-1]


def _star(rng: np.random.Generator) -> FloatArray:
    """Three to seven points, deep or flat."""
    tips = int(rng.integers(3, 8))
    angle = np.linspace(0, 2 * np.pi, 2 * tips, endpoint=False)
    return _round(angle, np.tile([1.0, rng.uniform(0.4, 0.8)], tips))


def _round(angle: FloatArray, radius: FloatArray) -> FloatArray:
    return np.column_stack([radius * np.cos(angle), radius * np.sin(angle)])
