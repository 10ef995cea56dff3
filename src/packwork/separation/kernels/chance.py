"""Random numbers of a worker: Marsaglia's xorshift over one word, which must not be 0."""

from __future__ import annotations

import math

import numpy as np

from packwork.compiled import helper

_13, _7, _17, _11 = np.uint64(13), np.uint64(7), np.uint64(17), np.uint64(11)
_UNIT = 1.0 / (1 << 53)


@helper
def uniform(state):
    """From 0 to before 1."""
    word = state[0]
    word ^= word << _13
    word ^= word >> _7
    word ^= word << _17
    state[0] = word
    return float(word >> _11) * _UNIT


@helper
def below(state, count):
    """A whole number from 0 to before ``count``."""
    return min(int(uniform(state) * count), count - 1)


@helper
def normal(state):
    """Of mean 0 and deviation 1 (Box and Muller)."""
    radius = math.sqrt(-2.0 * math.log(1.0 - uniform(state)))
    return radius * math.cos(2.0 * math.pi * uniform(state))
