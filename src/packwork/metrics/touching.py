"""Exact measures of layouts with straight rectangles, which may touch where no gap is asked."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
import shapely

from packwork.arrays import FloatArray
from packwork.geometry.outline import Outline, regions
from packwork.geometry.rectangles import exact_boxes, is_near
from packwork.metrics.exact import ExactMetrics, exact_metrics, smallest_gap
from packwork.scene.layout import Layout


@dataclass(frozen=True, eq=False)
class StraightItems:
    """Left, top, right and bottom of a layout's straight rectangles by row, canvas units.

    ``whole``: those of the container, None if it is no such rectangle.
    """

    boxes: Mapping[int, FloatArray]
    whole: FloatArray | None

    def is_free(self, row: int, other: int | None) -> bool:
        """Whether two overlap nowhere, exactly, or one does not stick out; False of any other."""
        own, met = self.boxes.get(row), self.whole if other is None else self.boxes.get(other)
        if own is None or met is None:
            return False
        if other is None:
            return bool((own[:2] >= met[:2]).all() and (own[2:] <= met[2:]).all())
        return bool(((own[2:] <= met[:2]) | (met[2:] <= own[:2])).any())


def straight_items(layout: Layout) -> StraightItems | None:
    """Straight upright rectangles of a layout, which may touch each other; None without any.

    Their coordinates are one number where rounding alone parts them. An item is straight if its
    ``coarseness`` is 0: curves that bulge past their outlines by less than a hair are not, however
    straight they seem. Nor is one whose place comes from numbers so large that rounding swallows
    overlaps.
    """
    container = layout.container
    if container.lattice is not None:
        return None
    far, rows = float(np.abs(container.outline.points).max()), list[int]()
    for k, item in enumerate(layout.items):
        if item.coarseness == 0.0:
            matrix = np.abs(layout.poses.matrix(k))
            own = matrix[:, :2] @ np.abs(item.outline.points).max(axis=0)
            placed = layout.outlines[k]
            reach = max(far, float(own.max()), float(matrix[:, 2].max()))
            if is_near(reach, placed.extent) and exact_boxes([placed]) is not None:
                rows.append(k)
    if not rows:
        return None
    straight = [layout.outlines[k] for k in rows]
    is_upright = exact_boxes([container.outline]) is not None
    boxes = exact_boxes([*straight, container.outline] if is_upright else straight)
    if boxes is None:
        # Rounding, over the extent of all, is as much as the side of one.
        return None
    found = dict(zip(rows, boxes, strict=False))
    return StraightItems(found, boxes[-1] if is_upright else None)


def touching_metrics(layout: Layout) -> ExactMetrics | None:
    """Exact measures of a layout with straight upright rectangles; None of one without."""
    straight = straight_items(layout)
    if straight is None:
        return None
    outlines, container = list(layout.outlines), layout.container.outline
    if straight.whole is not None:
        container = Outline.box(*straight.whole.tolist())
    for k, box in straight.boxes.items():
        outlines[k] = Outline.box(*box.tolist())
    found = exact_metrics(outlines, container)
    if not found.is_clean:
        return replace(found, gap_beside=0.0)
    placed, whole = regions(outlines), container.region
    is_straight = np.isin(np.arange(len(placed)), list(straight.boxes))
    exact, others = placed[is_straight], placed[~is_straight]
    beside = smallest_gap(others, whole)
    if len(others):
        _, apart = shapely.STRtree(exact).query_nearest(others, return_distance=True)
        beside = min(beside, float(apart.min()))
    if straight.whole is None:
        beside = min(beside, float(shapely.distance(whole.boundary, exact).min()))
    return replace(found, gap_beside=beside)
