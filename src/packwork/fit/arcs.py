"""The best cubic for every arc of a closed curve at once, by prefix sums.

With the parameter proportional to arc length and the ends held, the two handles are a
linear least-squares problem. Its right-hand sides are the arc's moments, and those are
differences of running sums: every arc costs the same few operations, however long it is.
Points are complex numbers here, so that both coordinates are solved together.
"""

from __future__ import annotations

from typing import NamedTuple, TypeAlias

import numpy as np
import numpy.typing as npt

from packwork.arrays import FloatArray

ComplexArray: TypeAlias = npt.NDArray[np.complex128]

_GRAM = np.array([[20, 10, 4, 1], [10, 12, 9, 4], [4, 9, 12, 10], [1, 4, 10, 20]]) / 140
"""Integrals of products of two Bernstein polynomials of degree three over 0..1."""

_HANDLES = np.linalg.inv(_GRAM[1:3, 1:3])

_GAUSS_AT = 0.5 + np.sqrt(0.15) * np.array([-1, 0, 1])
_GAUSS_WEIGHTS = np.array([5, 8, 5]) / 18
"""Gauss-Legendre rule on 0..1, exact to degree five."""


class ArcFits(NamedTuple):
    """Cubics of all arcs from site i on to site j, each an array ``(m, m)``.

    Parameters
    ----------
    cost
        Integral of the squared distance to the arc, over the ring's length, which is
        counted as one. On the diagonal: the whole ring.
    first, second
        The handles, as complex numbers.
    """

    cost: FloatArray
    first: ComplexArray
    second: ComplexArray


def resampled(ring: FloatArray, count: int) -> ComplexArray:
    """``count`` points at equal steps of arc length along a closed ring.

    Examples
    --------
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

    Parameters
    ----------
    samples
        ``(n,)`` points at equal steps along a closed curve.
    stride
        Every how manieth sample is a site; divides n.

    Examples
    --------
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

    Exact for the polygon of the samples: anything less would not cancel in ``arc_fits``,
    where short arcs leave small differences of these.
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
