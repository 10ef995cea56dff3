"""Default size of the items of a pile: as large as leaves room for all."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from packwork.geometry.simplify import hull_areas
from packwork.pipeline.earlier import matched
from packwork.pipeline.job import Job
from packwork.pipeline.plan.counts import MOST
from packwork.pipeline.plan.sizes import given_scales
from packwork.pipeline.widest import widest_cu
from packwork.recipe.piles import PileOptions
from packwork.scene.canvas import brought_over
from packwork.scene.container import Container
from packwork.scene.item import Item
from packwork.uses.room import NO_CONTAINER

HEAP = 0.4
"""Area of a pile's items over the container's: it stands about two thirds high. Chosen."""

FULL = 0.42
"""Share of the container that the items' convex hulls come to: heaped, they leave about a third of
what they reach into free, so the pile is two thirds high. Larger leaves some without room, smaller
piles look lost. Measured on square, heart, bear and cat of 20 and 60 icons: 0.55 to 0.70 high."""

WIDEST = 0.6
"""Longest item over the container's widest place, at most. Larger may wedge. Chosen."""

SMALLER, TRIES = 0.93, 6
"""Factor on all sizes while some items find no room, and how often. Smaller ends sooner with a
lower pile. Chosen."""


def is_size_open(job: Job, asked: PileOptions) -> bool:
    """Whether the run may choose how large its items are."""
    is_alone = job.container.name == NO_CONTAINER
    return asked.size is None and not job.is_counted and not is_alone


def heap_needed(container: Container, asked: PileOptions, items: Sequence[Item]) -> int:
    """Items of given sizes that heap up about two thirds high."""
    weights = np.ones(len(items))
    scales = given_scales(items, weights, container.unit, container.side, asked.size)
    own = np.array([item.outline.area for item in items]) * scales**2
    return int(np.clip(HEAP * container.outline.area / own.mean(), 1, MOST))


def fitting_factor(job: Job) -> float:
    """Factor on the sizes of the files at which the pile is about two thirds high.

    Where an earlier layout is gone on from, that at which its items keep their sizes.
    """
    container = job.container
    scales = given_scales(job.items, job.weights, container.unit, container.side)
    if job.earlier is not None:
        names = ([item.name for item in items] for items in (job.items, job.earlier.items))
        found = matched(*names)
        known = np.flatnonzero(found >= 0)
        if len(known):
            then = brought_over(job.earlier.poses, job.earlier.container, container)
            own = [job.items[k].outline.extent for k in known]
            before = [job.earlier.items[k].outline.extent for k in found[known]]
            sizes = then.scale[found[known]] * np.array(before) / np.array(own)
            return float(np.median(sizes / scales[known]))
    outlines = job.solid_outlines
    covered = float((hull_areas(outlines) * scales**2).sum())
    factor = float(np.sqrt(FULL * container.outline.area / covered))
    across = widest_cu(container.outline)
    longest = float((2 * np.array([o.radius for o in outlines]) * scales).max())
    return float(min(factor, WIDEST * across / longest))
