"""Exact measures of layouts with straight rectangles, which may touch where no gap is asked."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import shapely

from packwork.geometry.outline import Outline, regions
from packwork.geometry.rectangles import exact_boxes
from packwork.metrics.exact import ExactMetrics, exact_metrics, smallest_gap
from packwork.scene.layout import Layout


def touching_metrics(layout: Layout) -> ExactMetrics | None:
    """Exact measures of a layout with straight upright rectangles; None of one without.

    Their coordinates are one number where rounding alone parts them. An item is straight if its
    ``coarseness`` is 0: curves that bulge past their outlines by less than a hair are not, however
    straight they seem.
    """
    outlines, container = list(layout.outlines), layout.container.outline
    rows = [
        k for k, item in enumerate(layout.items)
        if item.coarseness == 0.0 and exact_boxes([outlines[k]]) is not None
    ]  # fmt: skip
    if not rows:
        return None
    straight = [outlines[k] for k in rows]
    may_touch_edge = exact_boxes([container]) is not None
    boxes = exact_boxes([*straight, container] if may_touch_edge else straight)
    if boxes is None:
        # Rounding, over the extent of all, is as much as the side of one.
        return None
    if may_touch_edge:
        container = Outline.box(*boxes[-1].tolist())
    for k, box in zip(rows, boxes.tolist(), strict=False):
        outlines[k] = Outline.box(*box)
    found = exact_metrics(outlines, container)
    if not found.is_clean:
        return replace(found, gap_beside=0.0)
    placed, whole = regions(outlines), container.region
    is_straight = np.isin(np.arange(len(placed)), rows)
    exact, others = placed[is_straight], placed[~is_straight]
    beside = smallest_gap(others, whole)
    if len(others):
        _, apart = shapely.STRtree(exact).query_nearest(others, return_distance=True)
        beside = min(beside, float(apart.min()))
    edge = math.inf if may_touch_edge else float(shapely.distance(whole.boundary, exact).min())
    return replace(found, gap_beside=min(beside, edge))
