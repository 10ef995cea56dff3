"""Circle packing about the origin by a front chain; sources in ``settle/round_pack.py``.

``discs``: ``(n, 2)`` centres.
"""

from __future__ import annotations

import math

import numpy as np

from packwork.compiled import helper, kernel

ROUNDING = 1e-9
"""Share of a distance that rounding may take. Derived, as for the check of the finish."""


@kernel
def front_chain(radii, order, shift, aside):
    """Front chain: discs one after another where they touch two and lie nearest to the origin.

    The first two touch each other across the origin, moved by ``shift`` along their line and
    by ``aside`` off it. ``order``: the largest first.
    """
    n = radii.shape[0]
    discs = np.zeros((n, 2))
    pairs, count = np.empty((32 * n, 4), np.int64), 0
    for k in range(n):
        i = order[k]
        # None that comes is wider than the next.
        widest = 2.0 * radii[order[k + 1]] if k + 1 < n else 0.0
        if k < 2:
            apart = 0.0 if n == 1 else radii[order[0]] + radii[order[1]]
            discs[i, 0], discs[i, 1] = shift + (apart if k else 0.0) - radii[order[0]], aside
        else:
            best = np.inf
            for p in range(count):
                best = _touching(discs, radii, order, k, pairs[p], best)
        for c in range(k):
            j = order[c]
            dx, dy = discs[i, 0] - discs[j, 0], discs[i, 1] - discs[j, 1]
            reach = radii[i] + radii[j] + widest
            if dx * dx + dy * dy < reach * reach:
                if count == pairs.shape[0]:
                    pairs = np.concatenate((pairs, pairs))
                pairs[count, 0] = pairs[count, 2] = pairs[count, 3] = j
                pairs[count, 1] = i
                count += 1
    return discs


@helper
def _meet(x, y, own, discs, radii, j):
    """True if a disc at a point meets another."""
    least = (own + radii[j]) * (1.0 - ROUNDING)
    return (x - discs[j, 0]) ** 2 + (y - discs[j, 1]) ** 2 < least * least


@helper
def _touching(discs, radii, order, k, pair, best):
    """Put disc ``order[k]`` where it touches a pair, if that is free and better.

    ``pair``: two discs, and which one was in the way on either side the last time.
    """
    i, a, b = order[k], pair[0], pair[1]
    along_x, along_y = discs[b, 0] - discs[a, 0], discs[b, 1] - discs[a, 1]
    square = along_x * along_x + along_y * along_y
    one, other = radii[a] + radii[i], radii[b] + radii[i]
    if square >= (one + other) * (one + other) or square <= (one - other) * (one - other):
        return best
    along = (one * one - other * other + square) / (2.0 * square)
    across = math.sqrt(max(one * one / square - along * along, 0.0))
    for side in range(2):
        x = discs[a, 0] + along * along_x - (2 * side - 1) * across * along_y
        y = discs[a, 1] + along * along_y + (2 * side - 1) * across * along_x
        height = x * x + y * y
        if height >= best * (1.0 - ROUNDING):
            continue
        if _meet(x, y, radii[i], discs, radii, pair[2 + side]):
            continue
        is_free = True
        for c in range(k):
            if _meet(x, y, radii[i], discs, radii, order[c]):
                pair[2 + side] = order[c]
                is_free = False
                break
        if is_free:
            best = height
            discs[i, 0], discs[i, 1] = x, y
    return best


@kernel
def circle_of(discs, radii):
    """Radius of the circle about the origin that holds all discs."""
    circle = 0.0
    for i in range(radii.shape[0]):
        circle = max(circle, math.sqrt(discs[i, 0] ** 2 + discs[i, 1] ** 2) + radii[i])
    return circle
