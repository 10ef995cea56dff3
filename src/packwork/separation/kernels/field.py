"""Places proposed by an image of all other parts: every position of a sheet, scored at once."""

from __future__ import annotations

import math

import numpy as np

from packwork.compiled import leaf
from packwork.separation.kernels.collision import PENALTY, TURN, X, Y

MARGIN = 4
"""Columns to either side of the image: a part that touches its edge is rounded to stick out by two
pixels at most, and rows are summed without a look at where they end. Derived."""


@leaf
def draw_others(i, pixel, items, index, weights, span_at, spans, image):
    """Image of all parts but ``i``, each by its spans of rows, as running sums along each row.

    ``image[r, MARGIN + c]``: the sum of weights of pixels ``0`` to before ``c`` of row r.
    """
    rows, columns = image.shape[0], image.shape[1] - 1 - 2 * MARGIN
    image[:] = 0.0
    for j in range(items.shape[1]):
        if j == i or math.isnan(items[X, j]):
            continue
        weight = np.float32(weights[i, j] * items[PENALTY, i] * items[PENALTY, j])
        row, column = math.floor(items[Y, j] / pixel), round(items[X, j] / pixel)
        for s in range(span_at[index[j, TURN]], span_at[index[j, TURN] + 1]):
            r = row + spans[0, s]
            if 0 <= r < rows:
                image[r, MARGIN + min(max(column + spans[1, s], 0), columns)] += weight
                image[r, MARGIN + min(max(column + spans[2, s], 0), columns)] -= weight
    for r in range(rows):
        height, before = np.float32(0.0), np.float32(0.0)
        for c in range(MARGIN, MARGIN + columns + 1):
            height += image[r, c]
            image[r, c] = before
            before += height
        image[r, MARGIN + columns + 1 :] = image[r, MARGIN + columns]


@leaf
def score_row(row, column, wide, first, last, spans, image, scores):
    """Sum of the image below a part's spans, for ``wide`` columns from ``column`` on."""
    rows, most = image.shape[0], image.shape[1] - wide
    here = scores[:wide]
    here[:] = 0.0
    for s in range(first, last):
        r = min(max(row + spans[0, s], 0), rows - 1)
        begin = min(max(MARGIN + column + spans[1, s], 0), most)
        end = min(max(MARGIN + column + spans[2, s], 0), most)
        starts, ends = image[r, begin : begin + wide], image[r, end : end + wide]
        for c in range(wide):
            here[c] += ends[c] - starts[c]


@leaf
def keep_best(found, count, score, x, y, turn, apart):
    """Put a place among the best ``len(found)``, none nearer to a better one than ``apart``.

    ``found``: rows of score, x, y, turn, best first. Returns their new number.
    """
    most = len(found)
    if count == most and score >= found[most - 1, 0]:
        return count
    at = count
    for k in range(count):
        near = abs(found[k, 1] - x) < apart and abs(found[k, 2] - y) < apart
        if near and found[k, 3] == turn:
            if found[k, 0] <= score:
                return count
            for m in range(k, count - 1):
                for axis in range(4):
                    found[m, axis] = found[m + 1, axis]
            count -= 1
            at = count
            break
    at = count if count < most else most - 1
    while at > 0 and found[at - 1, 0] > score:
        for axis in range(4):
            found[at, axis] = found[at - 1, axis]
        at -= 1
    found[at, 0], found[at, 1], found[at, 2], found[at, 3] = score, x, y, turn
    return min(count + 1, most)


@leaf
def propose(i, turn, box, pixel, sheet, span_at, spans, image, scores, found, count, apart):
    """Score all places of a part at one of its turns; add local minima to ``found``.

    ``box``: that of the part about its own point; ``scores``: three rows of scratch.
    """
    left, top = -box[0], -box[1]
    room_x, room_y = sheet[0] - box[2] - left, sheet[1] - box[3] - top
    if room_x < 0.0 or room_y < 0.0:
        return count
    wide = min(math.ceil(room_x / pixel) + 1, scores.shape[1])
    tall = math.ceil(room_y / pixel) + 1
    column = round(left / pixel)
    first, last = span_at[turn], span_at[turn + 1]
    for r in range(tall + 1):
        here = scores[r % 3]
        if r < tall:
            y = top + min(r * pixel, room_y)
            score_row(math.floor(y / pixel), column, wide, first, last, spans, image, here)
        if r == 0:
            continue
        # The row before, now that both its neighbours are known.
        middle, above = scores[(r - 1) % 3], scores[(r - 2) % 3]
        limit, lower = (found[count - 1, 0] if count == len(found) else np.inf), 0
        for c in range(wide):
            lower += middle[c] < limit
        if lower == 0:
            continue
        y = top + min((r - 1) * pixel, room_y)
        for c in range(wide):
            score = middle[c]
            if count == len(found) and score >= found[count - 1, 0]:
                continue
            if (c > 0 and middle[c - 1] < score) or (c + 1 < wide and middle[c + 1] < score):
                continue
            if (r > 1 and above[c] < score) or (r < tall and here[c] < score):
                continue
            x = left + min(c * pixel, room_x)
            count = keep_best(found, count, score, x, y, float(turn), apart)
    return count
