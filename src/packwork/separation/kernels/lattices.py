"""Rows of a part and its twin, dropped on one another: heights of lattices, by upper envelopes.

``edges``: ``(m, 4)`` of what bounds a no-fit polygon; ``rows``: the same in a frame whose x axis is
the row; columns of a row that repeats are all those that lie a period apart.
"""

from __future__ import annotations

import math

import numpy as np

from packwork.compiled import helper, kernel

NEXT = 4
"""Rows below that one is held against to begin with; later all that it may meet. Tried."""

GRID, SHARES = 24, (0.0, 0.02, 0.06, 0.12, 0.2, 0.3, 0.45, 0.65, 1.0)
"""Columns of a period, and how much longer than the least it is: tried to begin with. More take
longer, with their square."""

WIDENS, NARROWS = 1.4, 0.93
"""Factors on the steps of a descent where one gained, and where not. Tried."""


@helper
def _turn(edges, angle, rows):
    """Bring edges into the frame of a row, from the left to the right."""
    cosine, sine = math.cos(angle), math.sin(angle)
    for k in range(edges.shape[0]):
        ax = cosine * edges[k, 0] + sine * edges[k, 1]
        ay = cosine * edges[k, 1] - sine * edges[k, 0]
        bx = cosine * edges[k, 2] + sine * edges[k, 3]
        by = cosine * edges[k, 3] - sine * edges[k, 2]
        if ax > bx:
            ax, ay, bx, by = bx, by, ax, ay
        rows[k, 0], rows[k, 1], rows[k, 2], rows[k, 3] = ax, ay, bx, by


@helper
def _reach(rows):
    """Rightmost point of a no-fit polygon about 0 on the axis: the least period of a row."""
    found = 0.0
    for k in range(rows.shape[0]):
        ax, ay, bx, by = rows[k, 0], rows[k, 1], rows[k, 2], rows[k, 3]
        if min(ay, by) <= 0.0 <= max(ay, by):
            x = bx if ay == by else ax - ay * (bx - ax) / (by - ay)
            found = max(found, x)
    return found


@helper
def _top(rows, period, column):
    """Largest y of a no-fit polygon on columns a period apart."""
    found = -np.inf
    for k in range(rows.shape[0]):
        ax, ay, bx, by = rows[k, 0], rows[k, 1], rows[k, 2], rows[k, 3]
        n = math.ceil((ax - column) / period)
        x = column + n * period
        while x <= bx:
            y = max(ay, by) if bx == ax else ay + (x - ax) / (bx - ax) * (by - ay)
            found = max(found, y)
            x += period
    return found


@helper
def _height(same, twin, back, tall, least, period, x, shift, found):
    """Height of a row above the one before it, ``least`` or more; the twin's goes to ``found``.

    ``x``: column of the twin, ``shift``: of the next row; no twins where ``twin`` is empty.
    """
    height, above, n = least, 0.0, 1
    if twin.shape[0]:
        above = max(_top(twin, period, x), -tall)
    # Rows that are so much lower are beyond all that a part and its twin reach.
    while n * height < 2.0 * tall:
        height = max(height, _top(same, period, n * shift) / n)
        if twin.shape[0]:
            height = max(height, (_top(twin, period, x + n * shift) - above) / n)
            height = max(height, (_top(back, period, n * shift - x) + above) / n)
        n += 1
    found[0] = above
    return height


@helper
def _area(one, edges, rows, tall, least, found):
    """Area of the cell of a lattice, of its four numbers."""
    for k in range(3):
        _turn(edges[k], one[0], rows[k])
    period = _reach(rows[0]) * (1.0 + abs(one[1]))
    found[1] = period
    found[2] = _height(rows[0], rows[1], rows[2], tall, least / period, period, one[2] * period,
                       one[3] * period, found)  # fmt: skip
    return period * found[2]


@kernel
def search_lattices(same, twin, back, tall, least, angles, noise, best):
    """Find lattices of small cells, ``best``: ``(n, 8)``.

    Rows are begun with at all angles and described as angle, share, twin's column, next row's
    column; then each is changed by chance, ``noise`` ``(steps, 4)``, as long as that makes the cell
    smaller. ``least``: area of what a cell holds. Of each its four numbers, twin's height, period,
    height of a row and area.
    """
    edges = (same, twin, back)
    rows = (np.empty(same.shape), np.empty(twin.shape), np.empty(back.shape))
    tops, found, one, other = np.empty((3, GRID)), np.empty(3), np.empty(4), np.empty(4)
    has_twin = twin.shape[0] > 0
    best[:, 7] = np.inf
    for angle in angles:
        for k in range(3):
            _turn(edges[k], angle, rows[k])
        for share in SHARES:
            period = _reach(rows[0]) * (1.0 + share)
            for i in range(GRID):
                for k in range(3):
                    tops[k, i] = max(_top(rows[k], period, i * period / GRID), -tall)
            lowest, one[0], one[1] = np.inf, angle, share
            for i in range(GRID if has_twin else 1):
                for j in range(GRID):
                    height = least / period
                    for n in range(1, NEXT + 1):
                        height = max(height, tops[0, n * j % GRID] / n)
                        if has_twin:
                            height = max(height, (tops[1, (i + n * j) % GRID] - tops[1, i]) / n)
                            height = max(height, (tops[2, (n * j - i) % GRID] + tops[1, i]) / n)
                    if height * period < lowest:
                        lowest, one[2], one[3] = height * period, i / GRID, j / GRID
            worst = np.argmax(best[:, 7])
            if lowest < best[worst, 7]:
                best[worst, :4], best[worst, 7] = one, lowest
    for k in range(best.shape[0]):
        if not np.isfinite(best[k, 7]):
            continue
        one[:] = best[k, :4]
        area, step = _area(one, edges, rows, tall, least, found), 1.0
        best[k, 4:7], best[k, 7] = found, area
        for n in range(noise.shape[0]):
            other[:] = one + step * noise[n]
            area = _area(other, edges, rows, tall, least, found)
            if area < best[k, 7]:
                one[:], best[k, :4] = other, other
                best[k, 4:7], best[k, 7] = found, area
                step *= WIDENS
            else:
                step *= NARROWS
