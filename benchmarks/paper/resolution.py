"""Constant resolutions against hierarchies: ``packwork bench resolution [short]``.

The ablation of Wang and Lu 2025, table 1, on the frozen set: 200 epochs shared evenly
among the levels. Prints the tables and writes them to docs/benchmarks/resolution.md.
``short`` takes one seed in place of three, and only prints.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence

os.environ.setdefault("OMP_NUM_THREADS", "1")

import numpy as np

from benchmarks.kit.manifests import Manifest, stamp, write_manifest, write_text
from benchmarks.kit.measuring import machine, markdown_table, ranged
from benchmarks.kit.published import RESOLUTIONS
from benchmarks.kit.runs import EA, LC, MEASURES, OO, SECONDS, on_frozen_set
from packwork import precompile
from packwork.arrays import FloatArray

SEEDS = (0, 1, 2)
EPOCHS = 200
PRESETS = ("default", "paper")


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


def measure(seeds: Sequence[int]) -> Manifest:
    """Measures by levels and preset, ``(seeds, measures)``, means of the containers."""
    found: dict[str, dict[str, FloatArray]] = {}
    for levels in RESOLUTIONS:
        found[levels] = {
            preset: np.mean(
                on_frozen_set(seeds, epochs=EPOCHS, levels=levels, preset=preset), axis=0
            )
            for preset in PRESETS
        }
        middle = {preset: np.median(m, axis=0) for preset, m in found[levels].items()}
        print(levels, {preset: m.round(5).tolist() for preset, m in middle.items()}, flush=True)
    return {"seeds": len(seeds), "epochs": EPOCHS, "measures": MEASURES, "levels": found}


def page(manifest: Manifest) -> str:
    """docs/benchmarks/resolution.md."""
    return PAGE.format(
        date=manifest["date"],
        machine=manifest["machine"],
        epochs=manifest["epochs"],
        seeds=manifest["seeds"],
        LC=_table(manifest, LC, 100, ".1f", "LC"),
        OO=_table(manifest, OO, 100, ".3f", "OO"),
        EA=_table(manifest, EA, 100, ".4f", "EA"),
        seconds=_table(manifest, SECONDS, 1, ".2f", "seconds"),
    )


def _table(manifest: Manifest, measure: int, factor: float, form: str, name: str) -> str:
    """One measure of all runs, beside what was published."""
    rows = [
        [
            levels.replace(",", "+"),
            *(ranged([factor * one[measure] for one in of[preset]], form) for preset in PRESETS),
            getattr(RESOLUTIONS[levels], name),
        ]
        for levels, of in manifest["levels"].items()
    ]
    return markdown_table(HEADER, rows)


def main(words: list[str]) -> None:
    """Measure, print, write the manifest and docs/benchmarks/resolution.md."""
    seeds = SEEDS[:1] if "short" in words else SEEDS
    print(machine(), flush=True)
    precompile.warm_up()
    manifest = {**stamp(), **measure(seeds)}
    if seeds == SEEDS:
        write_text("resolution.md", page(write_manifest("resolution", manifest)))
    else:
        print(page(manifest))


if __name__ == "__main__":
    main(sys.argv[1:])
