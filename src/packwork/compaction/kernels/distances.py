"""Polygons in place, and the exact distances of pairs of them.

All polygons lie one after another in ``points``: first the items, then their images where they
repeat, last the container, whose rings run backwards, so that its inside is all that must not be
entered. The outward normal of an edge
``d`` is ``(d_y, -d_x)``.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from packwork.compaction.kernels.broad_phase import are_apart, sticks_out
from packwork.compiled import helper, kernel, leaf, shared


class Board(NamedTuple):
    """Polygons in place; arrays that the kernels write to.

    ``own``: points of all about their own origins; ``starts``: first point of each polygon;
    ``after``, ``before``: neighbours of each point in its ring; ``points``: in place; ``boxes``:
    left, top, right, bottom of each; ``spans``: the same of every ``stride`` successive edges of
    the container; ``places``: x, y, turn, logarithm of growth of each item and image; ``arms``:
    farthest point of each at growth 0; ``owners``: the item of each polygon, the container's number
    for itself; ``shifts``: ``(s, 2)`` from an item to its images, which follow one another.
    """

    own: np.ndarray
    starts: np.ndarray
    after: np.ndarray
    before: np.ndarray
    points: np.ndarray
    boxes: np.ndarray
    spans: np.ndarray
    stride: int
    places: np.ndarray
    arms: np.ndarray
    owners: np.ndarray
    shifts: np.ndarray


@kernel
def put(board, items, places):
    """Grow, turn and move some items, and their images, to the rows of ``places``."""
    own, points = board.own, board.points
    images = board.shifts.shape[0]
    count = board.places.shape[0] // (images + 1)
    for k in range(items.shape[0]):
        i = items[k]
        for c in range(4):
            board.places[i, c] = places[k, c]
        factor = math.exp(places[k, 3])
        cosine = factor * math.cos(places[k, 2])
        sine = factor * math.sin(places[k, 2])
        left = top = np.inf
        right = bottom = -np.inf
        for v in range(board.starts[i], board.starts[i + 1]):
            x = places[k, 0] + cosine * own[v, 0] - sine * own[v, 1]
            y = places[k, 1] + sine * own[v, 0] + cosine * own[v, 1]
            points[v, 0], points[v, 1] = x, y
            left, right = min(left, x), max(right, x)
            top, bottom = min(top, y), max(bottom, y)
        box = board.boxes[i]
        box[0], box[1], box[2], box[3] = left, top, right, bottom
        for s in range(images):
            _put_image(board, i, count + i * images + s, board.shifts[s])


@leaf
def _put_image(board, i, image, shift):
    """Put an image of an item beside it."""
    for c in range(4):
        board.places[image, c] = board.places[i, c] + (shift[c] if c < 2 else 0.0)
        board.boxes[image, c] = board.boxes[i, c] + shift[c % 2]
    begin = board.starts[image]
    for v in range(board.starts[i], board.starts[i + 1]):
        for c in range(2):
            board.points[begin, c] = board.points[v, c] + shift[c]
        begin += 1


@leaf
def arm(board, i):
    """Farthest point of an item from its origin, as large as it is now."""
    return board.arms[i] * math.exp(board.places[i, 3])


@leaf
def most_points(starts, pairs):
    """Points of the polygon of some pairs that has most: room for its edges."""
    most = 0
    for p in range(pairs.shape[0]):
        for i in pairs[p]:
            most = max(most, starts[i + 1] - starts[i])
    return most


class Scratch(NamedTuple):
    """Scratch of a distance: edges of the two polygons, boxes about :data:`RUN` of the second."""

    first: np.ndarray
    second: np.ndarray
    boxes: np.ndarray


RUN = 8
"""Edges that share a box where two polygons have many near each other. Larger and smaller are
slower. Tried."""


@helper
def room_for(most):
    """Room for distances of polygons of so many points."""
    edges = np.empty((2, most), np.int64)
    return Scratch(edges[0], edges[1], np.empty((most // RUN + 1, 4)))


@leaf
def cull(board, i, boxes, j, reach, kept):
    """Write the edges of a polygon (by their first vertex) within ``reach`` of one of the boxes."""
    points = board.points
    left, top = boxes[j, 0] - reach, boxes[j, 1] - reach
    right, bottom = boxes[j, 2] + reach, boxes[j, 3] + reach
    first, last = board.starts[i], board.starts[i + 1]
    is_container = i == board.starts.shape[0] - 2
    count = 0
    for begin in range(first, last, board.stride):
        if is_container:
            span = (begin - first) // board.stride
            if (
                board.spans[span, 0] > right
                or board.spans[span, 2] < left
                or board.spans[span, 1] > bottom
                or board.spans[span, 3] < top
            ):
                continue
        for v in range(begin, min(begin + board.stride, last)):
            w = board.after[v]
            if points[v, 0] < left and points[w, 0] < left:
                continue
            if points[v, 0] > right and points[w, 0] > right:
                continue
            if points[v, 1] < top and points[w, 1] < top:
                continue
            if points[v, 1] > bottom and points[w, 1] > bottom:
                continue
            kept[count] = v
            count += 1
    return count


@leaf
def _winding(x, y, board, j):
    """Winding number of the rings of a polygon about a point."""
    points, turns = board.points, 0
    first, last = board.starts[j], board.starts[j + 1]
    is_container = j == board.starts.shape[0] - 2
    for begin in range(first, last, board.stride):
        if is_container:
            # What counts crosses the line from the point to the right.
            span = board.spans[(begin - first) // board.stride]
            if span[2] < x or span[1] > y or span[3] <= y:
                continue
        for v in range(begin, min(begin + board.stride, last)):
            w = board.after[v]
            if (points[v, 1] <= y) == (points[w, 1] <= y):
                continue
            side = (points[w, 0] - points[v, 0]) * (y - points[v, 1]) - (x - points[v, 0]) * (
                points[w, 1] - points[v, 1]
            )
            if points[v, 1] <= y:
                turns += side > 0.0
            else:
                turns -= side < 0.0
    return turns


@leaf
def _is_in(board, v, j):
    x, y = board.points[v, 0], board.points[v, 1]
    # The container's rings run backwards: round a point inside once, the wrong way.
    return _winding(x, y, board, j) + (j == board.starts.shape[0] - 2) != 0


@leaf
def _enters(board, kept, count, j):
    """True if a ring has its first vertex in polygon ``j``, of rings with edges near that."""
    is_container = j == board.starts.shape[0] - 2
    box = board.boxes[j]
    for k in range(count):
        v = kept[k]
        # The first vertex of a ring is the one that comes after a later one.
        if board.before[v] < v:
            continue
        x, y = board.points[v, 0], board.points[v, 1]
        if not is_container and (x < box[0] or x > box[2] or y < box[1] or y > box[3]):
            continue
        if _is_in(board, v, j):
            return True
    return False


@leaf
def _to_edge_squared(x, y, points, v, w):
    dx, dy = points[w, 0] - points[v, 0], points[w, 1] - points[v, 1]
    ex, ey = x - points[v, 0], y - points[v, 1]
    length = dx * dx + dy * dy
    t = 0.0
    if length > 0.0:
        t = min(max((ex * dx + ey * dy) / length, 0.0), 1.0)
    ex -= t * dx
    ey -= t * dy
    return ex * ex + ey * ey


@leaf
def side(points, a, b, c):
    """Twice the signed area of the triangle of three vertices."""
    return (points[b, 0] - points[a, 0]) * (points[c, 1] - points[a, 1]) - (
        points[b, 1] - points[a, 1]
    ) * (points[c, 0] - points[a, 0])


@leaf
def _edges_squared(points, v, w, s, t, least):
    """Squared distance of two edges, 0 if they cross; ``least`` if it is not below that."""
    gap_x = max(
        min(points[v, 0], points[w, 0]) - max(points[s, 0], points[t, 0]),
        min(points[s, 0], points[t, 0]) - max(points[v, 0], points[w, 0]),
        0.0,
    )
    gap_y = max(
        min(points[v, 1], points[w, 1]) - max(points[s, 1], points[t, 1]),
        min(points[s, 1], points[t, 1]) - max(points[v, 1], points[w, 1]),
        0.0,
    )
    if gap_x * gap_x + gap_y * gap_y >= least:
        return least
    if (
        side(points, v, w, s) * side(points, v, w, t) < 0.0
        and side(points, s, t, v) * side(points, s, t, w) < 0.0
    ):
        return 0.0
    least = min(least, _to_edge_squared(points[v, 0], points[v, 1], points, s, t))
    least = min(least, _to_edge_squared(points[w, 0], points[w, 1], points, s, t))
    least = min(least, _to_edge_squared(points[s, 0], points[s, 1], points, v, w))
    return min(least, _to_edge_squared(points[t, 0], points[t, 1], points, v, w))


@leaf
def _box_runs(board, edges, count, boxes):
    """Write boxes about each :data:`RUN` edges (by their first vertex); returns how many."""
    points = board.points
    for e in range(count):
        box = boxes[e // RUN]
        if e % RUN == 0:
            box[0] = box[1] = np.inf
            box[2] = box[3] = -np.inf
        for v in (edges[e], board.after[edges[e]]):
            for c in range(2):
                box[c] = min(box[c], points[v, c])
                box[c + 2] = max(box[c + 2], points[v, c])
    return (count + RUN - 1) // RUN


@leaf
def _box_squared(box, points, v, w):
    squared = 0.0
    for c in range(2):
        low, high = min(points[v, c], points[w, c]), max(points[v, c], points[w, c])
        gap = max(box[c] - high, low - box[c + 2], 0.0)
        squared += gap * gap
    return squared


@leaf
def least_squared(board, room, count_first, count_second, least):
    """Squared distance of two sets of edges, 0 if any cross; ``least`` if it is not below that."""
    points, after, first, second, boxes = (
        board.points, board.after, room.first, room.second, room.boxes,
    )  # fmt: skip
    runs = _box_runs(board, second, count_second, boxes)
    for a in range(count_first):
        v = first[a]
        w = after[v]
        for r in range(runs):
            if _box_squared(boxes[r], points, v, w) >= least:
                continue
            for b in range(r * RUN, min((r + 1) * RUN, count_second)):
                least = _edges_squared(points, v, w, second[b], after[second[b]], least)
            if least == 0.0:
                return 0.0
    return least


@leaf
def distance(board, i, j, reach, room):
    """Distance of two polygons: 0 if they meet, ``reach`` if it is not below that.

    ``room``: of :func:`room_for`.
    """
    if j < board.starts.shape[0] - 2 and are_apart(board.boxes, i, j, reach):
        return reach
    return _near_distance(board, i, j, reach, room)


@shared(_nrt=False)
def _near_distance(board, i, j, reach, room):
    """Distance of two polygons whose boxes are within reach."""
    first, second = room.first, room.second
    count_j = cull(board, j, board.boxes, i, reach, second)
    if j == board.starts.shape[0] - 2:
        if sticks_out(board.boxes[i], board.boxes[j]):
            return 0.0
        if count_j == 0:
            # All inside or all outside.
            return 0.0 if _is_in(board, board.starts[i], j) else reach
    count_i = cull(board, i, board.boxes, j, reach, first)
    least = least_squared(board, room, count_i, count_j, reach * reach)
    if least == 0.0:
        return 0.0
    if _enters(board, first, count_i, j) or _enters(board, second, count_j, i):
        return 0.0
    return math.sqrt(least) if least < reach * reach else reach


@kernel
def distances(board, pairs, reach):
    """Distance of each pair: 0 if they meet, ``reach`` if it is not below that."""
    found = np.empty(pairs.shape[0])
    room = room_for(most_points(board.starts, pairs))
    for p in range(pairs.shape[0]):
        found[p] = distance(board, pairs[p, 0], pairs[p, 1], reach, room)
    return found
