"""Random start: anywhere in the container."""

from __future__ import annotations

import numpy as np

from packwork.arrays import FloatArray, Image


def scatter(
    container: Image, px_per_cu: float, count: int, rng: np.random.Generator
) -> tuple[FloatArray, FloatArray]:
    """Centres ``(x, y)``, canvas units, uniform over the container's pixels.

    Parameters
    ----------
    container
        Coverage of the container.
    px_per_cu
        Pixels of that image per canvas unit.

    Examples
    --------
    >>> x, y = scatter(np.array([[0.0, 1.0]]), 1.0, 3, np.random.default_rng(0))
    >>> bool((x >= 1).all() and (x <= 2).all())
    True
    """
    rows, columns = np.nonzero(container > 0.5)
    picks = rng.integers(len(rows), size=count)
    return (
        (columns[picks] + rng.uniform(0, 1, count)) / px_per_cu,
        (rows[picks] + rng.uniform(0, 1, count)) / px_per_cu,
    )
