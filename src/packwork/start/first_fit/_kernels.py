"""Inner loops on rows of bits: 64 pixels in a word, the lowest bit leftmost."""

from __future__ import annotations

import numpy as np

from packwork.compiled import helper, kernel

ALL = np.uint64(0xFFFFFFFFFFFFFFFF)
ONE = np.uint64(1)


@kernel
def smear(rows, top, bottom):
    """Write ``rows[y, k, x] = any(rows[y, 0, x : x + 2**k])``; taken beyond the last word."""
    levels, words = rows.shape[1], rows.shape[2]
    for y in range(top, bottom):
        for k in range(1, levels):
            shift = 1 << (k - 1)
            whole, part = shift >> 6, np.uint64(shift & 63)
            for i in range(words):
                rows[y, k, i] = rows[y, k - 1, i] | _from(rows[y, k - 1], i + whole, part)


@helper
def _from(row, i, part):
    """Return 64 pixels of a row, from bit ``part`` of its word ``i`` on."""
    words = len(row)
    here = row[i] if i < words else ALL
    if part == np.uint64(0):
        return here
    after = row[i + 1] if i + 1 < words else ALL
    return (here >> part) | (after << (np.uint64(64) - part))


@kernel
def find_free(rows, runs, height, free):
    """Set a bit of ``free`` where no run of the stencil, moved there, meets a taken pixel."""
    words = free.shape[1]
    for y in range(free.shape[0]):
        if y + height > rows.shape[0]:
            for i in range(words):
                free[y, i] = np.uint64(0)
            continue
        for i in range(words):
            free[y, i] = ALL
        for r in range(len(runs)):
            row, first, length, level = runs[r]
            last = first + length - (1 << level)
            whole_a, part_a = first >> 6, np.uint64(first & 63)
            whole_b, part_b = last >> 6, np.uint64(last & 63)
            smeared = rows[y + row, level]
            left = np.uint64(0)
            for i in range(words):
                if free[y, i] != np.uint64(0):
                    taken = _from(smeared, i + whole_a, part_a)
                    if last != first:
                        taken |= _from(smeared, i + whole_b, part_b)
                    free[y, i] &= ~taken
                    left |= free[y, i]
            if left == np.uint64(0):
                break


@kernel
def best_touching(free, taken, margin, fringe, worth, field, pull, origin, is_everywhere):
    """Return score, row and column of the free place whose fringe is taken most; -1 if none.

    ``worth + pull * field`` is added for the pixel that the stencil's origin comes to; a worth of
    minus infinity forbids it. Unless ``is_everywhere``, only places beside one that is not free
    come into question.
    """
    height, words = free.shape
    width = taken.shape[1]
    flat = taken.ravel()
    zero = np.uint64(0)
    best, best_y, best_x = -np.inf, -1, -1
    # What touches nothing is worth no less than that, and what touches all one more at most.
    least = -np.inf
    for is_counted in (False, True):
        for y in range(height):
            for i in range(words):
                word = free[y, i]
                if word == zero:
                    continue
                edge = word if is_everywhere else _edge_of(free, y, i)
                bit = 0
                while edge != zero:
                    while edge & ONE == zero:
                        edge >>= ONE
                        bit += 1
                    x = 64 * i + bit
                    edge >>= ONE
                    bit += 1
                    row = min(max(y + origin[0], 0), height - 1)
                    column = min(max(x + origin[1], 0), worth.shape[1] - 1)
                    more = worth[row, column]
                    if pull != 0.0:
                        more += pull * field[row, column]
                    if not is_counted:
                        least = max(least, more)
                        continue
                    if more == -np.inf or 1.0 + more < least:
                        continue
                    base = (y + margin) * width + x + margin
                    touched = 0
                    for k in range(len(fringe)):
                        touched += flat[base + fringe[k]]
                    score = touched / len(fringe) + more
                    least = max(least, score)
                    if best_y < 0 or score > best:
                        best, best_y, best_x = score, y, x
    return best, best_y, best_x


@helper
def _edge_of(free, y, i):
    """Return the free places of a word beside one that is not free."""
    height, words = free.shape
    zero = np.uint64(0)
    word = free[y, i]
    left = (word << ONE) | (free[y, i - 1] >> np.uint64(63) if i > 0 else zero)
    right = (word >> ONE) | (free[y, i + 1] << np.uint64(63) if i + 1 < words else zero)
    above = free[y - 1, i] if y > 0 else zero
    below = free[y + 1, i] if y + 1 < height else zero
    return word & ~(left & right & above & below)


@kernel
def grown(mask, wide, reach):
    """Return a mask, ``wide`` pixels larger all round, of the pixels at most ``reach`` from one."""
    height, width = mask.shape
    near = np.zeros((height + 2 * wide, width + 2 * wide), np.bool_)
    for y in range(height):
        for x in range(width):
            if not mask[y, x]:
                continue
            near[y + wide, x + wide] = True
            if _is_amid(mask, y, x):
                continue
            for j in range(-wide, wide + 1):
                for i in range(-wide, wide + 1):
                    if i * i + j * j <= reach * reach:
                        near[y + j + wide, x + i + wide] = True
    return near


@helper
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
def runs_of(mask):
    """Return runs of a mask, ``(r, 4)``: row, first column, length, log2 of it rounded down."""
    runs = np.empty((mask.size // 2 + mask.shape[0] + 1, 4), np.int64)
    found = 0
    for y in range(mask.shape[0]):
        x = 0
        while x < mask.shape[1]:
            if not mask[y, x]:
                x += 1
                continue
            first = x
            while x < mask.shape[1] and mask[y, x]:
                x += 1
            length = x - first
            level = 0
            while (2 << level) <= length:
                level += 1
            runs[found] = (y, first, length, level)
            found += 1
    return runs[:found].copy()


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
