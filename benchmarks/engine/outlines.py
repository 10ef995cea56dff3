"""Fitted outlines, icon by icon: ``packwork bench outlines``.

Prints the table and writes it to docs/benchmarks/outlines.md. One process, one thread;
milliseconds are of the processor, so that a busy machine does not show, medians with
quartiles, without the memory of earlier fits.
"""

from __future__ import annotations

import os
import time

os.environ.setdefault("OMP_NUM_THREADS", "1")

import numpy as np

from benchmarks.kit.manifests import write_page
from benchmarks.kit.measuring import Timing, machine, markdown_table
from packwork.fit.fitted import FittedOutline, fit_anew
from packwork.readers.items import read_items
from packwork.scene.item import Item

CURVES = (8, 12, 20, 40)
MAIN = 20
ROUNDS = 7

HEADER = ["icon", "points", "IoU", "ms", "ending"]

PAGE = """# Fitted outlines

Made by `packwork bench outlines` on {date}.
{machine}.

Each bundled icon's outline as closed chains of cubic curves (`packwork.fit_outline`). IoU
is exact, of polygons, against the outline as it was read; milliseconds are of the
processor, medians with quartiles. "Points" are those of the outline before.

## In short

{summary}

## Every icon, {main} curves

{rows}
"""


def fit_timed(item: Item, curves: int, rounds: int) -> tuple[FittedOutline, Timing]:
    """The fit and its processor time."""
    samples = []
    for _ in range(rounds):
        start = time.process_time()
        result = fit_anew(item.outline, curves)
        samples.append(1e3 * (time.process_time() - start))
    return result, Timing.of(samples)


def summary_row(curves: int, taken: list[tuple[FittedOutline, Timing]]) -> list[str]:
    shares = np.array([result.iou for result, _ in taken])
    times = np.array([timing.median for _, timing in taken])
    fitted = sum(result.is_fitted for result, _ in taken)
    return [
        str(curves), f"{shares.min():.4f}", f"{np.median(shares):.4f}",
        f"{np.median(times):.1f}", f"{times.max():.1f}", f"{fitted} of {len(taken)}",
    ]  # fmt: skip


def icon_row(item: Item, result: FittedOutline, timing: Timing) -> list[str]:
    return [
        item.name, f"{len(item.outline.points):,}", f"{result.iou:.4f}", str(timing),
        result.ending.name.lower(),
    ]  # fmt: skip


def main() -> None:
    """Measure, print, write docs/benchmarks/outlines.md."""
    print(machine(), flush=True)
    items = read_items(["icons"]).items
    fit_anew(items[0].outline, MAIN)
    summary, rows = [], []
    for curves in CURVES:
        taken = [fit_timed(item, curves, ROUNDS if curves == MAIN else 3) for item in items]
        if curves == MAIN:
            rows = [icon_row(item, *pair) for item, pair in zip(items, taken, strict=True)]
            print("\n".join("  ".join(row) for row in rows))
        summary.append(summary_row(curves, taken))
        print("  ".join(summary[-1]), flush=True)
    header = ["curves", "worst IoU", "median IoU", "median ms", "slowest ms", "fitted"]
    write_page(
        "outlines.md",
        PAGE,
        main=str(MAIN),
        summary=markdown_table(header, summary),
        rows=markdown_table(HEADER, sorted(rows, key=lambda row: float(row[2]))),
    )


if __name__ == "__main__":
    main()
