"""One polygon's way down among others that stand still, as far as it is free.

A pattern search (R. Hooke and T. Jeeves, "Direct search solution of numerical and statistical
problems", Journal of the ACM 8 (1961), 212-229, doi:10.1145/321062.321069) on exact distances:
steps straight down, aside and with a turn, halved where none is free.
"""

from __future__ import annotations

import math

from packwork.compaction.kernels import broad_phase, distances
from packwork.compiled import helper, kernel

FARTHEST = 4.0
"""Way of a slide in all at most, first steps. Larger looks at more neighbours. Chosen."""


@helper
def _is_free(board, i, near, gap, room):
    """True if an item is no nearer than ``gap`` to any of ``near`` and to the container's edge."""
    for j in near:
        if j != i and distances.distance(board, i, j, gap, room) < gap:
            return False
    return distances.distance(board, i, board.starts.shape[0] - 2, gap, room) >= gap


@kernel
def slide(board, item, down, ways, step, halvings, gap):
    """Move ``item`` ``(1,)``, which is free, as far down as steps that are free lead.

    ``down``: ``(2,)`` unit vector; ``ways``: ``(k, 2)`` directions in the order in which they are
    tried, rad off the way down, and turns, first steps at the item's farthest vertex; ``step``:
    first step, canvas units, halved so many times.
    """
    i = item[0]
    room = distances.room_for((board.starts[1:] - board.starts[:-1]).max())
    near = broad_phase.nearby(board.boxes, item, FARTHEST * step + gap)
    place = board.places[i : i + 1].copy()
    left = FARTHEST * step
    for _ in range(halvings + 1):
        is_moving = True
        while is_moving and left >= step:
            is_moving = False
            before = place.copy()
            for w in range(ways.shape[0]):
                cosine, sine = math.cos(ways[w, 0]), math.sin(ways[w, 0])
                place[0, 0] = before[0, 0] + step * (cosine * down[0] - sine * down[1])
                place[0, 1] = before[0, 1] + step * (sine * down[0] + cosine * down[1])
                place[0, 2] = before[0, 2] + step * ways[w, 1] / board.arms[i]
                distances.put(board, item, place)
                if _is_free(board, i, near, gap, room):
                    is_moving = True
                    left -= step
                    break
            if not is_moving:
                place[:] = before
                distances.put(board, item, place)
        step *= 0.5
