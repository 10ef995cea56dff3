"""Words of a text or a table as items, some icons and photographs among them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from itertools import count
from typing import TypeAlias, final

import numpy as np

from packwork.arrays import FloatArray
from packwork.errors import PackworkError
from packwork.offers import Verbs
from packwork.pipeline.job import Job
from packwork.pipeline.plan.padding import check_padding
from packwork.pipeline.plan.regions import read_regions
from packwork.pipeline.plan.shares import shared_out
from packwork.pipeline.plan.vectors import ItemVectors
from packwork.pipeline.read import AUTO
from packwork.pipeline.result import Run
from packwork.pipeline.state import RunState
from packwork.pipeline.step import RunStep, run_steps, share_of
from packwork.pipeline.use import Use
from packwork.pipeline.watch import RunContext
from packwork.readers.vectors import Vectors
from packwork.readers.words.items import EM_PX, WordsRead, read_word_items
from packwork.readers.words.options import WordOptions
from packwork.recipe import Recipe
from packwork.recipe.arrangement import unknown_measure
from packwork.recipe.meaning import parse_anchor
from packwork.recipe.verbs import VERBS
from packwork.scene.item import Item
from packwork.scene.layout import Layout
from packwork.steps.advice import MOST_BARE, smaller_copies
from packwork.steps.control import Replan, Retry
from packwork.uses.collage import filling, placing, reporting
from packwork.uses.words.cast import cast_words
from packwork.uses.words.colours import word_colours
from packwork.uses.words.columns import column_values, columns_there
from packwork.uses.words.counts import words_needed
from packwork.uses.words.graded import can_give_way, graded_places
from packwork.uses.words.heroes import BelowHero, LedByHero
from packwork.uses.words.letters import (
    Letters,
    LettersAtMost,
    heaviest,
    hopeful_sizes,
    letters_of,
    readable_count,
)
from packwork.uses.words.repeats import REPEATED, RepeatWords
from packwork.uses.words.report import RemarkGap, RemarkWords, ReportWords, words_of

MANY = 40
"""Words of which a container is to look full. Fewer leave it bare whatever their sizes, and are
compared with each other. Chosen."""

LEAST_SHOWN = 0.9
"""Share of a container's shape that a full cloud shows at least. Seen in clouds of running text:
at .83 to .88 a part of a circle holds nothing but specks, whole ones come to .96. By eye."""

DUST = 0.2
"""Share of a container far from any word above which hardly anything of it is seen. By eye."""

CLOSE = 0.1
"""Gap between words at most where none was asked for, over the side of a word's share of the
container. Larger leaves thousands of words too little room to be read, smaller lets fewer stand
closer than they usually do. By eye: from 900 words in a circle on."""

WORDS_REACH = 0.6
"""Share of a container that smaller copies of words come to cover. Larger is not always reached,
and then counts as not met. Tried."""


@final
@dataclass(frozen=True, eq=False)
class WordsUse(Use):
    """Words that are read, and what else is asked of them.

    Parameters
    ----------
    gives_way
        Whether each is as large as it found a place in its turn.
    """

    read: WordsRead
    options: WordOptions
    letters: Letters
    gives_way: bool = False

    # A palette of words is theirs: emoji and icons among them keep their colours.
    palette_tints = has_nearest = False

    def steps(self, job: Job) -> Sequence[RunStep]:
        """Steps of a cloud, closer together where there are so many words."""
        gap = close_gap(job)
        if gap >= job.plan.gap:
            return self._listed(job)
        closer = job.replanned(gap=gap)
        return [Replan(gap=gap), *self._listed(closer), RemarkGap()]

    def _listed(self, job: Job) -> list[RunStep]:
        """Sizes in proportion; where they leave the container bare, sizes that give way in turn."""
        graded = [Replan(sizes="graded"), *self._graded(job)]
        if job.plan.sizes == "graded" and (job.recipe.sizes != AUTO or can_give_way(job)):
            return graded
        first: list[RunStep] = []
        if job.plan.sizes == "graded":
            first = [Replan(sizes="shared")]
            job = job.replanned(sizes="shared")
        is_shared = job.plan.sizes == "shared"
        if is_shared and job.recipe.hero is not None:
            return [*first, LedByHero(lambda is_bounded: self._placed(job, is_bounded))]
        shared = self._placed(job)
        if is_shared and job.recipe.sizes == AUTO and can_give_way(job):
            return [*first, Retry(shared, graded, fills_container, fuller)]
        return [*first, *shared]

    def report(self, job: Job) -> Sequence[RunStep]:
        """Measures and looks, words that could not be drawn, what was left out."""
        return [*reporting(job, is_dressed=True, found=[ReportWords()]), RemarkWords()]

    def _placed(self, job: Job, is_below_hero: bool = False) -> list[RunStep]:
        """Words whose sizes are not graded, measured."""
        bounds: list[RunStep] = [BelowHero()] if is_below_hero else []
        if self.letters.largest is not None:
            bounds.append(LettersAtMost(self.letters.largest))

        def listed(job: Job) -> list[RunStep]:
            # However many: levels leave letters no room, and thousands of words become specks.
            return placing(job, suits_first_fit=True, bounds=bounds)

        smallest, steps = self.letters.smallest, listed(job)
        if smallest is not None:
            steps = [FewerWords(listed, job, smallest)]
        return [*steps, *self._filled(job), *self.report(job)]

    def _graded(self, job: Job) -> list[RunStep]:
        """Words each as large as it finds a place in its turn, measured."""
        bounds: list[RunStep] = []
        if self.letters.largest is not None:
            bounds.append(LettersAtMost(self.letters.largest))
        places = GradedPlaces(self.letters)
        placed = placing(job, suits_first_fit=True, bounds=bounds, place=places)
        return [*placed, *self._filled(job), *self.report(job)]

    def _filled(self, job: Job) -> list[RunStep]:
        """Copies in voids, and words set again in what is left."""
        steps = filling(job, self._filler_scales)
        if self.options.repeat == "auto" and job.plan.is_exact:
            steps.append(RepeatWords(self.letters, self.options.paper or "white"))
        return steps

    def _filler_scales(
        self, state: RunState, smallest: FloatArray, largest: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """Copies of words are to be read, and smaller than the words themselves."""
        job = state.job
        if job.plan.voids.has_own:
            return smallest, largest
        if self.letters.smallest:
            smallest = np.full(len(smallest), self.letters.smallest / EM_PX)
        known = dict(zip(job.items, state.poses.scale, strict=True))
        own = np.array([known[item] for item in job.fillers])
        return smallest, np.minimum(largest, REPEATED * own)

    @property
    def words(self) -> Sequence[Item]:
        """The words among the items."""
        return self.read.items

    def colours(self, job: Job, layout: Layout) -> Sequence[str | None] | None:
        """Colours by weight, column, picture or function, if asked for."""
        return word_colours(job.recipe, self.read, layout)

    def vectors(self, recipe: Recipe) -> ItemVectors:
        """Vectors of the words by the text that they come from."""
        rows = self.read.vectors
        if rows is None:
            return super().vectors(recipe)
        known = np.any(rows, axis=1)
        names = [word.text for word in self.read.words]
        words = Vectors("the text", tuple(names), rows)
        asked = map(parse_anchor, recipe.anchors)
        anchors = tuple((one.angle, words.called(one.name)) for one in asked)
        return ItemVectors.of_rows(self.read.items, rows, known, anchors=anchors)

    def column(self, job: Job, name: str) -> FloatArray:
        """Column of the words' table: numbers, or texts by the alphabet."""
        found = column_values(self.read, job, name)
        if found is None:
            raise unknown_measure(name, columns_there(self.read))
        return found

    def redrawn(self, job: Job, gone: Sequence[Item]) -> tuple[Item, ...]:
        """Words that left, set as the run's own: a layout file has outlines only."""
        source = {item.source: 1.0 for item in gone}
        try:
            asked = self.options.model_copy(update={"source": source, "count": len(source)})
            return read_word_items(asked, job.plan.holes).items
        except PackworkError:
            # Pictures among words, or words that this run's fonts lack: their outlines serve.
            return ()

    def remedy(self, job: Job) -> str:
        """More words, if there are more; and sizes that give way, or else smaller copies."""
        count = len(self.read.items)
        said = []
        if self.read.found > count:
            needed = max(words_needed(job.container), 2 * count)
            said = [f"-n {min(needed, self.read.found)} would show more of it"]
        # Fewer leave it bare with whatever sizes.
        is_cloud = self.read.found >= MANY
        if job.plan.sizes == "shared" and is_cloud and can_give_way(job):
            said.append("--sizes graded, whose proportions give way, would fill it")
        else:
            said.append(smaller_copies(job.plan.voids, WORDS_REACH))
        return "; ".join(said)

    def of_true(self, layout: Layout) -> dict[str, float]:
        """Sizes as shares of their proportion to the heaviest, of words that gave way in turn."""
        if not self.gives_way:
            return {}
        # The words themselves come first, copies of them last.
        pairs = list(zip(layout.items, layout.poses.scale, strict=True))
        scales = dict(reversed(pairs))
        own = np.array([item.outline.area for item in self.read.items])
        true = np.sqrt(self.read.areas / own)
        first = scales.get(self.read.items[0], np.nan) / true[0]
        return {
            item.name: round(float(scales[item] / height / first), 4)
            for item, height in zip(self.read.items, true, strict=True)
            if item in scales
        }


def close_gap(job: Job) -> float:
    """Gap no wider than suits so many words, if none was asked for, canvas units.

    The usual one is a share of the canvas: thousands of words would be specks between gaps.
    """
    if job.recipe.padding != VERBS[Verbs.WORDS].defaults["padding"]:
        return job.plan.gap
    most = CLOSE * float(np.sqrt(job.container.outline.area / len(job.items)))
    return min(job.plan.gap, most)


def fills_container(state: RunState) -> bool:
    """Whether words in proportion make a full cloud, or are too few to."""
    _, metrics = state.measured
    is_full = metrics.seen.bare <= MOST_BARE and metrics.seen.shape >= LEAST_SHOWN
    return is_full or len(words_of(state.job).read.items) < MANY


def fuller(tried: Sequence[RunState], watch: RunContext) -> RunState:
    """Of a cloud in proportion and one whose sizes give way, the second if it is plainly better."""
    found, graded = tried
    seen, more = found.measured[1].seen, graded.measured[1].seen
    is_fuller = more.bare <= seen.bare and more.shape > seen.shape
    # Better a full cloud of the heavier words than dust of all.
    is_kept = Run.of(graded).is_as_asked or (graded.certified and seen.bare > DUST)
    return graded if is_fuller and is_kept else found


@final
class GradedPlaces(RunStep):
    """Words whose sizes give way: each as large as it finds a place in its turn."""

    def __init__(self, letters: Letters) -> None:
        self._letters = letters

    def run(self, state: RunState, watch: RunContext) -> RunState:
        """State of the words that find a place; the others count as not drawn."""
        job, words = state.job, words_of(state.job)
        with job.clock.time("start"):
            places = graded_places(job, self._letters, watch.stop)
        gone = np.setdiff1d(np.arange(len(job.items)), places.placed)
        kept = places.placed[places.placed < len(words.read.items)]
        reason = "finds no place at a size that could be read; use fewer words or a larger canvas"
        undrawn = {job.items[k].name: reason for k in gone}
        read = replace(
            words.read,
            items=tuple(words.read.items[k] for k in kept),
            areas=words.read.areas[kept],
            words=tuple(words.read.words[k] for k in kept),
            undrawn={**undrawn, **words.read.undrawn},
        )
        smaller = replace(
            job.subset(places.placed),
            use=replace(words, read=read, gives_way=True),
            fillers=without(job.fillers, [job.items[k] for k in gone]),
        )
        check_padding(job.container, job.plan.gap, len(smaller.items))
        return replace(
            RunState.of(smaller), poses=places.poses, nominal=places.poses.scale,
            limits=places.limits, method="first-fit", is_tight=True, is_only_refined=True,
        )  # fmt: skip


Listed: TypeAlias = Callable[[Job], Sequence[RunStep]]
"""Steps that place the words of a job."""


@final
class FewerWords(RunStep):
    """Fewer and fewer words, the heaviest, until all letters are as large as asked.

    Parameters
    ----------
    smallest
        Least font size, canvas units.
    """

    def __init__(self, listed: Listed, job: Job, smallest: float) -> None:
        self._listed, self._smallest = listed, smallest
        self.share = share_of(listed(job))

    def run(self, state: RunState, watch: RunContext) -> RunState:
        """State of the words whose letters are large enough; others count as not drawn."""
        use = words_of(state.job)
        # Some could not even be large enough in the fullest cloud.
        sizes = hopeful_sizes(use.read, use.letters, state.job.container.outline.area)
        hopeful = int(np.count_nonzero(sizes >= self._smallest))
        job = heaviest_of(state.job, hopeful, sizes, self._smallest)
        for attempt in count(1):
            found = run_steps(self._listed(job), RunState.of(job), watch)
            read = words_of(found.job).read
            sizes = letters_of(found.poses, len(read.items))
            enough = readable_count(read, self._smallest, sizes, attempt)
            if watch.stop() or enough == len(read.items):
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
