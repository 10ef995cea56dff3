"""Room that items which are still to come need."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from packwork.geometry.outline import Outline

DENSE = 0.9
"""Share of the free room that boxes of small items are taken to fill. Larger leaves more of the
last items out, smaller makes all smaller than they need to be. Tried."""


class Reserve:
    """Room that items which are still to come need, by their lengths.

    Parameters
    ----------
    lengths
        Of all items; none asks for no room.
    apart_cu
        Room between two of them, canvas units.

    Examples
    --------
    >>> reserve = Reserve([3.0] * 5, 0.0)
    >>> reserve.add(Outline.box(0.0, 0.0, 6.0, 2.0))
    >>> reserve.common_size(1, 4 * 12.0 / DENSE)
    1.0
    """

    def __init__(self, lengths: Sequence[float], apart_cu: float) -> None:
        self._lengths, self._apart = np.asarray(lengths, dtype=np.float64), apart_cu
        self._boxes = list[tuple[float, float]]()

    def emptied(self) -> Reserve:
        """The same before any item was seen."""
        return Reserve(self._lengths.tolist(), self._apart)

    def add(self, outline: Outline) -> None:
        """See the next item."""
        left, top, right, bottom = outline.bounds
        self._boxes.append((right - left, bottom - top))

    def common_size(self, number: int, room: float) -> float:
        """Scale at which all items from one on have room, side by side; infinite if unknown."""
        to_come = self._lengths[number:]
        if len(to_come) == 0:
            return math.inf
        known = self._lengths[: len(self._boxes)]
        widths, heights = np.array(self._boxes).T
        wide = float(widths.sum() / max(known.sum(), 1.0)) * to_come
        high = float(heights.mean())
        # (w s + a) (h s + a), summed, is the room.
        square, sides = float(wide.sum()) * high, float(wide.sum()) + high * len(to_come)
        linear, rest = self._apart * sides, len(to_come) * self._apart**2 - DENSE * room
        if rest >= 0:
            return 0.0
        return (math.sqrt(linear**2 - 4 * square * rest) - linear) / (2 * square)
