"""What a stage tells and asks: steps, observers, stopping."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol, TypeAlias

from packwork.scene.pose import Poses


@dataclass(frozen=True, eq=False)
class Step:
    """One moment of a run.

    Parameters
    ----------
    level, levels
        Index of the level (from 0) and how many there are.
    resolution
        Pixels on the longer side at this level.
    epoch
        Epochs done, over all levels.
    progress
        How far the run is, 0 to 1.
    poses
        Where the items are now.
    coverage, overlap, outside
        Image-space shares of the container at this level: covered, covered twice,
        and covered outside it.
    is_finish
        Whether this is of the exact finish, after the last level.
    """

    level: int
    levels: int
    resolution: int
    epoch: int
    progress: float
    poses: Poses
    coverage: float
    overlap: float
    outside: float
    is_finish: bool = False


class Observer(Protocol):
    """Whoever wants to know: a progress bar, a film, a log."""

    every: int
    """Epochs between two steps that it is told; the last of a level is always told."""

    def on_step(self, step: Step) -> None:
        """Receive a step; must not change it."""
        ...


Stop: TypeAlias = Callable[[], bool]
"""Asked before every epoch; True ends the run with what it has."""


def never() -> bool:
    """Let the run go to its end."""
    return False
