"""Widest void, for one item more."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import shapely

from packwork.geometry.overlay import buffered, difference, union_of_layout, valid
from packwork.live.document import Document
from packwork.live.neighbourhood.shapes import ShapeCache

FINENESS = 0.005
"""How far the middle of the largest disc may be off, shares of the canvas. Chosen."""


EMPTY = 1e-6
"""Share of the container's area that is no room any more. Chosen."""


def widest_places(document: Document, shapes: ShapeCache) -> Iterator[tuple[float, float, float]]:
    """Middles and radii of the largest discs that no item and no disc before lies in.

    Without end: where nothing is free any more, items are taken for not there.

    Examples
    --------
    >>> from packwork import fill
    >>> layout = fill("square", "circle", count=1, epochs=20, levels="50")
    >>> x, y, radius = next(widest_places(Document.of(layout), ShapeCache()))
    >>> 0 < radius < 300
    True
    """
    covers = [
        shapes.cover(item.outline).mapped(document.poses.matrix(k)).region
        for k, item in enumerate(document.items)
    ]
    whole = valid(document.container.outline.region)
    left = difference(whole, union_of_layout(covers)) if covers else whole
    while True:
        if left.area <= EMPTY * whole.area:
            left = whole
        line = shapely.maximum_inscribed_circle(left, tolerance=FINENESS * document.container.side)
        (x, y), (edge_x, edge_y) = shapely.get_coordinates(line)
        radius = float(np.hypot(edge_x - x, edge_y - y))
        yield float(x), float(y), radius
        left = difference(left, buffered(shapely.Point(x, y), radius))
