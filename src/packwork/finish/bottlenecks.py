"""Bottlenecks: items that keep all others from growing, relocated to voids.

Where all sizes share one factor, it is that of the tightest place. The smallest items and those
that they touch are tried in the largest voids, turned; a move is kept if all can then grow.
"""

from __future__ import annotations

import numpy as np

from packwork.arrays import FloatArray, IntArray
from packwork.compaction.arrangement import Arrangement
from packwork.compaction.kernels.steps import Objective
from packwork.compaction.kernels.trials import Rounds, Trial
from packwork.compaction.separate import SMALLEST_VOID, free_room
from packwork.fields.voids import largest_voids
from packwork.finish.anneal import ANGLE_TRUST, Lengths, make_trial
from packwork.finish.proposals import ANGLES, at_angles

LOWEST, MOST_SUSPECTS = 3, 10
"""How many of the smallest items, and how many of them and of those they touch, are taken for
bottlenecks. More take longer and find little more. Tried."""

TOUCHING = 0.05
"""Gap within which items touch, shares of the side of an item's share of the container.
Tried."""

VOIDS = 8
"""Largest voids that a bottleneck is tried in. More take longer. Tried."""

TRIES = 6_000
"""Such moves that are tried at most, over the number of items. Larger gains a little for much more
time. Tried."""

RELIEF = 0.004
"""Logarithm by which all must grow for such a move to be kept. Larger ends before chains of small
gains, smaller takes longer. Tried."""

PROBE, PROMISING = 6, 0.001
"""Rounds after which such a move is given up if all have not grown by so much, a logarithm.
Measured."""

NEARLY = 0.1
"""Logarithm by which such an item may be smaller in its void than the smallest is. Larger tries
moves that seldom gain. Chosen."""


def bottlenecks(arrangement: Arrangement, spacing: float) -> IntArray:
    """``(m,)`` indices of the smallest items and those that they touch, small ones first.

    >>> from packwork.geometry.outline import Outline
    >>> box = Outline.from_rings([np.array([[-1.0, -1], [1, -1], [1, 1], [-1, 1]])])
    >>> wall = box.mapped(np.array([[99.0, 0, 0], [0, 99.0, 0]]))
    >>> sizes = np.log([0.9, 1.0, 1.5, 1.5, 1.6, 1.7])
    >>> x = np.array([0.0, 2.0, 30.0, 60.0, 90.0, -30.0])
    >>> row = Arrangement([box] * 6, wall, np.column_stack([x, 0 * x, 0 * x, sizes]))
    >>> bottlenecks(row, 10.0).tolist()
    [0, 1, 2]
    """
    growth = arrangement.places[:, 3]
    lowest = np.argsort(growth, kind="stable")[:LOWEST]
    reach = TOUCHING * spacing
    pairs = arrangement.pairs(reach)
    touching = pairs[arrangement.distances(pairs, reach) < reach]
    touching = arrangement.owners[touching]
    near = touching[np.isin(touching, lowest).any(axis=1)]
    found = np.union1d(lowest, near[near < arrangement.count])
    return found[np.argsort(arrangement.radii[found], kind="stable")][:MOST_SUSPECTS]


def relocate_bottleneck(
    arrangement: Arrangement,
    item: int,
    objective: Objective,
    lengths: Lengths,
    rng: np.random.Generator,
) -> bool:
    """Relocate an item, turned, to the void in which it grows most; False for nowhere."""
    moved = np.array([item])
    candidates = [
        at_angles(places, moved, objective, rng.random((ANGLES, 1)))
        for places in _in_voids(arrangement, moved)
    ]
    if not candidates:
        return False
    everywhere = np.arange(arrangement.count)
    trial = Trial(moved, np.concatenate(candidates), moved, everywhere, np.empty((0, 4)))
    rounds = Rounds(ANGLE_TRUST * lengths.spacing, np.empty(0), np.empty(0))
    return make_trial(arrangement, objective, trial, rounds, lengths) > -np.inf


def _in_voids(arrangement: Arrangement, moved: IntArray) -> list[FloatArray]:
    """Places of an item in the largest voids, as it is turned and as large as it is now."""
    others = np.setdiff1d(np.arange(arrangement.count), moved)
    room, px_per_cu, corner = free_room(arrangement, others)
    found = []
    voids = largest_voids(room, range(VOIDS), lambda _, radius: radius, least_px=SMALLEST_VOID)
    for _, x, y, _ in voids:
        places = arrangement.places[moved]
        places[0, :2] = corner[0] + x / px_per_cu, corner[1] + y / px_per_cu
        found.append(places)
    return found
