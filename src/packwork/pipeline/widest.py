"""How wide a container's widest place is."""

from __future__ import annotations

import numpy as np
import shapely

from packwork.fields.clearance import distance_inside
from packwork.geometry.outline import Outline
from packwork.raster.membership import centre_count

THIN = 5e-4
"""Mean half width of a region (area over perimeter), as a share of its extent, below which a
picture tells how wide it is: of hairs and spirals the exact search looks at thousands of places
that are about equally wide. Larger tells plain maps by pixels, smaller takes longer. Measured:
17.6 s of the processor for 5,000 hairs (4e-5), 0.01 s for the coasts of a country (over 0.01)."""

RESOLUTION = 1_000
"""Pixels on the longer side of that picture. Larger takes longer. Chosen: what is wider than
a pixel is seen, and the exact search is no finer."""

_WIDE = 1.5


def widest_cu(outline: Outline, tolerance: float = 0.0) -> float:
    """Diameter of the largest disc inside, canvas units, to a thousandth of the extent.

    Parameters
    ----------
    tolerance
        Canvas units that the radius may be off; 0: a thousandth of the extent.

    Examples
    --------
    >>> from packwork.readers.container import read_container
    >>> round(widest_cu(read_container("circle").outline) / 600, 2)
    1.0
    """
    region = outline.region
    mean = region.area / region.length
    if mean >= THIN * outline.extent:
        return 2 * float(shapely.maximum_inscribed_circle(region, tolerance or None).length)
    px = outline.extent / RESOLUTION
    left, top, right, bottom = outline.bounds
    shape = int((bottom - top) / px) + 2, int((right - left) / px) + 2
    placed = (outline.points - (left, top)) / px + 0.5
    is_inside = centre_count(placed, outline.starts, shape) > 0
    radius = float(distance_inside(np.asarray(is_inside)).max())
    # Hairs that meet the centres of one or two pixels in a row are not as wide as those.
    return 2 * (radius * px if radius >= _WIDE else mean)
