"""Containment, overlap and filling together, as the solver runs them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from packwork.arrays import Image
from packwork.losses import _kernels
from packwork.losses.overlap import SLACK


@dataclass(frozen=True)
class LinearWeights:
    """Weights of the three linear losses at one moment of a run.

    Parameters
    ----------
    containment, overlap, filling
        All at least zero. Only their ratios matter to the result.
    """

    containment: float
    overlap: float
    filling: float


class LinearAdjoint:
    """Adjoint of the weighted built-in losses straight from the accumulation buffer.

    Equal to the weighted sum of the adjoints of :func:`containment`, :func:`overlap`
    and :func:`filling` times the number of pixels; one pass instead of seven.

    Parameters
    ----------
    container
        ``(rows, columns)`` coverage of the container.

    Examples
    --------
    >>> fused = LinearAdjoint(np.ones((1, 2)))
    >>> fused(np.array([[0.5, 2.0], [0.0, 0.0]]), LinearWeights(1, 5, 2)).tolist()
    [[-2.0, 5.0]]
    """

    def __init__(self, container: Image) -> None:
        self._container = container
        self._running = np.zeros(container.shape[1], dtype=container.dtype)
        self._adjoint = np.empty_like(container)

    def __call__(self, accumulation: Image, weights: LinearWeights) -> Image:
        """Consume ``accumulation`` (it is zero afterwards); the result is reused."""
        as_pixel = self._container.dtype.type
        _kernels.linear_adjoint(
            accumulation, self._container, self._running, self._adjoint,
            as_pixel(weights.containment), as_pixel(weights.overlap),
            as_pixel(weights.filling), as_pixel(1 + SLACK),
        )  # fmt: skip
        return self._adjoint
