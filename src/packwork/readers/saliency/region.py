"""The quiet part of a picture: where its saliency is lowest."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import shapely

from packwork.arrays import FloatArray
from packwork.fields.saliency import spectral_residual
from packwork.geometry.polygon import Region, polygon_parts
from packwork.readers.pictures.contours import contour_region
from packwork.readers.pictures.developing import Negative, developed
from packwork.readers.unfit import UnfitError

SALIENCY_PX = 64
"""Longer side of the picture whose saliency is found: as in the paper, which found that larger
ones are all detail and no objects."""

MAP_PX = 600
"""Longer side of the image in which the quiet part is traced. Larger is no truer. Chosen."""

SMOOTH = 0.025
"""Spread of the smoothing of the map, as a share of the longer side. Larger gives plainer
regions that come nearer to what stands out; smaller leaves coves that hold nothing. Tried."""

SMALLEST_PART = 0.12
"""Share of the quiet area below which a part of it, or a busy hole in it, is dropped. Larger
loses room, smaller leaves scattered islands, and the plain inside of what stands out. Chosen
by eye."""

_SOFTNESS = 0.02
_SIMPLIFY_PX = 0.5


@dataclass(frozen=True, eq=False)
class Quiet:
    """What is found of a picture.

    Parameters
    ----------
    saliency
        ``[row, col]`` 0..1, ``MAP_PX`` long.
    region
        The quiet part, in pixels of the upright picture.
    """

    saliency: FloatArray
    region: Region


def quiet_part(data: bytes, negative: Negative, share: float) -> Quiet:
    """The share of a picture in which least is to be seen, small parts left out.

    Raises
    ------
    UnfitError
        If all of it is of one colour.
    """
    saliency = saliency_map(data, negative)
    limit = float(np.quantile(saliency, share))
    # A soft step, so that the contour runs between pixels.
    inside = np.clip(0.5 + (limit - saliency) / _SOFTNESS, 0.0, 1.0)
    traced = _main_parts(contour_region(inside, _SIMPLIFY_PX))
    scale = np.array([negative.width / saliency.shape[1], negative.height / saliency.shape[0]])
    return Quiet(saliency, shapely.transform(traced, lambda points: points * scale))


def saliency_map(data: bytes, negative: Negative) -> FloatArray:
    """Saliency of a picture's bytes, ``MAP_PX`` long, smoothed.

    Raises
    ------
    UnfitError
        If the picture is blank.
    """
    from scipy.ndimage import gaussian_filter, zoom

    full = (0.0, 0.0, float(negative.width), float(negative.height))
    small = developed(data, full, _size(negative, SALIENCY_PX)).convert("RGB")
    found = spectral_residual(np.asarray(small, dtype=np.float64) / 255)
    if not found.any():
        raise UnfitError(
            "is of one colour all over, so no part of it is quieter than the rest; give a picture "
            "that shows something, or fill a plain container"
        )
    columns, rows = _size(negative, MAP_PX)
    fine = zoom(found, (rows / found.shape[0], columns / found.shape[1]), order=1, grid_mode=True,
                mode="nearest")  # fmt: skip
    smooth = gaussian_filter(fine, SMOOTH * MAP_PX, mode="nearest")
    return np.asarray((smooth - smooth.min()) / np.ptp(smooth))


def _size(negative: Negative, longest: int) -> tuple[int, int]:
    """Width and height of a picture that is ``longest`` long."""
    scale = longest / max(negative.width, negative.height)
    return max(8, round(negative.width * scale)), max(8, round(negative.height * scale))


def _main_parts(region: Region) -> Region:
    smallest = SMALLEST_PART * region.area
    parts = [
        shapely.Polygon(part.exterior, [h for h in part.interiors if _area(h) > smallest])
        for part in polygon_parts(region)
        if part.area > smallest
    ]
    return shapely.MultiPolygon(parts)


def _area(ring: shapely.LinearRing) -> float:
    return float(shapely.Polygon(ring).area)
