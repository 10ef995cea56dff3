"""Whole runs on the frozen set, measured; what several benchmarks share."""

from __future__ import annotations

import time
from collections.abc import Sequence
from typing import Any

import numpy as np

from benchmarks.kit import frozen
from packwork import pipeline, uses
from packwork.arrays import FloatArray
from packwork.progress import Step
from packwork.recipe import Recipe, make_recipe
from packwork.scene.container import Container
from packwork.scene.item import Item

MEASURES = ("LC", "OO", "EA", "L-nU", "exact OO", "s")
"""What a run is measured by; seconds are the processor's, of the start and the levels, so
that a busy machine does not show."""

LC, OO, EA, LNU, EXACT_OO, SECONDS = range(len(MEASURES))


class Stopwatch:
    """Processor seconds from its making to the end of the last level."""

    every = 10**9

    def __init__(self) -> None:
        self._began = time.process_time()
        self.seconds = 0.0

    def on_step(self, step: Step) -> None:
        if not step.is_finish:
            self.seconds = time.process_time() - self._began


def timed_fill(
    recipe: Recipe, items: Sequence[Item] | None = None, container: Container | None = None
) -> tuple[pipeline.Run, float]:
    """A run, and the processor seconds of its start and levels."""
    job = uses.read(recipe, items, container)
    watch = Stopwatch()
    return pipeline.run(job, watch), watch.seconds


def measured(container: Container, seed: int, **options: Any) -> list[float]:
    """One run with the frozen items, up to the exact finish, in the order of ``MEASURES``."""
    options = {"finish": "none", **options}
    recipe = make_recipe(container="frozen", items=["icons"], seed=seed, **options)
    run, seconds = timed_fill(recipe, frozen.items(), container)
    pixel = run.metrics.pixel
    return [pixel.LC, pixel.OO, pixel.EA, pixel.LnU, run.metrics.exact.overlap, seconds]


def on_frozen_set(seeds: Sequence[int], **options: Any) -> FloatArray:
    """Measures by container, seed and measure, ``(4, seeds, 6)``."""
    return np.array(
        [[measured(make(), seed, **options) for seed in seeds] for make in frozen.CONTAINERS]
    )
