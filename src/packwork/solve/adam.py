"""Adam with one step length per quantity.

D. Kingma and J. Ba, "Adam: a method for stochastic optimization", ICLR 2015, arXiv:1412.6980. Ours
shares the second moment among the components of an item, and ties epsilon to the size of the
typical gradient.
"""

from __future__ import annotations

import numpy as np

from packwork.arrays import FloatArray, IntArray
from packwork.solve import _kernels

STILLNESS = 1.5e-2
"""Gradients this small against the typical one move an item less than a full step.
Adam divides by the gradient's own size, so without it a trapped item, whose forces
cancel to rounding noise, would dance at full speed. Larger slows settling. Tried."""


class Adam:
    """Moments of one quantity of n items, possibly a vector of several components.

    Components of one item share their second moment, so that a step's direction does
    not depend on how the canvas is turned.

    Parameters
    ----------
    shape
        ``(n, components)``.
    decay
        Of the first and of the second moment; both 0.9 as in Wang and Lu 2025.

    Examples
    --------
    >>> adam = Adam((1, 2))
    >>> adam.step(np.array([[3.0, 4.0]]), 1.0).round(2).tolist()
    [[-0.59, -0.79]]
    """

    def __init__(self, shape: tuple[int, int], decay: tuple[float, float] = (0.9, 0.9)) -> None:
        self._mean = np.zeros(shape)
        self._square = np.zeros(shape[0])
        self._change = np.zeros(shape)
        self._decay = decay
        self._count = 0

    def step(self, gradient: FloatArray, rate: float) -> FloatArray:
        """Change ``(n, components)`` of the quantity, in its unit, about ``rate`` long.

        ``gradient``: of the same shape. The next call reuses the result.
        """
        self._count += 1
        # Columns of a wider array would need a kernel of their own.
        _kernels.adam(
            np.ascontiguousarray(gradient), self._mean, self._square, *self._decay, self._count,
            STILLNESS, rate, self._change,
        )  # fmt: skip
        return self._change

    def forget(self, items: list[int]) -> None:
        """Start the moments of these items anew, after they were moved by force."""
        self._mean[items] = 0.0
        self._square[items] = np.mean(self._square)

    def go_on_from(self, other: Adam, mine: IntArray, theirs: IntArray) -> None:
        """Take over what another has learnt about some items: ``theirs`` there, ``mine`` here.

        Examples
        --------
        >>> one, two = Adam((1, 1)), Adam((3, 1))
        >>> step = one.step(np.array([[3.0]]), 1.0)
        >>> two.go_on_from(one, np.array([2]), np.array([0]))
        >>> two.step(np.zeros((3, 1)), 1.0)[:, 0].round(1).tolist()
        [-0.0, -0.0, -0.7]
        """
        self._mean[mine] = other._mean[theirs]
        self._square[:] = np.mean(other._square)
        self._square[mine] = other._square[theirs]
        self._count = other._count
