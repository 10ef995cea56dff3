"""Distances of points to the edge of a container, from the few edges that a grid lists near each.

A cell of the grid lists all edges that may be the nearest of any of its points: those no farther
from its middle than the nearest one and the cell's diagonal. What it gives is exact.

``wall``: edges ``(m, 6)``, both ends and the numbers of the edges before and after; the grid's
corner and cell; ``(rows, columns)`` least signed distance of any point of a cell, positive inside;
``(rows, columns + 1)`` starts of the cells' lists; the lists, one after another.
"""

from __future__ import annotations

import math

import numpy as np

from packwork.compiled import helper, kernel

BLOCK = 8
"""Cells beside one another whose edges are looked for at once first. Larger looks at more edges for
each cell, smaller at all edges more often. Chosen."""

MOST_CONTACTS = 3
"""Parts of the edge that push a disc at once, as at the end of a slot. Derived."""

ASIDE = 0.5
"""Cosine of the angle between two such pushes, at most. Larger counts one curve twice, smaller
overlooks blunt corners. Chosen."""

NOTHING = 1e-300
"""Guard of divisions by a distance of 0. Derived: the least of normal numbers, about."""


@helper
def _nearest_point(edges, e, x, y):
    """Nearest point of an edge, and its share of the way from end to end."""
    ax, ay, bx, by = edges[e, 0], edges[e, 1], edges[e, 2], edges[e, 3]
    along_x, along_y = bx - ax, by - ay
    square = along_x * along_x + along_y * along_y
    share = 0.0
    if square > 0.0:
        share = min(max(((x - ax) * along_x + (y - ay) * along_y) / square, 0.0), 1.0)
    return ax + share * along_x, ay + share * along_y, share


@helper
def _keep_near(edges, listed, x, y, slack, found, count):
    """Append those of listed edges that are farther than the nearest by ``slack`` at most."""
    least = np.inf
    for e in listed:
        qx, qy, _ = _nearest_point(edges, e, x, y)
        least = min(least, (x - qx) ** 2 + (y - qy) ** 2)
    most = (math.sqrt(least) + slack) ** 2
    for e in listed:
        qx, qy, _ = _nearest_point(edges, e, x, y)
        if (x - qx) ** 2 + (y - qy) ** 2 <= most:
            if count < found.shape[0]:
                found[count] = e
            count += 1
    return count


@kernel
def list_edges(edges, corner, cell, least, starts, found):
    """Write the grid's least distances, starts and lists; the length of all lists.

    Where ``found`` is too short, the lists are cut off, and are to be written again.
    """
    rows, columns = least.shape
    everything, block = np.arange(edges.shape[0]), np.empty(edges.shape[0], np.int64)
    near, count = 0, 0
    for r in range(rows):
        y = corner[1] + (r + 0.5) * cell
        for c in range(columns):
            if c % BLOCK == 0:
                middle = corner[0] + (c + BLOCK / 2) * cell
                wide = math.hypot(BLOCK, 1.0) * cell
                near = _keep_near(edges, everything, middle, y, wide, block, 0)
            starts[r, c] = count
            x = corner[0] + (c + 0.5) * cell
            slack = math.sqrt(2.0) * cell
            count = _keep_near(edges, block[:near], x, y, slack, found, count)
            if count <= found.shape[0]:
                first, signed = starts[r, c], np.inf
                _, _, signed = _nearest_of(edges, found[first:count], x, y)
                least[r, c] = signed - slack / 2.0
        starts[r, columns] = count
    return count


@helper
def _nearest_of(edges, listed, x, y):
    """Unit vector from the edge inwards, and the signed distance, positive inside."""
    least, nearest, at_x, at_y, at = np.inf, 0, 0.0, 0.0, 0.0
    for e in listed:
        qx, qy, share = _nearest_point(edges, e, x, y)
        square = (x - qx) ** 2 + (y - qy) ** 2
        if square < least:
            least, nearest, at_x, at_y, at = square, e, qx, qy, share
    normal_x, normal_y = _normal(edges, nearest, at)
    far = math.sqrt(least)
    off_x, off_y = x - at_x, y - at_y
    is_inside = off_x * normal_x + off_y * normal_y >= 0.0
    if far > 1e-12 * (abs(x) + abs(y)):
        normal_x, normal_y = off_x / far, off_y / far
        if not is_inside:
            normal_x, normal_y = -normal_x, -normal_y
    return normal_x, normal_y, far if is_inside else -far


@helper
def _normal(edges, e, share):
    """Normal of an edge, inwards; at an end of it that of both edges which meet there.

    Such pseudo-normals tell inside from outside (J. Baerentzen and H. Aanaes, IEEE Transactions on
    Visualization and Computer Graphics 11 (2005), 243-253, doi:10.1109/TVCG.2005.49).
    """
    normal_x, normal_y = _unit_normal(edges, e)
    if share <= 0.0 or share >= 1.0:
        more_x, more_y = _unit_normal(edges, int(edges[e, 4 if share <= 0.0 else 5]))
        normal_x, normal_y = normal_x + more_x, normal_y + more_y
        length = max(math.hypot(normal_x, normal_y), NOTHING)
        normal_x, normal_y = normal_x / length, normal_y / length
    return normal_x, normal_y


@helper
def _unit_normal(edges, e):
    along_x, along_y = edges[e, 2] - edges[e, 0], edges[e, 3] - edges[e, 1]
    length = max(math.hypot(along_x, along_y), NOTHING)
    return -along_y / length, along_x / length


@helper
def _cell_of(wall, x, y):
    """Row and column of the cell of a point, or of the nearest one."""
    _, corner, cell, least, _, _ = wall
    rows, columns = least.shape
    row = min(max(int((y - corner[1]) / cell), 0), rows - 1)
    return row, min(max(int((x - corner[0]) / cell), 0), columns - 1)


@helper
def edge_distance(wall, x, y, enough):
    """Signed distance of a point from the edge, positive inside; or ``enough``, if it is more."""
    edges, _, _, least, starts, listed = wall
    r, c = _cell_of(wall, x, y)
    if least[r, c] >= enough:
        return enough
    _, _, signed = _nearest_of(edges, listed[starts[r, c] : starts[r, c + 1]], x, y)
    return min(signed, enough)


@kernel
def edge_distances(wall, points):
    """Signed distances ``(n,)`` of points from the edge, positive inside."""
    found = np.empty(points.shape[0])
    for k in range(points.shape[0]):
        found[k] = edge_distance(wall, points[k, 0], points[k, 1], np.inf)
    return found


@helper
def edge_push(wall, x, y, reach):
    """Force of the edge on a disc at a point, sum and half the sum of squares of what it lacks.

    ``reach``: least distance of the disc's centre from the edge.
    """
    edges, _, _, least, starts, listed = wall
    r, c = _cell_of(wall, x, y)
    if least[r, c] >= reach:
        return 0.0, 0.0, 0.0, 0.0
    near = listed[starts[r, c] : starts[r, c + 1]]
    push_x, push_y, signed = _nearest_of(edges, near, x, y)
    lack = reach - signed
    if lack <= 0.0:
        return 0.0, 0.0, 0.0, 0.0
    force_x, force_y, total, energy = lack * push_x, lack * push_y, lack, 0.5 * lack * lack
    if signed <= 0.0:
        return force_x, force_y, total, energy
    before_x, before_y = push_x, push_y
    for contact in range(1, MOST_CONTACTS):
        found, next_x, next_y = reach, 0.0, 0.0
        for e in near:
            qx, qy, _ = _nearest_point(edges, e, x, y)
            off_x, off_y = x - qx, y - qy
            far = math.hypot(off_x, off_y)
            if far >= found or off_x * push_x + off_y * push_y > ASIDE * far:
                continue
            if contact > 1 and off_x * before_x + off_y * before_y > ASIDE * far:
                continue
            found, next_x, next_y = far, off_x / far, off_y / far
        if found >= reach:
            break
        lack = reach - found
        force_x += lack * next_x
        force_y += lack * next_y
        total += lack
        energy += 0.5 * lack * lack
        before_x, before_y = next_x, next_y
    return force_x, force_y, total, energy
