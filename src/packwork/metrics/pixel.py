"""The paper's pixel measures, from the true outlines at 1,200 px.

A pixel belongs to an item if its centre does (Wang and Lu 2025, section 4.1).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from packwork.arrays import BoolArray, IntArray
from packwork.fields.distance_transform import distance_to
from packwork.geometry.outline import Outline, joined
from packwork.raster.membership import centre_count
from packwork.raster.pyramid import image_shape
from packwork.scene.container import Container

RESOLUTION = 1_200
"""Pixels on the canvas' longer side, as in the paper."""

DISTANCE_CANVAS = 600
"""L-nU is in pixels of a canvas of this size."""


@dataclass(frozen=True)
class PixelMetrics:
    """Pixel measures of a layout.

    Parameters
    ----------
    LC
        Layout coverage: share of the container's pixels in at least one item.
    LC_ratio
        Covered over uncovered pixels of the container, as the paper's text reads;
        infinite if all are covered.
    OO
        Object overlap: pixels in two or more items over the container's pixels.
    EA
        Exceeding area: pixels in an item and not in the container, over the container's.
    LnU
        Layout non-uniformity: mean squared distance, in pixels of a 600 px canvas,
        from the container's uncovered pixels to the nearest item; 0 if all are covered.
    """

    LC: float
    LC_ratio: float
    OO: float
    EA: float
    LnU: float


def pixel_metrics(outlines: Sequence[Outline], container: Container) -> PixelMetrics:
    """Measure items in place (canvas units) against their container.

    Examples
    --------
    >>> square = Outline.from_rings([np.array([[0, 0], [8, 0], [8, 8], [0, 8.0]])])
    >>> half = Outline.from_rings([np.array([[0, 0], [4, 0], [4, 8], [0, 8.0]])])
    >>> pixel_metrics([half], Container("square", "square", square, 8, 8)).LC
    0.5
    """
    px_per_cu = RESOLUTION / container.side
    shape = image_shape(container.width, container.height, RESOLUTION)
    counts = _counts(outlines, px_per_cu, shape)
    inside = _counts([container.outline], px_per_cu, shape) > 0
    whole = max(int(np.count_nonzero(inside)), 1)
    covered = int(np.count_nonzero(inside & (counts > 0)))
    uncovered = whole - covered
    return PixelMetrics(
        LC=covered / whole,
        LC_ratio=covered / uncovered if uncovered else float("inf"),
        OO=int(np.count_nonzero(counts > 1)) / whole,
        EA=int(np.count_nonzero((counts > 0) & ~inside)) / whole,
        LnU=_non_uniformity(counts > 0, inside),
    )


def _counts(outlines: Sequence[Outline], px_per_cu: float, shape: tuple[int, int]) -> IntArray:
    points, starts = joined(outlines)
    return centre_count(points * px_per_cu, starts, shape).astype(np.int64)


def _non_uniformity(covered: BoolArray, inside: BoolArray) -> float:
    gaps = inside & ~covered
    if not gaps.any() or not covered.any():
        return 0.0
    distance = distance_to(covered)
    in_canvas = distance[gaps] * (DISTANCE_CANVAS / RESOLUTION)
    return float(np.mean(in_canvas**2))
