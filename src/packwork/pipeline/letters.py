"""How large the letters of words may be: the largest held down, the too small left out.

Sizes stay in the proportion of the weights. So where the lightest words would come out
smaller than was asked they are left out, by name, and the others grow into their room.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from packwork.arrays import FloatArray
from packwork.errors import RecipeError
from packwork.finish.finish import Finished
from packwork.forces.forces import Forces
from packwork.pipeline.beginning import Beginning
from packwork.pipeline.casting import cast_words
from packwork.pipeline.finishing import finished
from packwork.pipeline.job import Job
from packwork.pipeline.regions import read_regions
from packwork.pipeline.sharing import shared_out
from packwork.progress import Observer, Stop
from packwork.readers.words.items import EM_PX, MOST_SHOWN, WordsRead
from packwork.scene.pose import Poses

DENSEST = 0.6
"""Share of a container that words never cover at one common size. Larger begins with words
that are then left out after all, smaller leaves out some that would fit. The densest cloud
that was measured has 0.45."""

HOPEFUL = 3
"""Runs of a cloud in which words are left out only as far as must be; from then on ``FEWER``
of them are kept, so that it ends. Chosen."""

FEWER = 0.7


def letters_of(job: Job, poses: Poses) -> FloatArray:
    """``(n,)`` font size of each word, canvas units; the words come first of all items."""
    count = len(job.items) if job.words is None else len(job.words.items)
    return np.asarray(poses.scale[:count] * EM_PX)


def without_hopeless(job: Job) -> Job:
    """Job without words that could not even be large enough in the fullest cloud.

    Raises
    ------
    RecipeError
        If that is true of all.
    """
    if job.words is None or job.letters is None or job.letters.smallest is None:
        return job
    own = np.array([item.outline.area for item in job.words.items])
    heights = np.sqrt(job.words.areas / own)
    room = DENSEST * job.container.outline.area
    sizes = EM_PX * heights * np.sqrt(room / np.cumsum(job.words.areas))
    if job.letters.largest is not None:
        sizes = np.minimum(sizes, job.letters.largest * heights / heights.max())
    return _with_first(job, int(np.count_nonzero(sizes >= job.letters.smallest)), sizes)


def with_readable(job: Job, poses: Poses, attempt: int) -> Job:
    """The job itself if all letters are large enough; else one of fewer words.

    Parameters
    ----------
    attempt
        How many runs there were.

    Raises
    ------
    RecipeError
        If not even one word is large enough.
    """
    if job.words is None or job.letters is None or job.letters.smallest is None:
        return job
    sizes = letters_of(job, poses)
    if float(sizes.min()) >= job.letters.smallest * (1 - 1e-9):
        return job
    areas = np.cumsum(job.words.areas)
    # What the last word of as many would measure, were the same share covered.
    grown = sizes * np.sqrt(areas[-1] / areas)
    count = min(int(np.count_nonzero(grown >= job.letters.smallest)), len(sizes) - 1)
    if attempt >= HOPEFUL:
        count = min(count, int(FEWER * len(sizes)))
    return _with_first(job, count, sizes)


def held_down(
    job: Job,
    start: Beginning,
    exact: Finished,
    observer: Observer | None,
    stop: Stop,
    forces: Forces | None = None,
) -> Finished:
    """Exact poses whose largest letters are as large as they may be, all others in proportion."""
    if job.letters is None or job.letters.largest is None:
        return exact
    most = float(letters_of(job, exact.poses).max())
    if most <= job.letters.largest:
        return exact
    smaller = replace(exact.poses, scale=exact.poses.scale * (job.letters.largest / most))
    # A smaller copy may meet others, where letters stand in each other's bays.
    fixed = replace(job, recipe=job.recipe.model_copy(update={"sizes": "fixed"}))
    return finished(fixed, start, smaller, observer, stop, forces)


def _with_first(job: Job, count: int, sizes: FloatArray) -> Job:
    """Job of the heaviest words; the others are among those that could not be drawn."""
    words = job.words
    assert words is not None  # noqa: S101 - its callers look
    assert job.letters is not None  # noqa: S101 - its callers look
    if count == len(words.items):
        return job
    if count == 0:
        raise RecipeError(
            "smallest",
            f"not even {words.items[0].name[:MOST_SHOWN]!r} can be so large in this container; "
            "use a smaller length, a larger canvas or another container",
        )
    unit, least = job.container.unit, job.letters.smallest
    reasons = {
        item.name: f"its letters would be {size:.3g} {unit} high, less than the "
        f"{least:.3g} {unit} of --smallest"
        for item, size in zip(words.items[count:], sizes[count:].tolist(), strict=True)
    }
    return _recast(job, _first(words, count, reasons))


def _first(words: WordsRead, count: int, reasons: Mapping[str, str]) -> WordsRead:
    return replace(
        words,
        items=words.items[:count],
        areas=words.areas[:count],
        words=words.words[:count],
        undrawn={**reasons, **words.undrawn},  # the heaviest first
    )


def _recast(job: Job, words: WordsRead) -> Job:
    """Job of other words, what rules ask of them, and what is mixed in."""
    before = {id(item) for item in (() if job.words is None else job.words.items)}
    others = {id(item): item for item in job.items if id(item) not in before}
    chosen = cast_words(job.recipe, words, list(others.values()))
    weights = shared_out(chosen.items, chosen.weights, words.items, job.recipe.share)
    gone = before - {id(item) for item in words.items}
    return replace(
        job,
        items=chosen.items,
        asked=chosen.asked,
        weights=weights,
        regions=read_regions(chosen.asked, job.container),
        fillers=tuple(item for item in job.fillers if id(item) not in gone),
        words=words,
    )
