"""Voids filled with smaller copies, and many items at once: tables of ``bench quality``."""

from __future__ import annotations

import time
from collections.abc import Callable
from itertools import cycle, islice
from typing import Any

import numpy as np

from benchmarks.kit import frozen
from benchmarks.kit.measuring import markdown_table
from packwork import pipeline, uses
from packwork.recipe import make_recipe
from packwork.scene.container import Container

TARGET = 0.94
"""Share to cover: the least that the record of hand-made mosaics is said to have."""

CROWDS = {"round": (100, 1_000, 5_000), "concave": (100, 1_000), "thin": (100, 1_000),
          "letter": (100, 1_000)}  # fmt: skip

GAPS_HEADER = [
    "container", "LC of 100", "LC", "items", "smallest", "overlap", "outside", "least gap",
    "certified", "ended, as", "s",
]  # fmt: skip

CROWDS_HEADER = [
    "container", "items", "LC", "overlap", "outside", "least gap", "certified", "s",
]  # fmt: skip


def run(container: Container, count: int, **options: Any) -> tuple[pipeline.Run, float]:
    """A normal run with the frozen icons in turn, sizes free; its seconds of the processor."""
    recipe = make_recipe(container="frozen", items=["icons"], count=count, **options)
    items = list(islice(cycle(frozen.items()[: len(frozen.ICONS)]), count))
    began = time.process_time()
    done = uses.fill(recipe, items, container)
    return done, time.process_time() - began


def gaps_table() -> str:
    """Until 0.94 are covered or 1,000 items are there."""
    rows = []
    for make in frozen.CONTAINERS:
        container = make()
        plain, _ = run(container, frozen.COUNT)
        full, seconds = run(container, frozen.COUNT, target_coverage=TARGET)
        assert full.filling is not None
        extents = [item.outline.extent for item in full.layout.items] * full.layout.poses.scale
        rows.append(
            [
                container.name, f"{plain.metrics.exact.coverage:.3f}", *_exact(full)[:1],
                f"{len(full.layout.items):,}", f"{np.min(extents):.1f} px", *_exact(full)[1:],
                full.filling.ending, f"{seconds:.0f}",
            ]
        )  # fmt: skip
        print("  ".join(rows[-1]), flush=True)
    title = f"## frozen, voids filled, `--target-coverage {TARGET} --effort normal`"
    return f"{title}\n\n{markdown_table(GAPS_HEADER, rows)}\n"


def crowds_table() -> str:
    """100, 1,000 and 5,000 items."""
    rows = []
    for make in frozen.CONTAINERS:
        container = make()
        for count in CROWDS[container.name]:
            done, seconds = run(container, count)
            rows.append([container.name, f"{count:,}", *_exact(done), f"{seconds:.0f}"])
            print("  ".join(rows[-1]), flush=True)
    title = "## frozen icons, many, free, `--effort normal`"
    return f"{title}\n\n{markdown_table(CROWDS_HEADER, rows)}\n"


def _exact(done: pipeline.Run) -> list[str]:
    exact = done.metrics.exact
    return [
        f"{exact.coverage:.3f}",
        f"{exact.overlap:.1e}",
        f"{exact.exceeding:.1e}",
        f"{exact.min_gap:.4f}",
        "yes" if done.certified else "no",
    ]


TABLES: dict[str, Callable[[], str]] = {"gaps": gaps_table, "many": crowds_table}
"""By the word that asks for each."""
