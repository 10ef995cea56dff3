"""Inner loops on rows of bits: 64 pixels in a word, the lowest bit leftmost."""

from __future__ import annotations

import math

import numpy as np

from packwork.compiled import kernel, leaf

ALL = np.uint64(0xFFFFFFFFFFFFFFFF)
ONE, LAST = np.uint64(1), np.uint64(63)
TINY = 1e-300
SHARP = 0.5
"""1 plus the cosine of the turn from which on an offset's corners are twice the distance off."""


@kernel
def smear(rows, words, top, bottom, first, end):
    """Write whether any pixel of a box is taken, for rows from ``top`` to before ``bottom``.

    ``rows[j, k, y, x] = any(rows[0, 0, y : y + 2**j, x : x + 2**k])`` in the words from ``first``
    to before ``end``; all is taken beyond the first ``words``, and free below the last row. Rows
    above ``top`` whose boxes reach down there are written as well.
    """
    tall, levels, height = rows.shape[:3]
    for y in range(top, bottom):
        for k in range(1, levels):
            shift = 1 << (k - 1)
            whole, part = shift >> 6, np.uint64(shift & 63)
            row = rows[0, k - 1, y]
            for i in range(first, min(words - whole, end)):
                ahead = (row[i + whole] >> part) | ((row[i + whole + 1] << ONE) << (LAST - part))
                rows[0, k, y, i] = row[i] | ahead
            for i in range(max(words - whole, first), end):
                rows[0, k, y, i] = ALL
    for j in range(1, tall):
        below = 1 << (j - 1)
        for k in range(levels):
            for y in range(max(top - 2 * below + 1, 0), bottom):
                for i in range(first, end):
                    rows[j, k, y, i] = rows[j - 1, k, y, i]
                    if y + below < height:
                        rows[j, k, y, i] |= rows[j - 1, k, y + below, i]


@kernel
def clear_taken(rows, boxes, height, top, bottom, before, free):
    """Clear bits of ``free`` where a box of the stencil, moved there, meets a taken pixel.

    Its first row is row ``top`` of the image, in which a stencil ends above row ``bottom``, and
    ``before`` words of each row lie left of it. Returns whether any is left.
    """
    across = 0
    for r in range(len(boxes)):
        across = max(across, boxes[r, 1] + boxes[r, 3])
    # Words whose first bit is no place: beyond them all is taken.
    inside = rows.shape[3] - 1 - before - -(-across // 64)
    words = max(min(free.shape[1], inside + 1), 0)
    is_left = False
    for y in range(free.shape[0]):
        for i in range(words, free.shape[1]):
            free[y, i] = np.uint64(0)
        if top + y + height > bottom:
            free[y] = np.uint64(0)
            continue
        # Only from the first to the last word in which something is free.
        begin, end = 0, words
        while begin < end and free[y, begin] == np.uint64(0):
            begin += 1
        for r in range(len(boxes)):
            if begin == end:
                break
            row, first, tall, wide, j, k = boxes[r]
            last = first + wide - (1 << k)
            lowest = row + tall - (1 << j)
            left = _without(rows, top + y + row, j, k, first, last, before, free, y, begin, end)
            if lowest != row and left != np.uint64(0):
                left = _without(
                    rows, top + y + lowest, j, k, first, last, before, free, y, begin, end
                )
            if left == np.uint64(0):
                begin = end
                break
            while free[y, begin] == np.uint64(0):
                begin += 1
            while free[y, end - 1] == np.uint64(0):
                end -= 1
        is_left |= begin < end
    return is_left


BLOCK = 32
"""Rows that are cleared together. Larger goes on with the next box though nothing is left in most
of them, smaller begins loops more often. Tried."""


@kernel
def clear_rows(rows, boxes, height, top, bottom, free):
    """The same of whole rows: one loop goes over many of them, which is three times as fast.

    ``free``: ``(h, words + 1)``; the last word of each row is no place.
    """
    across, words = 0, rows.shape[3]
    for r in range(len(boxes)):
        across = max(across, boxes[r, 1] + boxes[r, 3])
    free[:, max(words - -(-across // 64), 0) :] = np.uint64(0)
    high = max(min(free.shape[0], bottom - top - height + 1), 0)
    free[high:] = np.uint64(0)
    flat = free.reshape(free.size)
    for y in range(0, high, BLOCK):
        here = flat[y * words : min(y + BLOCK, high) * words]
        for r in range(len(boxes)):
            row, first, tall, wide, j, k = boxes[r]
            taken = rows[j, k].reshape(rows.shape[2] * words)[(top + y) * words :]
            last, lowest = first + wide - (1 << k), row + tall - (1 << j)
            left = _without_all(taken[row * words :], first, last, here)
            if lowest != row and left != np.uint64(0):
                left = _without_all(taken[lowest * words :], first, last, here)
            if left == np.uint64(0):
                break


@leaf
def _without_all(taken, first, last, free):
    """Clear bits of many rows of ``free`` as of one; what is left of them."""
    one, other = taken[first >> 6 :], taken[last >> 6 :]
    near, far = np.uint64(first & 63), np.uint64(last & 63)
    left = np.uint64(0)
    # In the last words of the last row nothing is free.
    for i in range(min(len(free), len(other) - 1)):
        met = (one[i] >> near) | ((one[i + 1] << ONE) << (LAST - near))
        met |= (other[i] >> far) | ((other[i + 1] << ONE) << (LAST - far))
        here = free[i] & ~met
        free[i] = here
        left |= here
    return left


@leaf
def _without(rows, at, j, k, first, last, before, free, y, begin, end):
    """Clear bits of a row of ``free`` where a box from ``at`` on meets one; what is left of them.

    ``first``, ``last``: columns at which boxes so wide begin that cover it.
    """
    one, other = before + (first >> 6), before + (last >> 6)
    near, far = np.uint64(first & 63), np.uint64(last & 63)
    left = np.uint64(0)
    # No branches: several words go through at once.
    for i in range(begin, end):
        taken = rows[j, k, at, one + i] >> near
        taken |= (rows[j, k, at, one + i + 1] << ONE) << (LAST - near)
        taken |= rows[j, k, at, other + i] >> far
        taken |= (rows[j, k, at, other + i + 1] << ONE) << (LAST - far)
        here = free[y, i] & ~taken
        free[y, i] = here
        left |= here
    return left


@kernel
def keep_off(spans, height, width, free):
    """Clear bits for the corner of a box whose lesser side does not fit between it and any span.

    ``spans``: ``(n, 4)`` first row and end, first column and end. Returns whether any bit is left;
    where none is, all stay as they were.
    """
    kept = free.copy()
    gap = min(height, width)
    for s in range(len(spans)):
        left = max(spans[s, 2] - width - gap, 0)
        right = min(spans[s, 3] + gap, 64 * free.shape[1])
        for i in range(left >> 6, -(-right // 64)):
            outside = ~(ALL << np.uint64(max(left - 64 * i, 0)))
            if right < 64 * i + 64:
                outside |= ALL << np.uint64(right - 64 * i)
            for y in range(
                max(spans[s, 0] - height - gap, 0), min(spans[s, 1] + gap, free.shape[0])
            ):
                kept[y, i] &= outside
    is_left = kept.any()
    if is_left:
        free[:] = kept
    return is_left


@kernel
def spread(mask, down, across):
    """Return a mask, so many pixels larger on each side, of the pixels in a box about one of it.

    ``near[y + down, x + across] = any(mask[y - down : y + down + 1, x - across : x + across + 1])``
    """
    height, width = mask.shape
    near = np.zeros((height + 2 * down, width + 2 * across), np.bool_)
    # Row from which on a column has none.
    ends = np.zeros(width + 2 * across, np.int64)
    for y in range(height + 2 * down):
        end = 0
        for x in range(width + 2 * across):
            if y < height and x < width and mask[y, x]:
                end = x + 2 * across + 1
            if x < end:
                ends[x] = y + 2 * down + 1
            near[y, x] = y < ends[x]
    return near


@leaf
def _is_amid(mask, y, x):
    """Return whether the four pixels round one are in the mask as well."""
    height, width = mask.shape
    return (
        0 < y < height - 1
        and 0 < x < width - 1
        and mask[y - 1, x]
        and mask[y + 1, x]
        and mask[y, x - 1]
        and mask[y, x + 1]
    )


@kernel
def offset(points, starts, distance):
    """Return vertices moved outwards until edges are ``distance`` off, sharp corners less far."""
    moved = points.copy()
    for r in range(len(starts) - 1):
        begin, end = starts[r], starts[r + 1]
        for v in range(begin, end):
            u = v - 1 if v > begin else end - 1
            w = v + 1 if v + 1 < end else begin
            ax, ay = points[v, 0] - points[u, 0], points[v, 1] - points[u, 1]
            bx, by = points[w, 0] - points[v, 0], points[w, 1] - points[v, 1]
            a, b = max(math.hypot(ax, ay), TINY), max(math.hypot(bx, by), TINY)
            ax, ay, bx, by = ax / a, ay / a, bx / b, by / b
            # Twice the distance at most.
            step = distance / max(1.0 + ax * bx + ay * by, SHARP)
            moved[v, 0] += step * (ay + by)
            moved[v, 1] -= step * (ax + bx)
    return moved


@kernel
def mark_near(points, starts, reach, mask):
    """Set the pixels of a mask whose squares come nearer than ``reach`` to an edge of the rings.

    At corners a tenth of a pixel more: of a square counts how far it reaches towards that edge.
    """
    height, width = mask.shape
    for r in range(len(starts) - 1):
        begin, end = starts[r], starts[r + 1]
        for v in range(begin, end):
            w = v + 1 if v + 1 < end else begin
            ax, ay = points[v, 0], points[v, 1]
            along_x, along_y = points[w, 0] - ax, points[w, 1] - ay
            square = max(along_x * along_x + along_y * along_y, TINY)
            left = max(math.floor(min(ax, points[w, 0]) - reach), 0)
            right = min(math.ceil(max(ax, points[w, 0]) + reach), width)
            top = max(math.floor(min(ay, points[w, 1]) - reach), 0)
            bottom = min(math.ceil(max(ay, points[w, 1]) + reach), height)
            for y in range(top, bottom):
                for x in range(left, right):
                    if mask[y, x]:
                        continue
                    dx, dy = x + 0.5 - ax, y + 0.5 - ay
                    share = min(max((dx * along_x + dy * along_y) / square, 0.0), 1.0)
                    dx -= share * along_x
                    dy -= share * along_y
                    off = math.sqrt(dx * dx + dy * dy)
                    mask[y, x] = off * (off - reach) <= 0.5 * (abs(dx) + abs(dy))


@kernel
def boxes_of(mask, tallest, widest):
    """Return boxes that cover a mask and nothing else, ``(r, 6)``.

    Row, first column, height, width, and log2 of both rounded down, ``tallest`` and ``widest`` at
    most. Each run of a row goes down as far as the mask has all of it; what is covered so begins no
    box.
    """
    height, width = mask.shape
    boxes = np.empty((mask.size // 2 + height + 1, 6), np.int64)
    is_covered = np.zeros((height, width), np.bool_)
    found = 0
    for y in range(height):
        x = 0
        while x < width:
            if not mask[y, x]:
                x += 1
                continue
            first, is_new = x, False
            while x < width and mask[y, x]:
                is_new = is_new or not is_covered[y, x]
                x += 1
            if not is_new:
                continue
            tall = 1
            while tall < 2 << tallest and y + tall < height and mask[y + tall, first:x].all():
                tall += 1
            is_covered[y : y + tall, first:x] = True
            j = 0
            while j < tallest and (2 << j) <= tall:
                j += 1
            for begin in range(first, x, 2 << widest):
                wide, k = min(x - begin, 2 << widest), 0
                while k < widest and (2 << k) <= wide:
                    k += 1
                boxes[found] = (y, begin, tall, wide, j, k)
                found += 1
    return boxes[:found].copy()


@kernel
def fringe_of(mask, reach):
    """Return ``(r, 2)`` rows and columns of the pixels off a mask, at most ``reach`` from it."""
    height, width = mask.shape
    near = np.zeros((height + 2 * reach, width + 2 * reach), np.bool_)
    far = reach * reach + reach
    for y in range(height):
        for x in range(width):
            if not mask[y, x] or _is_amid(mask, y, x):
                continue
            for j in range(-reach, reach + 1):
                for i in range(-reach, reach + 1):
                    if i * i + j * j <= far:
                        near[y + j + reach, x + i + reach] = True
    for y in range(height):
        for x in range(width):
            if mask[y, x]:
                near[y + reach, x + reach] = False
    found = np.empty((near.size, 2), np.int64)
    count = 0
    for y in range(near.shape[0]):
        for x in range(near.shape[1]):
            if near[y, x]:
                found[count] = (y - reach, x - reach)
                count += 1
    return found[:count].copy()
