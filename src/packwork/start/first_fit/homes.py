"""Where items that are put one by one had better lie."""

from __future__ import annotations

from dataclasses import dataclass

from packwork.arrays import FloatArray


@dataclass(frozen=True, eq=False)
class Homes:
    """Points near which items had better lie.

    Parameters
    ----------
    points
        ``(n, 2)``, canvas units.
    pull
        Score that an item gives for lying the canvas' side nearer to its own.
    """

    points: FloatArray
    pull: float
