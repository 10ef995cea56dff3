"""Who lies beside whom in a finished layout."""

from __future__ import annotations

import numpy as np

from packwork.arrays import IntArray
from packwork.scene.layout import Layout
from packwork.scene.neighbours import side_by_side
from packwork.solve.shaped import seen_posed

RESOLUTION = 600
"""Pixels on the longer side of an image in which the outlines would look the same as the
simpler ones that distances are taken between. Larger is slower and no better. Chosen."""


def beside(layout: Layout) -> IntArray:
    """``(m, 2)`` pairs of items that lie side by side, as ``scene.neighbours`` says."""
    outlines = [item.outline for item in layout.items]
    seen = seen_posed(outlines, layout.poses, RESOLUTION / layout.container.side)
    placed = [outline.mapped(layout.poses.matrix(k)) for k, outline in enumerate(seen)]
    return side_by_side(placed, layout.poses.x, layout.poses.y)


def same_kind_beside(layout: Layout, kinds: IntArray | None) -> int | None:
    """How many pairs of one kind lie side by side; None if kinds do not matter."""
    if kinds is None:
        return None
    pairs = beside(layout)
    return int(np.count_nonzero(kinds[pairs[:, 0]] == kinds[pairs[:, 1]]))
