"""Ways through free pixels: which places hang together, and what it costs to get there."""

from __future__ import annotations

import math

import numpy as np

from packwork.compiled import kernel
from packwork.start.first_fit.kernels.row_bits import LAST, ONE


@kernel
def flood(free, reached):
    """Spread the bits of ``reached`` over all free places that hang together with them."""
    height, words = free.shape
    zero = np.uint64(0)
    is_new = True
    while is_new:
        is_new = False
        for step in (1, -1):
            for n in range(height):
                y = n if step == 1 else height - 1 - n
                beside = y - step
                carry = zero
                for i in range(words):
                    run, old = free[y, i], reached[y, i]
                    seeds = old | (carry & ONE)
                    if 0 <= beside < height:
                        seeds |= reached[beside, i]
                    seeds &= run
                    # A carry runs up through the ones of each run.
                    total = run + seeds
                    carry = ONE if total < run else zero
                    found = ((total ^ run) | seeds) & run
                    is_new = is_new or found != old
                    reached[y, i] = found
                carry = zero
                for n_word in range(words):
                    i = words - 1 - n_word
                    run, old = free[y, i], reached[y, i]
                    found = old | (carry & run)
                    for shift in (1, 2, 4, 8, 16, 32):
                        found |= run & (found >> np.uint64(shift))
                        run &= run >> np.uint64(shift)
                    is_new = is_new or found != old
                    reached[y, i] = found
                    carry = (found & ONE) << LAST


@kernel
def spread_costs(price, costs):
    """Lower costs to those of the cheapest ways over pixels, diagonals too, from where they are 0.

    ``price``: ``(rows, columns)`` of a way through each pixel; infinite where none leads.
    """
    height, width = price.shape
    diagonal = math.sqrt(2.0)
    is_new = True
    while is_new:
        is_new = False
        for step in (1, -1):
            for n in range(height):
                y = n if step == 1 else height - 1 - n
                for m in range(width):
                    x = m if step == 1 else width - 1 - m
                    if price[y, x] == np.inf:
                        continue
                    least = costs[y, x]
                    if 0 <= x - step < width:
                        least = min(least, costs[y, x - step] + price[y, x])
                    if 0 <= y - step < height:
                        least = min(least, costs[y - step, x] + price[y, x])
                        for across in (-1, 1):
                            if 0 <= x + across < width:
                                here = costs[y - step, x + across] + diagonal * price[y, x]
                                least = min(least, here)
                    if least < costs[y, x]:
                        costs[y, x] = least
                        is_new = True
