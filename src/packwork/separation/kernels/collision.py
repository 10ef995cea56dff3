"""Price of a part's collisions at a trial pose, weighted by pair; exact in what collides."""

from __future__ import annotations

import math

import numpy as np

from packwork.compiled import leaf

# Rows of ``items``: the box, and what enters the price of an overlap.
X0, Y0, X1, Y1, PENALTY, DECAY, X, Y, ANGLE, SIDE = range(10)
# Columns of ``index``: edges from and to, the shape, and the turn nearest to the angle.
EDGE, EDGE_END, SHAPE, TURN = range(4)

POLES = 16
"""Poles of each part, a multiple of what a processor works out at once."""

_SLIVER = 1e-4
"""Share of a part's box that any protrusion counts at least."""

_LARGEST = 4
"""Poles after which an overlap may be known to be too dear already. Chosen."""


@leaf
def outside_price(x0, y0, x1, y1, sheet, penalty):
    """Price of what of a box lies outside the sheet's (0, 0) to ``sheet``; 0 where nothing."""
    if x0 >= 0.0 and y0 >= 0.0 and x1 <= sheet[0] and y1 <= sheet[1]:
        return 0.0
    area = (x1 - x0) * (y1 - y0)
    wide, tall = min(x1, sheet[0]) - max(x0, 0.0), min(y1, sheet[1]) - max(y0, 0.0)
    if wide > 0.0 and tall > 0.0:
        out = area - wide * tall + _SLIVER * area
    else:
        out = area + math.hypot((x0 + x1 - sheet[0]) / 2.0, (y0 + y1 - sheet[1]) / 2.0)
    return 2.0 * math.sqrt(out) * penalty


@leaf
def pole_overlap(x, y, turned_poles, poles, decay, most, lanes):
    """Sum over pairs of poles of their depths, to 32 bits; above ``most``: only that it is.

    Depths below ``decay`` fall off as its square over the distance, never to 0. ``lanes``: scratch;
    sums run beside one another in a fixed order, so that no machine rounds otherwise.
    """
    for q in range(POLES):
        lanes[q] = 0.0
    shallow = np.float32(decay)
    square, twice = shallow * shallow, shallow + shallow
    left, top = np.float32(x), np.float32(y)
    begin, end = 0, _LARGEST
    while True:
        for p in range(begin, end):
            px, py, radius = left + turned_poles[0, p], top + turned_poles[1, p], turned_poles[2, p]
            for q in range(POLES):
                dx, dy = px - poles[0, q], py - poles[1, q]
                depth = radius + poles[2, q] - np.sqrt(dx * dx + dy * dy)
                decayed = depth if depth >= shallow else square / (twice - depth)
                lanes[q] += decayed * min(poles[2, q], radius)
        total = 0.0
        for q in range(POLES):
            total += lanes[q]
        if end == POLES or math.pi * total > most:
            return math.pi * total + decay * decay
        begin, end = end, POLES


@leaf
def _side(ax, ay, bx, by, px, py):
    return (bx - ax) * (py - ay) - (by - ay) * (px - ax)


@leaf
def _holds(edges, first, last, px, py):
    """True for a point inside rings, by the even-odd rule."""
    inside = False
    for k in range(first, last):
        ay, by = edges[1, k], edges[3, k]
        if (ay > py) == (by > py):
            continue
        if px < edges[0, k] + (py - ay) / (by - ay) * (edges[2, k] - edges[0, k]):
            inside = not inside
    return inside


@leaf
def _holds_ring(own, begin, end, box, edges, first, last):
    """True for rings one of which begins inside others, whose box is ``box``.

    Where no edges cross, the whole piece of a part that such a ring goes round lies there.
    """
    for k in range(begin, end):
        x, y = own[0, k], own[1, k]
        # Within a ring an edge begins where the one before it ends.
        if k > begin and x == own[2, k - 1] and y == own[3, k - 1]:
            continue
        is_near = x >= box[0] and y >= box[1] and x <= box[2] and y <= box[3]
        if is_near and _holds(edges, first, last, x, y):
            return True
    return False


@leaf
def _is_ring(edges, first, last):
    """True for edges of one ring."""
    return edges[2, last - 1] == edges[0, first] and edges[3, last - 1] == edges[1, first]


@leaf
def _touch(own, count, box, edges, first, last, other, close):
    """True for two parts that touch or overlap, both in absolute coordinates.

    ``own``: edges of the one; ``close``: scratch for those in the boxes' intersection.
    """
    x0, y0 = max(box[0], other[X0]), max(box[1], other[Y0])
    x1, y1 = min(box[2], other[X1]), min(box[3], other[Y1])
    met = 0
    for k in range(count):
        ax, ay, bx, by = own[0, k], own[1, k], own[2, k], own[3, k]
        if max(ax, bx) < x0 or min(ax, bx) > x1 or max(ay, by) < y0 or min(ay, by) > y1:
            continue
        close[met] = k
        met += 1
    if met > 0:
        for e in range(first, last):
            cx, cy, dx, dy = edges[0, e], edges[1, e], edges[2, e], edges[3, e]
            left, right = min(cx, dx), max(cx, dx)
            top, bottom = min(cy, dy), max(cy, dy)
            if right < x0 or left > x1 or bottom < y0 or top > y1:
                continue
            for m in range(met):
                k = close[m]
                ax, ay, bx, by = own[0, k], own[1, k], own[2, k], own[3, k]
                if max(ax, bx) < left or min(ax, bx) > right:
                    continue
                if max(ay, by) < top or min(ay, by) > bottom:
                    continue
                one, two = _side(ax, ay, bx, by, cx, cy), _side(ax, ay, bx, by, dx, dy)
                if (one > 0.0 and two > 0.0) or (one < 0.0 and two < 0.0):
                    continue
                one, two = _side(cx, cy, dx, dy, ax, ay), _side(cx, cy, dx, dy, bx, by)
                if (one > 0.0 and two > 0.0) or (one < 0.0 and two < 0.0):
                    continue
                return True
    is_in = box[0] >= other[X0] and box[1] >= other[Y0]
    is_in = is_in and box[2] <= other[X1] and box[3] <= other[Y1]
    if (is_in or not _is_ring(own, 0, count)) and _holds_ring(
        own, 0, count, other[X0 : Y1 + 1], edges, first, last
    ):
        return True
    is_around = box[0] <= other[X0] and box[1] <= other[Y0]
    is_around = is_around and box[2] >= other[X1] and box[3] >= other[Y1]
    return (is_around or not _is_ring(edges, first, last)) and _holds_ring(
        edges, first, last, box, own, 0, count
    )


@leaf
def price(i, x, y, bound, row, layout, weights, turned, sheet, scratch):
    """Weighted price of part ``i``, as it is turned, at (x, y); above ``bound``: only that it is.

    ``turned``: its edges about its own point, their box in the last column, and its poles;
    ``row``: empty, or what receives the price of each pair without its weight.
    """
    items, index, edges, poles = layout
    own_edges, own_poles = turned
    own, lanes, close, box, near = scratch
    count = index[i, EDGE_END] - index[i, EDGE]
    penalty, keeps = items[PENALTY, i], len(row) > 0
    box[0], box[1] = x + own_edges[0, count], y + own_edges[1, count]
    box[2], box[3] = x + own_edges[2, count], y + own_edges[3, count]
    cost = outside_price(box[0], box[1], box[2], box[3], sheet, penalty * penalty)
    total = weights[i, i] * cost
    if keeps:
        row[:] = 0.0
        row[i] = cost
    if total > bound:
        return total
    for k in range(count):
        own[0, k], own[1, k] = x + own_edges[0, k], y + own_edges[1, k]
        own[2, k], own[3, k] = x + own_edges[2, k], y + own_edges[3, k]
    x0, y0, x1, y1 = box[0], box[1], box[2], box[3]
    for j in range(items.shape[1]):
        near[j] = (
            (items[X0, j] <= x1)
            & (items[X1, j] >= x0)
            & (items[Y0, j] <= y1)
            & (items[Y1, j] >= y0)
        )
    near[i] = False
    for j in range(items.shape[1]):
        if not near[j]:
            continue
        first, last = index[j, EDGE], index[j, EDGE_END]
        if not _touch(own, count, box, edges, first, last, items[:, j], close):
            continue
        scale = penalty * items[PENALTY, j]
        decay, room = max(items[DECAY, i], items[DECAY, j]), (bound - total) / scale / weights[i, j]
        area = pole_overlap(x, y, own_poles, poles[j], decay, room * room, lanes)
        cost = math.sqrt(area) * scale
        if keeps:
            row[j] = cost
        total += weights[i, j] * cost
        if total > bound:
            return total
    return total
