"""Primal-dual interior-point method for linear programmes whose rows touch one item or two.

S. Mehrotra, "On the implementation of a primal-dual interior point method", SIAM Journal on
Optimization 2 (1992), 575-601, doi:10.1137/0802028: a predictor step sets the centring of the
corrector.

Maximise ``gain . z`` with ``coefficients . z <= limits`` and ``low <= z <= high``; four
unknowns an item. A row's second item of -1 is none: a wall, or an item that stands still.
The Newton matrix is kept by its envelope: row ``r`` of ``band`` holds the columns
``r - width`` to ``r``, of which those from ``begins[r // 4]`` on may differ from zero.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from packwork.compiled import helper, kernel, leaf

MOST_STEPS = 30
"""Newton steps at most; 7 to 15 are usual. Tried."""

STEP_BACK = 0.99
"""Share of the way to the nearest bound that one step may go. Usual."""

FIRST_BARRIER, FIRST_SLACK = 0.1, 0.2
"""First products of slack and dual, and smallest first slack, trust regions: with slacks as small
as those of items that touch, the first steps lead nowhere. Tried."""

LEAST_WIDTH = 1e-6
"""Least distance of two bounds: an unknown that is held is held by this. Chosen."""

ROUNDING = 1e-9
"""What counts as nothing beside one. Chosen."""

FEASIBLE = 1e-4
"""Trust regions by which rows may be off at the end; the caller checks. Chosen."""


class Rows(NamedTuple):
    """Conditions ``coefficients . z <= limits``.

    ``first``, ``second``: ``(m,)`` items that a row touches, -1 for none;
    ``coefficients``: ``(m, 8)``, four for the first, four for the second; ``limits``:
    ``(m,)``, none negative, so that standing still is allowed.
    """

    first: np.ndarray
    second: np.ndarray
    coefficients: np.ndarray
    limits: np.ndarray


class Iterate(NamedTuple):
    """Unknowns, slacks of the rows and their dual variables, slacks of the bounds and their duals.

    ``bound_slack``, ``bound_dual``: ``(n, 2)``, to the lower bound and to the upper one.
    """

    z: np.ndarray
    slack: np.ndarray
    dual: np.ndarray
    bound_slack: np.ndarray
    bound_dual: np.ndarray


@leaf(fastmath={"reassoc", "contract"})
def _dot(a, i, b, j, count):
    total = 0.0
    for k in range(count):
        total += a[i + k] * b[j + k]
    return total


@helper
def envelope(first, second, count):
    """First item that each item shares a row with, in its own order; and the band's width."""
    begins = np.empty(count, np.int64)
    for i in range(count):
        begins[i] = i
    for k in range(first.shape[0]):
        i, j = first[k], second[k]
        if j >= 0:
            begins[max(i, j)] = min(begins[max(i, j)], min(i, j))
    width = 3
    for i in range(count):
        width = max(width, 4 * (i - begins[i]) + 3)
    return begins, width


@leaf
def _normal(rows, weights, diagonal, width, band):
    """Write the weighted sum of the rows' squares plus a diagonal."""
    for r in range(diagonal.shape[0]):
        for c in range(width):
            band[r, c] = 0.0
        band[r, width] = diagonal[r]
    for k in range(rows.first.shape[0]):
        i, j, row = rows.first[k], rows.second[k], rows.coefficients[k]
        for c in range(4):
            left = weights[k] * row[c]
            for d in range(c + 1):
                band[4 * i + c, width + d - c] += left * row[d]
        if j < 0:
            continue
        low, high = (i, j) if i < j else (j, i)
        before, behind = (0, 4) if i < j else (4, 0)
        for c in range(4):
            left = weights[k] * row[4 + c]
            for d in range(c + 1):
                band[4 * j + c, width + d - c] += left * row[4 + d]
            left = weights[k] * row[behind + c]
            for d in range(4):
                band[4 * high + c, width + 4 * (low - high) + d - c] += left * row[before + d]


@leaf
def factorise(band, begins, width):
    """Cholesky factor in place; False if the matrix is not positive definite."""
    for r in range(band.shape[0]):
        begin = 4 * begins[r // 4]
        for c in range(begin, r + 1):
            since = max(begin, 4 * begins[c // 4])
            total = band[r, width + c - r] - _dot(
                band[r], width + since - r, band[c], width + since - c, c - since
            )
            if c < r:
                band[r, width + c - r] = total / band[c, width]
            elif total > 0.0:
                band[r, width] = math.sqrt(total)
            else:
                return False
    return True


@leaf
def substitute(band, begins, width, right):
    """Solve in place, given the factor."""
    for r in range(band.shape[0]):
        begin = 4 * begins[r // 4]
        total = right[r] - _dot(band[r], width + begin - r, right, begin, r - begin)
        right[r] = total / band[r, width]
    for r in range(band.shape[0] - 1, -1, -1):
        right[r] /= band[r, width]
        for c in range(4 * begins[r // 4], r):
            right[c] -= band[r, width + c - r] * right[r]


@leaf
def _row(rows, z, k):
    i, j = 4 * rows.first[k], 4 * rows.second[k]
    total = 0.0
    for c in range(4):
        total += rows.coefficients[k, c] * z[i + c]
    if j >= 0:
        for c in range(4):
            total += rows.coefficients[k, 4 + c] * z[j + c]
    return total


@leaf
def _add_row(rows, k, weight, out):
    i, j = 4 * rows.first[k], 4 * rows.second[k]
    for c in range(4):
        out[i + c] += rows.coefficients[k, c] * weight
    if j >= 0:
        for c in range(4):
            out[j + c] += rows.coefficients[k, 4 + c] * weight


@helper
def _direction(rows, now, step, band, begins, width, off_rows, off_cost, centring):
    """Newton direction towards ``centring``, less the second-order terms of the last one."""
    n, m = step.z.shape[0], now.slack.shape[0]
    rest_rows, rest = np.empty(m), np.empty((n, 2))
    right = np.empty(n)
    for r in range(n):
        right[r] = -off_cost[r]
    for k in range(m):
        rest_rows[k] = centring - now.slack[k] * now.dual[k] - step.slack[k] * step.dual[k]
        weight = -(rest_rows[k] + now.dual[k] * off_rows[k]) / now.slack[k]
        _add_row(rows, k, weight, right)
    for r in range(n):
        for s in range(2):
            bent = step.bound_slack[r, s] * step.bound_dual[r, s]
            rest[r, s] = centring - now.bound_slack[r, s] * now.bound_dual[r, s] - bent
        right[r] += rest[r, 0] / now.bound_slack[r, 0] - rest[r, 1] / now.bound_slack[r, 1]
    substitute(band, begins, width, right)
    for r in range(n):
        step.z[r] = step.bound_slack[r, 0] = right[r]
        step.bound_slack[r, 1] = -right[r]
        for s in range(2):
            step.bound_dual[r, s] = (
                rest[r, s] - now.bound_dual[r, s] * step.bound_slack[r, s]
            ) / now.bound_slack[r, s]
    for k in range(m):
        step.slack[k] = -off_rows[k] - _row(rows, step.z, k)
        step.dual[k] = (rest_rows[k] - now.dual[k] * step.slack[k]) / now.slack[k]


@leaf
def _length(value, change, most):
    """Step length that keeps a number above zero along its change, ``most`` at most."""
    return min(most, -value / change) if change < 0.0 else most


@leaf
def _lengths(now, step):
    """Step lengths of unknowns and of duals along a direction."""
    primal_length = dual_length = 1.0 / STEP_BACK
    for k in range(now.slack.shape[0]):
        primal_length = _length(now.slack[k], step.slack[k], primal_length)
        dual_length = _length(now.dual[k], step.dual[k], dual_length)
    for r in range(now.z.shape[0]):
        for s in range(2):
            primal_length = _length(now.bound_slack[r, s], step.bound_slack[r, s], primal_length)
            dual_length = _length(now.bound_dual[r, s], step.bound_dual[r, s], dual_length)
    return STEP_BACK * primal_length, STEP_BACK * dual_length


@leaf
def _advance(now, step, primal_length, dual_length):
    for k in range(now.slack.shape[0]):
        now.slack[k] += primal_length * step.slack[k]
        now.dual[k] += dual_length * step.dual[k]
    for r in range(now.z.shape[0]):
        now.z[r] += primal_length * step.z[r]
        for s in range(2):
            now.bound_slack[r, s] += primal_length * step.bound_slack[r, s]
            now.bound_dual[r, s] += dual_length * step.bound_dual[r, s]


@leaf
def _barrier(now, step, primal_length, dual_length):
    """Mean product of slacks and duals (complementarity) after a step."""
    total = 0.0
    for k in range(now.slack.shape[0]):
        slack = now.slack[k] + primal_length * step.slack[k]
        total += slack * (now.dual[k] + dual_length * step.dual[k])
    for r in range(now.z.shape[0]):
        for s in range(2):
            bound_slack = now.bound_slack[r, s] + primal_length * step.bound_slack[r, s]
            total += bound_slack * (now.bound_dual[r, s] + dual_length * step.bound_dual[r, s])
    return total / (now.slack.shape[0] + 2 * now.z.shape[0])


@helper
def _iterate(m, n):
    return Iterate(np.zeros(n), np.zeros(m), np.zeros(m), np.zeros((n, 2)), np.zeros((n, 2)))


@leaf
def _begin(rows, low, high, now):
    """First iterate: standing still, as far as the bounds leave room on both sides."""
    for r in range(now.z.shape[0]):
        width = max(high[r] - low[r], 2 * LEAST_WIDTH)
        now.z[r] = min(max(0.0, low[r] + 0.1 * width), low[r] + 0.9 * width)
        now.bound_slack[r, 0], now.bound_slack[r, 1] = now.z[r] - low[r], low[r] + width - now.z[r]
        for s in range(2):
            now.bound_dual[r, s] = FIRST_BARRIER / now.bound_slack[r, s]
    for k in range(now.slack.shape[0]):
        now.slack[k] = max(rows.limits[k] - _row(rows, now.z, k), FIRST_SLACK)
        now.dual[k] = FIRST_BARRIER / now.slack[k]


@leaf
def _clear(step):
    for k in range(step.slack.shape[0]):
        step.slack[k] = 0.0
    for r in range(step.z.shape[0]):
        step.bound_slack[r, 0] = step.bound_slack[r, 1] = 0.0


@kernel
def maximise(rows, gain, low, high, accuracy):
    """Nearly the best unknowns; all vectors have four numbers an item."""
    m, n = rows.first.shape[0], gain.shape[0]
    begins, width = envelope(rows.first, rows.second, n // 4)
    now, step = _iterate(m, n), _iterate(m, n)
    weights, diagonal, off_rows, off_cost = np.empty(m), np.empty(n), np.empty(m), np.empty(n)
    band = np.empty((n, width + 1))
    scale, nothing = 1e-300, 0.0
    for r in range(n):
        scale = max(scale, abs(gain[r]))
    _begin(rows, low, high, now)
    for _ in range(MOST_STEPS):
        worst, value, heaviest = 0.0, 0.0, 0.0
        for r in range(n):
            value += gain[r] / scale * now.z[r]
            off_cost[r] = -gain[r] / scale + now.bound_dual[r, 1] - now.bound_dual[r, 0]
        for k in range(m):
            off_rows[k] = _row(rows, now.z, k) + now.slack[k] - rows.limits[k]
            worst = max(worst, abs(off_rows[k]))
            weights[k] = now.dual[k] / now.slack[k]
            heaviest = max(heaviest, weights[k])
            _add_row(rows, k, now.dual[k], off_cost)
        _clear(step)
        barrier = _barrier(now, step, nothing, nothing)
        if barrier * (m + 2 * n) < accuracy * (abs(value) + ROUNDING) and worst < FEASIBLE:
            break
        for r in range(n):
            diagonal[r] = (
                now.bound_dual[r, 0] / now.bound_slack[r, 0]
                + now.bound_dual[r, 1] / now.bound_slack[r, 1]
            )
            # A hair on the diagonal: far below what matters, far above rounding.
            diagonal[r] += ROUNDING * (1.0 + heaviest)
        _normal(rows, weights, diagonal, width, band)
        if not factorise(band, begins, width):
            break
        _direction(rows, now, step, band, begins, width, off_rows, off_cost, nothing)
        primal_length, dual_length = _lengths(now, step)
        centring = (_barrier(now, step, primal_length, dual_length) / barrier) ** 3 * barrier
        _direction(rows, now, step, band, begins, width, off_rows, off_cost, centring)
        primal_length, dual_length = _lengths(now, step)
        _advance(now, step, primal_length, dual_length)
    return now.z
