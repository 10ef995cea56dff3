"""Outer simplification: rings with fewer vertices, by changes that only ever add to the polygon.

Sources: ``outer_simplify.py``.
"""

from __future__ import annotations

import math

import numpy as np

from packwork.compaction.kernels import distances
from packwork.compiled import helper, kernel


@helper
def _change(points, after, before, v, corner):
    """Area that the polygon gains if vertex ``v`` of a bay, or the edge after ``v``, goes.

    A vertex of a bay is left out; a convex edge goes by prolonging its neighbours until
    they meet in ``corner``. Infinite where neither can be.
    """
    u, w = before[v], after[v]
    bend = distances.side(points, u, v, w)
    if bend <= 0.0:
        length = math.hypot(points[w, 0] - points[u, 0], points[w, 1] - points[u, 1])
        return -bend / length if length > 0.0 else 0.0
    x = after[w]
    if distances.side(points, v, w, x) <= 0.0:
        return np.inf
    ax, ay = points[v, 0] - points[u, 0], points[v, 1] - points[u, 1]
    bx, by = points[w, 0] - points[x, 0], points[w, 1] - points[x, 1]
    across = ax * by - ay * bx
    # The neighbours meet beyond the edge only if they turn by less than half a turn.
    if across >= 0.0:
        return np.inf
    dx, dy = points[x, 0] - points[u, 0], points[x, 1] - points[u, 1]
    along = (dx * by - dy * bx) / across
    if along < 1.0:
        return np.inf
    corner[0], corner[1] = points[u, 0] + along * ax, points[u, 1] + along * ay
    ex, ey = points[w, 0] - points[v, 0], points[w, 1] - points[v, 1]
    cx, cy = corner[0] - points[v, 0], corner[1] - points[v, 1]
    length, along = math.hypot(ex, ey), ex * cx + ey * cy
    if 0.0 < along < length * length:
        return abs(ex * cy - ey * cx) / length
    # Beside the edge, as where three edges in one line bend by rounding alone.
    return min(math.hypot(cx, cy), math.hypot(cx - ex, cy - ey))


@helper
def _rank(costs, best, v):
    """Play all matches of vertex ``v`` anew, from its own up to the final.

    ``best`` is a tournament (a segment tree): ``best[k]`` the cheaper of ``best[2k]`` and ``best[2k
    + 1]``, the one of the lower number among equals.
    """
    k = (best.shape[0] // 2 + v) // 2
    while k >= 1:
        first, second = best[2 * k], best[2 * k + 1]
        is_first = second < 0 or costs[first] <= costs[second]
        best[k] = first if is_first else second
        k //= 2


@kernel
def simplify_outward(points, tolerance):
    """Vertices of a ring whose polygon holds that of ``points``, the cheapest changes first.

    The polygon lies where a positive ring has its inside. No change grows it by more than
    ``tolerance``; together they may by several times that, which is rare. Takes n log n steps.
    """
    count = points.shape[0]
    points = points.copy()
    after, before = np.empty(count, np.int64), np.empty(count, np.int64)
    costs, corners = np.empty(count), np.empty((count, 2))
    for v in range(count):
        after[v], before[v] = (v + 1) % count, (v - 1) % count
    for v in range(count):
        costs[v] = _change(points, after, before, v, corners[v])
    leaves = 1
    while leaves < count:
        leaves *= 2
    best = np.full(2 * leaves, -1)
    for v in range(count):
        best[leaves + v] = v
    for k in range(leaves - 1, 0, -1):
        first, second = best[2 * k], best[2 * k + 1]
        best[k] = first if second < 0 or costs[first] <= costs[second] else second
    left, last = count, 0
    while left > 3:
        v = best[1]
        if costs[v] > tolerance:
            break
        if distances.side(points, before[v], v, after[v]) <= 0.0:
            gone = v
        else:
            gone = after[v]
            points[v, 0], points[v, 1] = corners[v, 0], corners[v, 1]
        after[before[gone]], before[after[gone]] = after[gone], before[gone]
        costs[gone] = np.inf
        _rank(costs, best, gone)
        left -= 1
        last = before[gone]
        # All whose change touches what has moved: two back, and two on.
        u = before[before[last]]
        for _ in range(5):
            costs[u] = _change(points, after, before, u, corners[u])
            _rank(costs, best, u)
            u = after[u]
    ring = np.empty((left, 2))
    for k in range(left):
        ring[k, 0], ring[k, 1] = points[last, 0], points[last, 1]
        last = after[last]
    return ring
