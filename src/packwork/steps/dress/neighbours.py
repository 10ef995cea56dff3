"""Neighbouring items of a finished layout."""

from __future__ import annotations

import numpy as np

from packwork.arrays import IntArray
from packwork.pipeline.plan.cast import kinds
from packwork.scene.layout import Layout
from packwork.scene.neighbours import side_by_side


def beside(layout: Layout) -> IntArray:
    """``(m, 2)`` pairs of items that lie side by side, as ``scene.neighbours`` says."""
    placed = [item.outline.mapped(layout.poses.matrix(k)) for k, item in enumerate(layout.items)]
    return side_by_side(placed, layout.poses.x, layout.poses.y)


def same_kind_beside(layout: Layout) -> int:
    """Number of neighbouring pairs of one kind."""
    first, second = kinds(layout.items)[beside(layout)].T
    return int(np.count_nonzero(first == second))
