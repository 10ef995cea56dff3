"""Items assigned to places by what they are like: clusters, walks, what is held."""

from __future__ import annotations

import numpy as np

from packwork.arrays import FloatArray, IntArray
from packwork.assignment.embedding import assigned
from packwork.assignment.graph import NeighbourGraph, clusters, likeness


def _planted(count: int) -> tuple[IntArray, FloatArray]:
    """Kinds, and vectors about the middle of each."""
    rng = np.random.default_rng(0)
    kinds = np.arange(count) % 4
    return kinds, rng.standard_normal((4, 12))[kinds] + 0.2 * rng.standard_normal((count, 12))


def test_clusters_come_to_lie_together() -> None:
    kinds, vectors = _planted(64)
    points = np.stack(np.meshgrid(np.arange(8.0), np.arange(8.0)), axis=-1).reshape(-1, 2)
    at = assigned(vectors, points, np.random.default_rng(1))
    placed = np.empty(64, dtype=int)
    placed[at] = kinds
    grid = placed.reshape(8, 8)
    alike = np.concatenate([(grid[1:] == grid[:-1]).ravel(), (grid[:, 1:] == grid[:, :-1]).ravel()])
    # Four squares of sixteen are parted by sixteen of the 112 edges.
    assert alike.mean() > 0.8


def test_what_is_held_stays_and_sizes_are_heeded() -> None:
    _, vectors = _planted(40)
    rng = np.random.default_rng(2)
    points = rng.random((40, 2))
    free = np.arange(40) >= 10
    large = rng.permutation(40) % 2
    sizes = 50.0 * large[:, None]
    at = assigned(vectors, points, rng, own=sizes, there=sizes, free=free)
    assert at[:10].tolist() == list(range(10))
    assert (large[at] == large).all()


def test_what_is_small_comes_together_where_likeness_asks_for_it() -> None:
    kinds = np.arange(64) % 2
    points = np.stack(np.meshgrid(np.arange(8.0), np.arange(8.0)), axis=-1).reshape(-1, 2)
    sizes = 1.5 * kinds[:, None]
    at = assigned(np.eye(2)[kinds], points, np.random.default_rng(0), own=sizes, there=sizes)
    placed = np.empty(64, dtype=int)
    placed[at] = kinds
    grid = placed.reshape(8, 8)
    assert (grid[1:] == grid[:-1]).mean() > 0.8
    assert (grid[:, 1:] == grid[:, :-1]).mean() > 0.8


def test_the_graph_is_symmetric_and_leaves_out_none() -> None:
    rng = np.random.default_rng(0)
    graph = NeighbourGraph.of(rng.standard_normal((30, 5)), rng, 4)
    dense = np.zeros((30, 30))
    for item in range(30):
        own = slice(graph.starts[item], graph.starts[item + 1])
        dense[item, graph.partners[own]] = graph.weights[own]
    assert np.allclose(dense, dense.T)
    assert (dense.sum(axis=1) > 0.4).all()
    assert (np.diag(dense) == 0).all()


def test_copies_are_tied_to_what_their_thing_is_like() -> None:
    """Two things alike, one unlike them, thirty copies of each."""
    vectors = np.repeat([[1.0, 0.0], [1.0, 0.1], [0.0, 1.0]], 30, axis=0)
    graph = NeighbourGraph.of(vectors, np.random.default_rng(0))
    things = np.arange(90) // 30
    rows = np.repeat(np.arange(90), np.diff(graph.starts))
    pulls = np.zeros((3, 3))
    np.add.at(pulls, (things[rows], things[graph.partners]), graph.weights)
    assert pulls[0, 1] > 0.5 * pulls[0, 0]
    assert pulls[0, 2] < 0.3 * pulls[0, 1]


def test_one_item_and_no_neighbours() -> None:
    assert assigned(np.ones((1, 2)), np.zeros((1, 2)), np.random.default_rng(0)).tolist() == [0]
    assert len(NeighbourGraph.of(np.ones((1, 2)), np.random.default_rng(0)).partners) == 0


def test_planted_clusters_are_found() -> None:
    kinds, vectors = _planted(80)
    found = clusters(vectors, 4, np.random.default_rng(5))
    assert len({(int(a), int(b)) for a, b in zip(kinds, found, strict=True)}) == 4
    assert clusters(np.ones((3, 2)), 2, np.random.default_rng(0)).tolist() == [0, 0, 0]


def test_walks_tell_clusters_without_their_number() -> None:
    kinds, vectors = _planted(80)
    like = likeness(NeighbourGraph.of(vectors, np.random.default_rng(0)))
    same = kinds[:, None] == kinds
    assert like[same].mean() > 0.8
    assert like[~same].max() < 0.1


def test_walks_along_a_ring_fade_with_the_way() -> None:
    angles = np.linspace(0, 2 * np.pi, 100, endpoint=False)
    ring = np.column_stack([np.cos(angles), np.sin(angles)])
    like = likeness(NeighbourGraph.of(ring, np.random.default_rng(0)))
    assert like[0, 1] > like[0, 5] > like[0, 10]
    assert like[0, 50] == 0.0
    assert not likeness(NeighbourGraph.of(np.eye(3), np.random.default_rng(0))).any()


def test_neighbours_are_sharpened_and_what_is_held_stays() -> None:
    _, vectors = _planted(80)
    points = np.random.default_rng(1).random((80, 2))
    ties = likeness(NeighbourGraph.of(vectors, np.random.default_rng(0)))
    squares = ((points[:, None] - points) ** 2).sum(axis=2) * 80
    free = np.arange(80) > 5
    unsharp, sharp = (
        assigned(vectors, points, np.random.default_rng(2), free=free, ties=some)
        for some in (None, ties)
    )
    near = np.exp(-squares / 2)
    assert (ties * near[sharp][:, sharp]).sum() > (ties * near[unsharp][:, unsharp]).sum()
    assert sorted(sharp.tolist()) == list(range(80))
    assert sharp[:6].tolist() == list(range(6))
