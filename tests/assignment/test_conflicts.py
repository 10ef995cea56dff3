"""Labels handed round: as many of each, fewer side by side, and nobody moved who may not."""

from __future__ import annotations

import tracemalloc

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from packwork.assignment.orders import min_conflicts_order
from packwork.scene.neighbours import neighbour_pairs
from strategies import generators


def conflicts(labels: np.ndarray, pairs: np.ndarray) -> int:
    return int(np.count_nonzero(labels[pairs[:, 0]] == labels[pairs[:, 1]]))


@given(rng=generators(), count=st.integers(2, 60), kinds=st.integers(1, 6))
def test_the_order_is_a_permutation_that_never_does_harm(
    rng: np.random.Generator, count: int, kinds: int
) -> None:
    labels, groups = rng.integers(kinds, size=count), rng.integers(-1, 3, size=count)
    pairs = neighbour_pairs(*rng.uniform(size=(2, count)))
    order = min_conflicts_order(labels, pairs, groups, rng)
    assert sorted(order) == list(range(count))
    assert conflicts(labels[order], pairs) <= conflicts(labels, pairs)
    np.testing.assert_array_equal(groups[order], groups)
    assert (order[groups < 0] == np.flatnonzero(groups < 0)).all()


@given(rng=generators())
def test_labels_stay_with_places_of_their_size(rng: np.random.Generator) -> None:
    labels, sizes = rng.integers(3, size=50), rng.uniform(0, 5, size=50)
    pairs = neighbour_pairs(*rng.uniform(size=(2, 50)))
    order = min_conflicts_order(labels, pairs, np.zeros(50, dtype=np.int64), rng, sizes)
    assert np.abs(sizes[order] - sizes).max() <= 1


def test_with_five_labels_next_to_none_are_side_by_side(rng: np.random.Generator) -> None:
    labels = np.sort(np.arange(200) % 5)
    pairs = neighbour_pairs(*rng.uniform(size=(2, 200)))
    after = labels[min_conflicts_order(labels, pairs, np.zeros(200, dtype=np.int64), rng)]
    assert conflicts(labels, pairs) > 80
    assert conflicts(after, pairs) <= 3


def test_one_label_alone_is_left_as_it_is(rng: np.random.Generator) -> None:
    pairs = np.array([[0, 1], [1, 2]])
    same = np.zeros(3, dtype=np.int64)
    assert min_conflicts_order(same, pairs, same, rng).tolist() == [0, 1, 2]
    assert min_conflicts_order(same, pairs[:0], same, rng).tolist() == [0, 1, 2]


def test_memory_grows_with_places_and_not_with_pairs_of_labels(rng: np.random.Generator) -> None:
    count = 6_000
    labels = np.repeat(np.arange(count // 2), 2)
    pairs = np.column_stack([np.arange(count - 1), np.arange(1, count)])
    tracemalloc.start()
    order = min_conflicts_order(labels, pairs, np.zeros(count, dtype=np.int64), rng)
    _, most = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert conflicts(labels[order], pairs) < conflicts(labels, pairs)
    assert most < 8 * (count // 2) ** 2
