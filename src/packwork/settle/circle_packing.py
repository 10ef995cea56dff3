"""Circle packing: discs, equal or not, in a small enclosing circle.

Front chain: W. Wang, H. Wang, G. Dai and H. Wang, "Visualization of large hierarchical data by
circle packing", CHI 2006, 517-520, doi:10.1145/1124772.1124851; ours looks at all pairs and not
at the chain's alone, begins about several centres and takes the best. Then monotonic basin
hopping: A. Grosso, A. Jamali, M. Locatelli and F. Schoen, "Solving the problem of packing equal
and unequal circles in a circular container", Journal of Global Optimization 47 (2010), 63-81,
doi:10.1007/s10898-009-9458-3; our hops move a disc of the rim into a hole, or shake some, and
local minima are those of squared overlaps under a pressure, found by L-BFGS.
"""

from __future__ import annotations

import math

import numpy as np

from packwork.arrays import FloatArray
from packwork.settle.kernels import circle_packing as kernels

STARTS = 8
"""Fronts that are begun with, about other points of their first discs. More takes longer and finds
little that the trials do not. Tried."""

FRONTS = 4e6
"""Fronts by pairs of items at most; one is always laid. Larger gains little where there are
thousands, and takes seconds for each. Tried."""

TRIALS = 100
"""Changes that are tried then. More takes longer. Tried."""

WORK = 8e5
"""Trials by pairs of items at most; a trial looks at all pairs, again and again. Larger gains up
to 0.002 of the circle where there are many. Tried."""

TRIANGLE = 1 / math.sqrt(3)
"""How far the middle of three equal discs lies off the line of two, radii. Derived."""

ROUNDING = 1e-9
"""Share of a distance that rounding may take. Derived, as for the check of the finish."""


def packed_circles(radii: FloatArray, rng: np.random.Generator) -> FloatArray:
    """Centres ``(n, 2)`` of discs that do not meet, about the origin, in a small circle.

    Where one is more than a thousand times as large as another, small ones may come to lie in it.
    Deterministic for one generator. The circle is near the smallest for some tens of discs, equal
    or not: there is no table of known packs behind it.

    Parameters
    ----------
    radii
        Of the discs, with what they are to keep free round them.

    Examples
    --------
    >>> seven = packed_circles(np.ones(7), np.random.default_rng(0))
    >>> bool(2.999 < np.hypot(*seven.T).max() + 1 < 3.001)
    True
    """
    n = len(radii)
    order = np.argsort(-radii, kind="stable")
    best, centres = np.inf, np.zeros((n, 2))
    starts = max(min(STARTS, int(FRONTS / n**2)), 1)
    for shift, aside in _origins(rng)[:starts]:
        found = kernels.front_chain(radii, order, shift * radii[order[0]], aside * radii[order[0]])
        circle = kernels.circle_of(found, radii)
        squeezed = found.copy()
        narrower = kernels.squeeze(squeezed, radii)
        if narrower < circle:
            circle, found = narrower, squeezed
        if circle < best * (1 - ROUNDING):
            best, centres = circle, found
    trials = min(TRIALS, int(WORK / n**2)) if n > 2 else 0
    draws = rng.random((trials, 2 * max(n, kernels.SAMPLES) + 3))
    kernels.hop(centres, radii, draws)
    return centres * (1 + ROUNDING)


def _origins(rng: np.random.Generator) -> list[tuple[float, float]]:
    """Middles of the pack by the first two of its discs, in radii along and off their line."""
    known = [(1.0, 0.0), (0.0, 0.0), (0.0, TRIANGLE)]
    drawn = rng.uniform((0.0, 0.0), (1.0, TRIANGLE), (STARTS - len(known), 2))
    return known + [(float(a), float(b)) for a, b in drawn]
