"""Distances of edges of polygons in place; ``board`` is that of :mod:`distances`."""

from __future__ import annotations

import numpy as np

from packwork.compiled import helper

RUN = 8
"""Edges that share a box where two solids have many near each other. Tried: 16 and 32 are slower,
without the boxes outlines of hundreds of points take ten times as long."""


@helper
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


@helper
def side(points, a, b, c):
    """Twice the signed area of the triangle of three vertices."""
    return (points[b, 0] - points[a, 0]) * (points[c, 1] - points[a, 1]) - (
        points[b, 1] - points[a, 1]
    ) * (points[c, 0] - points[a, 0])


@helper
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


@helper
def _boxes_of_runs(board, edges):
    """``(r, 4)`` boxes about each :data:`RUN` edges (by their first vertex), one after another."""
    points = board.points
    found = np.empty(((edges.shape[0] + RUN - 1) // RUN, 4))
    found[:, :2] = np.inf
    found[:, 2:] = -np.inf
    for e in range(edges.shape[0]):
        box = found[e // RUN]
        for v in (edges[e], board.after[edges[e]]):
            for c in range(2):
                box[c] = min(box[c], points[v, c])
                box[c + 2] = max(box[c + 2], points[v, c])
    return found


@helper
def _box_squared(box, points, v, w):
    """Squared distance of a box from the box of an edge between two vertices."""
    squared = 0.0
    for c in range(2):
        low, high = min(points[v, c], points[w, c]), max(points[v, c], points[w, c])
        gap = max(box[c] - high, low - box[c + 2], 0.0)
        squared += gap * gap
    return squared


@helper
def least_squared(board, first, second, least):
    """Squared distance of two sets of edges, 0 if any cross; ``least`` if it is not below that."""
    points, after = board.points, board.after
    boxes = _boxes_of_runs(board, second)
    for a in range(first.shape[0]):
        v = first[a]
        w = after[v]
        for r in range(boxes.shape[0]):
            if _box_squared(boxes[r], points, v, w) >= least:
                continue
            for b in range(r * RUN, min((r + 1) * RUN, second.shape[0])):
                least = _edges_squared(points, v, w, second[b], after[second[b]], least)
            if least == 0.0:
                return 0.0
    return least
