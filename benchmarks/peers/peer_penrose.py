"""Items of given sizes in a disc, none over another: Penrose's optimisation of constraints.

Penrose keeps n shapes apart by n (n - 1) / 2 constraints, of polygons by their Minkowski
differences. Ours renders them all into one image.
"""

from __future__ import annotations

import time
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
import shapely

from benchmarks.kit import frozen, node
from benchmarks.kit.circles import RADIUS, circle
from benchmarks.kit.manifests import Manifest
from benchmarks.peers.peering import entry, missing, repeated, timed_out, version
from packwork import precompile, uses
from packwork.arrays import FloatArray
from packwork.geometry.outline import Outline
from packwork.recipe import make_recipe
from packwork.scene.container import Container
from packwork.scene.item import FlatArt, Item

SHARE = 0.6
"""Of the disc that the items cover: loose, so that every program can keep them apart."""

COUNTS = {"circles": (10, 20, 40, 80, 160, 320), "polygons": (5, 10, 20, 40, 100)}
OURS = (5, 10, 20, 40, 80, 100, 160, 320)
CORNERS = 8
LIMIT = 60
"""Seconds of the processor for one run of the peer."""


def rings_of(task: str, count: int) -> list[FloatArray]:
    """Convex rings round the origin, each of the area of a circle of ``RADIUS``."""
    if task == "circles":
        return [circle(k, RADIUS).outline.points for k in range(count)]
    known = [_octagon(item.outline) for item in frozen.items()[: len(frozen.ICONS)]]
    return [known[k % len(known)] for k in range(count)]


def _octagon(outline: Outline) -> FloatArray:
    """Convex hull, as far as it goes in eight directions."""
    points = shapely.get_coordinates(outline.region.convex_hull)
    turns = 2 * np.pi * np.arange(CORNERS) / CORNERS
    extreme = points[np.argmax(points @ np.array([np.cos(turns), np.sin(turns)]), axis=0)]
    hull = shapely.MultiPoint(extreme).convex_hull
    ring = shapely.get_coordinates(hull.exterior)[:-1] - shapely.get_coordinates(hull.centroid)
    return np.asarray(ring * np.sqrt(np.pi * RADIUS**2 / hull.area))


def measure(
    counts: dict[str, Sequence[int]] | None = None, ours: Sequence[int] = OURS
) -> list[Manifest]:
    """Both tasks, more and more items, until one is too many."""
    known = node.version("@penrose/core")
    found = [] if known else [missing("Penrose", "packwork bench peers install")]
    precompile.warm_up()
    for task, some in (counts or COUNTS).items():
        found += [_ours(task, count) for count in ours]
        if known:
            found += _until_late(task, known, some)
    return found


def _until_late(task: str, known: str, counts: Sequence[int]) -> Iterator[Manifest]:
    """One entry a count; the first that comes to no end is the last."""
    for count in counts:
        try:
            found, seconds = repeated(lambda seed, n=count: _penrose(task, n, seed))
        except TimeoutError:
            yield timed_out("Penrose", known, task, count, LIMIT)
            return
        yield entry("Penrose", known, task, count, seconds, _figures(found))


def _room(rings: Sequence[FloatArray]) -> float:
    """Radius of the disc."""
    return float(np.sqrt(len(rings) * RADIUS**2 / SHARE)) if len(rings) else 0.0


def _penrose(task: str, count: int, seed: int) -> tuple[dict[str, float], float]:
    rings = rings_of(task, count)
    data: dict[str, Any] = {"room": _room(rings), "seed": seed}
    if task == "circles":
        data["radii"] = [RADIUS] * count
    else:
        data["rings"] = [ring.tolist() for ring in rings]
    done = node.run("penrose.mjs", data, LIMIT)
    placed = [ring + place for ring, place in zip(rings, done["places"], strict=True)]
    return _faults(placed, _room(rings)), done["seconds"][0]


def _ours(task: str, count: int) -> Manifest:
    def call(seed: int) -> tuple[dict[str, float], float]:
        rings = rings_of(task, count)
        room = _room(rings)
        disc = Outline.from_region(shapely.Point(room, room).buffer(room, quad_segs=128))
        outlines = [Outline.from_region(shapely.Polygon(ring)) for ring in rings]
        items = [Item(str(k), "peers", one, one, FlatArt()) for k, one in enumerate(outlines)]
        recipe = make_recipe(container="disc", items=["-"], sizes="fixed", rotate="none", seed=seed)
        container = Container("disc", "peers", disc, 2 * room, 2 * room)
        began = time.process_time()
        run = uses.fill(recipe, items, container)
        seconds = time.process_time() - began
        placed = [outline.points - room for outline in run.layout.outlines]
        return _faults(placed, room), seconds

    found, seconds = repeated(call)
    return entry("packwork", str(version("packwork")), task, count, seconds, _figures(found))


def _faults(placed: Sequence[FloatArray], room: float) -> dict[str, float]:
    """What overlaps and what sticks out, shares of the disc."""
    shapes = shapely.polygons([shapely.linearrings(ring) for ring in placed])
    disc = shapely.Point(0.0, 0.0).buffer(room, quad_segs=512)
    covered = shapely.union_all(shapes)
    total = float(shapely.area(shapes).sum())
    return {
        "overlap": max(0.0, total - covered.area) / disc.area,
        "outside": covered.difference(disc).area / disc.area,
    }


def _figures(found: Sequence[dict[str, float]]) -> dict[str, list[float]]:
    return {key: [one[key] for one in found] for key in found[0]}
