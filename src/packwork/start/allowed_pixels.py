"""Pixels in which single items may begin: those of their zone, or of the line that they lie on."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeAlias

import numpy as np

from packwork.arrays import BoolArray, FloatArray, Image, IntArray
from packwork.geometry.outline import Outline
from packwork.raster.coverage import Rasteriser, region_image
from packwork.scene.limits import Limits
from packwork.scene.pose import Poses

AllowedPixels: TypeAlias = Sequence[IntArray | None]
"""Per item the pixels to choose from, ``row * columns + column``; None for any."""


def allowed_pixels(limits: Limits, container: Image, px_per_cu: float) -> AllowedPixels:
    """Pixels of the container for each item that may not lie anywhere in it.

    A line is the row or column of pixels that is nearest to it. Where no pixel shows an
    item's zone, it may begin anywhere.

    ``container``: ``(rows, columns)`` coverage of the container.

    Examples
    --------
    >>> from dataclasses import replace
    >>> limits = replace(Limits.free(2), x=np.array([np.nan, 1.2]))
    >>> [None if h is None else h.tolist() for h in allowed_pixels(limits, np.ones((2, 3)), 1.0)]
    [None, [1, 4]]
    """
    free = container > 0.5
    masks: dict[int, BoolArray] = {}
    for zone in limits.zones:
        inside = free & (_coverage(zone.outline, container, px_per_cu) > 0.5)
        masks |= {int(k): inside for k in zone.items}
    on_column, on_row = limits.held[:, 0], limits.held[:, 1]
    for k in np.flatnonzero(on_column & ~on_row):
        away = np.abs(np.arange(free.shape[1]) + 0.5 - limits.x[k] * px_per_cu)
        masks[int(k)] = _nearest(masks.get(int(k), free), away[None, :])
    for k in np.flatnonzero(on_row & ~on_column):
        away = np.abs(np.arange(free.shape[0]) + 0.5 - limits.y[k] * px_per_cu)
        masks[int(k)] = _nearest(masks.get(int(k), free), away[:, None])
    pixels = {k: np.flatnonzero(mask) for k, mask in masks.items()}
    return [pixels[k] if k in pixels and len(pixels[k]) else None for k in range(len(limits.x))]


def around(
    container: Image, px_per_cu: float, outlines: Sequence[Outline], poses: Poses, items: IntArray
) -> Image:
    """Coverage ``(rows, columns)`` that items ``(m,)`` leave; all of it, should they leave nothing.

    Examples
    --------
    >>> tile = Outline.from_rings([np.array([[-1.0, -1], [1, -1], [1, 1], [-1, 1]])])
    >>> one = np.ones(1)
    >>> around(np.ones((2, 3)), 1.0, [tile], Poses(one, one, 0 * one, one), np.arange(1)).tolist()
    [[0.0, 0.0, 1.0], [0.0, 0.0, 1.0]]
    """
    left = container
    for k in items:
        left = left * (1 - _coverage(outlines[k].mapped(poses.matrix(int(k))), left, px_per_cu))
    return left if (left > 0.5).any() else container


def _nearest(mask: BoolArray, away: FloatArray) -> BoolArray:
    least = np.where(mask, away, np.inf).min(initial=np.inf)
    return np.asarray(mask & (away <= least))


def _coverage(outline: Outline, like: Image, px_per_cu: float) -> Image:
    return region_image(outline, Rasteriser((like.shape[0], like.shape[1])), px_per_cu)
