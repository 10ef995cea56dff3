"""Contacts of polygons in place, and the linear constraints that they give.

A contact binds a convex vertex to an edge or corner that it sees from outside. The constraints of
compaction (Z. Li and V. Milenkovic 1995) without no-fit polygons.
"""

from __future__ import annotations

import math

import numpy as np

from packwork.compaction.kernels import broad_phase, distances, interior_point
from packwork.compiled import helper, kernel, leaf

REACH = 3.0
"""Distance within which features bind, trust regions. Larger gives more conditions, smaller lets
items run into what was not seen. Tried."""

BEND = 0.25
"""Distance kept beyond the gap for what turning bends: squares of the trust region over the mean
arm. Larger wastes room, smaller fails more checks. Tried."""

TIGHT = 1.2
"""Hair that steps aim at, over the one that is checked. Larger wastes room, smaller fails
more checks. Tried."""

LEAST_SLANT = 0.05
"""Angle by which a vertex may miss being the nearest of its neighbours to an edge and still bind,
rad, beyond what items may turn. Larger gives conditions that hardly matter. Tried."""


@helper
def contacts(board, pairs, reach, slants, pair_of, numbers):
    """Write what keeps pairs apart; returns how many, counting on past the end.

    ``pair_of``: which pair; ``numbers``: normal from the second polygon to the first, point on the
    first, point on the second, distance; ``slants``: by how much the two of each pair may turn
    against each other, rad. Only features within ``reach`` bind: convex vertices against edges that
    they see from outside, near the edge's own span, and against convex corners that face them.
    """
    most = distances.most_points(board.starts, pairs)
    kept, edges = np.empty((2, most), np.int64), np.empty((2, 9, most))
    near = np.empty(most, np.bool_)
    # A plain 0 has a type of its own, for which what is called would be compiled once more.
    count = np.int64(0)
    for k in range(pairs.shape[0]):
        i, j = pairs[k, 0], pairs[k, 1]
        if broad_phase.are_apart(board.boxes, i, j, reach):
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


@leaf
def _describe(board, kept, count, edges):
    """Write columns of what contacts need of edges.

    Their unit vector, length, the unit vector of the edge before, bends at their begin and
    their end, and their begin. A bend is positive where the polygon stands out.
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
        edges[5, k] = distances.side(points, u, v, w)
        edges[6, k] = distances.side(points, v, w, board.after[w])
        edges[7, k], edges[8, k] = points[v, 0], points[v, 1]


@leaf
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
        # Beyond a bay's corner an edge still binds: its line goes on inside the polygon.
        ends = (along <= length[b]) | ((along <= length[b] + reach) & (last[b] <= 0.0))
        near[b] = (
            (height > 0.0)
            & (height <= reach)
            & (along >= -reach)
            & ends
            & ((is_beyond & faces) | (reaches & ~is_beyond))
        )


@leaf
def _meet(
    own, count_own, others, count_others, near, reach, slant, pair, side, pair_of, numbers, count,
):  # fmt: skip
    """Contacts of convex vertices of one polygon with edges and corners of another.

    ``side``: 0 if the vertices are the first polygon's, 1 if the second's.
    """
    for a in range(count_own):
        if own[5, a] <= 0.0:
            continue
        # Each pair of corners counts once, from the first polygon's side.
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


@helper
def all_contacts(board, pairs, reach, slants):
    """All contacts of pairs: the pair of each ``(m,)`` and its numbers ``(m, 7)``."""
    room = 24 * pairs.shape[0] + 256
    while True:
        pair_of, numbers = np.empty(room, np.int64), np.empty((room, 7))
        count = contacts(board, pairs, reach, slants, pair_of, numbers)
        if count <= room:
            return pair_of[:count], numbers[:count]
        room = count


@leaf
def _motion(board, i, nx, ny, x, y, sign, out):
    """Write how fast a point of an item goes along a normal, for each unknown."""
    ex, ey = x - board.places[i, 0], y - board.places[i, 1]
    arm = distances.arm(board, i)
    out[0], out[1] = sign * nx, sign * ny
    out[2] = sign * (ex * ny - ey * nx) / arm
    out[3] = sign * (ex * nx + ey * ny) / arm


@helper
def constraint_rows(board, pairs, pair_of, numbers, where, trust, gap):
    """Contacts as rows of a programme, lengths in units of ``trust``.

    ``where``: each polygon's number in the programme, -1 if it stands still. Rows that no step
    within the trust region can reach are left out.
    """
    most = pair_of.shape[0]
    first, second = np.empty(most, np.int64), np.empty(most, np.int64)
    coefficients, limits = np.zeros((most, 8)), np.empty(most)
    count = 0
    for k in range(most):
        i, j = pairs[pair_of[k], 0], pairs[pair_of[k], 1]
        a, b = where[i], where[j]
        if a < 0 and b < 0:
            continue
        nx, ny = numbers[k, 0], numbers[k, 1]
        row = coefficients[count]
        for c in range(8):
            row[c] = 0.0
        part = 0
        if a >= 0:
            _motion(board, i, nx, ny, numbers[k, 2], numbers[k, 3], -1.0, row[:4])
            part = 4
        if b >= 0:
            _motion(board, j, nx, ny, numbers[k, 4], numbers[k, 5], 1.0, row[part : part + 4])
        if a == b:
            # An item and an image of its own move alike, but turn and grow towards each other.
            for c in range(4):
                row[c] += row[c + 4]
                row[c + 4] = 0.0
            b = -1
        limits[count] = max(numbers[k, 6] - gap, 0.0) / trust
        reach = 0.0
        for c in range(8):
            reach += abs(row[c])
        if limits[count] < reach:
            first[count], second[count] = (a, b) if a >= 0 else (b, -1)
            count += 1
    return interior_point.Rows(first[:count], second[:count], coefficients[:count], limits[:count])


@helper
def near_contacts(board, items, pairs, trust, gap, hair):
    """Contacts within reach of a step, each polygon's number in the programme, the gap to keep."""
    slants = np.empty(pairs.shape[0])
    last = board.starts.shape[0] - 2
    mean = 0.0
    for p in range(pairs.shape[0]):
        slants[p] = LEAST_SLANT
        for i in (pairs[p, 0], pairs[p, 1]):
            if i != last:
                slants[p] += trust / distances.arm(board, i)
        slants[p] = min(slants[p], 1.0)
    where = np.empty(last + 1, np.int64)
    for p in range(pairs.shape[0]):
        for i in (pairs[p, 0], pairs[p, 1]):
            where[i] = where[board.owners[i]] = -1
    for k in range(items.shape[0]):
        where[items[k]] = k
        mean += distances.arm(board, items[k]) / items.shape[0]
    for p in range(pairs.shape[0]):
        for i in (pairs[p, 0], pairs[p, 1]):
            where[i] = where[board.owners[i]]
    pair_of, numbers = all_contacts(board, pairs, gap + REACH * trust, slants)
    kept = gap + (TIGHT - 1.0) * hair + BEND * trust * trust / mean
    return pair_of, numbers, where, kept


@kernel
def rows_of(board, items, pairs, trust, gap, hair):
    """Rows of the programme that keep ``items`` apart, from each other and what stands still."""
    pair_of, numbers, where, kept = near_contacts(board, items, pairs, trust, gap, hair)
    return constraint_rows(board, pairs, pair_of, numbers, where, trust, kept)
