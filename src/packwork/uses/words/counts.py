"""Number of words needed for a container's shape to show."""

from __future__ import annotations

from packwork.pipeline.plan.counts import items_needed
from packwork.pipeline.read import AUTO
from packwork.readers.words.options import WordOptions
from packwork.scene.container import Container
from packwork.uses.room import KnownContainer

FEWEST_WORDS = 60
"""Words that a cloud has at least: fewer look like a list. Chosen by eye."""


def words_needed(container: Container) -> int:
    """Words for which the container's shape shows."""
    # Words are larger and smaller ones as they come, whether all keep their shares or not.
    return max(items_needed(container).count, FEWEST_WORDS)


def words_counted(asked: WordOptions, room: KnownContainer) -> WordOptions:
    """Options of a recipe's words, with a number in place of ``auto``."""
    if asked.count != AUTO:
        return asked
    return asked.model_copy(update={"count": words_needed(room.known)})
