"""Neighbourhoods of trials, and which trials may be made at once since theirs do not meet."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from packwork.compiled import helper, kernel


class Chosen(NamedTuple):
    """Trials that may be made at once, and where each of them may reach.

    ``trials``: ``(c,)`` which of those that were asked for; ``items``: of all of them one after
    another, from ``begins[k, 0]`` on those of the k-th, which ``bounds`` are the boxes of that they
    must not leave; ``near``: from ``begins[k, 1]`` on what they may come near, ascending.
    """

    trials: np.ndarray
    items: np.ndarray
    bounds: np.ndarray
    near: np.ndarray
    begins: np.ndarray


@helper
def _away(places, j, moved):
    """Squared distance of an item from the nearest of those that are moved."""
    least = np.inf
    for k in range(moved.shape[0]):
        x = places[j, 0] - places[moved[k], 0]
        y = places[j, 1] - places[moved[k], 1]
        least = min(least, x * x + y * y)
    return least


@helper
def _about(board, radii, moved, wanted, found):
    """Write the moved items and those nearest to them, by their x; returns how many.

    What is nearest goes by distances of centres less radii, ``(n,)``.
    """
    away = np.empty(wanted)
    held, farthest = 0, np.inf
    for j in range(radii.shape[0]):
        squared = _away(board.places, j, moved)
        if held == wanted and squared >= (farthest + radii[j]) ** 2 and farthest + radii[j] > 0.0:
            continue
        far = math.sqrt(squared) - radii[j]
        if held == wanted and far >= farthest:
            continue
        k = held if held < wanted else held - 1
        held = k + 1
        while k > 0 and away[k - 1] > far:
            away[k], found[k] = away[k - 1], found[k - 1]
            k -= 1
        away[k], found[k] = far, j
        farthest = away[held - 1]
    for k in range(moved.shape[0]):
        is_new = True
        for h in range(held):
            is_new &= found[h] != moved[k]
        if is_new:
            found[held] = moved[k]
            held += 1
    for h in range(1, held):
        item = found[h]
        k = h
        while k > 0 and (
            board.places[found[k - 1], 0] > board.places[item, 0]
            or (board.places[found[k - 1], 0] == board.places[item, 0] and found[k - 1] > item)
        ):
            found[k] = found[k - 1]
            k -= 1
        found[k] = item
    return held


@helper
def _bound(board, item, moved, places, room, bound):
    """Write the box that an item must not leave: about its disc where it is put, or its own."""
    box = board.boxes[item]
    for c in range(4):
        bound[c] = box[c] + (room if c > 1 else -room)
    for k in range(moved.shape[0]):
        if moved[k] == item:
            reach = board.arms[item] * math.exp(places[k, 3]) + room
            bound[0], bound[1] = places[k, 0] - reach, places[k, 1] - reach
            bound[2], bound[3] = places[k, 0] + reach, places[k, 1] + reach


@helper
def _hull(boxes, count, hull):
    """Write the box about some boxes."""
    for c in range(4):
        hull[c] = boxes[0, c]
    for k in range(1, count):
        hull[0], hull[1] = min(hull[0], boxes[k, 0]), min(hull[1], boxes[k, 1])
        hull[2], hull[3] = max(hull[2], boxes[k, 2]), max(hull[3], boxes[k, 3])


@helper
def _comes_near(boxes, begin, end, left, top, right, bottom):
    """Whether some boxes meet the one between these bounds."""
    for b in range(begin, end):
        if (
            boxes[b, 0] <= right
            and boxes[b, 2] >= left
            and boxes[b, 1] <= bottom
            and boxes[b, 3] >= top
        ):
            return True
    return False


@helper
def _meet(boxes, count, hull, others, begin, end, margin):
    """Whether some boxes, all in a hull, come within a margin of others."""
    for b in range(begin, end):
        left, top = others[b, 0] - margin, others[b, 1] - margin
        right, bottom = others[b, 2] + margin, others[b, 3] + margin
        if hull[0] > right or hull[2] < left or hull[1] > bottom or hull[3] < top:
            continue
        if _comes_near(boxes, np.int64(0), count, left, top, right, bottom):
            return True
    return False


@helper
def _longer(found, count):
    longer = np.empty(2 * count, np.int64)
    for k in range(count):
        longer[k] = found[k]
    return longer


@kernel
def disjoint(board, radii, moved, places, neighbours, room, margin, most):
    """The first of some trials and those after it whose neighbourhoods do not meet, ``most``.

    ``radii``: ``(n,)`` of all items; ``moved``: ``(p, 2)`` those that are put elsewhere, the second
    -1 for one alone; ``places``: ``(p, 2, 4)`` where; ``neighbours``: how many give way for each of
    these; ``room``: how far each may go; ``margin``: how near to what else.
    """
    count, width = board.places.shape[0], 2 * neighbours + 4
    trials, begins = np.empty(most, np.int64), np.zeros((most + 1, 2), np.int64)
    items, bounds = np.empty(most * width, np.int64), np.empty((most * width, 4))
    # Where the moved items were counts too.
    reached, ends = np.empty((most * (width + 2), 4)), np.zeros(most + 1, np.int64)
    near = np.empty(16 * most * width, np.int64)
    here, boxes, hull = np.empty(width, np.int64), np.empty((width + 2, 4)), np.empty(4)
    chosen = 0
    for p in range(moved.shape[0]):
        if chosen == most:
            break
        pair = 2 if moved[p, 1] >= 0 else 1
        held = _about(board, radii, moved[p, :pair], min(pair * (neighbours + 1), count), here)
        for k in range(held):
            _bound(board, here[k], moved[p, :pair], places[p], room, boxes[k])
        for k in range(pair):
            boxes[held + k] = board.boxes[moved[p, k]]
        _hull(boxes, held + pair, hull)
        if _meet(boxes, held + pair, hull, reached, np.int64(0), ends[chosen], margin):
            continue
        trials[chosen] = p
        begin, last = begins[chosen, 0], begins[chosen, 1]
        for k in range(held + pair):
            reached[ends[chosen] + k] = boxes[k]
        for k in range(held):
            items[begin + k], bounds[begin + k] = here[k], boxes[k]
        for j in range(count):
            left, top = board.boxes[j, 0] - margin, board.boxes[j, 1] - margin
            right, bottom = board.boxes[j, 2] + margin, board.boxes[j, 3] + margin
            is_near = hull[0] <= right and hull[2] >= left and hull[1] <= bottom and hull[3] >= top
            if is_near:
                is_near = _comes_near(boxes, np.int64(0), held, left, top, right, bottom)
            is_near |= j == moved[p, 0] or j == moved[p, 1]
            if is_near:
                if last == near.shape[0]:
                    near = _longer(near, last)
                near[last] = j
                last += 1
        ends[chosen + 1] = ends[chosen] + held + pair
        begins[chosen + 1, 0], begins[chosen + 1, 1] = begin + held, last
        chosen += 1
    return Chosen(
        trials[:chosen], items[: begins[chosen, 0]], bounds[: begins[chosen, 0]],
        near[: begins[chosen, 1]], begins[: chosen + 1],
    )  # fmt: skip
