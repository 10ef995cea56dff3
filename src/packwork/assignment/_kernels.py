"""Inner loop of 2-exchange local search over a quadratic assignment."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from packwork.compiled import helper, kernel


class FlowPrices(NamedTuple):
    """Sparse symmetric matrix over rows: partners of row k lie from ``starts[k]`` on."""

    starts: np.ndarray
    partners: np.ndarray
    weights: np.ndarray


class DistancePrices(NamedTuple):
    """Distance of two columns: ``between`` their kinds, and Euclidean of their ``points``.

    An empty ``between`` is 1 of two of one kind, 0 of all else and of kinds below 0.
    """

    kinds: np.ndarray
    between: np.ndarray
    points: np.ndarray


class Blend(NamedTuple):
    """Linear mixtures of columns' features, and the response to them that is wanted.

    Row k adds ``weights[j, part] * features[column, part]`` to the mixture ``mixtures[j]`` for each
    j from ``starts[k]`` on. The response to a mixture is ``after @ (before @ mixture) **
    exponent``.
    """

    starts: np.ndarray
    mixtures: np.ndarray
    weights: np.ndarray
    features: np.ndarray
    wanted: np.ndarray
    before: np.ndarray
    after: np.ndarray
    exponent: float


@helper
def _own_price(row, column, rows, columns, staying):
    """Price of a row in a column."""
    total = 0.0 if row == column else staying
    for k in range(rows.shape[1]):
        away = rows[row, k] - columns[column, k]
        total += away * away
    return total


@helper
def _pair_price(row, other, column, at, flow, distance):
    """Price of a row in a column with all its partners but one."""
    total = 0.0
    for k in range(flow.starts[row], flow.starts[row + 1]):
        partner = flow.partners[k]
        if partner != other:
            there = at[partner]
            square = 0.0
            for axis in range(distance.points.shape[1]):
                off = distance.points[column, axis] - distance.points[there, axis]
                square += off * off
            one, two = distance.kinds[column], distance.kinds[there]
            if len(distance.between) > 0:
                apart = distance.between[one, two]
            else:
                apart = 1.0 if one == two and one >= 0 else 0.0
            total += flow.weights[k] * (apart + math.sqrt(square))
    return total


@helper
def _missed(mixture, wanted, blend, scratch):
    """Price of one mixture: the squared distance where it is linear, else the distance."""
    count = len(mixture)
    for k in range(count):
        total = 0.0
        for c in range(count):
            total += blend.before[k, c] * mixture[c]
        scratch[k] = total if blend.exponent == 1.0 else max(total, 0.0) ** blend.exponent
    square = 0.0
    for k in range(count):
        off = -wanted[k]
        for c in range(count):
            off += blend.after[k, c] * scratch[c]
        square += off * off
    return square if blend.exponent == 1.0 else math.sqrt(square)


@helper
def _replace(row, gone, comer, blend, mixed):
    """Mix one column in place of another in a row."""
    for k in range(blend.starts[row], blend.starts[row + 1]):
        for part in range(blend.weights.shape[1]):
            weight = blend.weights[k, part]
            for c in range(mixed.shape[1]):
                change = blend.features[comer, part, c] - blend.features[gone, part, c]
                mixed[blend.mixtures[k], c] += weight * change


@helper
def _blend_change(first, second, mark, at, blend, mixed, missed, trial, scratch):
    """Change of the price of mixtures by an exchange, which is made in ``mixed``.

    ``missed``: their prices now; ``trial``: those after it, and the exchange that was tried last.
    """
    _replace(first, at[first], at[second], blend, mixed)
    _replace(second, at[second], at[first], blend, mixed)
    total = 0.0
    for row in (first, second):
        for k in range(blend.starts[row], blend.starts[row + 1]):
            j = blend.mixtures[k]
            if trial[j, 1] != mark:
                trial[j, 1] = mark
                trial[j, 0] = _missed(mixed[j], blend.wanted[j], blend, scratch)
                total += trial[j, 0] - missed[j]
    return total


@kernel
def exchange(at, pairs, chances, heat, sizes, staying, rows, columns, flow, distance, blend, mixed):
    """Exchange the columns of pairs of rows where that costs less, or by a chance that heat allows.

    ``at[row]`` is its column; it and ``mixed``, the mixtures, are changed. Returns how many
    exchanges were made, and how much cheaper all is.
    """
    made, gained = 0, 0.0
    scratch = np.empty(mixed.shape[1])
    missed, trial = np.empty(len(mixed)), np.zeros((len(mixed), 2))
    for j in range(len(mixed)):
        missed[j] = _missed(mixed[j], blend.wanted[j], blend, scratch)
    for k in range(len(pairs)):
        first, second = pairs[k, 0], pairs[k, 1]
        here, there = at[first], at[second]
        if first == second:
            continue
        if len(sizes) > 0:
            off = max(abs(sizes[first] - sizes[there]), abs(sizes[second] - sizes[here]))
            if off > 1.0:
                continue
        cost = _own_price(first, there, rows, columns, staying)
        cost += _own_price(second, here, rows, columns, staying)
        cost -= _own_price(first, here, rows, columns, staying)
        cost -= _own_price(second, there, rows, columns, staying)
        if len(flow.weights) > 0:
            cost += _pair_price(first, second, there, at, flow, distance)
            cost += _pair_price(second, first, here, at, flow, distance)
            cost -= _pair_price(first, second, here, at, flow, distance)
            cost -= _pair_price(second, first, there, at, flow, distance)
        if len(mixed) > 0:
            cost += _blend_change(first, second, k + 1.0, at, blend, mixed, missed, trial, scratch)
        if cost < 0.0 or (heat > 0.0 and chances[k] < math.exp(-cost / heat)):
            at[first], at[second] = there, here
            made += 1
            gained -= cost
            if len(mixed) > 0:
                for row in (first, second):
                    for part in range(blend.starts[row], blend.starts[row + 1]):
                        missed[blend.mixtures[part]] = trial[blend.mixtures[part], 0]
        elif len(mixed) > 0:
            _replace(first, there, here, blend, mixed)
            _replace(second, here, there, blend, mixed)
    return made, gained
