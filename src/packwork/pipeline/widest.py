"""Width of a container's widest place."""

from __future__ import annotations

import numpy as np
import shapely

from packwork.fields.clearance import distance_inside
from packwork.geometry.outline import Outline
from packwork.raster.membership import centre_count
from packwork.scene.container import Container

THIN = 5e-4
"""Mean half width of a region (area over perimeter), as a share of its extent, below which a
picture tells how wide it is: of hairs and spirals the exact search looks at thousands of places
that are about equally wide. Larger tells plain maps by pixels, smaller takes longer. Measured:
17.6 s of the processor for 5,000 hairs (4e-5), 0.01 s for the coasts of a country (over 0.01)."""

RESOLUTION = 1_000
"""Pixels on the longer side of that picture. Larger takes longer. Chosen: what is wider than
a pixel is seen, and the exact search is no finer."""

_WIDE = 1.5

LINES = 0.005
"""Mean width of a container, as a share of the canvas's side, below which it is but lines: what
fits is hardly to be seen. Larger blames wrought letters, smaller passes spirals. Chosen."""


def lines_width(container: Container) -> float | None:
    """Mean width of a container that is but lines, canvas units; None of one that is more.

    Examples
    --------
    >>> hair = Outline.from_rings([np.array([[0.0, 0], [90, 0], [90, 0.1], [0, 0.1]])])
    >>> round(lines_width(Container("hair", "", hair, 100.0, 100.0)), 3)
    0.1
    """
    width = 2 * container.outline.area / container.outline.region.length
    return float(width) if width <= LINES * container.side else None


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
