"""Items assigned to places so that those pulled towards each other come to lie side by side.

A quadratic assignment whose flow is a graph of nearest neighbours, begun with a split of items and
places into halves along their longest axes. Places repel nothing: that two items cannot have one
takes the part of the repulsion in t-SNE and UMAP.
"""

from __future__ import annotations

import numpy as np

from packwork.arrays import BoolArray, FloatArray, IntArray
from packwork.assignment._kernels import FlowPrices
from packwork.assignment.graph import NeighbourGraph, unit_rows
from packwork.assignment.quadratic import (
    Assignment,
    improved,
    kind_distance,
    neighbour_flow,
    point_distance,
)

STEPS, EXCHANGES = 80, 60
"""Temperatures, and exchanges tried at each for every item. More find a little more. Tried."""

HOT, COLD = 1.0, 0.02
"""First and last temperature, in spacings of the places. A hotter start forgets the first
order, a colder one keeps its mistakes. Tried."""

DRAWN = 0.5
"""Pull of an anchor, over that of all neighbours together. Larger parts clusters, smaller is not
heard. Tried."""

IN_COMMON = 3.0
"""A difference between items is paid for less if what neighbours have in common deviates by more
than one over this, in spacings. Smaller keeps stars among hearts that are twice as large, larger
covers less. Tried."""

IMAGES = np.array([[x, y] for x in (1, -1, 2, -2) for y in (1, -1, 2, -2) if abs(x * y) < 4])
"""Of the places, along x and y: mirrored, and halved first along either."""

SHARPENING, WARM, SHARPER_STEPS, SHARPER_TRIES = 0.6, 0.5, 40, 60
"""Weight of neighbours that are alike, over that of distances; the first temperature, their number
and exchanges tried for each item where neighbours alone count. More of the first heeds sizes less.
Tried."""

REACH = 3.0
"""Spacings within which places are near each other: beyond, a hundredth of it is left. Derived."""

MOST_AXES = 64
"""Numbers of a vector that are looked at for its longest axes; of more, so many sums of them by
chance. Chosen."""


def assigned(
    vectors: FloatArray,
    points: FloatArray,
    rng: np.random.Generator,
    *,
    own: FloatArray | None = None,
    there: FloatArray | None = None,
    drawn: FloatArray | None = None,
    along: FloatArray | None = None,
    free: BoolArray | None = None,
    ties: FloatArray | None = None,
) -> IntArray:
    """Place of each item: those with like vectors lie near each other.

    ``vectors``: ``(n, d)`` of the items; only their directions count.
    ``points``: ``(n, 2)`` the places, in any unit. Item k stands at place k first.
    ``own``, ``there``: ``(n, s)`` what items and places are like: the squared difference is paid
    for, in spacings of the places; less if it is what like items have in common.
    ``drawn``, ``along``: ``(n, a)`` how much items are drawn along each of some ways, 0..1, and how
    far along it places lie, in the unit of the points: an item that is drawn by 1 would rather lie
    a spacing farther along than half a spacing nearer to all that pull it.
    ``free``: ``(n,)`` which items may leave their places; None for all.
    ``ties``: ``(n, n)`` how alike items are: with it neighbours count alone in the end, as short
    ties leave the borders of clusters ragged.

    Returns ``(n,)`` a permutation: item k goes to place ``found[k]``.

    Examples
    --------
    >>> row = np.column_stack([np.arange(6.0), np.zeros(6)])
    >>> kinds = np.eye(2)[[0, 1, 0, 1, 0, 1]]
    >>> found = assigned(kinds, row, np.random.default_rng(0))
    >>> sorted(found[::2].tolist()) in ([0, 1, 2], [3, 4, 5])
    True
    """
    count = len(points)
    at = np.arange(count)
    movable = at if free is None else np.flatnonzero(free)
    if len(movable) < 2:
        return at
    spacing = _spacing(points)
    scaled = points / spacing
    own = np.zeros((count, 0)) if own is None else own
    there = np.zeros((count, 0)) if there is None else there
    drawn = np.zeros((count, 0)) if drawn is None else drawn
    along = np.zeros((count, 0)) if along is None else along / spacing
    axes = _axes(vectors[movable], rng)
    at[movable] = movable[_begun(axes, scaled[movable], drawn[movable], along[movable])]
    graph = NeighbourGraph.of(vectors, rng)
    own, there = _eased(graph, own, there)
    # Of a squared difference nothing but the product depends on who is where.
    even = np.sqrt(DRAWN / 2)
    own, there = np.hstack([own, even * drawn]), np.hstack([there, even * along])
    groups = np.full(count, -1)
    groups[movable] = 0
    problem = Assignment(
        groups,
        rows=own,
        columns=there,
        flow=FlowPrices(graph.starts, graph.partners, graph.weights),
        distance=point_distance(scaled),
    )
    at = improved(problem, rng, np.geomspace(HOT, COLD, STEPS), EXCHANGES, at)
    if ties is None:
        return at
    return _sharpened(at, SHARPENING * ties, scaled, own, there, groups, rng)


def _eased(
    graph: NeighbourGraph, own: FloatArray, there: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """The same, cheaper where like items differ from others: else they could not come together."""
    spread = IN_COMMON * graph.means(own).std(axis=0)
    return own / np.maximum(spread, 1.0), there / np.maximum(spread, 1.0)


def _sharpened(
    at: IntArray,
    ties: FloatArray,
    points: FloatArray,
    own: FloatArray,
    there: FloatArray,
    groups: IntArray,
    rng: np.random.Generator,
) -> IntArray:
    """Place of each item, annealed again by who lies about a spacing from whom."""
    # A tree of points is needed for likeness alone.
    from scipy.spatial import cKDTree

    pairs = cKDTree(points).query_pairs(REACH, output_type="ndarray")
    squares = ((points[pairs[:, 0]] - points[pairs[:, 1]]) ** 2).sum(axis=1)
    # Places are the rows here: of these few are near each other, of items any may be alike.
    problem = Assignment(
        groups,
        rows=there,
        columns=own,
        flow=neighbour_flow(len(at), pairs.astype(np.int64), np.exp(-squares / 2)),
        distance=kind_distance(np.arange(len(at)), -ties),
    )
    heats = np.geomspace(WARM, COLD, SHARPER_STEPS)
    return np.argsort(improved(problem, rng, heats, SHARPER_TRIES, np.argsort(at)))


def _spacing(points: FloatArray) -> float:
    """Side of a square for each point of their box."""
    wide, high = np.ptp(points, axis=0)
    return max(float(np.sqrt(max(wide * high, 1e-12) / len(points))), float(max(wide, high)) * 1e-6)


def _begun(axes: FloatArray, points: FloatArray, drawn: FloatArray, along: FloatArray) -> IntArray:
    """Point of each vector to begin with: of several images that which is best along the ways."""
    if drawn.shape[1] == 0:
        return _halved(axes, points)
    found = [_halved(axes, points * image) for image in IMAGES]
    return max(found, key=lambda at: float((drawn * along[at]).sum()))


def _axes(vectors: FloatArray, rng: np.random.Generator) -> FloatArray:
    """``(n, m)`` coordinates of directions about their mean, few enough to be looked at."""
    units = unit_rows(vectors)
    units = units - units.mean(axis=0)
    if units.shape[1] <= MOST_AXES:
        return np.asarray(units)
    chance = rng.standard_normal((units.shape[1], MOST_AXES)) / np.sqrt(MOST_AXES)
    return np.asarray(units @ chance)


def _halved(vectors: FloatArray, points: FloatArray) -> IntArray:
    """Point of each vector: both are halved along their longest axes, again and again."""
    found = np.empty(len(points), dtype=np.int64)
    parts = [(np.arange(len(points)), np.arange(len(points)))]
    while parts:
        items, places = parts.pop()
        if len(items) == 1:
            found[items] = places
            continue
        half = len(items) // 2
        items = items[np.argsort(_along(vectors[items]), kind="stable")]
        places = places[np.argsort(_along(points[places]), kind="stable")]
        parts += [(items[:half], places[:half]), (items[half:], places[half:])]
    return found


def _along(vectors: FloatArray) -> FloatArray:
    """Coordinates along the first principal axis, whose largest part is positive."""
    about = vectors - vectors.mean(axis=0)
    axis = np.linalg.eigh(about.T @ about)[1][:, -1]
    return np.asarray(about @ (axis * np.sign(axis[np.argmax(np.abs(axis))])))
