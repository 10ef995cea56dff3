"""Inner loops of simulated annealing over an assignment."""

from __future__ import annotations

import math

from packwork.compiled import helper, kernel


@helper
def _pulled(item, other, place, at, starts, partners, weights, points):
    """Weighted distances from a place to the partners of an item, but for one of them."""
    total = 0.0
    for k in range(starts[item], starts[item + 1]):
        partner = partners[k]
        if partner != other:
            there = at[partner]
            across = points[place, 0] - points[there, 0]
            down = points[place, 1] - points[there, 1]
            total += weights[k] * math.sqrt(across * across + down * down)
    return total


@helper
def _unlike(item, place, own, there):
    """Squared difference of an item from what its place is like."""
    total = 0.0
    for k in range(own.shape[1]):
        away = own[item, k] - there[place, k]
        total += away * away
    return total


@kernel
def anneal_exchanges(at, starts, partners, weights, points, own, there, pairs, chances, heat):
    """Exchange the places of pairs where that costs less, or by a chance no more than heat allows.

    ``at[item]`` is its place and is changed; returns how much cheaper all is.
    """
    gained = 0.0
    for k in range(len(pairs)):
        first, second = pairs[k, 0], pairs[k, 1]
        if first == second:
            continue
        here, other = at[first], at[second]
        cost = _pulled(first, second, other, at, starts, partners, weights, points)
        cost += _pulled(second, first, here, at, starts, partners, weights, points)
        cost -= _pulled(first, second, here, at, starts, partners, weights, points)
        cost -= _pulled(second, first, other, at, starts, partners, weights, points)
        cost += _unlike(first, other, own, there) + _unlike(second, here, own, there)
        cost -= _unlike(first, here, own, there) + _unlike(second, other, own, there)
        if cost <= 0.0 or chances[k] < math.exp(-cost / heat):
            at[first], at[second] = other, here
            gained -= cost
    return gained


@kernel
def anneal_neighbours(at, ties, near, own, there, pairs, chances, heat):
    """The same where what counts is how near places are, ``(n, n)``, of items tied so strongly."""
    for k in range(len(pairs)):
        first, second = pairs[k, 0], pairs[k, 1]
        if first == second:
            continue
        here, other = at[first], at[second]
        cost = _unlike(first, other, own, there) + _unlike(second, here, own, there)
        cost -= _unlike(first, here, own, there) + _unlike(second, other, own, there)
        for item in range(len(at)):
            if item not in (first, second):
                more = ties[first, item] - ties[second, item]
                cost -= more * (near[other, at[item]] - near[here, at[item]])
        if cost <= 0.0 or chances[k] < math.exp(-cost / heat):
            at[first], at[second] = other, here
