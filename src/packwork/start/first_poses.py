"""The first poses of a run: sizes, places, angles."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from packwork.arrays import FloatArray
from packwork.geometry.outline import Outline
from packwork.raster.coverage import Rasteriser
from packwork.raster.pyramid import image_shape, region_image
from packwork.scene.container import Container
from packwork.scene.pose import Poses
from packwork.start.distance_field import distance_field
from packwork.start.options import StartOptions
from packwork.start.scatter import scatter
from packwork.start.sizes import hull_areas

RESOLUTION = 200
"""Pixels on the longer side of the image that places are chosen on, for up to 1,600
items; more items need smaller pixels. Larger is slower and no better. Tried."""

HULL_SHARE = 0.85
"""How much an item's hull counts against its area for the disc that stands for it:
0 the area alone, 1 the hull alone. Tried."""

ELBOW_ROOM = 1.5
"""Radius of that disc over that of a disc of its area. Larger spreads the items along
the container's edge first. Tried."""


def start_resolution(count: int) -> int:
    """Pixels on the longer side for ``count`` items.

    Examples
    --------
    >>> start_resolution(100), start_resolution(10_000)
    (200, 500)
    """
    return int(min(max(RESOLUTION, 5 * math.sqrt(count)), 1_000))


def first_poses(
    container: Container,
    outlines: Sequence[Outline],
    scales: FloatArray,
    angles: FloatArray,
    options: StartOptions,
    rng: np.random.Generator,
) -> Poses:
    """Poses of items of given scales and angles, by the method asked for.

    Parameters
    ----------
    container
        The region to fill.
    outlines
        One per item, item units.
    scales, angles
        ``(n,)``.
    rng
        The only source of randomness.
    """
    resolution = start_resolution(len(outlines))
    px_per_cu = resolution / container.side
    shape = image_shape(container.width, container.height, resolution)
    image = region_image(container.outline, Rasteriser(shape), px_per_cu)
    if not (image > 0.5).any():
        # Thinner than a pixel everywhere: any pixel it touches will do.
        image = (image >= image.max()).astype(image.dtype)
    if options.method == "scatter":
        x, y = scatter(image, px_per_cu, len(outlines), rng)
    else:
        areas = np.array([o.area for o in outlines]) ** (1 - HULL_SHARE)
        radii = np.sqrt(areas * hull_areas(outlines) ** HULL_SHARE / np.pi) * scales * ELBOW_ROOM
        x, y = distance_field(image, px_per_cu, radii, rng)
    return Poses(x, y, angles, scales)
