"""Contacts of polygons in place: vertices with the edges and corners that they could meet.

The linear constraints of a compaction (Z. Li and V. Milenkovic 1995) without no-fit polygons: a
convex vertex binds to each edge within reach that it sees from outside.
"""

from __future__ import annotations

import math

import numpy as np

from packwork.compaction.kernels import distances
from packwork.compaction.kernels import edges as edge_kernels
from packwork.compiled import helper


@helper
def contacts(board, pairs, reach, slants, pair_of, numbers):
    """Write what keeps pairs apart; returns how many, counting on past the end.

    ``pair_of``: which pair. ``numbers``: normal from the second solid to the first, point on
    the first, point on the second, distance. Only features within ``reach`` bind: convex
    vertices against edges that they see from outside, near the edge's own span, and
    against convex corners that face them. ``slants``: by how much the two solids of each
    pair may turn against each other, rad.
    """
    most = distances.most_points(board.starts, pairs)
    kept, edges = np.empty((2, most), np.int64), np.empty((2, 9, most))
    near = np.empty(most, np.bool_)
    # A plain 0 has a type of its own, for which what is called would be compiled once more.
    count = np.int64(0)
    for k in range(pairs.shape[0]):
        i, j = pairs[k, 0], pairs[k, 1]
        if distances.are_apart(board.boxes, i, j, reach):
            continue
        count_j = distances.cull(board, j, board.boxes, i, reach, kept[1])
        if count_j == 0:
            continue
        count_i = distances.cull(board, i, board.boxes, j, reach, kept[0])
        if count_i == 0:
            continue
        _describe(board, kept[0], count_i, edges[0])
        _describe(board, kept[1], count_j, edges[1])
        for side in range(2):
            mine, theirs = (count_i, count_j) if side == 0 else (count_j, count_i)
            count = _meet(
                edges[side], mine, edges[1 - side], theirs, near, reach, slants[k], k, side,
                pair_of, numbers, count,
            )  # fmt: skip
    return count


@helper
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
        edges[5, k] = edge_kernels.side(points, u, v, w)
        edges[6, k] = edge_kernels.side(points, v, w, board.after[w])
        edges[7, k], edges[8, k] = points[v, 0], points[v, 1]


@helper
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


@helper
def _meet(
    own, count_own, others, count_others, near, reach, slant, pair, side, pair_of, numbers, count,
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
            if count < pair_of.shape[0]:
                pair_of[count] = pair
                row = numbers[count]
                sign = 1.0 - 2.0 * side
                row[0], row[1], row[6] = sign * nx, sign * ny, height
                here, there = 2 + 2 * side, 4 - 2 * side
                row[here], row[here + 1] = x, y
                row[there], row[there + 1] = x - height * nx, y - height * ny
            count += 1
    return count
