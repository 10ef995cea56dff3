"""Inner loops of exchanges by colour."""

from __future__ import annotations

import math

import numpy as np

from packwork.compiled import helper, kernel


@helper
def _away(shown, wanted, cones, lab):
    """Distance in Oklab of a light from a colour."""
    first, second, third = 0.0, 0.0, 0.0
    for k in range(3):
        cone = cones[k, 0] * shown[0] + cones[k, 1] * shown[1] + cones[k, 2] * shown[2]
        root = max(cone, 0.0) ** (1.0 / 3.0)
        first += lab[0, k] * root
        second += lab[1, k] * root
        third += lab[2, k] * root
    first, second, third = first - wanted[0], second - wanted[1], third - wanted[2]
    return math.sqrt(first * first + second * second + third * third)


@helper
def _add(place, gone, comer, starts, points, weights, patches, shown):
    """Show one item in a place instead of another."""
    for k in range(starts[place], starts[place + 1]):
        point = points[k]
        for part in range(weights.shape[1]):
            weight = weights[k, part]
            for c in range(3):
                shown[point, c] += weight * (patches[comer, part, c] - patches[gone, part, c])


@kernel
def exchange_by_colour(
    order, starts, points, weights, patches, shown, wanted, away, price, pairs, cones, lab
):
    """Exchange the items of pairs of places where what is seen from afar comes nearer.

    ``order[place]`` is its item, ``away`` the distance at each point; these and ``shown`` are
    changed. Returns how many exchanges were made.
    """
    made = 0
    seen = np.full(len(away), -1)
    for k in range(len(pairs)):
        here, there = pairs[k, 0], pairs[k, 1]
        if here == there:
            continue
        own, other = order[here], order[there]
        before = price[here, own] + price[there, other]
        after = price[here, other] + price[there, own]
        _add(here, own, other, starts, points, weights, patches, shown)
        _add(there, other, own, starts, points, weights, patches, shown)
        for place in (here, there):
            for at in range(starts[place], starts[place + 1]):
                point = points[at]
                if seen[point] != k:
                    seen[point] = k
                    before += away[point]
                    after += _away(shown[point], wanted[point], cones, lab)
        if after < before:
            order[here], order[there] = other, own
            made += 1
            for place in (here, there):
                for at in range(starts[place], starts[place + 1]):
                    point = points[at]
                    away[point] = _away(shown[point], wanted[point], cones, lab)
        else:
            _add(here, other, own, starts, points, weights, patches, shown)
            _add(there, own, other, starts, points, weights, patches, shown)
    return made
