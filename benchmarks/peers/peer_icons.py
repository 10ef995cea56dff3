"""Equal items in a rectangle, against a nesting program.

The 100 icons of the frozen set, equal in area, any rotation. ``spyrrow`` packs them into a
strip as short as it can; Packwork then fills a rectangle of the proportions that came out,
sizes ``shared``. Both have the same time by the clock.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import shapely

from benchmarks.kit import frozen
from benchmarks.kit.manifests import Manifest
from benchmarks.peers.peering import RUNS, entry, missing, version
from packwork import precompile, uses
from packwork.geometry import affine
from packwork.geometry.outline import Outline
from packwork.geometry.simplify import hull
from packwork.metrics.exact import ExactMetrics, exact_metrics
from packwork.recipe import make_recipe
from packwork.scene.container import Container
from packwork.scene.item import FlatArt, Item

SECONDS = 15
"""By the clock for each layout."""

EDGES = 6_000
AREA = 100.0
"""Of each item, squared units."""

STRIP = 120.0
"""Height of the strip: about a square at the densities that come out."""

STEPS: dict[str, list[float] | None] = {
    "any": None,
    "every 5°": [5.0 * k for k in range(72)],
}
"""Angles that the peer may use."""


@dataclass(frozen=True)
class Result:
    """One layout, and what it took."""

    density: float
    exact: ExactMetrics
    clock: float
    processor: float


def outlines() -> list[Outline]:
    """The 100 icons, one ring each, all of one area."""
    whole = [o if len(o.rings) == 1 else hull(o) for o in frozen.outlines_of(EDGES)]
    return [o.mapped(affine.similarity(0.0, 0.0, 0.0, (AREA / o.area) ** 0.5)) for o in whole]


def timed(call: Callable[[], Any]) -> tuple[Any, float, float]:
    """What a call gives, its seconds by the clock and of the processor."""
    clock, processor = time.perf_counter(), time.process_time()
    given = call()
    return given, time.perf_counter() - clock, time.process_time() - processor


def measured(
    placed: Sequence[Outline], rectangle: Outline, clock: float, processor: float
) -> Result:
    """Judge outlines in place, lengths in units of a canvas of 600."""
    _, _, right, bottom = rectangle.bounds
    to_canvas = affine.similarity(0.0, 0.0, 0.0, frozen.SIDE / max(right, bottom))
    exact = exact_metrics([one.mapped(to_canvas) for one in placed], rectangle.mapped(to_canvas))
    density = sum(one.area for one in placed) / rectangle.area
    return Result(density, exact, clock, processor)


def peer(
    own: Sequence[Outline], angles: list[float] | None, seed: int, seconds: int
) -> tuple[Result, float]:
    """The peer's strip, and how long it is."""
    import spyrrow

    items = [
        spyrrow.Item(str(k), list(map(tuple, outline.points.tolist())), 1, angles)
        for k, outline in enumerate(own)
    ]
    strip = spyrrow.StripPackingInstance("icons", strip_height=STRIP, items=items)
    config = spyrrow.StripPackingConfig(
        early_termination=False, total_computation_time=seconds, num_workers=1, seed=seed
    )
    found, clock, processor = timed(lambda: strip.solve(config))
    placed = [
        own[int(one.id)].mapped(
            affine.similarity(*one.translation, float(np.radians(one.rotation)), 1.0)
        )
        for one in found.placed_items
    ]
    return measured(placed, _rectangle(found.width), clock, processor), found.width


def ours(own: Sequence[Outline], length: float, seed: int, seconds: int) -> Result:
    """The same rectangle, filled."""
    rectangle = _rectangle(length)
    container = Container("rectangle", "peers", rectangle, length, STRIP)
    items = [Item(str(k), "peers", outline, outline, FlatArt()) for k, outline in enumerate(own)]
    recipe = make_recipe(
        container="rectangle", items=["-"], sizes="shared", effort="best", time=seconds, seed=seed
    )
    run, clock, processor = timed(lambda: uses.fill(recipe, items, container))
    return measured(run.layout.outlines, rectangle, clock, processor)


def _rectangle(length: float) -> Outline:
    return Outline.from_region(shapely.box(0.0, 0.0, length, STRIP))


def measure(seconds: int = SECONDS, seeds: int = RUNS) -> list[Manifest]:
    """The peer for each choice of angles, in turn with ours, so that a drift hits both."""
    known, own = version("spyrrow"), outlines()
    if known is None:
        return [missing("spyrrow", "pip install packwork[bench]")]
    theirs: dict[str, list[Result]] = {name: [] for name in STEPS}
    mine = []
    precompile.warm_up()
    for seed in range(seeds):
        lengths = []
        for name, angles in STEPS.items():
            result, length = peer(own, angles, seed, seconds)
            theirs[name].append(result)
            lengths.append(length)
        mine.append(ours(own, min(lengths), seed, seconds))
        print(seed, *(f"{some[-1].density:.4f}" for some in (*theirs.values(), mine)), flush=True)
    found = [_entry("spyrrow", known, name, results) for name, results in theirs.items()]
    return [*found, _entry("packwork", str(version("packwork")), "any", mine)]


def _entry(program: str, known: str, task: str, results: Sequence[Result]) -> Manifest:
    figures = {
        "density": [result.density for result in results],
        "overlap": [result.exact.overlap for result in results],
        "outside": [result.exact.exceeding for result in results],
        "gap": [result.exact.min_gap for result in results],
        "clock": [result.clock for result in results],
    }
    seconds = [result.processor for result in results]
    return entry(program, known, task, frozen.COUNT, seconds, figures)
