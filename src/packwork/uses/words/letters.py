"""Bounds on letter sizes: the largest limited, words with too small ones left out.

Sizes stay in the proportion of the weights. So where the lightest words would come out
smaller than was asked they are left out, by name, and the others grow into their room.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import final

import numpy as np

from packwork.arrays import FloatArray
from packwork.errors import RecipeError
from packwork.pipeline.state import RunState
from packwork.pipeline.step import RunStep
from packwork.pipeline.watch import RunContext
from packwork.readers.words.items import EM_PX, MOST_SHOWN, WordsRead
from packwork.readers.words.options import WordOptions
from packwork.recipe import Sizes
from packwork.recipe.refusals import length_asked
from packwork.scene.container import Container
from packwork.scene.pose import Poses
from packwork.steps.finish import finished
from packwork.units import Unit

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
        """Bounds that words are asked to keep in a container on its canvas.

        Raises
        ------
        RecipeError
            If one is no length, they cross, or sizes are neither shared nor graded.
        """
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

    def run(self, state: RunState, watch: RunContext) -> RunState:
        """State with exact poses of such sizes."""
        most = float(letters_of(state.poses, len(state.job.use.words)).max())
        if most <= self._largest:
            return state
        return at_sizes(state, state.poses.scale * (self._largest / most), watch)


def at_sizes(state: RunState, scale: FloatArray, watch: RunContext) -> RunState:
    """State with exact poses at smaller scales ``(n,)``.

    A smaller copy may meet others, where letters stand in each other's bays.
    """
    job = state.job
    fixed = job.replanned(sizes="fixed")
    with job.clock.time("finish"):
        poses = replace(state.poses, scale=scale)
        found = finished(replace(state, job=fixed, poses=poses), watch)
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

    Raises
    ------
    RecipeError
        If there is not even one.
    """
    if count == 0:
        raise RecipeError(
            "smallest",
            f"not even {words.items[0].name[:MOST_SHOWN]!r} can be so large in this container; "
            "use a smaller length, a larger canvas or another container",
        )
    reasons = {
        word.text: f"its letters would be {size:.3g} {unit} high, less than the "
        f"{smallest:.3g} {unit} of --smallest"
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
