"""Where there is most room for one item more."""

from __future__ import annotations

import numpy as np
import shapely

from packwork.geometry.overlay import difference, union, valid
from packwork.live.document import Document
from packwork.live.neighbourhood.shapes import Shapes

FINENESS = 0.005
"""How far the middle of the largest disc may be off, shares of the canvas. Chosen."""


def widest_place(document: Document, shapes: Shapes) -> tuple[float, float, float]:
    """Middle and radius of the largest disc that no item lies in, canvas units.

    Examples
    --------
    >>> from packwork import fill
    >>> layout = fill("square", "circle", count=1, epochs=20, levels="50")
    >>> x, y, radius = widest_place(Document.of(layout), Shapes())
    >>> 0 < radius < 300
    True
    """
    covers = [
        shapes.cover(item.outline).mapped(document.poses.matrix(k)).region
        for k, item in enumerate(document.items)
    ]
    whole = valid(document.container.outline.region)
    left = difference(whole, union(covers)) if covers else whole
    if left.area <= 0:
        left = whole
    line = shapely.maximum_inscribed_circle(left, tolerance=FINENESS * document.container.side)
    (x, y), (edge_x, edge_y) = shapely.get_coordinates(line)
    return float(x), float(y), float(np.hypot(edge_x - x, edge_y - y))
