"""A container as whole pixels, each taken or not."""

from __future__ import annotations

import math

import numpy as np

from packwork.arrays import BoolArray, FloatArray
from packwork.fields.clearance import distance_inside
from packwork.fields.distance_transform import distance_to
from packwork.start.first_fit import _kernels
from packwork.start.first_fit.stencil import TALLEST, Stencil

LEVELS = 10
"""Widths of boxes that are looked at in one step: powers of two up to 512."""

MOST_FRINGE = 96
"""The same unless more are asked for."""


class Occupancy:
    """Bitmap of the taken pixels; it finds places by bits, 64 pixels at a time.

    Parameters
    ----------
    free
        ``(rows, columns)`` the pixels that may be taken.
    margin
        Pixels by which a fringe may reach out of a box.
    most_fringe
        Pixels round a stencil that are looked at, at most: every so manieth of a longer fringe.

    Examples
    --------
    >>> from packwork.geometry.outline import Outline
    >>> from packwork.start.first_fit.stencil import cut
    >>> tile = Outline.from_rings([np.array([[0.0, 0], [2, 0], [2, 2], [0, 2]])])
    >>> stencil = cut(tile, 1)
    >>> occupancy = Occupancy(np.ones((2, 5), dtype=bool), 1)
    >>> worth = np.zeros((2, 5))
    >>> while (place := occupancy.best_place(stencil, worth)) is not None:
    ...     score, row, column = place
    ...     print(round(score, 2), row, column)
    ...     occupancy.take(stencil.mask, row, column)
    0.83 0 0
    0.83 0 2
    """

    def __init__(self, free: BoolArray, margin: int, most_fringe: int = MOST_FRINGE) -> None:
        height, width = free.shape
        self.shape = (height, width)
        self._margin, self._most_fringe = margin, most_fringe
        # Beyond the picture all is taken; bits, and bytes to count touched ones on.
        self.taken = np.ones((height + 2 * margin, width + 2 * margin), dtype=np.uint8)
        self.taken[margin : margin + height, margin : margin + width] = ~free
        self._words = -(-width // 64)
        self._rows = np.full(
            (height, TALLEST + 1, LEVELS, 2 * self._words + 1), _kernels.ALL, dtype=np.uint64
        )
        self._free = np.empty((height, self._words), dtype=np.uint64)
        self._clearance: FloatArray | None = None
        self._widest: FloatArray = np.zeros(height)  # of each row: most rows stay as they are
        self.widest = 0.0
        """Largest clearance, once that has been asked for."""
        self._refresh(0, height)

    def _refresh(self, top: int, bottom: int) -> None:
        height, width = self.shape
        inner = self.taken[self._margin : self._margin + height, self._margin :][:, :width]
        bits = np.ones((bottom - top, self._words * 64), dtype=np.uint8)
        bits[:, :width] = inner[top:bottom]
        self._rows[top:bottom, 0, 0, : self._words] = np.packbits(
            bits, axis=1, bitorder="little"
        ).view("<u8")
        _kernels.smear(self._rows, self._words, top, bottom)

    def best_place(
        self,
        stencil: Stencil,
        worth: FloatArray,
        is_everywhere: bool = False,
        field: FloatArray | None = None,
        pull: float = 1.0,
    ) -> tuple[float, int, int] | None:
        """Score, row and column for the stencil's box where it touches most; None if none.

        Parameters
        ----------
        worth
            ``(rows, columns)`` added to the score, which is 0 to 1, where the origin comes to;
            minus infinity where it may not.
        is_everywhere
            Look at places that touch nothing, too.
        field, pull
            ``(rows, columns)`` that is added as well, so many times; None for none.
        """
        height = stencil.mask.shape[0]
        _kernels.find_free(self._rows, stencil.boxes, height, self._free)
        if not self._free.any():
            return None
        fringe = stencil.fringe
        if len(fringe) > self._most_fringe:
            fringe = fringe[:: -(-len(fringe) // self._most_fringe)]
        steps = fringe[:, 0] * self.taken.shape[1] + fringe[:, 1]
        origin = np.array(stencil.origin)
        score, row, column = _kernels.best_touching(
            self._free, self.taken, self._margin, steps, worth,
            worth if field is None else field, 0.0 if field is None else float(pull),
            origin, is_everywhere,
        )  # fmt: skip
        return (float(score), int(row), int(column)) if row >= 0 else None

    def take(self, mask: BoolArray, row: int, column: int) -> None:
        """Take the pixels of a mask put there; what of it lies off the image is not kept."""
        height, width = mask.shape
        top, left = max(row, 0), max(column, 0)
        bottom, right = min(row + height, self.shape[0]), min(column + width, self.shape[1])
        if top >= bottom or left >= right:
            return
        m = self._margin
        self.taken[top + m : bottom + m, left + m : right + m] |= mask[
            top - row : bottom - row, left - column : right - column
        ]
        self._refresh(top, bottom)
        if self._clearance is not None:
            self._lessen(self._clearance, top, bottom, left, right)

    @property
    def clearance(self) -> FloatArray:
        """``(rows, columns)`` pixels to the nearest taken one; kept up from the first call on."""
        if self._clearance is None:
            height, width = self.shape
            m = self._margin
            self._clearance = distance_inside(self.taken[m : m + height, m : m + width] == 0)
            self._widest = self._clearance.max(axis=1)
            self.widest = float(self._widest.max())
        return self._clearance

    def _lessen(self, clearance: FloatArray, top: int, bottom: int, left: int, right: int) -> None:
        """Clearance round a box in which pixels have been taken."""
        reach = math.ceil(self.widest)
        rows = slice(max(top - reach, 0), min(bottom + reach, self.shape[0]))
        columns = slice(max(left - reach, 0), min(right + reach, self.shape[1]))
        m = self._margin
        near = self.taken[rows.start + m : rows.stop + m, columns.start + m : columns.stop + m]
        window = clearance[rows, columns]
        # Not ``distance_inside``: the window's own edge is no edge.
        away = distance_to(near != 0) - 0.5
        np.minimum(window, np.maximum(away, 0.0), out=window)
        self._widest[rows] = clearance[rows].max(axis=1)
        self.widest = float(self._widest.max())
