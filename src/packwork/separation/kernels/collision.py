"""Price of a part's collisions at a trial pose, weighted by pair; exact in what collides."""

from __future__ import annotations

import math

import numpy as np

from packwork.compiled import helper

# Columns of ``items``: the box, and what enters the price of an overlap.
X0, Y0, X1, Y1, PENALTY, DECAY, X, Y, ANGLE, SIDE = range(10)
# Columns of ``index``: edges and poles from and to, the shape, and the turn nearest to the angle.
EDGE, EDGE_END, POLE, POLE_END, SHAPE, TURN = range(6)

_SLIVER = 1e-4
"""Share of a part's box that any protrusion counts at least."""


@helper
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


@helper
def pole_overlap(x, y, turned_poles, count, poles, first, last, decay, lanes):
    """Sum over pairs of poles of their depths, and the greatest depth, both to 32 bits.

    Depths below ``decay`` fall off as its square over the distance, never to 0. ``lanes``: two rows
    of scratch; sums run beside one another in a fixed order, so that no machine rounds otherwise.
    """
    wide = last - first
    for q in range(wide):
        lanes[0, q] = 0.0
        lanes[1, q] = -np.inf
    shallow = np.float32(decay)
    square, twice = shallow * shallow, shallow + shallow
    left, top = np.float32(x), np.float32(y)
    for p in range(count):
        px, py, radius = left + turned_poles[0, p], top + turned_poles[1, p], turned_poles[2, p]
        for q in range(wide):
            dx, dy = px - poles[0, first + q], py - poles[1, first + q]
            other = poles[2, first + q]
            depth = radius + other - np.sqrt(dx * dx + dy * dy)
            decayed = depth if depth >= shallow else square / (twice - depth)
            lanes[0, q] += decayed * (min(other, radius))
            lanes[1, q] = max(lanes[1, q], depth)
    total, deepest = 0.0, -np.inf
    for q in range(wide):
        total += lanes[0, q]
        deepest = max(deepest, lanes[1, q])
    return math.pi * total + decay * decay, deepest


@helper
def _side(ax, ay, bx, by, px, py):
    return (bx - ax) * (py - ay) - (by - ay) * (px - ax)


@helper
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


@helper
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
    if box[0] >= other[X0] and box[1] >= other[Y0] and box[2] <= other[X1] and box[3] <= other[Y1]:
        return _holds(edges, first, last, own[0, 0], own[1, 0])
    if box[0] <= other[X0] and box[1] <= other[Y0] and box[2] >= other[X1] and box[3] >= other[Y1]:
        return _holds(own, 0, count, edges[0, first], edges[1, first])
    return False


@helper
def price(i, x, y, bound, row, layout, weights, turned, sheet, scratch):
    """Weighted price of part ``i``, as it is turned, at (x, y); above ``bound``: only that it is.

    ``turned``: its edges about its own point, their box in the last column, and its poles;
    ``row``: empty, or what receives the price of each pair without its weight.
    """
    items, index, edges, poles = layout
    own_edges, own_poles = turned
    own, lanes, waiting, prices, close, box = scratch
    count = index[i, EDGE_END] - index[i, EDGE]
    pole_count = index[i, POLE_END] - index[i, POLE]
    penalty, keeps = items[i, PENALTY], len(row) > 0
    box[0], box[1] = x + own_edges[0, count], y + own_edges[1, count]
    box[2], box[3] = x + own_edges[2, count], y + own_edges[3, count]
    cost = outside_price(box[0], box[1], box[2], box[3], sheet, penalty * penalty)
    total = weights[i, i] * cost
    if keeps:
        row[:] = 0.0
        row[i] = cost
    if total > bound:
        return total
    left = 0
    for j in range(len(items)):
        if items[j, X0] > box[2] or items[j, X1] < box[0] or j == i:
            continue
        if items[j, Y0] > box[3] or items[j, Y1] < box[1]:
            continue
        decay = max(items[i, DECAY], items[j, DECAY])
        area, depth = pole_overlap(
            x, y, own_poles, pole_count, poles, index[j, POLE], index[j, POLE_END], decay, lanes
        )
        cost = math.sqrt(area) * penalty * items[j, PENALTY]
        if depth <= decay:
            # Not deep enough for poles to tell, rounded as they are.
            waiting[left], prices[left] = j, cost
            left += 1
            continue
        if keeps:
            row[j] = cost
        total += weights[i, j] * cost
        if total > bound:
            return total
    if left > 0:
        for k in range(count):
            own[0, k], own[1, k] = x + own_edges[0, k], y + own_edges[1, k]
            own[2, k], own[3, k] = x + own_edges[2, k], y + own_edges[3, k]
    for k in range(left):
        j = waiting[k]
        if _touch(own, count, box, edges, index[j, EDGE], index[j, EDGE_END], items[j], close):
            if keeps:
                row[j] = prices[k]
            total += weights[i, j] * prices[k]
            if total > bound:
                return total
    return total
