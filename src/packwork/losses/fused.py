"""The default losses together, as the solver runs them."""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np

from packwork.arrays import Image
from packwork.losses import _kernels
from packwork.losses.evenness import TYPICAL_ITEMS, Windows
from packwork.losses.overlap import SLACK


@dataclass(frozen=True)
class FusedWeights:
    """Weights of the fused losses at one moment of a run.

    Parameters
    ----------
    containment, overlap, filling, evenness
        All at least zero. Only their ratios matter to the result.
    """

    containment: float = 0.0
    overlap: float = 0.0
    filling: float = 0.0
    evenness: float = 0.0


FUSED = tuple(field.name for field in fields(FusedWeights))
"""Names of the losses that are evaluated together."""


class FusedAdjoint:
    """Adjoint of the weighted default losses straight from the accumulation buffer.

    Equal to the weighted sum of the adjoints of :func:`containment`, :func:`overlap`,
    :func:`filling` and :func:`evenness` times the number of pixels; one pass over the
    image instead of seven, two with evenness.

    Parameters
    ----------
    container
        ``(rows, columns)`` coverage of the container.
    items
        How many items share it: sets the size of evenness' windows.

    Examples
    --------
    >>> fused = FusedAdjoint(np.ones((1, 2)))
    >>> fused(np.array([[0.5, 2.0], [0.0, 0.0]]), FusedWeights(1, 5, 2)).tolist()
    [[-2.0, 5.0]]
    """

    def __init__(self, container: Image, items: int = TYPICAL_ITEMS) -> None:
        self._items = items
        self._container = container
        self._running = np.zeros(container.shape[1], dtype=container.dtype)
        self._line = np.zeros_like(self._running)
        self._adjoint = np.empty_like(container)
        self._windows: Windows | None = None
        self._empty: Image = np.zeros((1, 1), dtype=container.dtype)

    def __call__(self, accumulation: Image, weights: FusedWeights) -> Image:
        """Adjoint ``(rows, columns)`` per unit of density; the next call reuses it.

        ``accumulation``: ``(rows + 1, columns)``, consumed: it is zero afterwards.
        """
        as_pixel = self._container.dtype.type
        emphasis, factor = self._emphasis(accumulation, weights.evenness)
        _kernels.adjoint(
            accumulation, self._container, self._running, self._line, emphasis, factor,
            as_pixel(weights.containment), as_pixel(weights.overlap),
            as_pixel(weights.filling), as_pixel(1 + SLACK), self._adjoint,
        )  # fmt: skip
        return self._adjoint

    def _emphasis(self, accumulation: Image, weight: float) -> tuple[Image, int]:
        """Price of covering a pixel for evenness, per block, and a block's side."""
        if weight == 0:
            return np.zeros((1, 1), dtype=accumulation.dtype), max(accumulation.shape)
        if self._windows is None:
            self._windows = Windows(self._container, self._items)
            self._empty = np.empty_like(self._windows.blocks(self._container))
        factor = self._windows.factor
        _kernels.gaps(accumulation, self._container, self._running, self._line, self._empty, factor)
        emphasis = self._windows.derivative(self._empty)
        emphasis *= emphasis.dtype.type(weight * self._container.size)
        return emphasis, factor
