"""Orders of items in the places of a layout, each the price of one quadratic assignment.

Few neighbours with one label (a colouring of fixed counts), parts of a container that fill alike,
and a picture seen from afar: each item is a patch of a few by a few colours, which blend as light;
pairs exchange their places as long as what is then seen comes nearer to what is wanted, in Oklab.
An assignment by the colour of each alone comes first: neighbours that make up for each other are
seen by exchanges only.
"""

from __future__ import annotations

import numpy as np
import shapely

from packwork.arrays import FloatArray, IntArray
from packwork.assignment._kernels import Blend
from packwork.assignment.quadratic import Assignment, improved, neighbour_flow, same_kind
from packwork.geometry.outline import Outline
from packwork.scene.contrast import CONES_OF_LIGHT, LAB_OF_CONES, oklabs_of_light

CONFLICT_HEATS = (*np.geomspace(0.1, 0.04, 10).tolist(), 0.0)
"""Temperatures, in conflicts. Hotter moves labels for nothing, colder leaves conflicts. Tried."""

CONFLICT_TRIES = 100
"""Exchanges tried at each for every place. More find little more. Tried."""

CONFLICT_STAYING = 0.45
"""Price of a label that leaves its place, in conflicts. From a half on an exchange that takes away
one conflict is not made; smaller moves labels for nothing. Derived and tried."""


def min_conflicts_order(
    labels: IntArray,
    pairs: IntArray,
    groups: IntArray,
    rng: np.random.Generator,
    sizes: FloatArray | None = None,
) -> IntArray:
    """Order in which the labels stand so that few neighbours have the same.

    How many of each there are stays. Not the fewest conflicts that there could be: that is a hard
    problem, and with four labels or more next to none are left.

    ``labels``: ``(n,)`` one per place, at least 0.
    ``pairs``: ``(m, 2)`` places that are neighbours, each pair once.
    ``groups``, ``sizes``: of places and of the labels that stand there first, as those of an
    ``Assignment``.

    Returns ``(n,)``: place p gets ``labels[order[p]]``.

    Examples
    --------
    >>> labels, in_a_row = np.array([0, 0, 1, 1]), np.array([[0, 1], [1, 2], [2, 3]])
    >>> order = min_conflicts_order(labels, in_a_row, np.zeros(4, int), np.random.default_rng(0))
    >>> int(abs(np.diff(labels[order])).min())
    1
    """
    count = len(labels)
    if not (labels[pairs[:, 0]] == labels[pairs[:, 1]]).any():
        return np.arange(count)
    known, kinds, counts = np.unique(labels, return_inverse=True, return_counts=True)
    several = np.flatnonzero(counts > 1)
    # Those of which there is one alone are in conflict with none.
    numbers = np.full(len(known), -1)
    numbers[several] = np.arange(len(several))
    problem = Assignment(
        groups,
        np.zeros(0) if sizes is None else sizes,
        CONFLICT_STAYING,
        flow=neighbour_flow(count, pairs),
        distance=same_kind(numbers[kinds.ravel()]),
    )
    return improved(problem, rng, CONFLICT_HEATS, CONFLICT_TRIES)


BALANCE_STAYING = (0.3, 0.1, 0.03, 0.01)
"""Price of an item that leaves its place, one after another, in squared deviations of a value: what
gains most comes first, so that few are moved. Smaller at last moves more for nothing. Tried."""

BALANCE_ROUNDS, BALANCE_TRIES = 3, 50
"""Rounds at each, and exchanges tried in a round for every item. More find little more. Tried."""


def parts_of(container: Outline, x: FloatArray, y: FloatArray) -> IntArray:
    """``(n,)`` index of the container's part that is nearest to each point.

    Examples
    --------
    >>> tiles = [np.array([[a, 0.0], [a + 2, 0], [a + 2, 2], [a, 2]]) for a in (0, 5)]
    >>> parts_of(Outline.from_rings(tiles), np.array([1.0, 9.0]), np.ones(2)).tolist()
    [0, 1]
    """
    centres = shapely.points(x, y)
    parts = shapely.get_parts(container.region)
    return np.asarray(np.argmin([shapely.distance(part, centres) for part in parts], axis=0))


def balanced_order(
    values: FloatArray,
    parts: IntArray,
    groups: IntArray,
    sizes: FloatArray,
    rng: np.random.Generator,
) -> IntArray:
    """Order in which items stand so that the parts' means of a value are about equal.

    Where the value is the share of an item's hull that it fills, parts crowded with sketchy items
    would end emptier than the others.

    ``values``: ``(n,)`` of items.
    ``parts``: ``(n,)`` number of the part in which each item stands first.
    ``groups``, ``sizes``: as those of an ``Assignment``.

    Returns ``(n,)``: place p gets item ``order[p]``.

    Examples
    --------
    >>> full_or_sketchy, parts = np.array([1.0, 1, 0, 0]), np.array([0, 0, 1, 1])
    >>> rng = np.random.default_rng(0)
    >>> order = balanced_order(full_or_sketchy, parts, np.zeros(4, dtype=int), np.zeros(4), rng)
    >>> float(full_or_sketchy[order][:2].sum())
    1.0
    """
    count, spread = len(values), float(values.std())
    if spread == 0.0:
        return np.arange(count)
    counts = np.maximum(np.bincount(parts), 1)
    off = (values - values.mean()) / spread
    # The price is the squared sum of each part over how many it has.
    blend = Blend(
        np.arange(count + 1), parts.astype(np.int64), 1 / np.sqrt(counts[parts])[:, None],
        off[:, None, None], np.zeros((len(counts), 1)), np.eye(1), np.eye(1), 1.0,
    )  # fmt: skip
    order = np.arange(count)
    for staying in BALANCE_STAYING:
        problem = Assignment(groups, sizes, staying, blend=blend)
        order = improved(problem, rng, [0.0] * BALANCE_ROUNDS, BALANCE_TRIES, order)
    return order


GRID = 3
"""Colours of an item along each side. More take longer, and no more is seen from afar. Chosen."""

REACH = 3.0
"""Standard deviations of the blur beyond which nothing is seen to blend. Derived: 1 %."""

COLOUR_TRIES = 150
"""Exchanges tried for each item at most. More find next to nothing. Tried."""

COLOUR_ROUNDS = 10
"""Rounds of them, of which one without any exchange is the last. Chosen."""


def order_by_colour(
    order: IntArray,
    places: FloatArray,
    sides: FloatArray,
    patches: FloatArray,
    wanted: FloatArray,
    shapes: FloatArray,
    blur: float,
    rng: np.random.Generator,
) -> IntArray:
    """Order of items after exchanges, none of which is for the worse.

    ``order``: ``(n,)`` item in each place first.
    ``places``: ``(n, 3)`` x, y and angle of the places.
    ``sides``: ``(n, 2)`` width and height of what lies there.
    ``patches``: ``(n, GRID * GRID, 3)`` light of the items, row by row.
    ``wanted``: ``(n, 3)`` light of the picture at the places, blurred as much.
    ``shapes``: ``(n, s)`` features of items, and of the places in which they lie first: the squared
    difference is paid for as if it were a distance in Oklab.
    ``blur``: standard deviation, in the unit of the places.
    """
    # A tree of points is needed for pictures alone.
    from scipy.spatial import cKDTree

    count, points = len(order), places[:, :2]
    parts = _parts(places, sides)
    areas = sides.prod(axis=1) / GRID**2
    near = cKDTree(points).query_ball_point(points, REACH * blur + sides.max() / 2)
    # Rows of places and the points at which they are seen; every point sees what is near it.
    counts = np.array([len(one) for one in near])
    rows, seen = np.repeat(np.arange(count), counts), np.concatenate([np.sort(one) for one in near])
    away = ((parts[rows] - points[seen][:, None]) ** 2).sum(axis=2) / blur**2
    weights = areas[rows, None] * np.exp(-away / 2)
    weights /= np.bincount(seen, weights.sum(axis=1), count)[seen][:, None]
    starts = np.concatenate([[0], np.cumsum(counts)])
    blend = Blend(
        starts, seen.astype(np.int64), weights, patches, oklabs_of_light(wanted),
        CONES_OF_LIGHT, LAB_OF_CONES, 1 / 3,
    )  # fmt: skip
    problem = Assignment(np.zeros(count, np.int64), rows=shapes, columns=shapes, blend=blend)
    return improved(problem, rng, [0.0] * COLOUR_ROUNDS, COLOUR_TRIES // COLOUR_ROUNDS, order)


def _parts(places: FloatArray, sides: FloatArray) -> FloatArray:
    """``(n, GRID * GRID, 2)`` middles of the parts of what lies in the places."""
    steps = (np.arange(GRID) + 0.5) / GRID - 0.5
    down, across = (one.ravel() for one in np.meshgrid(steps, steps, indexing="ij"))
    own = np.stack([across[None] * sides[:, :1], down[None] * sides[:, 1:]], axis=2)
    sine, cosine = np.sin(places[:, 2]), np.cos(places[:, 2])
    x = own[..., 0] * cosine[:, None] - own[..., 1] * sine[:, None]
    y = own[..., 0] * sine[:, None] + own[..., 1] * cosine[:, None]
    return np.asarray(places[:, None, :2] + np.stack([x, y], axis=2))
