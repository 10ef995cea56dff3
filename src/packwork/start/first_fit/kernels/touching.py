"""The best of free places: the one whose fringe touches most, on rows of bits."""

from __future__ import annotations

import numpy as np

from packwork.compiled import kernel, leaf

ONE = np.uint64(1)


@kernel
def best_touching(free, taken, begin, fringe, reach, worth, field, pull, origin, is_everywhere):
    """Return score, row and column of the free place whose fringe is taken most; -1 if none.

    ``begin`` is where the first of the places lies among the bytes of ``taken``; ``fringe`` tells
    how far on each pixel is, at most ``reach`` pixels from the stencil that ``free`` is about; 0
    where it is about another one.
    ``worth + pull * field`` is added for the pixel that the stencil's origin comes to; a worth of
    minus infinity forbids it. Unless ``is_everywhere``, only places beside one that is not free
    come into question.
    """
    height, words = free.shape
    width = taken.shape[1]
    flat = taken.ravel()
    zero = np.uint64(0)
    best, best_y, best_x = -np.inf, -1, -1
    # Those amid free places touch nothing: nearer to what they touch they would not be free.
    amid = np.zeros(free.shape, np.uint64)
    if is_everywhere and reach > 0:
        _mark_amid(free, reach, amid)
    # What the best is worth at least; what touches all is worth one more than what touches nothing.
    least = -np.inf
    for step in (SOME, 1):
        is_counted = step == 1
        for y in range(0, height, step):
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
                    least = max(least, more)
                    if more == -np.inf or 1.0 + more < least:
                        continue
                    touched = 0
                    if not is_everywhere or (amid[y, i] >> np.uint64(bit - 1)) & ONE == zero:
                        enough = (max(best, least) - more) * len(fringe) - ROUNDED
                        touched = _touched(flat, begin + y * width + x, fringe, enough)
                        if touched < 0:
                            continue
                    score = touched / len(fringe) + more
                    least = max(least, score)
                    if is_counted and (best_y < 0 or score > best):
                        best, best_y, best_x = score, y, x
    return best, best_y, best_x


SOME = 8
"""Of so many rows one is looked at first, to know what the best place is worth at least. Larger
counts more that cannot win, smaller looks at more places twice. Tried."""

ROUNDED = 1e-3
"""Pixels of a fringe by which sums may be rounded. Derived: far more than they are, less than 1."""

LOOK = 32
"""Pixels of a fringe that are counted between two looks at whether enough can be taken. Larger
counts in vain, smaller looks too often. Tried."""


@leaf
def _touched(flat, base, fringe, enough):
    """Return how many pixels of a fringe are taken; -1 if too few are left to be enough."""
    count, touched = len(fringe), 0
    for begin in range(0, count, LOOK):
        end = min(begin + LOOK, count)
        for k in range(begin, end):
            touched += flat[base + fringe[k]]
        if touched + (count - end) < enough:
            return -1
    return touched


@leaf
def _mark_amid(free, reach, amid):
    """Mark the free places with nothing but free ones so many pixels about them."""
    height, words = free.shape
    for y in range(reach, height - reach):
        for i in range(words):
            word = free[y, i]
            for j in range(1, reach + 1):
                word &= free[y - j, i] & free[y + j, i]
            amid[y, i] = word
    for y in range(reach, height - reach):
        before = np.uint64(0)
        for i in range(words):
            here = amid[y, i]
            behind = amid[y, i + 1] if i + 1 < words else np.uint64(0)
            word = here
            for k in range(1, reach + 1):
                near, far = np.uint64(k), np.uint64(64 - k)
                word &= ((here << near) | (before >> far)) & ((here >> near) | (behind << far))
            amid[y, i] = word
            before = here


@leaf
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
