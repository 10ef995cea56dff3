"""A hero among words in proportion: what came out larger than it gives way."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import TypeAlias, final

import numpy as np

from packwork.arrays import FloatArray
from packwork.phrasing import enumerated
from packwork.pipeline.job import Job
from packwork.pipeline.plan.asked import RuleSource
from packwork.pipeline.state import RunState
from packwork.pipeline.step import RunStep, run_steps, share_of
from packwork.pipeline.watch import RunContext
from packwork.uses.words.letters import at_sizes

MOST_RUNS = 1
"""Runs at most in which the heaviest words give way, before all become smaller: in each all others
grow into the room. More fill better and leave less of the proportions. Chosen."""

BELOW = 0.9
"""Longer side of other words over the hero's, at most, where they give way. Chosen."""

Listed: TypeAlias = Callable[[bool], Sequence[RunStep]]
"""Steps of a cloud, and whether all words are made smaller than the hero at the end."""


@final
class LedByHero(RunStep):
    """A cloud in which no word is larger than the hero; that some are is said where it cannot be.

    The heaviest become as high as each other, so that no word is higher than a heavier one.
    """

    def __init__(self, listed: Listed) -> None:
        self._listed = listed
        self.share = share_of(listed(False))

    def run(self, state: RunState, watch: RunContext) -> RunState:
        """State of the cloud, measured."""
        job, found = state.job, run_steps(self._listed(False), state, watch)
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
            found = run_steps(self._listed(number == MOST_RUNS), RunState.of(job), watch)
            sizes, has_led = _sizes(job, found), True
        pairs = zip(job.items, sizes, strict=True)
        larger = [item.name for item, size in pairs if size > sizes[hero]]
        if larger:
            why = f"{enumerated(larger)}: larger than {first}, the hero; give it a larger size"
            return replace(found, faults=(*found.faults, why))
        said = f"other words are smaller than their weights ask, so that {first}, the hero, leads"
        return replace(found, remarks=(*found.remarks, said)) if has_led else found


@final
class BelowHero(RunStep):
    """All words, in proportion, smaller than the hero."""

    def run(self, state: RunState, watch: RunContext) -> RunState:
        """State with exact poses of such sizes."""
        hero, poses = hero_of(state.job), state.poses
        sizes = _extents(state.job) * poses.scale
        if hero is None or sizes[hero] == sizes.max():
            return state
        scale = poses.scale * (BELOW * sizes[hero] / sizes.max())
        scale[hero] = poses.scale[hero]
        return at_sizes(state, scale, watch)


def hero_of(job: Job) -> int | None:
    """Row of the hero; None if there is none."""
    voices = (one.voices.get("pin.size", RuleSource("")) for one in job.asked)
    return next((k for k, voice in enumerate(voices) if voice.key == "hero"), None)


def _extents(job: Job) -> FloatArray:
    return np.array([item.outline.extent for item in job.items])


def _sizes(job: Job, found: RunState) -> FloatArray:
    """``(n,)`` longer sides as they came out; what found no place has none."""
    # Items of a layout have colours of their own, and copies come last.
    layout, _ = found.measured
    outlines = [item.outline for item in layout.items]
    scales = dict(zip(reversed(outlines), reversed(layout.poses.scale), strict=True))
    placed = np.array([scales.get(item.outline, 0.0) for item in job.items])
    return np.asarray(placed * _extents(job))
