"""Result of an exact finish."""

from __future__ import annotations

from dataclasses import dataclass

from packwork.compaction.conflicts import Conflict
from packwork.scene.pose import Poses


@dataclass(frozen=True, eq=False)
class Finished:
    """Result of a finish.

    Parameters
    ----------
    clean
        Whether no two items, and no item and the edge, are nearer than was asked.
    undersized
        Items that found no room at the size that they should have at least.
    rounds
        Linear programmes for each item.
    """

    poses: Poses
    clean: bool
    conflicts: tuple[Conflict, ...]
    undersized: tuple[int, ...]
    rounds: int
    seconds: float
