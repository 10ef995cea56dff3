"""Compactness of a pile: shares of its hull, smallest circle and box that items cover."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
import shapely

from packwork.geometry.outline import Outline


def compactness(outlines: Sequence[Outline]) -> dict[str, float]:
    """Share that items cover of their convex hull, smallest circle and upright box.

    Exact, of the flattened outlines in place; items that overlap count twice. All zero for
    no items.

    Examples
    --------
    >>> tile = Outline.from_rings([np.array([[0.0, 0], [2, 0], [2, 2], [0, 2]])])
    >>> {name: round(share, 3) for name, share in compactness([tile]).items()}
    {'hull': 1.0, 'circle': 0.637, 'box': 1.0}
    """
    if len(outlines) == 0:
        return {"hull": 0.0, "circle": 0.0, "box": 0.0}
    covered = sum(outline.area for outline in outlines)
    # The hull of a line through all points is theirs, and no geometry is made of each.
    line = shapely.linestrings(np.concatenate([outline.points for outline in outlines]))
    hull = shapely.convex_hull(line)
    left, top, right, bottom = hull.bounds
    return {
        "hull": covered / hull.area,
        "circle": float(covered / (math.pi * shapely.minimum_bounding_radius(hull) ** 2)),
        "box": covered / ((right - left) * (bottom - top)),
    }
