"""How evenly the parts of one container fill: ``packwork bench parts [short]``.

A word of eight letters, each a part; exact coverage of every part. Prints the table and
writes it to docs/benchmarks/parts.md. ``short`` takes one seed in place of eight, and only
prints.
"""

from __future__ import annotations

import os
import sys
from dataclasses import dataclass

os.environ.setdefault("OMP_NUM_THREADS", "1")

import numpy as np
import shapely

from benchmarks.kit.manifests import write_page
from benchmarks.kit.measuring import machine, markdown_table, ranged
from benchmarks.kit.runs import timed_fill
from packwork import precompile
from packwork.arrays import FloatArray
from packwork.geometry.outline import Outline
from packwork.metrics.exact import exact_coverage
from packwork.recipe import make_recipe
from packwork.scene.layout import Layout

WORD = "SIGGRAPH"
SEEDS = tuple(range(8))
COUNTS = (200, 400)
COARSE = {"levels": "50:9,200:23,600:68"}
WAYS: dict[str, dict[str, str]] = {
    "levels to 600 px, no finish": {"finish": "none", **COARSE},
    "levels to 600 px": COARSE,
    "default, no finish": {"finish": "none"},
    "default": {},
}
"""Options by what the table calls them."""

HEADER = [
    "items", "run", "LC", "spread of the parts, points", "furthest from the whole, points",
    "fewest items in a part", "exact OO", "s",
]  # fmt: skip
PARTS_HEADER = ["items", "run", *(f"{k}: {letter}" for k, letter in enumerate(WORD, 1))]

PAGE = """# Parts

Made by `packwork bench parts` on {date}.
{machine}.

`text:{word}` with the bundled icons, `--effort normal`, on a canvas of 600 px. LC is exact, of
each letter's own region; the spread is that of the best filled letter from the worst; seconds are
the processor's, of the start and the levels, not of the finish. Of {seeds} seeds the median,
least and most.

{table}

LC of each letter, median of the seeds:

{parts}
"""


@dataclass(frozen=True)
class Filled:
    """One run: LC of the whole and of each part, items in each part, exact OO, seconds."""

    whole: float
    parts: FloatArray
    items: FloatArray
    overlap: float
    seconds: float


def part_regions(layout: Layout) -> list[shapely.Polygon]:
    """The container's parts, from left to right."""
    return sorted(layout.container.outline.region.geoms, key=lambda part: part.bounds[0])


def filled(count: int, seed: int, options: dict[str, str]) -> Filled:
    recipe = make_recipe(container=f"text:{WORD}", count=count, seed=seed, **options)
    run, seconds = timed_fill(recipe)
    outlines, parts = run.layout.outlines, part_regions(run.layout)
    centres = shapely.points([outline.centroid for outline in outlines])
    nearest = np.argmin([shapely.distance(part, centres) for part in parts], axis=0)
    return Filled(
        run.metrics.exact.coverage,
        np.array([exact_coverage(outlines, Outline.from_region(part)) for part in parts]),
        np.bincount(nearest, minlength=len(parts)),
        run.metrics.exact.overlap,
        seconds,
    )


def row(runs: list[Filled]) -> list[str]:
    spreads = [100 * float(np.ptp(run.parts)) for run in runs]
    furthest = [100 * float(np.abs(run.parts - run.whole).max()) for run in runs]
    return [
        ranged([run.whole for run in runs], ".3f"),
        ranged(spreads, ".1f"),
        ranged(furthest, ".1f"),
        ranged([float(run.items.min()) for run in runs], ".0f"),
        ranged([run.overlap for run in runs], ".1e"),
        f"{np.median([run.seconds for run in runs]):.2f}",
    ]


def main(words: list[str]) -> None:
    """Measure, print, write docs/benchmarks/parts.md."""
    seeds = SEEDS[:1] if "short" in words else SEEDS
    print(machine(), flush=True)
    precompile.warm_up()
    rows, parts = [], []
    for count in COUNTS:
        for name, options in WAYS.items():
            runs = [filled(count, seed, options) for seed in seeds]
            rows.append([str(count), name, *row(runs)])
            middle = np.median([run.parts for run in runs], axis=0)
            parts.append([str(count), name, *(f"{lc:.3f}" for lc in middle)])
            print("  ".join(rows[-1]), flush=True)
    tables = markdown_table(HEADER, rows), markdown_table(PARTS_HEADER, parts)
    print("\n\n".join(["", *tables]))
    if seeds == SEEDS:
        write_page(
            "parts.md",
            PAGE,
            word=WORD,
            seeds=str(len(seeds)),
            table=tables[0],
            parts=tables[1],
        )


if __name__ == "__main__":
    main(sys.argv[1:])
