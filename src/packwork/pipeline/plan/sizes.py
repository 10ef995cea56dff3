"""Sizes that items are given: in their files, or one for all."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from packwork.arrays import FloatArray
from packwork.scene.item import Item
from packwork.units import Unit, convert, parse_length


def given_scales(
    items: Sequence[Item],
    weights: FloatArray,
    unit: Unit,
    side: float,
    size: str | float | None = None,
) -> FloatArray:
    """``(n,)`` scales of items of given sizes.

    Parameters
    ----------
    weights
        ``(n,)`` share of area of each.
    unit, side
        Of the canvas, and its longer side.
    size
        Longer side of an item of weight 1, a length; None for sizes as in the files.
    """
    if size is None:
        # Items are in px, as their files say; the canvas may be in mm.
        return np.full(len(items), convert(1.0, "px", unit))
    length = parse_length(str(size), unit, side)
    return np.array([length / item.outline.extent for item in items]) * np.sqrt(weights)
