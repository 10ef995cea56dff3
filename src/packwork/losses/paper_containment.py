"""The paper's squared error between items and container."""

from __future__ import annotations

import numpy as np

from packwork.arrays import Image
from packwork.losses.term import Term

OUTSIDE = 100.0
"""Weight of an error outside the container, against 1 inside (the paper's)."""


def paper_containment(density: Image, container: Image) -> Term:
    """Mean squared difference of covered and container, outside a hundred times dearer.

    Of images ``(rows, columns)``.

    Wang and Lu 2025, section 3.3. Inside, covered is min(density, 1), as black items on
    white compose; outside it is the density itself, so that coincident items there are
    still pushed back.

    Examples
    --------
    >>> term = paper_containment(np.array([[0.5, 2.0]]), np.array([[1.0, 0.0]]))
    >>> term.value, term.adjoint.tolist()
    (200.125, [[-0.5, 200.0]])
    """
    short = np.minimum(density - container, 1 - container)
    inside = container * short
    beyond = density * (1 - container)
    value = float(np.mean(inside * short)) + OUTSIDE * float(np.mean(beyond * density))
    free = density < 1
    adjoint = (2 / density.size) * (inside * free + OUTSIDE * beyond)
    return Term(value, adjoint.astype(density.dtype))
