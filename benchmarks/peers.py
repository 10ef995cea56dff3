"""Equal items in a rectangle, against a nesting program: ``packwork bench peers [WORD...]``.

The 100 icons of the frozen set, equal in area, any rotation. ``spyrrow`` packs them into a
strip as short as it can; Packwork then fills a rectangle of the proportions that came out,
sizes ``shared``. Both have the same time. ``short`` takes one seed and only prints;
``seconds=15`` measures for that time alone. Needs ``pip install packwork[bench]``.
"""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from importlib import metadata
from typing import Any

os.environ.setdefault("OMP_NUM_THREADS", "1")

import numpy as np
import shapely

import frozen
from manifests import write_page
from measuring import machine, markdown_table, ranged
from packwork import pipeline
from packwork.geometry import affine
from packwork.geometry.outline import Outline
from packwork.geometry.simplify import hull
from packwork.metrics.exact import ExactMetrics, exact_metrics
from packwork.recipe import make_recipe
from packwork.scene.container import Container
from packwork.scene.item import FlatArt, Item

BUDGETS = {15: 5, 60: 1}
"""Seconds by the clock for each layout, and how many seeds."""

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

HEADER = ["program", "turns", "density", "overlap", "outside", "least gap", "s of a clock", "s"]

PAGE = """# Peers

Made by `packwork bench {words}` on {date}.
{machine}; spyrrow {spyrrow}.

The frozen set's 100 icons, {edges} edges in all, each scaled to the same area; one icon of
several parts is taken as its hull, for both. spyrrow (the heuristic sparrow, for nesting, as a
Python package) packs them into a strip of height {strip} as short as it can, with one
thread and for a time by the clock; sizes are given, the length of the strip is what it seeks.
Packwork fills the shorter of the rectangles that the peer needed, in the same time, with turns of
any angle (`sizes = "shared"`, `effort = "best"`, `time`): the rectangle is given, the common
size is what it seeks. So each does what it was made for, and density, the items' area over the
rectangle's, says the same of both. All is measured by polygons: overlap and what sticks out as
shares of the rectangle, the least gap in canvas units of 600. Medians of the seeds, least and
most in brackets; overlap and outside are the worst, the gap is the least of all. Both are given
the time of the heading; what they took by the clock is in the table, and last what they had of
the processor, on a machine that others use too.

{tables}
"""


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
    run, clock, processor = timed(lambda: pipeline.fill(recipe, items, container))
    return measured(run.layout.outlines, rectangle, clock, processor)


def _rectangle(length: float) -> Outline:
    return Outline.from_region(shapely.box(0.0, 0.0, length, STRIP))


def row(program: str, turns: str, results: Sequence[Result]) -> list[str]:
    """A line of the table."""
    return [
        program,
        turns,
        ranged([result.density for result in results], ".3f"),
        f"{max(result.exact.overlap for result in results):.1e}",
        f"{max(result.exact.exceeding for result in results):.1e}",
        f"{min(result.exact.min_gap for result in results):.2g}",
        f"{np.median([result.clock for result in results]):.1f}",
        f"{np.median([result.processor for result in results]):.1f}",
    ]


def rows(seeds: Sequence[int], seconds: int) -> list[list[str]]:
    """The peer for each choice of angles, in turn with ours, so that a drift hits both."""
    own = outlines()
    theirs: dict[str, list[Result]] = {name: [] for name in STEPS}
    mine = []
    for seed in seeds:
        lengths = []
        for name, angles in STEPS.items():
            result, length = peer(own, angles, seed, seconds)
            theirs[name].append(result)
            lengths.append(length)
        mine.append(ours(own, min(lengths), seed, seconds))
        print(seed, *(f"{some[-1].density:.4f}" for some in (*theirs.values(), mine)), flush=True)
    return [
        *(row("spyrrow", name, results) for name, results in theirs.items()),
        row("packwork", "any", mine),
    ]


def budgets(words: Sequence[str]) -> dict[int, int]:
    """Seconds and seeds that are asked for."""
    given = [int(word.split("=")[1]) for word in words if word.startswith("seconds=")]
    chosen = {seconds: BUDGETS.get(seconds, 1) for seconds in given or BUDGETS}
    return dict.fromkeys(given or [min(BUDGETS)], 1) if "short" in words else chosen


def main(words: list[str]) -> None:
    """Measure, print, write docs/benchmarks-peers.md."""
    try:
        version = metadata.version("spyrrow")
    except metadata.PackageNotFoundError:
        sys.exit("packwork: bench peers: spyrrow is not there; pip install packwork[bench]")
    print(machine(), flush=True)
    pipeline.warm_up()
    tables = []
    for seconds, count in budgets(words).items():
        table = markdown_table(HEADER, rows(range(count), seconds))
        tables.append(f"## {seconds} s, seeds: {count}\n\n{table}\n")
        print(tables[-1], flush=True)
        if "short" not in words:
            # After each table: what a stopped run has measured is not lost.
            write_page(
                "benchmarks-peers.md", PAGE, words=" ".join(["peers", *words]), spyrrow=version,
                edges=f"{EDGES:,}", strip=f"{STRIP:g}", tables="\n".join(tables),
            )  # fmt: skip


if __name__ == "__main__":
    main(sys.argv[1:])
