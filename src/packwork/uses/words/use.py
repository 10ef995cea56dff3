"""Words of a text or a table as items, some icons and photographs among them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import final

import numpy as np

from packwork.arrays import FloatArray
from packwork.errors import PackworkError
from packwork.phrasing import enumerated, number_of
from packwork.pipeline.findings import Sentence, Unplaced, WordsFound
from packwork.pipeline.job import Job, Use
from packwork.pipeline.plan.plan import found_sizes
from packwork.pipeline.plan.vectors import ItemVectors
from packwork.pipeline.read import Material, read_named
from packwork.pipeline.result import Run
from packwork.pipeline.state import RunContext, RunState, RunStep
from packwork.readers.vectors import Vectors
from packwork.readers.words.items import WordsRead, read_word_items
from packwork.readers.words.options import WordOptions
from packwork.readers.words.shaping import EM_PX
from packwork.readers.words.word import Word
from packwork.recipe import AUTO, Recipe
from packwork.recipe.order import FROM_TEXT, parse_anchor, unknown_measure
from packwork.scene.item import Item
from packwork.scene.layout import Layout
from packwork.steps.close_gap import RemarkGap, close_gap
from packwork.steps.control import BestOf, Replan, Retry
from packwork.steps.shortfalls import CLEARLY_MORE, MOST_BARE, more_copies
from packwork.steps.track import StartRecording
from packwork.uses.collage import filling, placing, reporting
from packwork.uses.icons import KnownContainer, best_balanced
from packwork.uses.photos.crop import crops
from packwork.uses.words.along import RoundTheEdge, SetAlong
from packwork.uses.words.colours import check_colours, word_colours
from packwork.uses.words.copies import (
    cast_words,
    column_values,
    columns_there,
    for_letters,
    nesting,
    words_counted,
    words_needed,
    words_of,
)
from packwork.uses.words.fitted import (
    FitWords,
    StackWords,
    beside,
    gap_of_few,
    goes_by_letters,
    least_gap,
)
from packwork.uses.words.graded import GradedPlaces, can_give_way
from packwork.uses.words.grown import GrowWords
from packwork.uses.words.repeats import REPEATED, RepeatWords
from packwork.uses.words.sizes import BelowHero, FewerWords, LedByHero, Letters, LettersAtMost

MANY = 40
"""Words of which a container is to look full. Fewer leave it bare whatever their sizes, and are
compared with each other. Chosen."""

FEW = 12
"""Words of one weight that are set in lines, at most. More make a cloud. By eye."""

LEAST_SHOWN = 0.9
"""Share of a container's shape that a full cloud shows at least. Seen in clouds of running text:
at .83 to .88 a part of a circle holds nothing but specks, whole ones come to .96. By eye."""

DUST = 0.2
"""Share of a container far from any word above which hardly anything of it is seen. By eye."""

CLOSE = 0.1
"""Gap between words at most where none was asked for, over the side of a word's share of the
container. Larger leaves thousands of words too little room to be read, smaller lets fewer stand
closer than they usually do. By eye: from 900 words in a circle on."""


@final
@dataclass(frozen=True, eq=False)
class WordsUse(Use):
    """Words that are read, and what else is asked of them.

    Parameters
    ----------
    count
        Words that were read, some of which may have been left out since.
    gives_way
        Whether each is as large as it found a place in its turn.
    """

    read: WordsRead
    options: WordOptions
    letters: Letters
    count: int
    gives_way: bool = False

    # A palette of words is theirs: emoji and icons among them keep their colours.
    palette_tints = has_nearest = False

    def steps(self, job: Job) -> Sequence[RunStep]:
        """Sizes in proportion; where they leave the container bare, sizes that give way in turn."""
        recording: list[RunStep] = [StartRecording()] if job.is_recorded else []
        if self.options.along is not None or self.options.ring:
            placed = self._on_curves(job)
            if self.options.ring:
                placed = [RoundTheEdge(self.options.ring, self._on_curves)]
            found = [*recording, *self._filled(job), *self.report(job)]
            return [Replan(sizes="graded"), *placed, *found]
        if self._stacks(job):
            cloud = placing(job.replanned(sizes="shared"), suits_first_fit=True)
            cloud = [Replan(sizes="shared"), *cloud]
            lines = [Replan(sizes="free"), *recording, StackWords(cloud)]
            placed = [BestOf([lines, cloud], best_balanced)]
            return [*placed, *self._filled(job), *self.report(job)]
        graded = [Replan(sizes="graded"), *_closer(job, self._graded)]
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
            return [*first, Retry(shared, graded, self._will_do, fuller)]
        return [*first, *shared]

    def report(self, job: Job) -> Sequence[RunStep]:
        """Measures and looks, words that could not be drawn, what was left out."""
        # Along limbs no more than their middles is to be seen.
        shows = self.options.along != "limbs"
        found = [ReportWords()]
        told = reporting(job, is_dressed=True, shows_shape=shows, found=found)
        return [*told, RemarkWords()]

    def _stacks(self, job: Job) -> bool:
        """Whether words are few, upright and of one weight: sizes that go by room say nothing.

        At one size the longest is as wide as the container, and leaves most of that bare.
        """
        plan, letters = job.plan, self.letters
        is_equal = len({word.weight for word in self.read.words}) == 1
        is_few = 1 < len(job.items) == len(self.read.items) <= FEW
        is_auto = job.recipe.sizes == AUTO and job.recipe.hero is None and can_give_way(job)
        # A line is as long as a container is wide: letters of a container show no line of theirs.
        is_one = job.container.lattice is None and len(job.container.outline.parts) == 1
        is_plain = plan.is_exact and plan.rotation.limit == 0.0
        has_bounds = letters.smallest is not None or letters.largest is not None
        return is_equal and is_few and is_auto and is_one and is_plain and not has_bounds

    def _will_do(self, state: RunState) -> bool:
        """Whether words in proportion make a full cloud, or are too few to."""
        seen = state.measured[1].seen
        is_full = seen.bare <= MOST_BARE and seen.shape >= LEAST_SHOWN
        return is_full or self.count < MANY

    def _placed(self, job: Job, is_below_hero: bool = False) -> list[RunStep]:
        """Words whose sizes are not graded, measured."""
        by_letters = goes_by_letters(job) and not is_below_hero
        bounds: list[RunStep] = [BelowHero()] if is_below_hero else []
        if self.letters.largest is not None:
            bounds.append(LettersAtMost(self.letters.largest))

        def listed(job: Job) -> list[RunStep]:
            # However many: levels leave letters no room, and thousands of words become specks.
            steps = placing(job, suits_first_fit=True, bounds=bounds)
            if not by_letters:
                return steps
            then: list[RunStep] = [StartRecording()] if job.is_recorded else []
            return [FitWords([*then, GrowWords(beside(job) * EM_PX)], steps), *bounds]

        def all_of(job: Job) -> list[RunStep]:
            smallest, steps = self.letters.smallest, listed(job)
            if smallest is not None:
                steps = [FewerWords(listed, job, smallest)]
            return [*steps, *self._filled(job), *self.report(job)]

        few = job.plan.gap if is_below_hero else gap_of_few(job)
        if not by_letters and few == job.plan.gap:
            return _closer(job, all_of)
        gap = least_gap(job) if by_letters else few
        return [Replan(gap=gap), *all_of(job.replanned(gap=gap))]

    def _graded(self, job: Job) -> list[RunStep]:
        """Words each as large as it finds a place in its turn, measured."""
        return [*self._graded_places(job), *self._filled(job), *self.report(job)]

    def _on_curves(self, job: Job) -> list[RunStep]:
        """Words along limbs or the edge where that is asked, else as large as they find a place."""
        if self.options.along is None:
            return self._graded_places(job)
        return [SetAlong(self.options.along, self.letters, self._graded_places)]

    def _graded_places(self, job: Job) -> list[RunStep]:
        """The same before they are measured."""
        bounds: list[RunStep] = []
        if self.letters.largest is not None:
            bounds.append(LettersAtMost(self.letters.largest))
        places = GradedPlaces(self.letters)
        return placing(job, suits_first_fit=True, bounds=bounds, place=places)

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
        placed, found, said = len(self.read.items), self.read.found, list[str]()
        count = min(max(words_needed(job.container), 2 * placed), found)
        if count > CLEARLY_MORE * placed:
            said.append(Sentence.MORE_OF_THEM.of(count=count))
        # Fewer leave it bare with whatever sizes; of automatic ones graded ones have been tried.
        was_tried = job.recipe.sizes == AUTO and self.count >= MANY
        if job.container.lattice is not None:
            if job.plan.sizes != "free":
                said.append(Sentence.FREE_SIZES.of())
        elif job.plan.sizes == "shared" and found >= MANY and can_give_way(job) and not was_tried:
            said.append(Sentence.GRADED.of())
        elif job.plan.voids.target is not None:
            said.append(more_copies(job.plan.voids))
        elif self.options.repeat != "auto" and job.plan.is_exact:
            # A share of the container that is asked for may not be reached, and counts as not met.
            said.append(Sentence.REPEATED.of())
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


def _closer(job: Job, listed: Callable[[Job], list[RunStep]]) -> list[RunStep]:
    """Steps of a cloud, closer together where there are so many words."""
    gap = close_gap(job, CLOSE)
    if gap >= job.plan.gap:
        return listed(job)
    return [Replan(gap=gap), *listed(job.replanned(gap=gap)), RemarkGap("words")]


def fuller(tried: Sequence[RunState], context: RunContext) -> RunState:
    """Of a cloud in proportion and one whose sizes give way, the second if it is plainly better."""
    found, graded = tried
    seen, more = found.measured[1].seen, graded.measured[1].seen
    is_fuller = more.bare <= seen.bare and more.shape > seen.shape
    # Better a full cloud of the heavier words than dust of all.
    is_kept = Run.of(graded).is_as_asked or (graded.certified and seen.bare > DUST)
    return graded if is_fuller and is_kept else found


def with_sizes_that_give_way(job: Job) -> Job:
    """The run of items that are words, in proportion as far as that leaves the container full."""
    names = [item.name for item in job.items]
    words = tuple(map(Word, names, job.weights.tolist()))
    read = WordsRead(job.items, job.weights, words, {}, len(words))
    asked = WordOptions(source=dict.fromkeys(names, 1.0), count=len(words))
    recipe = job.recipe.model_copy(update={"sizes": AUTO})
    return replace(job, recipe=recipe, use=WordsUse(read, asked, Letters(), len(words)))


def read_cloud(
    recipe: Recipe, asked: WordOptions, room: KnownContainer, given: Sequence[Item] | None
) -> Material:
    """Words of a recipe, and the items and photographs among them."""
    # Refuses cut photographs among words.
    crops(recipe)
    asked = nesting(asked, recipe, room)
    is_related = recipe.embeddings == FROM_TEXT
    counted = words_counted(asked, room)
    read = read_word_items(counted, recipe.holes, recipe, is_related=is_related)
    words = for_letters(read, recipe, room)
    check_colours(recipe, words)
    named = read_named(recipe, given)
    chosen = cast_words(recipe, words, named.items)
    container = room.of(chosen)
    return Material(
        use=WordsUse(words, asked, Letters.of(asked, container, recipe.sizes), len(words.items)),
        container=container,
        cast=chosen,
        fillers=tuple(dict.fromkeys(words.items)),
        given=None if words.order is None else (*words.order, *named.keys),
        skipped=(*named.skipped, *words.told),
    )


@final
class ReportWords(RunStep):
    """Words that the source holds, and those that could not be drawn."""

    def run(self, state: RunState, context: RunContext) -> RunState:
        """State with these among what is unplaced, numbered after the items."""
        use, (layout, _) = words_of(state.job), state.measured
        undrawn = tuple(
            Unplaced(word[:40], index, reason)
            for index, (word, reason) in enumerate(use.read.undrawn.items(), start=state.placed)
        )
        # Words along limbs may be set again and again.
        asked = len({word.text for word in use.read.words}) + len(use.read.undrawn)
        words = WordsFound(use.read.found, asked, use.of_true(layout))
        return replace(state, unplaced=(*state.unplaced, *undrawn), words=words)


@final
class RemarkWords(RunStep):
    """Sentences about words that were left out since they say little, and sizes that give way."""

    def run(self, state: RunState, context: RunContext) -> RunState:
        """State with the remarks."""
        job, use = state.job, words_of(state.job)
        items, kinds = use.read.items, len(set(use.read.items))
        if use.options.count == AUTO:
            state = state.with_finding(Sentence.COUNT, many=number_of(kinds, "word"))
        if words := use.read.stopped:
            many = number_of(len(words), "function word is", "function words are")
            state = state.with_finding(Sentence.STOPWORDS, many=many, names=enumerated(words))
        if kinds < len(items):
            many = number_of(kinds, "word is", "words are")
            said = Sentence.READ_LETTERS
            state = state.with_finding(said, many=many, total=len(items), option="--repeat none")
        follows = use.options.along is not None or use.options.ring
        if use.gives_way and job.recipe.sizes == AUTO and not follows:
            is_thin = found_sizes(job.recipe, job.container) == "graded"
            why = Sentence.THIN if is_thin else Sentence.LEFT_BARE
            state = state.with_finding(Sentence.GIVES_WAY, why=why.of())
        return state
