"""Circles to be packed round each other, and how dense they lie; what benchmarks share."""

from __future__ import annotations

import time
from collections.abc import Callable

import numpy as np
import shapely

import packwork as pw
from packwork.arrays import FloatArray
from packwork.geometry.outline import Outline
from packwork.scene.item import FlatArt, Item

CORNERS = 256
"""Of the polygon that stands for a circle: its corners lie on it."""

SPREAD = 0.5
"""Of the logarithms of the mixed radii."""

RADIUS = 10.0


def lognormal(seed: int, count: int) -> FloatArray:
    draws = np.random.default_rng(seed).normal(0, SPREAD, count)
    return np.asarray(RADIUS * np.exp(draws))


def equal(seed: int, count: int) -> FloatArray:
    del seed
    return np.full(count, RADIUS)


RADII: dict[str, Callable[[int, int], FloatArray]] = {"lognormal": lognormal, "equal": equal}
"""Radii by seed and count."""


def circle(k: int, radius: float) -> Item:
    turns = 2 * np.pi * np.arange(CORNERS) / CORNERS
    points = radius * np.column_stack([np.cos(turns), np.sin(turns)])
    outline = Outline.from_rings([points])
    return Item(f"c{k}", f"c{k}", outline, outline, FlatArt())


def packed(radii: FloatArray, seed: int) -> tuple[FloatArray, float]:
    """Our pack, ``(n, 3)`` of x, y, radius, and the processor's seconds."""
    items = [circle(k, radius) for k, radius in enumerate(radii)]
    began = time.process_time()
    layout = pw.pile("none", items, rotate="none", compact=True, seed=seed)
    seconds = time.process_time() - began
    own = [item.outline.radius for item in layout.items] * layout.poses.scale
    return np.column_stack([layout.poses.x, layout.poses.y, own]), seconds


def front_chain(radii: FloatArray) -> FloatArray:
    """What ``packcircles`` makes of them."""
    import packcircles

    return np.array(list(packcircles.pack(radii.tolist())))


def density(circles: FloatArray) -> float:
    """Area of circles over that of the smallest circle that holds them all."""
    turns = 2 * np.pi * np.arange(720) / 720
    rims = np.stack([np.cos(turns), np.sin(turns)], axis=1)
    radii = circles[:, 2]
    points = (circles[:, None, :2] + radii[:, None, None] * rims).reshape(-1, 2)
    whole = shapely.minimum_bounding_radius(shapely.MultiPoint(points))
    return float((radii**2).sum() / whole**2)


def deepest(circles: FloatArray) -> float:
    """How deep two of them lie in each other at most, in the smaller one's radii."""
    tree = shapely.STRtree(shapely.points(circles[:, :2]).tolist())
    reach = 2 * float(circles[:, 2].max())
    first, second = tree.query(tree.geometries, predicate="dwithin", distance=reach)
    first, second = first[first < second], second[first < second]
    apart = np.hypot(*(circles[first, :2] - circles[second, :2]).T)
    deep = circles[first, 2] + circles[second, 2] - apart
    smaller = np.minimum(circles[first, 2], circles[second, 2])
    return float(np.max(deep / smaller, initial=0.0))
