"""Distances from what lies in a container, kept up item by item."""

from __future__ import annotations

import numpy as np

from packwork.fields.distance_transform import distance_to
from packwork.start.first_fit.greedy_board import Bareness


def test_distances_are_those_of_all_items_together() -> None:
    rng = np.random.default_rng(0)
    free = np.ones((60, 90), dtype=bool)
    free[20:30, 40:] = False
    bare, covered = Bareness(free, 0.5), np.zeros_like(free)
    for _ in range(12):
        mask = rng.random((rng.integers(1, 7), rng.integers(1, 7))) < 0.8
        row, column = int(rng.integers(-2, 58)), int(rng.integers(-2, 88))
        bare.cover(mask, row, column)
        for y, x in np.argwhere(mask) + np.array([row, column]):
            if 0 <= y < 60 and 0 <= x < 90:
                covered[y, x] = True
        found = bare.away()
        assert found is not None
        assert (found == np.where(free, distance_to(covered), 0)).all()


def test_neither_an_empty_container_nor_a_full_one_draws_items() -> None:
    free = np.ones((5, 5), dtype=bool)
    bare = Bareness(free, 1.0)
    assert bare.away() is None
    bare.cover(free[:1, :1], 0, 0)
    assert bare.away() is not None
    bare.cover(free, 0, 0)
    assert bare.away() is None
    assert bare.emptied().away() is None
