"""Random start: anywhere in the container."""

from __future__ import annotations

import numpy as np

from packwork.arrays import FloatArray, Image
from packwork.start.allowed_pixels import AllowedPixels


def scatter(
    container: Image,
    px_per_cu: float,
    count: int,
    rng: np.random.Generator,
    homes: AllowedPixels | None = None,
) -> tuple[FloatArray, FloatArray]:
    """Centres ``(x, y)``, canvas units, uniform over the container's pixels.

    Examples
    --------
    >>> x, y = scatter(np.array([[0.0, 1.0]]), 1.0, 3, np.random.default_rng(0))
    >>> bool((x >= 1).all() and (x <= 2).all())
    True
    """
    inside = np.flatnonzero(container > 0.5)
    picks = inside[rng.integers(len(inside), size=count)]
    for k, home in enumerate(homes or ()):
        if home is not None:
            picks[k] = rng.choice(home)
    rows, columns = np.divmod(picks, container.shape[1])
    return (
        (columns + rng.uniform(0, 1, count)) / px_per_cu,
        (rows + rng.uniform(0, 1, count)) / px_per_cu,
    )
