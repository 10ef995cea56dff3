"""Best knots of a closed curve for a given number of cubics: dynamic programming.

Over the sites that are offered the result is the best there is, for one cut held; as in
Perez and Vidal, "Optimum polygonal approximation of digitized curves" (1994), with cubics
for straight lines.
"""

from __future__ import annotations

import numpy as np

from packwork.arrays import FloatArray, IntArray
from packwork.fit.arcs import arc_fits, resampled

SITES_PER_CURVE = 6
"""Places offered for each cut: larger finds better cuts in its square of the time. 8 and
12 end at the same IoU within 0.0006. Tried."""

MOST_SITES = 400
"""Sites of one ring at most: their square is the memory. Chosen."""

SAMPLES_PER_SITE = 12
"""Samples between two sites: fewer blur the outline, more cost little. Chosen."""


def best_chain(ring: FloatArray, curves: int) -> FloatArray:
    """Chain ``(curves, 3, 2)`` of least squared distance to a ring, cut where it is best.

    The distance is taken at equal shares of arc length, so the chain is a start for a
    fit that does not care where on a curve a point lies.

    Examples
    --------
    >>> square = np.array([[0, 0], [2, 0], [2, 2], [0, 2.0]])
    >>> sorted(best_chain(square, 4)[:, 0].tolist())
    [[0.0, 0.0], [0.0, 2.0], [2.0, 0.0], [2.0, 2.0]]
    """
    sites = min(SITES_PER_CURVE * curves, MOST_SITES)
    # Running sums far from the origin would lose what short arcs leave of them.
    middle = ring.mean(axis=0)
    samples = resampled(ring - middle, sites * SAMPLES_PER_SITE)
    fits = arc_fits(samples, SAMPLES_PER_SITE)
    # The first cut was held wherever the ring happens to start; a cut that was free to
    # move is a better one to hold.
    held = closed_path(fits.cost, curves, 0)
    cuts = closed_path(fits.cost, curves, int(held[curves // 2]))
    following = np.roll(cuts, -1)
    chain = np.stack(
        [
            samples[cuts * SAMPLES_PER_SITE],
            fits.first[cuts, following],
            fits.second[cuts, following],
        ],
        axis=1,
    )
    return np.asarray(np.stack([chain.real, chain.imag], axis=2) + middle)


def closed_path(cost: FloatArray, arcs: int, first: int) -> IntArray:
    """Sites at which a ring is cut into ``arcs`` arcs of least total cost.

    Parameters
    ----------
    cost
        ``(m, m)``: of the arc from site i on to site j.
    arcs
        From 2 to m.
    first
        The site that must be a cut.

    Returns
    -------
    IntArray
        ``(arcs,)`` in their order along the ring, ``first`` at the front.

    Examples
    --------
    >>> cost = np.array([[9, 1, 2, 9], [9, 9, 3, 5], [5, 9, 9, 1], [0, 5, 9, 9.0]])
    >>> closed_path(cost, 3, 0).tolist()
    [0, 2, 3]
    """
    m = len(cost)
    order = (np.arange(m) + first) % m
    ahead = np.full((m, m + 1), np.inf)
    ahead[:, :m] = np.where(np.tri(m, dtype=bool), np.inf, cost[np.ix_(order, order)])
    ahead[:, m] = cost[order, first]
    reached = ahead[0]
    came_from = []
    for _ in range(arcs - 1):
        through = reached[:m, None] + ahead
        came_from.append(through.argmin(axis=0))
        reached = through[came_from[-1], np.arange(m + 1)]
    cuts = [m]
    for previous in reversed(came_from):
        cuts.append(int(previous[cuts[-1]]))
    return np.asarray(order[[0, *reversed(cuts[1:])]])
