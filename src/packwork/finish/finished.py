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
    poses
        Where the items are now.
    clean
        Whether no two items, and no item and the edge, are nearer than was asked.
    conflicts
        What is still in conflict; empty if clean.
    undersized
        Items that found no room at the size that they should have at least.
    rounds
        Linear programmes for each item.
    seconds
        Time taken.
    small
        What is said of items a little smaller than free sizes go; empty if none is.
    """

    poses: Poses
    clean: bool
    conflicts: tuple[Conflict, ...]
    undersized: tuple[int, ...]
    rounds: int
    seconds: float
    small: str = ""

    @classmethod
    def as_is(cls, poses: Poses) -> Finished:
        """Poses that no finish has seen: nothing is known of them."""
        return cls(poses, False, (), (), 0, 0.0)
