"""Places for items: the widest voids, the nearest ones inside, and those to which forces pull them.

What falls goes down the heights of the forces at its size, from where a settle has left it: that is
compaction down a potential (:mod:`packwork.settle.settle`) without a search for first places.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np
import shapely

from packwork.arrays import FloatArray, IntArray
from packwork.compaction.arrangement import FINE, Detail
from packwork.compaction.objective import turn_ranges
from packwork.compaction.options import HAIR
from packwork.geometry.overlay import buffered, difference, union, union_of_layout, valid
from packwork.geometry.polygon import Region
from packwork.geometry.simplify import hull
from packwork.live.document import PROPERTIES, Document
from packwork.live.neighbourhood.caches import ShapeCache
from packwork.live.neighbourhood.settle import gap_of, room_of
from packwork.progress import Stop, never
from packwork.settle.pile import SettleOptions
from packwork.settle.separate_fixed import separate_fixed
from packwork.settle.settle import FIRST_TRUST, LAST_TRUST, Settling

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


LOOSE = 0.7
"""Covered share up to which items that touch are parted first. Larger takes seconds where there is
no room for that, smaller leaves loose items hanging. Tried."""


def fallen(
    document: Document,
    loose: IntArray,
    shapes: ShapeCache,
    stop: Stop = never,
    on_fall: Callable[[Document], object] = lambda _: None,
) -> Document:
    """Document at rest under its forces; what is held in place is a wall.

    The same document where items touch and have no room to part, or if it was stopped.

    Parameters
    ----------
    loose
        ``(m,)`` rows of what falls first, all others as walls: beside many at rest, which keep
        the steps of all short, it would stay in the air.
    on_fall
        Told of the items on their way.
    """
    movable = np.flatnonzero(~document.held[:, 0])
    first = np.intersect1d(movable, loose)
    now, is_falling = document, len(first) < len(movable)
    while is_falling and not stop():
        before, now = now, _fallen(now, first, shapes, stop, on_fall)
        way = np.hypot(now.poses.x - before.poses.x, now.poses.y - before.poses.y)
        # What went less than its own size did not end where the room about it does.
        is_falling = bool((way > np.sqrt(now.areas)).any())
    now = _fallen(now, movable, shapes, stop, on_fall)
    return document if stop() else now


def _fallen(
    document: Document,
    movable: IntArray,
    shapes: ShapeCache,
    stop: Stop,
    on_fall: Callable[[Document], object],
) -> Document:
    """The document with some of its items at rest, all others as walls."""
    room = room_of(document, movable, shapes) if len(movable) else None
    if room is None:
        return document
    poses, side = document.poses.subset(movable), document.container.side
    outlines = [shapes.cover(document.items[k].outline) for k in movable]
    still = np.zeros(len(movable))
    detail = Detail(outlines, room.outline, poses).covers(FINE)
    arrangement = detail.arrangement(np.column_stack([poses.x, poses.y, still, still]))
    gap, hair = gap_of(document, movable), HAIR * side
    rotation = document.options.rotation
    options = SettleOptions(
        turning=document.options.turns,
        turn_limit=rotation.limit if document.options.turns else None,
        still=tuple(document.held[movable, 1].tolist()),
    )
    turns = turn_ranges(poses.angle, options)
    is_tight = len(arrangement.conflicts(arrangement.pairs(gap), gap)) > 0
    # A settle leaves a few that touch.
    if is_tight and (is_full(document) or len(separate_fixed(arrangement, turns, gap, hair))):
        return document
    settling = Settling(
        arrangement, document.forces(movable), document.areas[movable], turns, gap, hair, side
    )

    if settling.is_at_rest():
        # Another way down may lead to another rest: a gesture elsewhere would move a heap.
        return document

    def at(places: FloatArray) -> Document:
        x, y, turn, _ = places.T.copy()
        made = replace(poses, x=x, y=y, angle=poses.angle + turn)
        return document.with_poses(document.poses.with_some(movable, made))

    def tell(places: FloatArray) -> None:
        on_fall(at(places))

    settling.settle(tell, stop, (FIRST_TRUST, LAST_TRUST))
    return at(arrangement.places)


def is_full(document: Document) -> bool:
    """Whether items cover so much that touching ones find no room beside each other."""
    return float(document.areas.sum()) > LOOSE * document.container.outline.area
