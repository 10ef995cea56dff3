"""Overlap loss: mean density above one, where items cover a place twice."""

from __future__ import annotations

import numpy as np

from packwork.arrays import Image
from packwork.losses.term import Term

SLACK = 1e-4
"""Density above one that still counts as one: float32 coverage is good to this. Larger
hides real overlap, smaller turns rounding into force. Derived."""


def overlap(density: Image, container: Image) -> Term:
    """Mean density above one, of images ``(rows, columns)``.

    Wang and Lu 2025, section 3.3, count pixels that are too opaque, which has no
    gradient; this is the rectified excess that their own code uses.

    Examples
    --------
    >>> term = overlap(np.array([[1.0, 2.0]]), np.ones((1, 2)))
    >>> term.value, term.adjoint.tolist()
    (0.5, [[0.0, 0.5]])
    """
    excess = density > 1 + SLACK
    return Term(
        float(np.mean(np.where(excess, density - 1, 0))),
        (excess / density.size).astype(density.dtype),
    )
