"""Sizes of words along limbs in the order of their weights, where they are set again and again."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from packwork.arrays import FloatArray

if TYPE_CHECKING:
    from packwork.start.lanes import WordOnLine

LARGER = 1.05
"""Size of a word over that of a heavier one, at most. Smaller holds more words down, larger tells
weights less well. Chosen."""


def in_order(found: Sequence[WordOnLine], wanted: FloatArray) -> list[WordOnLine]:
    """The largest of each word in turn, then those set again.

    None is larger than itself before, nor by more than ``LARGER`` than what wants a larger size.
    """
    by_size = sorted(found, key=lambda one: (one.word, -one.size))
    firsts = list({one.word: one for one in reversed(by_size)}.values())[::-1]
    once, sizes = set(firsts), np.array([one.size for one in found])
    largest = largest_of([one.word for one in found], sizes, len(wanted))
    most = np.minimum(largest, LARGER * least_above(largest, wanted))
    again = [one for one in by_size if one not in once]
    return [one.at_most(float(most[one.word])) for one in (*firsts, *again)]


def held_down(words: Sequence[int], sizes: FloatArray, wanted: FloatArray) -> FloatArray:
    """Sizes ``(m,)`` of settings, at most ``LARGER`` times the largest of each that wants more."""
    most = LARGER * least_above(largest_of(words, sizes, len(wanted)), wanted)
    return np.asarray(np.minimum(sizes, most[np.asarray(words, dtype=int)]))


def largest_of(words: Sequence[int], sizes: FloatArray, count: int) -> FloatArray:
    """``(count,)`` size of each word where it is largest; infinite of those that are not set.

    Examples
    --------
    >>> largest_of([0, 2, 0], np.array([4.0, 3.0, 1.0]), 3).tolist()
    [4.0, inf, 3.0]
    """
    found, rows = np.full(count, np.inf), np.asarray(words, dtype=int)
    found[rows] = 0.0
    np.maximum.at(found, rows, sizes)
    return found


def least_above(sizes: FloatArray, wanted: FloatArray) -> FloatArray:
    """``(n,)`` least size of all that want more than each.

    Examples
    --------
    >>> least_above(np.array([4.0, 3.0, 5.0, 2.0]), np.array([9.0, 8.0, 8.0, 7.0])).tolist()
    [inf, 4.0, 4.0, 3.0]
    """
    # Rounded: what the last digits say is no weight.
    ranked, rows = np.unique(-np.round(wanted / wanted.max(), 9), return_inverse=True)
    least = np.full(len(ranked) + 1, np.inf)
    np.minimum.at(least, rows + 1, sizes)
    return np.asarray(np.minimum.accumulate(least)[rows])
