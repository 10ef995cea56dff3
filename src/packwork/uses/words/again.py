"""Words that are items already, in a run whose sizes give way as those of a text do."""

from __future__ import annotations

from dataclasses import replace

from packwork.pipeline.job import Job
from packwork.pipeline.read import AUTO
from packwork.readers.words.items import WordsRead
from packwork.readers.words.options import Word, WordOptions
from packwork.uses.words.sizes import Letters
from packwork.uses.words.use import WordsUse


def with_sizes_that_give_way(job: Job) -> Job:
    """The run of items that are words, in proportion as far as that leaves the container full."""
    names = [item.name for item in job.items]
    pairs = zip(names, job.weights.tolist(), strict=True)
    words = tuple(Word(name, weight) for name, weight in pairs)
    read = WordsRead(job.items, job.weights, words, {}, len(words))
    asked = WordOptions(source=dict.fromkeys(names, 1.0), count=len(words))
    recipe = job.recipe.model_copy(update={"sizes": AUTO})
    return replace(job, recipe=recipe, use=WordsUse(read, asked, Letters(), len(words)))
