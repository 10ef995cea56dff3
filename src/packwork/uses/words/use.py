"""Words of a text or a table as items, some icons and photographs among them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import final

import numpy as np

from packwork.arrays import FloatArray
from packwork.errors import PackworkError
from packwork.finish.finished import Finished
from packwork.phrasing import enumerated, number_of
from packwork.pipeline.advice import MOST_BARE, smaller_copies
from packwork.pipeline.beginning import Beginning
from packwork.pipeline.job import Job
from packwork.pipeline.measure import Unmeasured, measured
from packwork.pipeline.plan.plan import found_sizes
from packwork.pipeline.plan.regions import read_regions
from packwork.pipeline.plan.shares import shared_out
from packwork.pipeline.plan.vectors import ItemVectors
from packwork.pipeline.read import AUTO, Material, read_named
from packwork.pipeline.result import Run, Unplaced, WordsFound
from packwork.pipeline.run import along
from packwork.pipeline.use import OwnPlaces, Use
from packwork.pipeline.watch import Watch
from packwork.progress import Stop
from packwork.readers.vectors import Vectors
from packwork.readers.words.items import EM_PX, MOST_SHOWN, WordsRead, read_word_items
from packwork.readers.words.options import WordOptions
from packwork.recipe import Recipe
from packwork.recipe.arrangement import unknown_measure
from packwork.recipe.meaning import FROM_TEXT, parse_anchor
from packwork.scene.item import Item
from packwork.scene.layout import Layout
from packwork.scene.pose import Poses
from packwork.uses.photos.crop import crops
from packwork.uses.room import Room
from packwork.uses.words.cast import cast_words
from packwork.uses.words.colours import check_colours, word_colours
from packwork.uses.words.columns import column_values, columns_there
from packwork.uses.words.counts import words_counted, words_needed
from packwork.uses.words.graded import Places, can_give_way, graded_places
from packwork.uses.words.heroes import below_hero, led_by_hero
from packwork.uses.words.letters import (
    Letters,
    heaviest,
    held_down,
    hopeful_sizes,
    letters_of,
    readable_count,
)
from packwork.uses.words.repeats import REPEATED, with_repeats

MANY = 40
"""Words of which a container is to look full. Fewer leave it bare whatever their sizes, and are
compared with each other. Chosen."""

LEAST_SHOWN = 0.9
"""Share of a container's shape that a full cloud shows at least. Seen in clouds of running text:
at .83 to .88 a part of a circle holds nothing but specks, whole ones come to .96. By eye."""

DUST = 0.2
"""Share of a container far from any word above which hardly anything of it is seen. By eye."""

WORDS_REACH = 0.6
"""Share of a container that smaller copies of words come to cover. Larger is not always reached,
and then counts as not met. Tried."""


@final
@dataclass(frozen=True, eq=False)
class Words(Use):
    """Words that are read, and what else is asked of them.

    Parameters
    ----------
    read
        The words among the items; they come first.
    options
        As asked.
    letters
        How large they may be.
    places
        Where they lie, if their sizes give way in turn; None until that is known, or else.
    is_below_hero
        Whether all become smaller where some came out larger than the hero.
    """

    read: WordsRead
    options: WordOptions
    letters: Letters
    places: Places | None = None
    is_below_hero: bool = False

    def run(self, job: Job, watch: Watch) -> Run:
        """The common road; where many words in proportion leave the container bare, again."""
        found = self._set(job, watch)
        if job.plan.sizes == "shared" and job.recipe.hero is not None:
            return led_by_hero(job, partial(self._led, watch=watch), found, watch)
        seen, many = found.metrics.seen, len(self.read.items) >= MANY
        is_bare = many and (seen.bare > MOST_BARE or seen.shape < LEAST_SHOWN)
        is_ours = job.recipe.sizes == AUTO and job.plan.sizes == "shared" and can_give_way(job)
        if not (is_bare and is_ours) or watch.stop():
            return found
        graded = self._set(replace(job, plan=replace(job.plan, sizes="graded")), watch)
        fuller = graded.metrics.seen
        is_fuller = fuller.bare <= seen.bare and fuller.shape > seen.shape
        # Better a full cloud of the heavier words than dust of all.
        is_kept = graded.is_as_asked or (graded.certified and seen.bare > DUST)
        return graded if is_fuller and is_kept else found

    def _led(self, job: Job, is_bounded: bool, watch: Watch) -> Run:
        """A run in which all words are smaller than the hero, if that is asked for."""
        use = replace(self, is_below_hero=is_bounded)
        return use._set(replace(job, use=use), watch)

    def _set(self, job: Job, watch: Watch) -> Run:
        """The common road, and words set again in what is left."""
        placed = along(job, watch)
        if self.options.repeat == "auto" and placed.exact.clean and placed.job.plan.is_exact:
            use = placed.job.use
            count, paper = len(use.words), self.options.paper or "white"
            placed = with_repeats(placed, count, self.letters, paper, watch.stop)
        return measured(Unmeasured.of(placed))

    @property
    def words(self) -> Sequence[Item]:
        """The words among the items."""
        return self.read.items

    def suits_first_fit(self, count: int, is_turning: bool) -> bool:
        """However many: levels leave letters no room, and thousands of words become specks."""
        del count, is_turning
        return True

    def before(self, job: Job, stop: Stop) -> Job:
        """Job without words that could not even be large enough in the fullest cloud.

        Where sizes give way in turn, that of the words that find a place, and their places.
        """
        if job.plan.sizes == "graded" and job.recipe.sizes == AUTO and not can_give_way(job):
            job = replace(job, plan=replace(job.plan, sizes="shared"))
        if job.plan.sizes == "graded":
            return self._with_places(job, stop)
        smallest = self.letters.smallest
        if smallest is None:
            return job
        sizes = hopeful_sizes(self.read, self.letters, job.container.outline.area)
        count = int(np.count_nonzero(sizes >= smallest))
        return self._with_heaviest(job, count, sizes, smallest)

    def fewer(self, job: Job, poses: Poses, attempt: int) -> Job:
        """The job itself if all letters are large enough; else one of fewer words."""
        smallest = self.letters.smallest
        if smallest is None or self.places is not None:
            return job
        sizes = letters_of(poses, len(self.read.items))
        count = readable_count(self.read, smallest, sizes, attempt)
        return self._with_heaviest(job, count, sizes, smallest)

    def bounded(self, job: Job, start: Beginning, exact: Finished, watch: Watch) -> Finished:
        """Exact poses whose letters are no larger than asked."""
        if self.is_below_hero:
            exact = below_hero(job, start, exact, watch)
        count, largest = len(self.read.items), self.letters.largest
        return held_down(job, start, exact, count, largest, watch)

    def filler_scales(
        self, job: Job, exact: Finished, smallest: FloatArray, largest: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """Copies of words are to be read, and smaller than the words themselves."""
        if job.plan.voids.has_own:
            return smallest, largest
        if self.letters.smallest:
            smallest = np.full(len(smallest), self.letters.smallest / EM_PX)
        known = dict(zip(job.items, exact.poses.scale, strict=True))
        own = np.array([known[item] for item in job.fillers])
        return smallest, np.minimum(largest, REPEATED * own)

    def missing(self, start: int) -> tuple[Unplaced, ...]:
        """Words that could not be drawn, numbered from ``start``: after the items."""
        return tuple(
            Unplaced(word[:MOST_SHOWN], index, reason)
            for index, (word, reason) in enumerate(self.read.undrawn.items(), start=start)
        )

    def words_found(self, layout: Layout) -> WordsFound:
        """How many words the source holds, how many were to be set, and which gave way."""
        asked = len(self.read.items) + len(self.read.undrawn)
        return WordsFound(self.read.found, asked, self._of_true(layout))

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
        """What the words' table says of each in a column: numbers, or texts by the alphabet."""
        found = column_values(self.read, job, name)
        if found is None:
            raise unknown_measure(name, columns_there(self.read))
        return found

    @property
    def palette_tints(self) -> bool:
        """Not among words, whose palette is theirs: emoji and icons keep their colours there."""
        return False

    @property
    def has_nearest(self) -> bool:
        """Not among words either."""
        return False

    def redrawn(self, job: Job, gone: Sequence[Item]) -> tuple[Item, ...]:
        """Words that left, set as the run's own: a layout file has outlines only."""
        source = {item.source: 1.0 for item in gone}
        try:
            asked = self.options.model_copy(update={"source": source, "count": len(source)})
            return read_word_items(asked, job.plan.holes).items
        except PackworkError:
            # Pictures among words, or words that this run's fonts lack: their outlines serve.
            return ()

    def remarks(self, job: Job) -> tuple[str, ...]:
        """How many words the run chose, and how many it left out since they say little."""
        stopped: tuple[str, ...] = ()
        if words := self.read.stopped:
            many = number_of(len(words), "function word is", "function words are")
            names = enumerated(words)
            stopped = (f"{many} left out ({names}); --language none keeps them",)
        if self.places is not None and job.recipe.sizes == AUTO:
            is_thin = found_sizes(job.recipe, job.container) == "graded"
            why = "the container is thin" if is_thin else "in proportion they would leave it bare"
            said = f"{why}, so sizes of words give way; --sizes shared keeps proportions"
            stopped = (*stopped, said)
        if self.options.count == AUTO:
            return (f"auto chose {number_of(len(job.items), 'word')}", *stopped)
        return (*super().remarks(job), *stopped)

    def remedy(self, job: Job) -> str:
        """More words, if there are more; and sizes that give way, or else smaller copies."""
        count = len(self.read.items)
        said = []
        if self.read.found > count:
            needed = max(words_needed(job.container), 2 * count)
            said = [f"-n {min(needed, self.read.found)} would show more of it"]
        if job.plan.sizes == "shared" and can_give_way(job):
            said.append("--sizes graded, whose proportions give way, would fill it")
        else:
            said.append(smaller_copies(job.plan.voids, WORDS_REACH))
        return "; ".join(said)

    @property
    def own_places(self) -> OwnPlaces | None:
        """Places of words whose sizes give way in turn."""
        return None if self.places is None else OwnPlaces(self.places.poses, self.places.limits)

    def _of_true(self, layout: Layout) -> dict[str, float]:
        """Sizes as shares of their proportion to the heaviest, of words that gave way in turn."""
        if self.places is None:
            return {}
        # The words themselves come first, copies of them last.
        pairs = list(zip(layout.items, layout.poses.scale, strict=True))
        scales = {id(item): scale for item, scale in reversed(pairs)}
        own = np.array([item.outline.area for item in self.read.items])
        true = np.sqrt(self.read.areas / own)
        first = scales.get(id(self.read.items[0]), np.nan) / true[0]
        return {
            item.name: round(float(scales[id(item)] / height / first), 4)
            for item, height in zip(self.read.items, true, strict=True)
            if id(item) in scales
        }

    def _with_places(self, job: Job, stop: Stop) -> Job:
        """Job of the words that find a place, each as large as it does."""
        with job.clock.time("start"):
            places = graded_places(job, self.letters, stop)
        gone = np.setdiff1d(np.arange(len(job.items)), places.placed)
        words = places.placed[places.placed < len(self.read.items)]
        reason = "finds no place at a size that could be read; use fewer words or a larger canvas"
        undrawn = {job.items[k].name: reason for k in gone}
        read = replace(
            self.read,
            items=tuple(self.read.items[k] for k in words),
            areas=self.read.areas[words],
            words=tuple(self.read.words[k] for k in words),
            undrawn={**undrawn, **self.read.undrawn},
        )
        return replace(
            job.some(places.placed),
            use=replace(self, read=read, places=places),
            fillers=without(job.fillers, [job.items[k] for k in gone]),
        )

    def _with_heaviest(self, job: Job, count: int, sizes: FloatArray, smallest: float) -> Job:
        """Job of fewer words, what rules ask of them, and what is mixed in."""
        if count == len(self.read.items):
            return job
        words = heaviest(self.read, count, sizes, smallest, job.container.unit)
        before = {id(item) for item in self.read.items}
        others = {id(item): item for item in job.items if id(item) not in before}
        chosen = cast_words(job.recipe, words, list(others.values()))
        kept = {id(item) for item in words.items}
        gone = [item for item in self.read.items if id(item) not in kept]
        return replace(
            job,
            use=replace(self, read=words),
            items=chosen.items,
            asked=chosen.asked,
            weights=shared_out(chosen.items, chosen.weights, words.items, job.plan.share),
            regions=read_regions(chosen.asked, job.container),
            fillers=without(job.fillers, gone),
        )


def without(items: Sequence[Item], gone: Sequence[Item]) -> tuple[Item, ...]:
    """Items but those that are gone: a word that is not there is not repeated either."""
    known = {id(item) for item in gone}
    return tuple(item for item in items if id(item) not in known)


def nesting(asked: WordOptions, recipe: Recipe, room: Room) -> WordOptions:
    """Options that say whether words stand in counters: unless asked, where sizes give way."""
    if asked.nest is not None or room.container is None:
        return asked
    return asked.model_copy(update={"nest": found_sizes(recipe, room.container) == "graded"})


def read_cloud(
    recipe: Recipe, asked: WordOptions, room: Room, given: Sequence[Item] | None
) -> Material:
    """Words of a recipe, and the items and photographs among them."""
    # Refuses cut photographs among words.
    crops(recipe)
    asked = nesting(asked, recipe, room)
    is_related = recipe.embeddings == FROM_TEXT
    counted = words_counted(asked, room)
    words = read_word_items(counted, recipe.holes, recipe, is_related=is_related)
    check_colours(recipe, words)
    named = read_named(recipe, given)
    chosen = cast_words(recipe, words, named.items)
    container = room.of(chosen)
    return Material(
        use=Words(words, asked, Letters.of(asked, container, recipe.sizes)),
        container=container,
        cast=chosen,
        fillers=words.items,
        given=None if words.order is None else (*words.order, *named.keys),
        skipped=(*named.skipped, *words.told),
    )
