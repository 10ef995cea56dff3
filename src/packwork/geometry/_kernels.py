"""Inner loops over the vertices and edges of rings."""

from __future__ import annotations

import math

from packwork.compiled import kernel


@kernel
def clearance(points, starts, across, down, most):
    """Return the smallest distance of a vertex from another one or from an edge, ``most`` at most.

    ``across`` and ``down`` are the vertices' coordinates, sorted by the first, so that an edge is
    compared with those only beside which it runs. Vertices that lie on one another count as one.
    """
    best = most
    for ring in range(len(starts) - 1):
        for v in range(starts[ring], starts[ring + 1]):
            w = v + 1 if v + 1 < starts[ring + 1] else starts[ring]
            ax, ay, bx, by = points[v, 0], points[v, 1], points[w, 0], points[w, 1]
            ex, ey = bx - ax, by - ay
            squared = ex * ex + ey * ey
            if squared == 0.0:
                continue
            best = min(best, math.sqrt(squared))
            k, after = 0, len(across)
            while k < after:
                middle = (k + after) // 2
                if across[middle] < min(ax, bx) - best:
                    k = middle + 1
                else:
                    after = middle
            while k < len(across) and across[k] <= max(ax, bx) + best:
                px, py = across[k], down[k]
                k += 1
                is_end = (px == ax and py == ay) or (px == bx and py == by)
                if is_end or py < min(ay, by) - best or py > max(ay, by) + best:
                    continue
                along = min(max(((px - ax) * ex + (py - ay) * ey) / squared, 0.0), 1.0)
                best = min(best, math.hypot(px - ax - along * ex, py - ay - along * ey))
    return best
