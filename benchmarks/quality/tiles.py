"""Seamless tiles: ``packwork bench tiles [tiles=N]``.

What a tile covers beside the same icons within walls, at which cost; and random tiles, whose
overlap and seam are measured in the written picture.
"""

from __future__ import annotations

import os
import sys
import time
from dataclasses import replace
from io import BytesIO

os.environ.setdefault("OMP_NUM_THREADS", "1")

import numpy as np
from PIL import Image

from benchmarks.kit.manifests import write_page
from benchmarks.kit.measuring import markdown_table
from packwork import precompile, uses
from packwork.arrays import IntArray
from packwork.metrics.torus import torus_metrics
from packwork.pipeline.result import Run
from packwork.readers.builtin import item_names
from packwork.recipe import make_recipe
from packwork.scene.layout import Layout
from packwork.writers.bitmaps import png_bytes

COUNTS, SEEDS, TILES, SIDE_PX = (20, 40, 100), (0, 1, 2), 200, 600
KINDS = (None, "square", "half-drop", "hexagon")
HEADER = [
    "icons",
    "within walls",
    "square",
    "half-drop",
    "hexagon",
    "seconds over those within walls",
]

TWO_ROWS = 128
"""Difference of a pixel that is none: renderers count edges by rows of a quarter of a pixel, and
two may cross one."""

PAGE = """# Seamless tiles

Made by `packwork bench tiles` on {date}.
{machine}.

Share of a page that icons of free sizes cover, exact, means over {seeds} seeds: within its walls,
and as a tile, on the torus. Seconds are processor seconds of a square tile over those of the page.

{table}

**{tiles} random tiles** of 1 to 40 icons, all three kinds, with and without padding, little effort:
{certified} are certified; the largest overlap on the torus is {overlap} px² of a page of 600 px;
{seams} of them show a seam. For that the layout is cut elsewhere and drawn anew: where a pixel at
the edge differs from that one by more than two rows of the renderer's grid, there is one. The
largest difference is {largest} of 255.
"""


def run_of(tile: str | None, count: int, seed: int, **options: object) -> tuple[Run, float]:
    """A run on a page, and its processor seconds."""
    recipe = make_recipe(container="page", tile=tile, count=count, seed=seed, **options)
    began = time.process_time()
    return uses.fill(recipe), time.process_time() - began


def pixels(layout: Layout) -> IntArray:
    """Picture of a tile, ``(rows, columns, 3)``."""
    with Image.open(BytesIO(png_bytes(layout, SIDE_PX))) as picture:
        return np.array(picture.convert("RGB")).astype(np.int64)


def seam_of(layout: Layout) -> int:
    """Largest difference along a tile's edges from the same layout cut elsewhere."""
    lattice = layout.container.lattice
    if lattice is None:
        raise ValueError("no tile")
    down, right = 40, round(lattice.width / 2)
    there = np.column_stack([layout.poses.x + right, layout.poses.y + down])
    x, y = lattice.wrapped(there).T
    moved = replace(layout, poses=replace(layout.poses, x=x, y=y))
    off = np.abs(pixels(layout) - np.roll(pixels(moved), (-down, -right), axis=(0, 1)))
    return int(max(off[[0, -1]].max(), off[:, [0, -1]].max()))


def main() -> None:
    asked = dict(word.split("=", 1) for word in sys.argv[1:])
    tiles = int(asked.get("tiles", TILES))
    precompile.warm_up()
    rows = []
    for count in COUNTS:
        means, seconds = [], []
        for kind in KINDS:
            runs = [run_of(kind, count, seed) for seed in SEEDS]
            means.append(np.mean([run.metrics.exact.coverage for run, _ in runs]))
            seconds.append(sum(used for _, used in runs))
        rows.append(
            [str(count), *(f"{mean:.3f}" for mean in means), f"{seconds[1] / seconds[0]:.1f}"]
        )
        print("  ".join(rows[-1]), flush=True)
    rng = np.random.default_rng(0)
    names, overlaps, offs, certified = item_names(), [], [], 0
    for seed in range(tiles):
        count = int(rng.integers(1, 41))
        run, _ = run_of(
            str(rng.choice(KINDS[1:])), count, seed, effort="draft",
            items=tuple(rng.choice(names, min(count, 12), replace=False)),
            padding=str(rng.choice(["0", "0.5%"])),
        )  # fmt: skip
        lattice = run.layout.container.lattice
        certified += run.certified
        overlaps.append(torus_metrics(run.layout.outlines, lattice).overlap_area if lattice else 0)
        offs.append(seam_of(run.layout))
    write_page(
        "tiles.md", PAGE, seeds=str(len(SEEDS)), table=markdown_table(HEADER, rows),
        tiles=str(tiles), certified=str(certified), overlap=f"{max(overlaps):g}",
        seams=str(sum(off > TWO_ROWS for off in offs)), largest=str(max(offs)),
    )  # fmt: skip


if __name__ == "__main__":
    main()
