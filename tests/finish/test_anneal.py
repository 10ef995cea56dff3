"""Trials of a finish: annealing, and bottlenecks that are relocated."""

from __future__ import annotations

import os
from collections.abc import Iterator

import numpy as np
import pytest
import shapely
from numba.core.runtime import _nrt_python as memory

from packwork.arrays import FloatArray
from packwork.compaction.arrangement import Arrangement
from packwork.compaction.kernels.steps import Objective
from packwork.compaction.objective import FreeSizes
from packwork.finish.anneal import Lengths, anneal
from packwork.finish.bottlenecks import relocate_bottleneck
from packwork.finish.proposals import destination, destinations
from packwork.geometry.outline import Outline
from scenes import box, square

GAP, HAIR = 0.01, 0.001


def free(arrangement: Arrangement, areas: FloatArray) -> FreeSizes:
    """Any turn, half to twice the size."""
    n = arrangement.count
    turns = np.full(n, -np.inf), np.full(n, np.inf)
    return FreeSizes(areas, turns, np.full(n, -np.log(2)), np.full(n, np.log(2)))


def is_clean(arrangement: Arrangement) -> bool:
    return len(arrangement.conflicts(arrangement.pairs(GAP), GAP)) == 0


def test_places_of_many_trials_are_those_of_each() -> None:
    rng = np.random.default_rng(0)
    arrangement = Arrangement([square()] * 4, box(0, 0, 60, 60), rng.uniform(0.0, 1.0, (4, 4)))
    moved = np.array([[2, -1], [1, 3]])
    one, two = destinations(arrangement, moved)
    assert np.array_equal(one[:1], destination(arrangement, moved[0, :1]))
    assert np.array_equal(two, destination(arrangement, moved[1]))


def test_items_that_no_trial_reaches_grow_all_the_same() -> None:
    x = np.arange(3.0, 120.0, 6.0)
    zero = np.zeros_like(x)
    arrangement = Arrangement(
        [square()] * len(x), box(0, 0, 123, 6), np.column_stack([x, zero + 3, zero, zero])
    )
    sizing = free(arrangement, zero + 4.0)
    lengths = Lengths(6.0, GAP, HAIR)

    def objective_at(places: FloatArray) -> Objective:
        return sizing.objective(places[:, 3], 0.1)

    anneal(arrangement, objective_at, 3, lengths, np.random.default_rng(0))
    assert is_clean(arrangement)
    assert arrangement.places[:, 3].min() > 0.05


@pytest.fixture
def counted() -> Iterator[None]:
    """Numba counts arrays that are made and that are let go."""
    memory.memsys_enable_stats()
    yield
    memory.memsys_disable_stats()


@pytest.mark.usefixtures("counted")
@pytest.mark.skipif(bool(os.environ.get("NUMBA_DISABLE_JIT")), reason="nothing is compiled")
def test_trials_let_go_of_all_arrays_that_they_make() -> None:
    rng = np.random.default_rng(1)
    places = np.column_stack([4.0 * np.arange(1, 6), np.full(5, 5.0), np.zeros(5), np.zeros(5)])
    arrangement = Arrangement(
        [square(), box(-1.5, -0.2, 1.5, 0.2)] * 2 + [square()], box(0, 0, 25, 10), places
    )
    sizing = free(arrangement, np.full(5, 4.0))

    def objective_at(places: FloatArray) -> Objective:
        return sizing.objective(places[:, 3], 0.1)

    def held_after(trials: int) -> int:
        anneal(arrangement, objective_at, trials, Lengths(6.0, GAP, HAIR), rng)
        return int(memory.memsys_get_stats_mi_alloc() - memory.memsys_get_stats_mi_free())

    held_after(1)
    before, made = held_after(1), memory.memsys_get_stats_mi_alloc()
    assert held_after(40) == before
    assert memory.memsys_get_stats_mi_alloc() > made + 400


def test_a_bottleneck_is_relocated_to_where_it_grows_most() -> None:
    """The pocket has the larger disc, but a bar has more room in the corridor."""
    bar = box(-4.0, -0.5, 4.0, 0.5)
    walls = Outline.from_region(shapely.union(box(0, 0, 4, 4).region, box(3.9, 0, 30, 2).region))
    arrangement = Arrangement([bar], walls, np.array([[2.0, 2.0, 0.0, -0.8]]))
    free, still = np.full(1, 9.0), np.zeros(1)
    objective = Objective(-free, free, still, still, np.full(1, 8.0), 2.0, np.zeros((1, 2)))
    lengths = Lengths(10.0, GAP, GAP)
    assert relocate_bottleneck(arrangement, 0, objective, lengths, np.random.default_rng(0))
    assert is_clean(arrangement)
    assert arrangement.places[0, 0] > 4
    assert arrangement.places[0, 3] > np.log(0.5)
