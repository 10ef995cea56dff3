"""Constant resolutions against hierarchies: ``packwork bench resolution [short]``.

The ablation of Wang and Lu 2025, table 1, on the frozen set: 200 epochs shared evenly
among the levels. Prints the tables and writes them to docs/benchmarks-resolution.md.
``short`` takes one seed in place of five, and only prints.
"""

from __future__ import annotations

import os
import sys
from dataclasses import dataclass

os.environ.setdefault("OMP_NUM_THREADS", "1")

import numpy as np

from measuring import machine, markdown_table, ranged, write_page
from packwork import pipeline
from packwork.arrays import FloatArray
from runs import EA, LC, OO, SECONDS, on_frozen_set

SEEDS = (0, 1, 2, 3, 4)
EPOCHS = 200
PRESETS = ("default", "paper")


@dataclass(frozen=True)
class Published:
    """One row of the paper's table 1: LC, OO, EA in percent, seconds for 200 epochs."""

    LC: str
    OO: str
    EA: str
    seconds: str


STRATEGIES = {
    "50": Published("69.67", "2.72", "1.11", "12.90"),
    "100": Published("65.60", "0.68", "0.33", "13.41"),
    "200": Published("73.43", "0.42", "0.07", "15.44"),
    "400": Published("67.55", "0.08", "0.01", "22.36"),
    "600": Published("70.77", "0.11", "0.00", "32.54"),
    "800": Published("72.23", "0.12", "0.00", "52.42"),
    "1000": Published("71.16", "0.05", "0.00", "76.04"),
    "1200": Published("69.39", "0.01", "0.00", "99.76"),
    "100,600": Published("51.47", "0.02", "0.00", "18.51"),
    "50,200,600": Published("60.73", "0.01", "0.00", "20.74"),
}
"""Levels, with what the paper reports for them."""

HEADER = ["levels, px", *(f"preset `{preset}`" for preset in PRESETS), "published"]

PAGE = """# Resolutions

Made by `packwork bench resolution` on {date}.
{machine}.

The ablation of Wang and Lu 2025 (table 1): constant resolutions against hierarchies, 100
items, {epochs} epochs shared evenly among the levels, the mean of four containers (the frozen
set). Of {seeds} seeds the median, least and most. The presets start where theirs says
(`distance-field`, items covering 0.64 and 0.55 of the container). LC, OO and EA by pixels at
1,200 px, in percent of the container, before the exact finish (`--finish none`): what the levels
leave; seconds are the processor's, of the start and the levels.

"Published" are the paper's own figures, for its own items and containers, on hardware that it
does not name: between the columns compare how figures change from row to row, not how large
they are.

## Coverage (LC), %

{LC}

## Overlap (OO), %

{OO}

## Outside (EA), %

{EA}

## Seconds

{seconds}
"""


def taken(seeds: tuple[int, ...]) -> dict[str, dict[str, FloatArray]]:
    """Measures by levels and preset, ``(seeds, measures)``, means of the containers."""
    found: dict[str, dict[str, FloatArray]] = {}
    for levels in STRATEGIES:
        found[levels] = {
            preset: np.mean(
                on_frozen_set(seeds, epochs=EPOCHS, levels=levels, preset=preset), axis=0
            )
            for preset in PRESETS
        }
        middle = {preset: np.median(m, axis=0) for preset, m in found[levels].items()}
        print(levels, {preset: m.round(5).tolist() for preset, m in middle.items()}, flush=True)
    return found


def table(
    found: dict[str, dict[str, FloatArray]], measure: int, factor: float, form: str, name: str
) -> str:
    """One measure of all runs, beside what was published."""
    rows = [
        [
            levels.replace(",", "+"),
            *(ranged((factor * found[levels][p][:, measure]).tolist(), form) for p in PRESETS),
            getattr(published, name),
        ]
        for levels, published in STRATEGIES.items()
    ]
    return markdown_table(HEADER, rows)


def main(words: list[str]) -> None:
    """Measure, print, write docs/benchmarks-resolution.md."""
    seeds = SEEDS[:1] if "short" in words else SEEDS
    print(machine(), flush=True)
    pipeline.warm_up()
    found = taken(seeds)
    tables = {
        "LC": table(found, LC, 100, ".1f", "LC"),
        "OO": table(found, OO, 100, ".3f", "OO"),
        "EA": table(found, EA, 100, ".4f", "EA"),
        "seconds": table(found, SECONDS, 1, ".2f", "seconds"),
    }
    print("\n\n".join(["", *tables.values()]))
    if seeds == SEEDS:
        write_page(
            "benchmarks-resolution.md", PAGE, epochs=str(EPOCHS), seeds=str(len(seeds)), **tables
        )


if __name__ == "__main__":
    main(sys.argv[1:])
