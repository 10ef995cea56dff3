"""Upright rectangles whose corners are exact, so that touching ones are told from overlapping ones.

Two numbers that differ by no more than rounding are one; after that, comparisons are exact.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from packwork.arrays import FloatArray
from packwork.geometry.outline import Outline

ROUNDING = 1e-12
"""Difference up to which coordinates are one number, over the extent of all: what some thousand
sums of doubles may be off. Larger would take thin overlaps for touching. Derived."""

FARTHEST = 2048.0
"""Size of numbers, over the extent of what they place, up to which they are good to ``ROUNDING`` of
it: three roundings of theirs are 7e-13. Derived."""


def exact_boxes(outlines: Sequence[Outline]) -> FloatArray | None:
    """Left, top, right and bottom ``(n, 4)`` of upright rectangles; None if one is no such.

    None of them has moved by more than ``ROUNDING``.

    Examples
    --------
    >>> exact_boxes([Outline.box(0, 0, 0.1 + 0.2, 1), Outline.box(0.3, 0, 1, 1)]).tolist()
    [[0.0, 0.0, 0.3, 1.0], [0.3, 0.0, 1.0, 1.0]]
    """
    if not outlines or any(len(one.rings) != 1 or len(one.rings[0]) != 4 for one in outlines):
        return None
    corners = np.array([one.rings[0] for one in outlines])
    most = ROUNDING * float(np.ptp(corners, axis=(0, 1)).max())
    corners = np.stack([_as_one(corners[..., axis], most) for axis in (0, 1)], axis=-1)
    low, high = corners.min(axis=1), corners.max(axis=1)
    # Edges go along one axis and the other, in turn.
    steps = corners != np.roll(corners, 1, axis=1)
    is_upright = (steps.sum(axis=2) == 1).all() and (steps != np.roll(steps, 1, axis=1)).all()
    return np.hstack([low, high]) if is_upright else None


def is_near(reach: float, extent: float) -> bool:
    """Whether numbers up to ``reach`` place what is ``extent`` long, both in one unit, exactly.

    Examples
    --------
    >>> is_near(400.0, 1.0), is_near(1e7, 64.0)
    (True, False)
    """
    return reach <= FARTHEST * extent


def _as_one(values: FloatArray, most: float) -> FloatArray:
    """The same numbers, each the least of those that differ from it by no more than ``most``."""
    found, place = np.unique(values, return_inverse=True)
    least = found[0]
    for k, value in enumerate(found):
        least = value if value - least > most else least
        found[k] = least
    return np.asarray(found[place].reshape(values.shape), dtype=np.float64)
