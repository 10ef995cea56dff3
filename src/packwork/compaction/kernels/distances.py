"""Distances of polygons in place, pair by pair, and the pairs that are near.

All solids lie one after another in ``points``: first the items, last the container,
whose rings run backwards, so that its solid is all that must not be entered. The outward
normal of an edge ``d`` is ``(d_y, -d_x)``.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from packwork.compaction.kernels.edges import least_squared
from packwork.compiled import helper, kernel, shared


class Board(NamedTuple):
    """Solids in place; arrays that the kernels write to.

    ``own``: points of all solids about their own origins; ``starts``: first point of each
    solid; ``after``, ``before``: neighbours of each point in its ring; ``points``: in
    place; ``boxes``: left, top, right, bottom of each; ``spans``: the same of every
    ``stride`` successive edges of the container, which stands still; ``places``: x, y, turn,
    logarithm of growth of each item; ``arms``: farthest point of each item at growth 0.
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


@kernel
def put(board, items, places):
    """Grow, turn and move some items to the rows of ``places``."""
    own, points = board.own, board.points
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


@helper
def arm(board, i):
    """Farthest point of an item from its origin, as large as it is now."""
    return board.arms[i] * math.exp(board.places[i, 3])


@kernel
def near_pairs(boxes, order, reach, found):
    """Write pairs of boxes within ``reach``, smaller index first; returns how many.

    ``order`` sorts the boxes by their left side. Counts on past the end of ``found``.
    """
    count = 0
    for a in range(order.shape[0]):
        i = order[a]
        limit = boxes[i, 2] + reach
        for b in range(a + 1, order.shape[0]):
            j = order[b]
            if boxes[j, 0] > limit:
                break
            if boxes[j, 1] > boxes[i, 3] + reach or boxes[i, 1] > boxes[j, 3] + reach:
                continue
            if count < found.shape[0]:
                found[count, 0] = min(i, j)
                found[count, 1] = max(i, j)
            count += 1
    return count


@helper
def are_apart(boxes, i, j, reach):
    """True if two of some boxes are farther apart than ``reach`` along an axis."""
    # Number by number: a view of a row is counted by all threads together, which takes longer.
    return (
        boxes[j, 0] > boxes[i, 2] + reach
        or boxes[i, 0] > boxes[j, 2] + reach
        or boxes[j, 1] > boxes[i, 3] + reach
        or boxes[i, 1] > boxes[j, 3] + reach
    )


@helper
def _two_boxes(boxes, items):
    """Boxes about those of ``items`` near the first of them, and about those far from it."""
    middle = np.empty(2)
    farthest, most = items[0], -1.0
    for k in range(items.shape[0]):
        away = 0.0
        for c in range(2):
            middle[c] = boxes[items[k], c] + boxes[items[k], c + 2]
            away += (middle[c] - boxes[items[0], c] - boxes[items[0], c + 2]) ** 2
        if away > most:
            farthest, most = items[k], away
    found = np.empty((2, 4))
    for a in range(2):
        found[a, 0] = found[a, 1] = np.inf
        found[a, 2] = found[a, 3] = -np.inf
    for k in range(items.shape[0]):
        box = boxes[items[k]]
        nearer = 0.0
        for c in range(2):
            here = box[c] + box[c + 2]
            nearer += (here - boxes[items[0], c] - boxes[items[0], c + 2]) ** 2
            nearer -= (here - boxes[farthest, c] - boxes[farthest, c + 2]) ** 2
        one = found[int(nearer > 0.0)]
        for c in range(2):
            one[c], one[c + 2] = min(one[c], box[c]), max(one[c + 2], box[c + 2])
    return found


@kernel
def nearby(boxes, items, reach):
    """Items whose boxes may be within ``reach`` of one of ``items``, in their order."""
    about = _two_boxes(boxes, items)
    near = np.empty(boxes.shape[0] - 1, np.int64)
    count = 0
    for j in range(near.shape[0]):
        for a in range(2):
            if (
                boxes[j, 0] <= about[a, 2] + reach
                and about[a, 0] <= boxes[j, 2] + reach
                and boxes[j, 1] <= about[a, 3] + reach
                and about[a, 1] <= boxes[j, 3] + reach
            ):
                near[count] = j
                count += 1
                break
    return near[:count]


@helper
def pairs_among(boxes, items, near, reach):
    """Pairs of boxes within ``reach``, of each of ``items`` with those of ``near``.

    Smaller index first; then each of the items with the last box, the container's.
    """
    last = boxes.shape[0] - 1
    chosen = np.zeros(last, np.bool_)
    for k in range(items.shape[0]):
        chosen[items[k]] = True
    found = np.empty((16 * items.shape[0] + 16, 2), np.int64)
    count = 0
    for k in range(items.shape[0]):
        i = items[k]
        for a in range(near.shape[0] + 1):
            j = near[a] if a < near.shape[0] else last
            if j == i or (j < i and chosen[j]):
                continue
            if j < last and are_apart(boxes, i, j, reach):
                continue
            if count == found.shape[0]:
                longer = np.empty((2 * count, 2), np.int64)
                for f in range(count):
                    longer[f, 0], longer[f, 1] = found[f, 0], found[f, 1]
                found = longer
            found[count, 0], found[count, 1] = min(i, j), max(i, j)
            count += 1
    return found[:count]


@kernel
def pairs_of(boxes, items, reach):
    """Pairs of boxes within ``reach`` of which one at least is among ``items``.

    Smaller index first; then each of the items with the last box, the container's.
    """
    return pairs_among(boxes, items, nearby(boxes, items, reach), reach)


@helper
def cull(board, i, boxes, j, reach, kept):
    """Write the edges of a solid (by their first vertex) within ``reach`` of one of the boxes."""
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


@helper
def _winding(x, y, board, j):
    """Winding number of the rings of a solid about a point."""
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


@helper
def _is_in(board, v, j):
    """True if a vertex lies in solid ``j``."""
    x, y = board.points[v, 0], board.points[v, 1]
    # The container's rings run backwards: round a point inside once, the wrong way.
    return _winding(x, y, board, j) + (j == board.starts.shape[0] - 2) != 0


@helper
def _enters(board, kept, count, j):
    """True if a ring has its first vertex in solid ``j``, of rings with edges near that."""
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


@helper
def most_points(starts, pairs):
    """Points of the solid of some pairs that has most: room for its edges."""
    most = 0
    for p in range(pairs.shape[0]):
        for i in pairs[p]:
            most = max(most, starts[i + 1] - starts[i])
    return most


@helper
def sticks_out(inner, outer):
    """True if a box is not within another one."""
    return inner[0] < outer[0] or inner[1] < outer[1] or inner[2] > outer[2] or inner[3] > outer[3]


@helper
def distance(board, i, j, reach, room):
    """Distance of two solids: 0 if they meet, ``reach`` if it is not below that.

    ``room``: two rows of :func:`most_points`.
    """
    if j < board.starts.shape[0] - 2 and are_apart(board.boxes, i, j, reach):
        return reach
    return _near_distance(board, i, j, reach, room)


@shared
def _near_distance(board, i, j, reach, room):
    """Distance of two solids whose boxes are within reach."""
    first, second = room[0], room[1]
    count_j = cull(board, j, board.boxes, i, reach, second)
    if j == board.starts.shape[0] - 2:
        if sticks_out(board.boxes[i], board.boxes[j]):
            return 0.0
        if count_j == 0:
            # All inside or all outside.
            return 0.0 if _is_in(board, board.starts[i], j) else reach
    count_i = cull(board, i, board.boxes, j, reach, first)
    least = least_squared(board, first[:count_i], second[:count_j], reach * reach)
    if least == 0.0:
        return 0.0
    if _enters(board, first, count_i, j) or _enters(board, second, count_j, i):
        return 0.0
    return math.sqrt(least) if least < reach * reach else reach


@kernel
def distances(board, pairs, reach):
    """Distance of each pair: 0 if they meet, ``reach`` if it is not below that."""
    found = np.empty(pairs.shape[0])
    room = np.empty((2, most_points(board.starts, pairs)), np.int64)
    for p in range(pairs.shape[0]):
        found[p] = distance(board, pairs[p, 0], pairs[p, 1], reach, room)
    return found
