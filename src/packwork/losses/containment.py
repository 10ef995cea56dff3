"""Containment loss: mean density outside the container."""

from __future__ import annotations

import numpy as np

from packwork.arrays import Image
from packwork.losses.term import Term


def containment(density: Image, container: Image) -> Term:
    """Mean density outside the container, of images ``(rows, columns)``: linear in that area.

    The density itself counts, not min(density, 1): coincident items outside must
    still be pushed back. Wang and Lu 2025, section 3.3, use a squared error; the linear
    form ends with less violation at equal coverage.

    Examples
    --------
    >>> term = containment(np.array([[1.0, 2.0]]), np.array([[1.0, 0.0]]))
    >>> term.value, term.adjoint.tolist()
    (1.0, [[0.0, 0.5]])
    """
    outside = 1 - container
    return Term(float(np.mean(density * outside)), outside / density.size)
