"""Neighbouring items: Delaunay edges of places, and pairs with a small gap between them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import shapely

from packwork.arrays import FloatArray, IntArray
from packwork.geometry.outline import Outline
from packwork.geometry.outline import regions as regions_of

NEAR = 0.5
"""Gap between two items that lie side by side at most, in radii of a disc as large as the smaller
of them, or as the typical item. Larger counts pairs that another item could nearly pass between.
Chosen."""


def neighbour_pairs(x: FloatArray, y: FloatArray) -> IntArray:
    """Pairs of points with an edge between them in their Delaunay triangulation.

    Points on one line, or fewer than three, are neighbours one after another; a point
    that lies on another is its neighbour.

    ``x``, ``y``: ``(n,)``.

    Returns ``(m, 2)``, each pair once, the smaller index first, in order.

    Examples
    --------
    >>> neighbour_pairs(np.array([0.0, 9, 0, 9, 1]), np.array([0.0, 0, 9, 9, 2])).tolist()
    [[0, 1], [0, 2], [0, 4], [1, 3], [1, 4], [2, 3], [2, 4], [3, 4]]
    >>> neighbour_pairs(np.array([0.0, 2, 1]), np.zeros(3)).tolist()
    [[0, 2], [1, 2]]
    """
    # Takes a tenth of a second to load, and most runs do without.
    from scipy.spatial import Delaunay, QhullError

    points = np.column_stack([x, y])
    try:
        if len(points) < 3:
            raise QhullError
        found = Delaunay(points)
    except QhullError:
        along = np.lexsort((y, x))
        edges = np.column_stack([along[:-1], along[1:]])
    else:
        corners = found.simplices
        edges = np.concatenate([corners[:, [0, 1]], corners[:, [1, 2]], corners[:, [2, 0]]])
        # Points that the triangulation left out lie on one of its corners.
        edges = np.concatenate([edges, found.coplanar[:, [0, 2]]])
    return np.unique(np.sort(edges.astype(np.int64), axis=1), axis=0).reshape(-1, 2)


def side_by_side(outlines: Sequence[Outline]) -> IntArray:
    """Pairs of items that lie side by side, with a small gap between them.

    Small is below :data:`NEAR` of the radius of a disc as large as the smaller of the two, or as
    the median item where that is smaller: a large item has many small ones about it, and of these
    a few lie beside each other. By their outlines: of long words the middles say little.

    ``outlines``: in place.

    Returns ``(m, 2)``, each pair once, the smaller index first, in order.

    Examples
    --------
    >>> def tile(at):
    ...     return Outline.from_rings([np.array([[at, 0.0], [at + 2, 0], [at + 2, 2], [at, 2]])])
    >>> side_by_side([tile(at) for at in (0, 2.1, 9)]).tolist()
    [[0, 1]]
    """
    if len(outlines) < 2:
        return np.zeros((0, 2), dtype=np.int64)
    radii = np.sqrt(np.array([outline.area for outline in outlines]) / np.pi)
    regions = regions_of(outlines)
    near = NEAR * np.minimum(radii, np.median(radii))
    one, other = shapely.STRtree(regions).query(regions, "dwithin", near)
    # Each pair is found from its smaller item.
    is_pair = (radii[one] < radii[other]) | ((radii[one] == radii[other]) & (one < other))
    found = np.sort(np.column_stack([one, other])[is_pair], axis=1).astype(np.int64)
    return found[np.lexsort(found.T[::-1])]
