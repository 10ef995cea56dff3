"""Changed rectangle between one frame and the next."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt


@dataclass(frozen=True)
class Rectangle:
    """A rectangle of a frame, in whole pixels."""

    top: int
    left: int
    bottom: int
    right: int

    @property
    def rows(self) -> slice:
        """For an array."""
        return slice(self.top, self.bottom)

    @property
    def columns(self) -> slice:
        """For an array."""
        return slice(self.left, self.right)


def changed_part(changed: npt.NDArray[np.bool_]) -> Rectangle:
    """Smallest rectangle that holds all that changed; one pixel if nothing did.

    Examples
    --------
    >>> seen = np.zeros((4, 6), dtype=bool)
    >>> seen[1, 2] = seen[2, 4] = True
    >>> changed_part(seen)
    Rectangle(top=1, left=2, bottom=3, right=5)
    """
    rows, columns = np.flatnonzero(changed.any(axis=1)), np.flatnonzero(changed.any(axis=0))
    if len(rows) == 0:
        return Rectangle(0, 0, 1, 1)
    return Rectangle(int(rows[0]), int(columns[0]), int(rows[-1]) + 1, int(columns[-1]) + 1)
