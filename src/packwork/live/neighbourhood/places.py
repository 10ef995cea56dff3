"""Places for items: the widest voids, and the nearest places at which an item lies inside."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import shapely

from packwork.arrays import FloatArray, IntArray
from packwork.geometry.overlay import buffered, difference, union, union_of_layout, valid
from packwork.geometry.polygon import Region
from packwork.geometry.simplify import hull
from packwork.live.document import PROPERTIES, Document
from packwork.live.neighbourhood.caches import ShapeCache
from packwork.live.neighbourhood.settle import gap_of

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
    >>> x, y, radius = next(widest_places(Document.from_layout(layout), ShapeCache()))
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


HALVINGS = 7
"""Sizes that are tried where an item is too large for all places. More come nearer to the largest,
by a hundredth of it already, and take longer. Chosen."""

MARGIN = 1e-4
"""Share of the canvas' side that is kept to the edge of all places. Larger is farther from what was
asked, smaller leaves nothing to the rounding of what follows. Chosen."""


def brought_inside(document: Document, rows: IntArray, shapes: ShapeCache) -> Document:
    """A document whose items ``(m,)`` lie in the room that what is held leaves them.

    Those that stick out come to the nearest place; what is too large for every place is made
    smaller until it has one.
    """
    if len(rows) == 0:
        return document
    room = _room(document, rows, shapes)
    for k in rows.tolist():
        placed = shapes.cover(document.items[k].outline).mapped(document.poses.matrix(k))
        if not room.covers(placed.region):
            document = _brought(document, k, room)
    return document


def _room(document: Document, rows: IntArray, shapes: ShapeCache) -> Region:
    """Room of the container, gaps taken off, without everything that is held."""
    gap = gap_of(document, rows)
    region = valid(document.container.outline.region)
    held = np.setdiff1d(np.flatnonzero(document.held[:, PROPERTIES.index("place")]), rows)
    covers = [shapes.cover(document.items[k].outline) for k in held]
    walls = [c.mapped(document.poses.matrix(k)) for c, k in zip(covers, held, strict=True)]
    if walls:
        taken = union_of_layout([outline.region for outline in walls])
        return difference(buffered(region, -gap), buffered(taken, gap))
    return buffered(region, -gap)


def _brought(document: Document, k: int, room: Region) -> Document:
    """The document with one item inside; as it was where it has no place at any size tried."""
    poses, (is_held, _, is_sized) = document.poses, document.held[k]
    at = np.array([poses.x[k], poses.y[k]])
    shape = hull(document.items[k].outline.mapped(poses.matrix(k))).points - at
    margin = MARGIN * document.container.side
    low, high, factor = 0.0, 1.0, 1.0
    place = None
    for _ in range(1 if is_sized else HALVINGS):
        found = None if is_held else _nearest(room, factor * shape, at, margin)
        low, high = (low, factor) if found is None else (factor, high)
        place = place if found is None else found
        if low == 1.0:
            break
        factor = (low + high) / 2
    if place is None:
        return document
    made = document.scaled(k, low)
    x, y, weights = poses.x.copy(), poses.y.copy(), document.weights.copy()
    x[k], y[k] = place
    # Sizes stay in the shares that are asked for, so another one is asked for.
    weights[k] *= low**2 if document.options.sizes == "shared" else 1.0
    return replace(made, poses=replace(made.poses, x=x, y=y), weights=weights)


def _nearest(room: Region, shape: FloatArray, at: FloatArray, margin: float) -> FloatArray | None:
    """Place nearest to a point at which a convex shape ``(m, 2)`` about it lies in the room."""
    if room.is_empty:
        return None
    rings = shapely.get_rings(shapely.get_parts(room))
    lines = [shapely.get_coordinates(ring) for ring in rings]
    edges = np.concatenate([np.stack([line[:-1], line[1:]], axis=1) for line in lines])
    # Where the shape's middle may not be: along each edge, swept by the shape turned about.
    swept = (edges[:, :, None] - shape).reshape(len(edges), -1, 2)
    taken = union(shapely.convex_hull(shapely.linestrings(swept)))
    free = buffered(difference(room, taken), -margin)
    if free.is_empty:
        return None
    way = shapely.shortest_line(free, shapely.Point(*at))
    return np.asarray(shapely.get_coordinates(way)[0])
