"""Weighted Voronoi stippling: places that lie closely where a density is high, each with its share.

A. Secord, "Weighted Voronoi stippling", NPAR 2002, 37-43 (doi:10.1145/508530.508537): Lloyd's
method, each point going to the centroid of its Voronoi cell, weighted by the density. Ours begins
with points drawn by that density, counts pixels instead of cutting polygons, and gives the areas.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from packwork.arrays import FloatArray, Image, IntArray

ROUNDS = 30
"""Rounds of Lloyd's method. Fewer leave cells uneven, more move nothing that is seen. Tried."""


@dataclass(frozen=True, eq=False)
class Stippling:
    """Points and their cells.

    ``x``, ``y``: ``(n,)``, pixels.
    ``areas``: ``(n,)`` of the cells, pixels, none below one.
    """

    x: FloatArray
    y: FloatArray
    areas: FloatArray


def stippled(
    inside: Image, density: Image, count: int, rng: np.random.Generator, rounds: int = ROUNDS
) -> Stippling:
    """Points whose cells are small where the density is high: side of a cell by its fourth root.

    ``inside``: coverage of the region; pixels of which more than half is covered belong to it.
    ``density``: positive weight of each pixel.
    ``count``: number of points, at least 1; where there are more than pixels, several share one.

    Examples
    --------
    >>> density = np.ones((40, 80)); density[:, 40:] = 16.0
    >>> found = stippled(np.ones((40, 80)), density, 60, np.random.default_rng(0))
    >>> left = found.x < 40
    >>> bool(np.median(found.areas[left]) > 2.5 * np.median(found.areas[~left]))
    True
    """
    # The tree is needed for pictures alone.
    from scipy.spatial import cKDTree

    rows, columns = np.nonzero(inside > 0.5)
    pixels = np.column_stack([columns + 0.5, rows + 0.5])
    weights = density[rows, columns].astype(np.float64)
    points = pixels[_drawn(weights, count, rng)] + rng.uniform(-0.25, 0.25, (count, 2))
    for _ in range(rounds):
        cells = cKDTree(points).query(pixels)[1]
        points = _centroids(pixels, weights, cells, points)
    cells = cKDTree(points).query(pixels)[1]
    areas = np.maximum(np.bincount(cells, minlength=count), 1.0)
    return Stippling(points[:, 0], points[:, 1], areas)


def _drawn(weights: FloatArray, count: int, rng: np.random.Generator) -> IntArray:
    """Pixels drawn one from each equal part of the summed weight: spread better than by chance.

    At one place of all parts they would stand in columns where rows hold a whole number of parts.
    """
    sums = np.cumsum(weights)
    at = (np.arange(count) + rng.uniform(size=count)) / count * sums[-1]
    return np.asarray(np.minimum(np.searchsorted(sums, at), len(sums) - 1))


def _centroids(
    pixels: FloatArray, weights: FloatArray, cells: IntArray, points: FloatArray
) -> FloatArray:
    """Weighted centroids of the cells; a point without a cell stays."""
    count = len(points)
    whole = np.bincount(cells, weights, count)
    sums = [np.bincount(cells, weights * pixels[:, k], count) for k in range(2)]
    held = whole > 0
    moved = points.copy()
    moved[held] = np.column_stack(sums)[held] / whole[held, None]
    return moved
