"""Distances and contacts of polygons in place, pair by pair.

All solids lie one after another in ``points``: first the items, last the container,
whose rings run backwards, so that its solid is all that must not be entered. The outward
normal of an edge ``d`` is ``(d_y, -d_x)``.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numba import njit


class Board(NamedTuple):
    """Solids in place; arrays that the kernels write to.

    ``own``: points of all solids about their own origins; ``starts``: first point of each
    solid; ``after``, ``before``: neighbours of each point in its ring; ``points``: in
    place; ``boxes``: left, top, right, bottom of each; ``places``: x, y, turn, logarithm
    of growth of each item; ``arms``: farthest point of each item at growth 0.
    """

    own: np.ndarray
    starts: np.ndarray
    after: np.ndarray
    before: np.ndarray
    points: np.ndarray
    boxes: np.ndarray
    places: np.ndarray
    arms: np.ndarray


@njit(cache=True, nogil=True, error_model="numpy")
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


@njit(cache=True, nogil=True, error_model="numpy")
def arm(board, i):
    """Farthest point of an item from its origin, as large as it is now."""
    return board.arms[i] * math.exp(board.places[i, 3])


@njit(cache=True, nogil=True, error_model="numpy")
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


@njit(cache=True, nogil=True, error_model="numpy")
def _are_apart(boxes, i, j, reach):
    """Whether two boxes are farther apart than ``reach`` along an axis."""
    return (
        boxes[j, 0] > boxes[i, 2] + reach
        or boxes[i, 0] > boxes[j, 2] + reach
        or boxes[j, 1] > boxes[i, 3] + reach
        or boxes[i, 1] > boxes[j, 3] + reach
    )


@njit(cache=True, nogil=True, error_model="numpy")
def pairs_of(boxes, items, reach):
    """Pairs of boxes within ``reach`` of which one at least is among ``items``.

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
        for j in range(last + 1):
            if j == i or (j < i and chosen[j]):
                continue
            if j < last and _are_apart(boxes, i, j, reach):
                continue
            if count == found.shape[0]:
                longer = np.empty((2 * count, 2), np.int64)
                for f in range(count):
                    longer[f, 0], longer[f, 1] = found[f, 0], found[f, 1]
                found = longer
            found[count, 0], found[count, 1] = min(i, j), max(i, j)
            count += 1
    return found[:count]


@njit(cache=True, nogil=True, error_model="numpy")
def _cull(board, i, box, reach, kept):
    """Write the edges of a solid (by their first vertex) within ``reach`` of a box."""
    points = board.points
    left, top, right, bottom = box[0] - reach, box[1] - reach, box[2] + reach, box[3] + reach
    count = 0
    for v in range(board.starts[i], board.starts[i + 1]):
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


@njit(cache=True, nogil=True, error_model="numpy")
def _to_edge_squared(x, y, points, v, w):
    """Squared distance of a point from the edge between two vertices."""
    dx, dy = points[w, 0] - points[v, 0], points[w, 1] - points[v, 1]
    ex, ey = x - points[v, 0], y - points[v, 1]
    length = dx * dx + dy * dy
    t = 0.0
    if length > 0.0:
        t = min(max((ex * dx + ey * dy) / length, 0.0), 1.0)
    ex -= t * dx
    ey -= t * dy
    return ex * ex + ey * ey


@njit(cache=True, nogil=True, error_model="numpy")
def _side(points, a, b, c):
    """Twice the signed area of the triangle of three vertices."""
    return (points[b, 0] - points[a, 0]) * (points[c, 1] - points[a, 1]) - (
        points[b, 1] - points[a, 1]
    ) * (points[c, 0] - points[a, 0])


@njit(cache=True, nogil=True, error_model="numpy")
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
        _side(points, v, w, s) * _side(points, v, w, t) < 0.0
        and _side(points, s, t, v) * _side(points, s, t, w) < 0.0
    ):
        return 0.0
    least = min(least, _to_edge_squared(points[v, 0], points[v, 1], points, s, t))
    least = min(least, _to_edge_squared(points[w, 0], points[w, 1], points, s, t))
    least = min(least, _to_edge_squared(points[s, 0], points[s, 1], points, v, w))
    return min(least, _to_edge_squared(points[t, 0], points[t, 1], points, v, w))


@njit(cache=True, nogil=True, error_model="numpy")
def _winding(x, y, board, j):
    """How often the rings of a solid go round a point."""
    points, turns = board.points, 0
    for v in range(board.starts[j], board.starts[j + 1]):
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


@njit(cache=True, nogil=True, error_model="numpy")
def _enters(board, i, j):
    """Whether a ring of solid ``i`` has its first vertex in solid ``j``."""
    is_container = j == board.starts.shape[0] - 2
    box = board.boxes[j]
    for v in range(board.starts[i], board.starts[i + 1]):
        # The first vertex of a ring is the one that comes after a later one.
        if board.before[v] < v:
            continue
        x, y = board.points[v, 0], board.points[v, 1]
        if not is_container and (x < box[0] or x > box[2] or y < box[1] or y > box[3]):
            continue
        # The container's rings run backwards: round a point inside once, the wrong way.
        if _winding(x, y, board, j) + is_container != 0:
            return True
    return False


@njit(cache=True, nogil=True, error_model="numpy")
def most_points(starts):
    """Points of the solid that has most: room for its edges."""
    most = 0
    for i in range(starts.shape[0] - 1):
        most = max(most, starts[i + 1] - starts[i])
    return most


@njit(cache=True, nogil=True, error_model="numpy")
def distance(board, i, j, reach, room):
    """Distance of two solids: 0 if they meet, ``reach`` if it is not below that.

    ``room``: two rows of :func:`most_points`.
    """
    if j < board.starts.shape[0] - 2 and _are_apart(board.boxes, i, j, reach):
        return reach
    least = reach * reach
    first, second = room[0], room[1]
    count_i = _cull(board, i, board.boxes[j], reach, first)
    count_j = _cull(board, j, board.boxes[i], reach, second)
    for a in range(count_i):
        v = first[a]
        w = board.after[v]
        for b in range(count_j):
            s = second[b]
            least = _edges_squared(board.points, v, w, s, board.after[s], least)
        if least == 0.0:
            return 0.0
    if _enters(board, i, j) or _enters(board, j, i):
        return 0.0
    return math.sqrt(least) if least < reach * reach else reach


@njit(cache=True, nogil=True, error_model="numpy")
def distances(board, pairs, reach):
    """Distance of each pair: 0 if they meet, ``reach`` if it is not below that."""
    found = np.empty(pairs.shape[0])
    room = np.empty((2, most_points(board.starts)), np.int64)
    for p in range(pairs.shape[0]):
        found[p] = distance(board, pairs[p, 0], pairs[p, 1], reach, room)
    return found


@njit(cache=True, nogil=True, error_model="numpy")
def contacts(board, pairs, reach, slants, who, numbers):
    """Write what keeps pairs apart; returns how many, counting on past the end.

    ``who``: which pair. ``numbers``: normal from the second solid to the first, point on
    the first, point on the second, distance. Only features within ``reach`` bind: convex
    vertices against edges that they see from outside, near the edge's own span, and
    against convex corners that face them. ``slants``: by how much the two solids of each
    pair may turn against each other, rad.
    """
    most = most_points(board.starts)
    kept, edges = np.empty((2, most), np.int64), np.empty((2, 9, most))
    near = np.empty(most, np.bool_)
    count = 0
    for k in range(pairs.shape[0]):
        i, j = pairs[k, 0], pairs[k, 1]
        if _are_apart(board.boxes, i, j, reach):
            continue
        count_i = _cull(board, i, board.boxes[j], reach, kept[0])
        count_j = _cull(board, j, board.boxes[i], reach, kept[1])
        _describe(board, kept[0], count_i, edges[0])
        _describe(board, kept[1], count_j, edges[1])
        for side in range(2):
            mine, theirs = (count_i, count_j) if side == 0 else (count_j, count_i)
            count = _meet(
                edges[side], mine, edges[1 - side], theirs, near, reach, slants[k], k, side,
                who, numbers, count,
            )  # fmt: skip
    return count


@njit(cache=True, nogil=True, error_model="numpy")
def _describe(board, kept, count, edges):
    """Write columns of what contacts need of edges.

    Their unit vector, length, the unit vector of the edge before, bends at their begin and
    their end, and their begin. A bend is positive where the solid stands out.
    """
    points = board.points
    for k in range(count):
        v = kept[k]
        w, u = board.after[v], board.before[v]
        dx, dy = points[w, 0] - points[v, 0], points[w, 1] - points[v, 1]
        ex, ey = points[v, 0] - points[u, 0], points[v, 1] - points[u, 1]
        length = math.sqrt(dx * dx + dy * dy)
        other = math.sqrt(ex * ex + ey * ey)
        edges[0, k], edges[1, k] = dx / max(length, 1e-300), dy / max(length, 1e-300)
        edges[2, k] = length
        edges[3, k], edges[4, k] = ex / max(other, 1e-300), ey / max(other, 1e-300)
        edges[5, k] = _side(points, u, v, w)
        edges[6, k] = _side(points, v, w, board.after[w])
        edges[7, k], edges[8, k] = points[v, 0], points[v, 1]


@njit(cache=True, nogil=True, error_model="numpy")
def _sift(own, a, others, count, reach, slant, has_corners, near):
    """Mark the edges that bind a vertex, but for corners nearly: few of many do.

    A loop without branches takes several edges at a time. ``has_corners``: whether corners
    that face the vertex count.
    """
    x, y = own[7, a], own[8, a]
    out_x, out_y, in_x, in_y = own[0, a], own[1, a], own[3, a], own[4, a]
    ux, uy, length, wx, wy = others[0], others[1], others[2], others[3], others[4]
    first, last, begin_x, begin_y = others[5], others[6], others[7], others[8]
    for b in range(count):
        ex, ey = x - begin_x[b], y - begin_y[b]
        height = uy[b] * ex - ux[b] * ey
        along = ux[b] * ex + uy[b] * ey
        # The vertex must reach farthest against the normal among its neighbours, nearly.
        reaches = (uy[b] * out_x - ux[b] * out_y >= -slant) & (uy[b] * in_x - ux[b] * in_y <= slant)
        is_beyond = (along < 0.0) & (first[b] > 0.0)
        faces = has_corners & (ex * wx[b] + ey * wy[b] >= 0.0)
        # Beyond a bay's corner an edge still binds: its line goes on inside the solid.
        ends = (along <= length[b]) | ((along <= length[b] + reach) & (last[b] <= 0.0))
        near[b] = (
            (height > 0.0)
            & (height <= reach)
            & (along >= -reach)
            & ends
            & ((is_beyond & faces) | (reaches & ~is_beyond))
        )


@njit(cache=True, nogil=True, error_model="numpy")
def _meet(
    own, count_own, others, count_others, near, reach, slant, pair, side, who, numbers, count,
):  # fmt: skip
    """Contacts of convex vertices of one solid with edges and corners of another.

    ``side``: 0 if the vertices are the first solid's, 1 if the second's.
    """
    for a in range(count_own):
        if own[5, a] <= 0.0:
            continue
        # Each pair of corners counts once, from the first solid's side.
        _sift(own, a, others, count_others, reach, slant, side == 0, near)
        x, y = own[7, a], own[8, a]
        for b in range(count_others):
            if not near[b]:
                continue
            nx, ny = others[1, b], -others[0, b]
            ex, ey = x - others[7, b], y - others[8, b]
            height = nx * ex + ny * ey
            if ny * ex > nx * ey and others[5, b] > 0.0:
                # Beyond a convex corner that faces the vertex, the corner itself.
                height = math.sqrt(ex * ex + ey * ey)
                if height > reach:
                    continue
                nx, ny = ex / height, ey / height
                if nx * own[0, a] + ny * own[1, a] < -slant:
                    continue
                if nx * own[3, a] + ny * own[4, a] > slant:
                    continue
            if count < who.shape[0]:
                who[count] = pair
                row = numbers[count]
                sign = 1.0 - 2.0 * side
                row[0], row[1], row[6] = sign * nx, sign * ny, height
                here, there = 2 + 2 * side, 4 - 2 * side
                row[here], row[here + 1] = x, y
                row[there], row[there + 1] = x - height * nx, y - height * ny
            count += 1
    return count
