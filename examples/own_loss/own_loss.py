"""A loss of one's own: keep the top of the canvas free, for a title."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

import packwork as pw


def headroom(density: npt.NDArray[np.floating], container: npt.NDArray[np.floating]) -> pw.Term:
    """Mean density in the top third, the dearer the higher: items slide down and out."""
    depth = np.linspace(1 / 3, -2 / 3, len(density), dtype=density.dtype)
    price = np.where(depth > 0, 1 + 9 * depth, 0)[:, None] * np.ones_like(density)
    return pw.Term(float(np.mean(density * price)), price / density.size)


if __name__ == "__main__":
    layout = pw.fill("circle", count=60, losses={"own_loss:headroom": 10.0}, seed=1)
    layout.save("headroom.svg")
