"""Findings of a run beside poses: items without a place, voids that were filled, words read."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from typing import Any


@dataclass(frozen=True)
class Unplaced:
    """An item that found no place of its own, and why."""

    item: str
    index: int
    reason: str


@dataclass(frozen=True)
class Filling:
    """Report on filling the voids between items.

    Parameters
    ----------
    covered, target
        Shares of the container that are covered, and that were to be; None if as much as
        goes.
    """

    added: int
    ending: str
    covered: float
    target: float | None

    @property
    def is_short(self) -> bool:
        """Whether less is covered than was asked for."""
        return self.target is not None and self.covered < self.target


@dataclass(frozen=True)
class WordsFound:
    """Number of different words that a source holds, and of those that were to be set.

    Parameters
    ----------
    of_true
        Where sizes gave way, of each word its size as a share of its proportion to the heaviest.
    """

    found: int
    asked: int
    of_true: Mapping[str, float] = field(default_factory=dict)


def plain(one: Filling | WordsFound | None) -> dict[str, Any] | None:
    """Plain values of a part of a result, for JSON; None if there is no such part."""
    return None if one is None else asdict(one)
