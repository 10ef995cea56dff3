"""Best knots of a closed curve for a given number of cubics: dynamic programming.

Over the sites that are offered the result is the best there is, for one cut held; as in
Perez and Vidal, "Optimum polygonal approximation of digitized curves" (1994), with cubics
for straight lines. The best cubic for every arc comes from prefix sums: with the parameter
proportional to arc length and the ends held, the two handles are a linear least-squares problem.
Its right-hand sides are the arc's moments, and those are differences of running sums: every arc
costs the same few operations, however long it is. Points are complex numbers here, so that both
coordinates are solved together.
"""

from __future__ import annotations

from typing import NamedTuple, TypeAlias

import numpy as np
import numpy.typing as npt

from packwork.arrays import FloatArray, IntArray

ComplexArray: TypeAlias = npt.NDArray[np.complex128]


_GRAM = np.array([[20, 10, 4, 1], [10, 12, 9, 4], [4, 9, 12, 10], [1, 4, 10, 20]]) / 140
"""Integrals of products of two Bernstein polynomials of degree three over 0..1."""

_HANDLES = np.linalg.inv(_GRAM[1:3, 1:3])

_GAUSS_AT = 0.5 + np.sqrt(0.15) * np.array([-1, 0, 1])

_GAUSS_WEIGHTS = np.array([5, 8, 5]) / 18
"""Gauss-Legendre rule on 0..1, exact to degree five."""


class ArcFits(NamedTuple):
    """Cubics of all arcs from site i on to site j, each an array ``(m, m)``.

    ``cost``: integral of the squared distance to the arc, over the ring's length, which is counted
    as one. On the diagonal: the whole ring; ``first``, ``second``: the handles, as complex numbers.
    """

    cost: FloatArray
    first: ComplexArray
    second: ComplexArray


def resampled(ring: FloatArray, count: int) -> ComplexArray:
    """``count`` points at equal steps of arc length along a closed ring.

    >>> resampled(np.array([[0, 0], [2, 0], [2, 2], [0, 2.0]]), 8)[:3].tolist()
    [0j, (1+0j), (2+0j)]
    """
    corners = np.concatenate([ring, ring[:1]])
    along = np.concatenate([[0], np.cumsum(np.hypot(*np.diff(corners, axis=0).T))])
    asked = np.arange(count) * (along[-1] / count)
    x, y = (np.interp(asked, along, corners[:, axis]) for axis in (0, 1))
    return np.asarray(x + 1j * y)


def arc_fits(samples: ComplexArray, stride: int) -> ArcFits:
    """Least-squares cubic of every arc between two sites, its ends held.

    ``samples``: ``(n,)`` points at equal steps along a closed curve; each ``stride``-th is a site.

    >>> square = resampled(np.array([[0, 0], [2, 0], [2, 2], [0, 2.0]]), 64)
    >>> fits = arc_fits(square, 16)
    >>> bool(fits.cost[0, 1] < 1e-12 < fits.cost[0, 2])
    True
    """
    n = len(samples)
    begin = np.arange(0, n, stride)
    i, j = begin[:, None], begin[None, :]
    j = np.where(j <= i, j + n, j)
    moments, square = _bernstein_moments(samples, i, j)
    start, end = samples[i], samples[j % n]
    first = moments[1] - _GRAM[1, 0] * start - _GRAM[1, 3] * end
    second = moments[2] - _GRAM[2, 0] * start - _GRAM[2, 3] * end
    handle_1 = _HANDLES[0, 0] * first + _HANDLES[0, 1] * second
    handle_2 = _HANDLES[1, 0] * first + _HANDLES[1, 1] * second
    # |z - start B0 - end B3|^2, less what the handles explain of it.
    left = (
        square
        - 2 * (_dot(start, moments[0]) + _dot(end, moments[3]))
        + _GRAM[0, 0] * (_dot(start, start) + _dot(end, end))
        + 2 * _GRAM[0, 3] * _dot(start, end)
        - _dot(handle_1, first)
        - _dot(handle_2, second)
    )
    return ArcFits(np.maximum(left, 0) * ((j - i) / n), handle_1, handle_2)


def _bernstein_moments(
    samples: ComplexArray, i: npt.NDArray[np.int64], j: npt.NDArray[np.int64]
) -> tuple[list[ComplexArray], FloatArray]:
    """Means over each arc of the curve times B0..B3 of the arc's own parameter, and of |z|^2."""
    sums, energy = _running_moments(samples)
    raw = [s[j] - s[i] for s in sums]
    n = len(samples)
    a, per = i / n, n / (j - i)
    # Moments about the arc's start, its length taken as one.
    m0 = per * raw[0]
    m1 = per**2 * (raw[1] - a * raw[0])
    m2 = per**3 * (raw[2] - 2 * a * raw[1] + a**2 * raw[0])
    m3 = per**4 * (raw[3] - 3 * a * raw[2] + 3 * a**2 * raw[1] - a**3 * raw[0])
    bernstein = [m0 - 3 * m1 + 3 * m2 - m3, 3 * (m1 - 2 * m2 + m3), 3 * (m2 - m3), m3]
    return bernstein, per * (energy[j] - energy[i])


def _running_moments(samples: ComplexArray) -> tuple[list[ComplexArray], FloatArray]:
    """Integrals of z, s z, s^2 z, s^3 z and |z|^2 from the first sample on, twice round.

    Exact for the polygon of the samples, or differences for short arcs would not cancel.
    """
    n = len(samples)
    begin = np.concatenate([samples, samples])
    step = np.roll(begin, -1) - begin
    sums = [np.zeros(2 * n + 1, dtype=np.complex128) for _ in range(4)]
    energy = np.zeros(2 * n + 1)
    for share, weight in zip(_GAUSS_AT, _GAUSS_WEIGHTS, strict=True):
        z = begin + share * step
        s = (np.arange(2 * n) + share) / n
        for k in range(4):
            sums[k][1:] += weight / n * s**k * z
        energy[1:] += weight / n * np.abs(z) ** 2
    return [np.cumsum(s) for s in sums], np.cumsum(energy)


def _dot(a: ComplexArray, b: ComplexArray) -> FloatArray:
    return np.asarray(a.real * b.real + a.imag * b.imag)


SITES_PER_CURVE = 6
"""Places offered for each cut: more find better cuts in their square of the time. Tried."""

MOST_SITES = 400
"""Sites of one ring at most: their square is the memory. Chosen."""

SAMPLES_PER_SITE = 12
"""Samples between two sites: fewer blur the outline, more cost little. Chosen."""


def best_chain(ring: FloatArray, curves: int) -> FloatArray:
    """Chain ``(curves, 3, 2)`` of least squared distance to a ring, cut where it is best.

    The distance is taken at equal shares of arc length, so the chain is a start for a
    fit that does not care where on a curve a point lies.

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
    """Sites ``(arcs,)`` at which a ring is cut into arcs of least total cost, ``first`` in front.

    ``cost``: ``(m, m)``: of the arc from site i on to site j.

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
