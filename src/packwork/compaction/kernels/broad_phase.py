"""Broad phase: pairs of polygons that may be near each other, found by their bounding boxes.

``boxes``: ``(n + 1, 4)`` left, top, right, bottom of the items and, last, of the container.
:mod:`distances` says which of the pairs are near indeed.
"""

from __future__ import annotations

import numpy as np

from packwork.compiled import helper, kernel, leaf


@kernel
def near_pairs(boxes, order, reach, found):
    """Write pairs of boxes within ``reach``, smaller index first; returns how many.

    ``order`` sorts the boxes by their left side. Counts on past the end of ``found``.
    """
    count = 0
    for a in range(order.shape[0]):
        i = order[a]
        limit = boxes[i, 2] + reach
        for b in range(a + 1, order.shape[0]):
            j = order[b]
            if boxes[j, 0] > limit:
                break
            if boxes[j, 1] > boxes[i, 3] + reach or boxes[i, 1] > boxes[j, 3] + reach:
                continue
            if count < found.shape[0]:
                found[count, 0] = min(i, j)
                found[count, 1] = max(i, j)
            count += 1
    return count


@leaf
def are_apart(boxes, i, j, reach):
    """True if two of some boxes are farther apart than ``reach`` along an axis."""
    # Number by number: a view of a row is counted by all threads together, which takes longer.
    return (
        boxes[j, 0] > boxes[i, 2] + reach
        or boxes[i, 0] > boxes[j, 2] + reach
        or boxes[j, 1] > boxes[i, 3] + reach
        or boxes[i, 1] > boxes[j, 3] + reach
    )


@helper
def _two_boxes(boxes, items):
    """Boxes about those of ``items`` near the first of them, and about those far from it."""
    middle = np.empty(2)
    farthest, most = items[0], -1.0
    for k in range(items.shape[0]):
        away = 0.0
        for c in range(2):
            middle[c] = boxes[items[k], c] + boxes[items[k], c + 2]
            away += (middle[c] - boxes[items[0], c] - boxes[items[0], c + 2]) ** 2
        if away > most:
            farthest, most = items[k], away
    found = np.empty((2, 4))
    for a in range(2):
        found[a, 0] = found[a, 1] = np.inf
        found[a, 2] = found[a, 3] = -np.inf
    for k in range(items.shape[0]):
        box = boxes[items[k]]
        nearer = 0.0
        for c in range(2):
            here = box[c] + box[c + 2]
            nearer += (here - boxes[items[0], c] - boxes[items[0], c + 2]) ** 2
            nearer -= (here - boxes[farthest, c] - boxes[farthest, c + 2]) ** 2
        one = found[int(nearer > 0.0)]
        for c in range(2):
            one[c], one[c + 2] = min(one[c], box[c]), max(one[c + 2], box[c + 2])
    return found


@kernel
def nearby(boxes, items, reach):
    """Items whose boxes may be within ``reach`` of one of ``items``, in their order."""
    about = _two_boxes(boxes, items)
    near = np.empty(boxes.shape[0] - 1, np.int64)
    count = 0
    for j in range(near.shape[0]):
        for a in range(2):
            if (
                boxes[j, 0] <= about[a, 2] + reach
                and about[a, 0] <= boxes[j, 2] + reach
                and boxes[j, 1] <= about[a, 3] + reach
                and about[a, 1] <= boxes[j, 3] + reach
            ):
                near[count] = j
                count += 1
                break
    return near[:count]


@helper
def pairs_among(boxes, items, near, reach):
    """Pairs of boxes within ``reach``, of each of ``items`` with those of ``near``.

    Smaller index first; then each of the items with the last box, the container's.
    """
    last = boxes.shape[0] - 1
    chosen = np.zeros(last, np.bool_)
    for k in range(items.shape[0]):
        chosen[items[k]] = True
    found = np.empty((16 * items.shape[0] + 16, 2), np.int64)
    count = 0
    for k in range(items.shape[0]):
        i = items[k]
        for a in range(near.shape[0] + 1):
            j = near[a] if a < near.shape[0] else last
            if j == i or (j < i and chosen[j]):
                continue
            if j < last and are_apart(boxes, i, j, reach):
                continue
            if count == found.shape[0]:
                longer = np.empty((2 * count, 2), np.int64)
                for f in range(count):
                    longer[f, 0], longer[f, 1] = found[f, 0], found[f, 1]
                found = longer
            found[count, 0], found[count, 1] = min(i, j), max(i, j)
            count += 1
    return found[:count]


@kernel
def pairs_of(boxes, items, reach):
    """Pairs of boxes within ``reach`` of which one at least is among ``items``.

    Smaller index first; then each of the items with the last box, the container's.
    """
    return pairs_among(boxes, items, nearby(boxes, items, reach), reach)


@leaf
def sticks_out(inner, outer):
    """True if a box is not within another one."""
    return inner[0] < outer[0] or inner[1] < outer[1] or inner[2] > outer[2] or inner[3] > outer[3]
