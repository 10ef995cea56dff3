"""A hero among words in proportion: what came out larger than it gives way."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from packwork.arrays import FloatArray
from packwork.finish.finished import Finished
from packwork.phrasing import enumerated
from packwork.pipeline.beginning import Beginning
from packwork.pipeline.exact import finished
from packwork.pipeline.job import Job
from packwork.pipeline.plan.asked import Voice
from packwork.pipeline.result import Run
from packwork.pipeline.watch import Watch

MOST_RUNS = 1
"""Runs at most in which the heaviest words give way, before all become smaller: in each all others
grow into the room. More fill better and leave less of the proportions. Chosen."""

BELOW = 0.9
"""Longer side of other words over the hero's, at most, where they give way. Chosen."""


def led_by_hero(job: Job, run: Callable[[Job, bool], Run], found: Run, watch: Watch) -> Run:
    """A run in which no word is larger than the hero; that some are is said where it cannot be.

    The heaviest become as high as each other, so that no word is higher than a heavier one.

    Parameters
    ----------
    run
        What places a job, and whether what is larger than the hero then is made smaller.
    found
        Of the job as it is.
    """
    hero = hero_of(job)
    if hero is None:
        return found
    first, sizes, has_led = job.items[hero].name, _sizes(job, found), False
    for number in range(MOST_RUNS + 1):
        if not (sizes > sizes[hero]).any() or watch.stop():
            break
        extents = _extents(job)
        scales = sizes / extents
        most = BELOW * sizes[hero] / extents[sizes > sizes[hero]].max()
        share = np.minimum(most / np.maximum(scales, most), 1.0) ** 2
        share[hero] = 1.0
        job = replace(job, weights=job.weights * share)
        found = run(job, number == MOST_RUNS)
        sizes, has_led = _sizes(job, found), True
    larger = [item.name for item, size in zip(job.items, sizes, strict=True) if size > sizes[hero]]
    if larger:
        why = f"{enumerated(larger)}: larger than {first}, the hero; give it a larger size"
        return replace(found, broken=(*found.broken, why))
    said = f"other words are smaller than their weights ask, so that {first}, the hero, leads"
    return replace(found, remarks=(*found.remarks, said)) if has_led else found


def hero_of(job: Job) -> int | None:
    """Row of the hero; None if there is none."""
    voices = (one.voices.get("pin.size", Voice("")) for one in job.asked)
    return next((k for k, voice in enumerate(voices) if voice.key == "hero"), None)


def below_hero(job: Job, start: Beginning, exact: Finished, watch: Watch) -> Finished:
    """Exact poses in which all words, in proportion, are smaller than the hero."""
    hero = hero_of(job)
    sizes = _extents(job) * exact.poses.scale
    if hero is None or sizes[hero] == sizes.max():
        return exact
    scale = exact.poses.scale * (BELOW * sizes[hero] / sizes.max())
    scale[hero] = exact.poses.scale[hero]
    fixed = replace(job, plan=replace(job.plan, sizes="fixed"))
    return finished(fixed, start, replace(exact.poses, scale=scale), watch)


def _extents(job: Job) -> FloatArray:
    return np.array([item.outline.extent for item in job.items])


def _sizes(job: Job, found: Run) -> FloatArray:
    """``(n,)`` longer sides as they came out; what found no place has none."""
    # Items of a layout have colours of their own, and copies come last.
    outlines = [item.outline for item in found.layout.items]
    scales = dict(zip(reversed(outlines), reversed(found.layout.poses.scale), strict=True))
    placed = np.array([scales.get(item.outline, 0.0) for item in job.items])
    return np.asarray(placed * _extents(job))
