"""Items in those of some places in which, seen from afar, they show a picture best.

Each item is a patch of a few by a few colours, so that a photograph half sky and half roof is both.
From afar they blend as light; pairs exchange their places as long as what is then seen comes nearer
to what is wanted, in Oklab. An assignment by the colour of each alone comes first: neighbours that
make up for each other are seen by exchanges only.
"""

from __future__ import annotations

import numpy as np

from packwork.arrays import FloatArray, IntArray
from packwork.assignment._kernels import Blend
from packwork.assignment.local_search import improved
from packwork.assignment.problem import Assignment
from packwork.scene.contrast import CONES_OF_LIGHT, LAB_OF_CONES, oklabs_of_light

GRID = 3
"""Colours of an item along each side. More take longer, and no more is seen from afar. Chosen."""

REACH = 3.0
"""Standard deviations of the blur beyond which nothing is seen to blend. Derived: 1 %."""

TRIES = 150
"""Exchanges tried for each item at most. More find next to nothing. Tried."""

ROUNDS = 10
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

    Parameters
    ----------
    order
        ``(n,)`` item in each place first.
    places
        ``(n, 3)`` x, y and angle of the places.
    sides
        ``(n, 2)`` width and height of what lies there.
    patches
        ``(n, GRID * GRID, 3)`` light of the items, row by row.
    wanted
        ``(n, 3)`` light of the picture at the places, blurred as much.
    shapes
        ``(n, s)`` features of items, and of the places in which they lie first: the squared
        difference is paid for as if it were a distance in Oklab.
    blur
        Standard deviation, in the unit of the places.
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
    return improved(problem, rng, [0.0] * ROUNDS, TRIES // ROUNDS, order)


def _parts(places: FloatArray, sides: FloatArray) -> FloatArray:
    """``(n, GRID * GRID, 2)`` middles of the parts of what lies in the places."""
    steps = (np.arange(GRID) + 0.5) / GRID - 0.5
    down, across = (one.ravel() for one in np.meshgrid(steps, steps, indexing="ij"))
    own = np.stack([across[None] * sides[:, :1], down[None] * sides[:, 1:]], axis=2)
    sine, cosine = np.sin(places[:, 2]), np.cos(places[:, 2])
    x = own[..., 0] * cosine[:, None] - own[..., 1] * sine[:, None]
    y = own[..., 0] * sine[:, None] + own[..., 1] * cosine[:, None]
    return np.asarray(places[:, None, :2] + np.stack([x, y], axis=2))
