"""Images of one region at several resolutions."""

from __future__ import annotations

import math

from packwork.arrays import Image
from packwork.geometry.outline import Outline
from packwork.raster.coverage import Rasteriser


def image_shape(width_cu: float, height_cu: float, resolution: int) -> tuple[int, int]:
    """Rows and columns of the image whose longer side has ``resolution`` pixels.

    Examples
    --------
    >>> image_shape(600, 300, 50)
    (25, 50)
    """
    per_cu = resolution / max(width_cu, height_cu)
    return max(math.ceil(height_cu * per_cu - 1e-9), 1), max(math.ceil(width_cu * per_cu - 1e-9), 1)


def region_image(outline: Outline, rasteriser: Rasteriser, px_per_cu: float) -> Image:
    """Coverage of a region given in canvas units, in the rasteriser's image.

    Examples
    --------
    >>> import numpy as np
    >>> square = Outline.from_rings([np.array([[0, 0], [2, 0], [2, 2], [0, 2.0]])])
    >>> region_image(square, Rasteriser((1, 2), np.float64), 0.5).tolist()
    [[1.0, 0.0]]
    """
    rasteriser.sweep(outline.points * px_per_cu, outline.starts)
    return rasteriser.density()
