"""Sizes of words: font sizes kept within bounds, the hero kept ahead of the others."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import count
from typing import final

import numpy as np

from packwork.arrays import FloatArray
from packwork.errors import RecipeError
from packwork.phrasing import enumerated
from packwork.pipeline.findings import Sentence
from packwork.pipeline.job import Job
from packwork.pipeline.plan.copies import RuleSource, shared_out
from packwork.pipeline.read import read_regions
from packwork.pipeline.state import RunContext, RunState, RunStep, run_steps, share_of
from packwork.readers.words.items import WordsRead
from packwork.readers.words.options import WordOptions
from packwork.readers.words.shaping import EM_PX
from packwork.recipe import Sizes
from packwork.scene.container import Container
from packwork.scene.item import Item
from packwork.scene.pose import Poses
from packwork.steps.finish import finished
from packwork.units import Unit, length_asked
from packwork.uses.words.copies import cast_words, words_of

DENSEST = 0.6
"""Share of a container that words never cover at one common size. Larger begins with words
that are then left out after all, smaller leaves out some that would fit. The densest cloud
that was measured has 0.45."""

HOPEFUL = 3
"""Runs of a cloud in which words are left out only as far as must be; from then on ``FEWER``
of them are kept, so that it ends. Chosen."""

FEWER = 0.7


@dataclass(frozen=True)
class Letters:
    """Bounds of the font size of words, canvas units; None where there is none.

    Examples
    --------
    >>> Letters(smallest=8.0).largest is None
    True
    """

    smallest: float | None = None
    largest: float | None = None

    @classmethod
    def of(cls, asked: WordOptions, container: Container, sizes: Sizes) -> Letters:
        """Bounds that words are asked to keep in a container on its canvas."""
        found: dict[str, float | None] = {}
        for key in ("smallest", "largest"):
            length = getattr(asked, key)
            if length is None:
                continue
            found[key] = size = length_asked(key, length, container.unit, container.side)
            if size <= 0:
                raise RecipeError(key, f"must be more than nothing, not {length}")
            if sizes not in {"shared", "graded", "auto"}:
                raise RecipeError(
                    key, f"bounds words in proportion to each other, not --sizes {sizes}"
                )
        letters = cls(**found)
        if letters.smallest and letters.largest and letters.smallest > letters.largest:
            raise RecipeError(
                "smallest",
                f"is {letters.smallest:g}, more than the {letters.largest:g} of --largest",
            )
        return letters


def hopeful_sizes(words: WordsRead, letters: Letters, room_cu2: float) -> FloatArray:
    """``(n,)`` font size of each word as the last one of the fullest cloud, canvas units."""
    own = np.array([item.outline.area for item in words.items])
    heights = np.sqrt(words.areas / own)
    sizes = EM_PX * heights * np.sqrt(DENSEST * room_cu2 / np.cumsum(words.areas))
    if letters.largest is not None:
        sizes = np.minimum(sizes, letters.largest * heights / heights.max())
    return np.asarray(sizes)


def readable_count(words: WordsRead, smallest: float, sizes: FloatArray, attempt: int) -> int:
    """Number of the heaviest words to place anew; all if their letters are large enough.

    Parameters
    ----------
    smallest
        Least font size, canvas units.
    sizes
        ``(n,)`` font size of each, as they lie.
    attempt
        How many runs there were.
    """
    if float(sizes.min()) >= smallest * (1 - 1e-9):
        return len(sizes)
    areas = np.cumsum(words.areas)
    # What the last word of as many would measure, were the same share covered.
    grown = sizes * np.sqrt(areas[-1] / areas)
    count = min(int(np.count_nonzero(grown >= smallest)), len(sizes) - 1)
    return min(count, int(FEWER * len(sizes))) if attempt >= HOPEFUL else count


@final
class LettersAtMost(RunStep):
    """The largest letters as large as they may be, all others in proportion.

    Parameters
    ----------
    largest
        Font size, canvas units.
    """

    def __init__(self, largest: float) -> None:
        self._largest = largest

    def run(self, state: RunState, context: RunContext) -> RunState:
        """State with exact poses of such sizes."""
        most = float(letters_of(state.poses, len(state.job.use.words)).max())
        if most <= self._largest:
            return state
        return at_sizes(state, state.poses.scale * (self._largest / most), context)


def at_sizes(state: RunState, scale: FloatArray, context: RunContext) -> RunState:
    """State with exact poses at smaller scales ``(n,)``.

    A smaller copy may meet others, where letters stand in each other's bays.
    """
    job = state.job
    fixed = job.replanned(sizes="fixed")
    with job.clock.time("finish"):
        poses = replace(state.poses, scale=scale)
        found = finished(replace(state, job=fixed, poses=poses), context)
    return replace(found, job=job)


def letters_of(poses: Poses, count: int) -> FloatArray:
    """``(count,)`` font size of each word, canvas units; words come first of all items."""
    return np.asarray(poses.scale[:count] * EM_PX)


def heaviest(
    words: WordsRead, count: int, sizes: FloatArray, smallest: float, unit: Unit
) -> WordsRead:
    """The heaviest words; the others are among those that could not be drawn.

    Parameters
    ----------
    sizes
        ``(n,)`` what the letters of each would measure.
    smallest, unit
        What was asked.
    """
    if count == 0:
        raise RecipeError(
            "smallest",
            f"not even {words.items[0].name[:40]!r} can be so large in this container; "
            "use a smaller length, a larger canvas or another container",
        )
    reasons = {
        word.text: Sentence.LETTERS.of(size=size, unit=unit, least=smallest)
        for word, size in zip(words.words[count:], sizes[count:].tolist(), strict=True)
    }
    return _first(words, count, reasons)


def _first(words: WordsRead, count: int, reasons: Mapping[str, str]) -> WordsRead:
    return replace(
        words,
        items=words.items[:count],
        areas=words.areas[:count],
        words=words.words[:count],
        undrawn={**reasons, **words.undrawn},  # the heaviest first
    )


MOST_RUNS = 1
"""Runs at most in which the heaviest words give way, before all become smaller: in each all others
grow into the room. More fill better and leave less of the proportions. Chosen."""

BELOW = 0.9
"""Longer side of other words over the hero's, at most, where they give way. Chosen."""


@final
class LedByHero(RunStep):
    """A cloud in which no word is larger than the hero; that some are is said where it cannot be.

    The heaviest become as high as each other, so that no word is higher than a heavier one.

    Parameters
    ----------
    listed
        Steps of a cloud, by whether all words are made smaller than the hero at the end.
    """

    def __init__(self, listed: Callable[[bool], Sequence[RunStep]]) -> None:
        self._listed = listed
        self.share = share_of(listed(False))

    def run(self, state: RunState, context: RunContext) -> RunState:
        """State of the cloud, measured."""
        job, found = state.job, run_steps(self._listed(False), state, context)
        hero = hero_of(job)
        if hero is None:
            return found
        first, sizes, has_led = job.items[hero].name, _sizes(job, found), False
        for number in range(MOST_RUNS + 1):
            if not (sizes > sizes[hero]).any() or context.stop():
                break
            extents = _extents(job)
            scales = sizes / extents
            most = BELOW * sizes[hero] / extents[sizes > sizes[hero]].max()
            share = np.minimum(most / np.maximum(scales, most), 1.0) ** 2
            share[hero] = 1.0
            job = replace(job, weights=job.weights * share)
            found = run_steps(self._listed(number == MOST_RUNS), RunState.of(job), context)
            sizes, has_led = _sizes(job, found), True
        pairs = zip(job.items, sizes, strict=True)
        larger = [item.name for item, size in pairs if size > sizes[hero]]
        if larger:
            return found.with_finding(
                Sentence.LARGER_THAN_HERO, names=enumerated(larger), hero=first
            )
        return found.with_finding(Sentence.HERO_LEADS, hero=first) if has_led else found


@final
class BelowHero(RunStep):
    """All words, in proportion, smaller than the hero."""

    def run(self, state: RunState, context: RunContext) -> RunState:
        """State with exact poses of such sizes."""
        hero, poses = hero_of(state.job), state.poses
        sizes = _extents(state.job) * poses.scale
        if hero is None or sizes[hero] == sizes.max():
            return state
        scale = poses.scale * (BELOW * sizes[hero] / sizes.max())
        scale[hero] = poses.scale[hero]
        return at_sizes(state, scale, context)


def hero_of(job: Job) -> int | None:
    """Row of the hero; None if there is none."""
    sources = (one.sources.get("pin.size", RuleSource("")) for one in job.asked)
    return next((k for k, source in enumerate(sources) if source.key == "hero"), None)


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


@final
class FewerWords(RunStep):
    """Fewer and fewer words, the heaviest, until all letters are as large as asked.

    Parameters
    ----------
    smallest
        Least font size, canvas units.
    """

    def __init__(
        self, listed: Callable[[Job], Sequence[RunStep]], job: Job, smallest: float
    ) -> None:
        self._listed, self._smallest = listed, smallest
        self.share = share_of(listed(job))

    def run(self, state: RunState, context: RunContext) -> RunState:
        """State of the words whose letters are large enough; others count as not drawn."""
        use = words_of(state.job)
        # Some could not even be large enough in the fullest cloud.
        sizes = hopeful_sizes(use.read, use.letters, state.job.container.outline.area)
        hopeful = int(np.count_nonzero(sizes >= self._smallest))
        job = heaviest_of(state.job, hopeful, sizes, self._smallest)
        for attempt in count(1):
            found = run_steps(self._listed(job), RunState.of(job), context)
            read = words_of(found.job).read
            sizes = letters_of(found.poses, len(read.items))
            enough = readable_count(read, self._smallest, sizes, attempt)
            if context.stop() or enough == len(read.items):
                break
            job = heaviest_of(job, enough, sizes, self._smallest)
        return found


def heaviest_of(job: Job, number: int, sizes: FloatArray, smallest: float) -> Job:
    """Job of fewer words, what rules ask of them, and what is mixed in.

    Parameters
    ----------
    sizes
        ``(n,)`` what the letters of each would measure.
    smallest
        Least font size, canvas units.
    """
    use = words_of(job)
    if number == len(use.read.items):
        return job
    words = heaviest(use.read, number, sizes, smallest, job.container.unit)
    others = without(job.items, use.read.items)
    chosen = cast_words(job.recipe, words, list(dict.fromkeys(others)))
    gone = without(use.read.items, words.items)
    weights = chosen.weights
    if job.plan.share is not None:
        weights = shared_out(chosen.items, weights, words.items, job.plan.share)
    return replace(
        job,
        use=replace(use, read=words),
        items=chosen.items,
        asked=chosen.asked,
        weights=weights,
        regions=read_regions(chosen.asked, job.container),
        fillers=without(job.fillers, gone),
    )


def without(items: Sequence[Item], gone: Sequence[Item]) -> tuple[Item, ...]:
    """Items but those that are gone: a word that is not there is not repeated either."""
    known = set(gone)
    return tuple(item for item in items if item not in known)
