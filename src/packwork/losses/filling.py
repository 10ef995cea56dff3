"""Filling loss: minus the container's mean coverage, a reward."""

from __future__ import annotations

import numpy as np

from packwork.arrays import Image
from packwork.losses.overlap import SLACK
from packwork.losses.term import Term


def filling(density: Image, container: Image) -> Term:
    """Minus the mean of container covered, of images ``(rows, columns)``: items grow into gaps.

    Examples
    --------
    >>> term = filling(np.array([[0.5, 2.0]]), np.ones((1, 2)))
    >>> term.value, term.adjoint.tolist()
    (-0.75, [[-0.5, -0.0]])
    """
    free = density <= 1 + SLACK
    return Term(
        -float(np.mean(np.minimum(density, 1) * container)),
        (-(free * container) / density.size).astype(density.dtype),
    )
