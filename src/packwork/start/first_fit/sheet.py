"""A container as whole pixels, each taken or not."""

from __future__ import annotations

import numpy as np

from packwork.arrays import BoolArray, FloatArray
from packwork.start.first_fit import _kernels
from packwork.start.first_fit.stencil import Stencil

LEVELS = 10
"""Lengths of runs that are looked at in one step: powers of two up to 512."""

MOST_RING = 96
"""Pixels round a stencil that are looked at, at most: every so manieth of a longer ring."""


class Sheet:
    """Which pixels are taken; it finds places in them by bits, 64 pixels at a time.

    Parameters
    ----------
    free
        ``(rows, columns)`` the pixels that may be taken.
    margin
        Pixels by which a ring may reach out of a box.

    Examples
    --------
    >>> from packwork.geometry.outline import Outline
    >>> from packwork.start.first_fit.stencil import cut_all
    >>> tile = Outline.from_rings([np.array([[0.0, 0], [2, 0], [2, 2], [0, 2]])])
    >>> stencil = cut_all({"tile": tile}, 1)["tile"]
    >>> sheet = Sheet(np.ones((2, 5), dtype=bool), 1)
    >>> noise = np.zeros((2, 5))
    >>> for _ in range(3):
    ...     score, row, column = sheet.best_place(stencil, noise)
    ...     print(round(score, 2), row, column)
    ...     if score > 0: sheet.take(stencil, row, column)
    0.83 0 0
    0.83 0 2
    -1.0 -1 -1
    """

    def __init__(self, free: BoolArray, margin: int) -> None:
        height, width = free.shape
        self.shape = (height, width)
        self._margin = margin
        # Beyond the picture all is taken; bits, and bytes to count touched ones on.
        self.taken = np.ones((height + 2 * margin, width + 2 * margin), dtype=np.uint8)
        self.taken[margin : margin + height, margin : margin + width] = ~free
        self._words = -(-width // 64)
        self._rows = np.full((height, LEVELS, self._words), _kernels.ALL, dtype=np.uint64)
        self._free = np.empty((height, self._words), dtype=np.uint64)
        self._refresh(0, height)

    def _refresh(self, top: int, bottom: int) -> None:
        height, width = self.shape
        inner = self.taken[self._margin : self._margin + height, self._margin :][:, :width]
        bits = np.ones((bottom - top, self._words * 64), dtype=np.uint8)
        bits[:, :width] = inner[top:bottom]
        self._rows[top:bottom, 0] = np.packbits(bits, axis=1, bitorder="little").view("<u8")
        _kernels.smear(self._rows, top, bottom)

    def best_place(
        self, stencil: Stencil, noise: FloatArray, allowed: BoolArray | None = None
    ) -> tuple[float, int, int]:
        """Score, row and column for the stencil's box where it touches most; -1 if none.

        Parameters
        ----------
        noise
            ``(rows, columns)`` added to the scores, which are 0 to 1.
        allowed
            ``(rows, columns)`` where the origin may come to; None for anywhere.
        """
        height = stencil.mask.shape[0]
        _kernels.find_free(self._rows, stencil.runs, height, self._free)
        ring = stencil.ring
        if len(ring) > MOST_RING:
            ring = ring[:: -(-len(ring) // MOST_RING)]
        steps = ring[:, 0] * self.taken.shape[1] + ring[:, 1]
        allowed = np.zeros((0, 0), dtype=np.bool_) if allowed is None else allowed
        origin = np.array(stencil.origin)
        score, row, column = _kernels.best_touching(
            self._free, self.taken, self._margin, steps, noise, allowed, origin
        )
        return float(score), int(row), int(column)

    def take(self, stencil: Stencil, row: int, column: int) -> None:
        """Put the stencil's box there; what of it lies off the sheet is not kept."""
        height, width = stencil.mask.shape
        top, left = max(row, 0), max(column, 0)
        bottom, right = min(row + height, self.shape[0]), min(column + width, self.shape[1])
        if top >= bottom or left >= right:
            return
        m = self._margin
        self.taken[top + m : bottom + m, left + m : right + m] |= stencil.mask[
            top - row : bottom - row, left - column : right - column
        ]
        self._refresh(top, bottom)
