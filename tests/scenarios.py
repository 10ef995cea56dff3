"""Whole runs as people might ask for them, the awkward ones before all."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import shapely
from hypothesis import strategies as st

from packwork.geometry import affine
from packwork.geometry.outline import Outline
from packwork.geometry.polygon import Region, polygon_parts
from packwork.scene.container import Container
from packwork.scene.item import Item
from scenes import flat_item
from strategies import SEEDS

Choose = Callable[[Sequence[Any]], Any]
"""One of several, by hypothesis or by a generator."""

UNIT_SIDE = 100.0
"""Canvas that shapes are made for; they are scaled to the scenario's afterwards."""


@dataclass(frozen=True)
class Scenario:
    """What a run is asked to do.

    Parameters
    ----------
    container, items
        In place of files.
    options
        The recipe's.
    """

    container: Container
    items: tuple[Item, ...]
    options: dict[str, Any]

    def __repr__(self) -> str:
        names = [item.name for item in self.items]
        return f"<Scenario: {names} in {self.container.name}, {self.options}>"


def _blob(rng: np.random.Generator, inner: float = 0.3) -> Region:
    count = int(rng.integers(3, 14))
    turns = 2 * np.pi * (np.arange(count) + rng.uniform(0, 0.4, count)) / count
    spokes = rng.uniform(inner, 1.0, count)[:, None]
    return shapely.Polygon(spokes * np.column_stack([np.cos(turns), np.sin(turns)]))


def _comb(rng: np.random.Generator) -> Region:
    teeth = int(rng.integers(2, 6))
    gaps = [shapely.box(k + 0.4, 0.5, k + rng.uniform(0.6, 1.0), 4) for k in range(teeth)]
    return shapely.difference(shapely.box(0, 0, teeth + 0.4, 4), shapely.union_all(gaps))


def _ring(rng: np.random.Generator) -> Region:
    return shapely.difference(_blob(rng, 0.8), shapely.Point(0, 0).buffer(rng.uniform(0.1, 0.35)))


def _nearly_touching(rng: np.random.Generator) -> Region:
    """A hole and a second part, each a millionth or less from the outer ring."""
    hair = 10 ** rng.uniform(-9, -6)
    holed = shapely.difference(shapely.box(0, 0, 4, 4), shapely.box(hair, 1, 3, 3))
    return shapely.union_all([holed, shapely.box(4 + hair, 0, 5, 4)])


def _parts(rng: np.random.Generator) -> Region:
    return shapely.MultiPolygon(
        [affine_region(_blob(rng), rng.uniform(0.5, 1.0), 3.0 * k, 0.0) for k in range(3)]
    )


def _island(rng: np.random.Generator) -> Region:
    inner = affine_region(_blob(rng, 0.5), 0.3, 0.0, 0.0)
    frame = shapely.difference(shapely.box(-1, -1, 1, 1), shapely.box(-0.8, -0.8, 0.8, 0.8))
    return shapely.union_all([frame, inner])


def _sliver(rng: np.random.Generator) -> Region:
    return shapely.box(0, 0, 1, 10 ** rng.uniform(-4, -2))


def _spike(rng: np.random.Generator) -> Region:
    return shapely.Polygon([[0, 0], [1, 0], [1, 1], [0.5, rng.uniform(5, 50)], [0.49, 1], [0, 1]])


def _curve(rng: np.random.Generator) -> Region:
    """A thin stroke of many points, as drawn by hand."""
    t = np.linspace(0, 1, 40)
    y = np.sin(rng.uniform(2, 9) * t + rng.uniform(0, 6))
    return shapely.LineString(np.column_stack([4 * t, y])).buffer(rng.uniform(0.03, 0.3), 8)


def _disc(_: np.random.Generator) -> Region:
    return shapely.Point(0, 0).buffer(1.0, 32)


def _square(_: np.random.Generator) -> Region:
    return shapely.box(0, 0, 1, 1)


SHAPES = {
    "square": _square, "disc": _disc, "blob": _blob, "comb": _comb, "ring": _ring,
    "nearly touching": _nearly_touching, "parts": _parts, "island": _island, "sliver": _sliver,
    "spike": _spike, "curve": _curve,
}  # fmt: skip


def _room(low: float, high: float) -> Region:
    return shapely.box(low, low, high, high)


ROOMS: dict[str, Callable[[np.random.Generator], Region]] = {
    "square": lambda _: _room(5, 95),
    "disc": lambda _: shapely.Point(50, 50).buffer(45, 32),
    "blob": lambda rng: affine_region(_blob(rng), 48, 50, 50),
    "comb": lambda rng: affine_region(_comb(rng), 15, 10, 20),
    "ring": lambda rng: affine_region(_ring(rng), 45, 50, 50),
    "parts": lambda rng: affine_region(_parts(rng), 12, 15, 50),
    "island": lambda rng: affine_region(_island(rng), 45, 50, 50),
    "thin": lambda rng: shapely.box(2, 50, 98, 50 + rng.uniform(0.5, 6)),
    "curve": lambda rng: affine_region(_curve(rng), 22, 6, 50),
    "triangle": lambda _: shapely.Polygon([[5, 5], [95, 50], [5, 90]]),
    "dust": lambda _: shapely.union_all([_room(5, 80), _room(90, 90.1)]),
}  # fmt: skip


def affine_region(region: Region, scale: float, x: float, y: float) -> Region:
    """Region scaled about the origin and moved."""
    return shapely.transform(region, lambda points: scale * points + (x, y))


def _outline(region: Region, extent: float) -> Outline:
    """Outline about its centroid, its longer side given."""
    rough = Outline.from_region(shapely.union_all(polygon_parts(shapely.make_valid(region))))
    x, y = rough.centroid
    scale = extent / rough.extent
    return rough.mapped(affine.similarity(-scale * x, -scale * y, 0.0, scale))


def _container(name: str, rng: np.random.Generator, side: float) -> Container:
    region = affine_region(ROOMS[name](rng), side / UNIT_SIDE, 0.0, 0.0)
    return Container(name, name, Outline.from_region(region), side, side)


def _options(choose: Choose, side: float) -> dict[str, Any]:
    sizes = choose(("free", "shared", "fixed"))
    options: dict[str, Any] = {
        "sizes": sizes,
        "count": choose((1, 2, 3, 5, 8, 13, 30)),
        "rotate": choose(("free", "none", "20", "0,90")),
        "padding": choose((0.0, 0.0, 0.005 * side, 0.03 * side)),
        "effort": choose(("draft", "normal")),
        "epochs": choose((1, 20, 40)),
        "levels": choose(("32", "24,48")),
        "stretch": choose((1.0, 1.0, 1.3)),
        "start": choose(("distance-field", "auto", "scatter")),
        "time": choose((None, None, None, 0.01, 0.2)),
    }
    if sizes == "free" and choose((False, False, True)):
        options["max_items"] = options["count"] + choose((1, 12))
        options["target_coverage"] = choose((None, 0.5, 0.97))
    return options


def scenario(choose: Choose, rng: np.random.Generator) -> Scenario:
    """One of them all."""
    side = choose((600.0, 100.0, 0.01, 1e5))
    sorts = [choose(tuple(SHAPES)) for _ in range(choose((1, 1, 2, 4)))]
    options = _options(choose, side)
    # Where sizes stay as they are in the files, mostly as large as all may find room.
    share = choose((0.4, 0.05, 1.2)) / np.sqrt(options["count"])
    extent = share * side if options["sizes"] == "fixed" else choose((1.0, 30.0, 0.01, 1e4))
    items = [
        flat_item(f"{sort} {k}", _outline(SHAPES[sort](rng), extent))
        for k, sort in enumerate(sorts)
    ]
    return Scenario(_container(choose(tuple(ROOMS)), rng, side), tuple(items), options)


def any_scenario() -> st.SearchStrategy[Scenario]:
    """Scenarios by hypothesis, which makes failing ones simpler."""

    @st.composite
    def drawn(draw: st.DrawFn) -> Scenario:
        rng = np.random.default_rng(draw(SEEDS))
        return scenario(lambda options: draw(st.sampled_from(options)), rng)

    return drawn()
