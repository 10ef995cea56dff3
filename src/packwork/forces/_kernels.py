"""Inner loops of forces between many items."""

from __future__ import annotations

import math

from packwork.compiled import kernel

FAR = 3.0
"""Reaches beyond which two items do not feel each other. Derived: a hundredth is left there."""


@kernel
def add_ties(points, order, ties, reach, parts, slopes):
    """Add the heights of all pairs, half to each, and their slopes, in squares of the reach.

    ``order``: of the points by x.
    """
    far = FAR * reach
    for a in range(len(order)):
        i = order[a]
        for b in range(a + 1, len(order)):
            j = order[b]
            across = points[j, 0] - points[i, 0]
            if across > far:
                break
            down = points[j, 1] - points[i, 1]
            square = across * across + down * down
            if square > far * far or ties[i, j] == 0.0:
                continue
            height = ties[i, j] * math.exp(-0.5 * square / (reach * reach))
            parts[i] -= 0.5 * height * reach * reach
            parts[j] -= 0.5 * height * reach * reach
            slopes[i, 0] -= height * across
            slopes[i, 1] -= height * down
            slopes[j, 0] += height * across
            slopes[j, 1] += height * down
