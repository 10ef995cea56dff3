"""Report of a cloud: words that could not be drawn, sizes that gave way, what was left out."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, cast, final

from packwork.phrasing import enumerated, number_of
from packwork.pipeline.findings import Unplaced, WordsFound
from packwork.pipeline.job import Job
from packwork.pipeline.plan.plan import found_sizes
from packwork.pipeline.read import AUTO
from packwork.pipeline.state import RunState
from packwork.pipeline.step import RunStep
from packwork.pipeline.watch import RunContext
from packwork.readers.words.items import MOST_SHOWN

if TYPE_CHECKING:
    from packwork.uses.words.use import WordsUse


def words_of(job: Job) -> WordsUse:
    """The use of a job whose items are words; steps of words are on lists of no other."""
    return cast("WordsUse", job.use.inner)


@final
class ReportWords(RunStep):
    """Words that the source holds, and those that could not be drawn."""

    def run(self, state: RunState, watch: RunContext) -> RunState:
        """State with these among what is unplaced, numbered after the items."""
        use, (layout, _) = words_of(state.job), state.measured
        undrawn = tuple(
            Unplaced(word[:MOST_SHOWN], index, reason)
            for index, (word, reason) in enumerate(use.read.undrawn.items(), start=state.placed)
        )
        asked = len(use.read.items) + len(use.read.undrawn)
        words = WordsFound(use.read.found, asked, use.of_true(layout))
        return replace(state, unplaced=(*state.unplaced, *undrawn), words=words)


@final
class RemarkWords(RunStep):
    """Sentences about words that were left out since they say little, and sizes that give way."""

    def run(self, state: RunState, watch: RunContext) -> RunState:
        """State with the remarks."""
        job, use, said = state.job, words_of(state.job), list[str]()
        if use.options.count == AUTO:
            said.append(f"auto chose {number_of(len(job.items), 'word')}")
        if words := use.read.stopped:
            many = number_of(len(words), "function word is", "function words are")
            said.append(f"{many} left out ({enumerated(words)}); --language none keeps them")
        if use.gives_way and job.recipe.sizes == AUTO:
            is_thin = found_sizes(job.recipe, job.container) == "graded"
            why = "the container is thin" if is_thin else "in proportion they would leave it bare"
            said.append(f"{why}, so sizes of words give way; --sizes shared keeps proportions")
        return replace(state, remarks=(*state.remarks, *said))


@final
class RemarkGap(RunStep):
    """A sentence about a gap that is narrower than usual, for there are so many words."""

    def run(self, state: RunState, watch: RunContext) -> RunState:
        """State with the remark."""
        job, unit = state.job, state.job.container.unit
        usual = job.recipe.padding_cu(job.container)
        said = f"so many words stand {job.plan.gap:.2g} {unit} apart, not {usual:g} {unit}"
        return replace(state, remarks=(*state.remarks, f"{said}; another --padding is kept"))
