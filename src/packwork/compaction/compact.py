"""Compaction: the best small step of some items by a linear programme over their contacts.

Z. Li and V. Milenkovic, "Compaction and separation algorithms for non-convex polygons and their
applications", European Journal of Operational Research 84 (1995), 539-561,
doi:10.1016/0377-2217(95)00021-H: positions of polygons as unknowns, contacts as linear
constraints, solved again about each new layout. That sizes grow and items turn in the same
programme is as in the adaptive shrinking cell of S. Torquato and Y. Jiao, "Dense packings of the
Platonic and Archimedean solids", Nature 460 (2009), 876-879, doi:10.1038/nature08239, and in
"Robust algorithm to generate a diverse class of dense disordered and ordered sphere packings via
linear programming", Physical Review E 82 (2010), 061302, doi:10.1103/PhysRevE.82.061302; where
their cell shrinks round particles, our items grow in a container that stays.

Ours differs from both: constraints bind vertices to edges and corners that they see, no no-fit
polygons are made; programmes are over blocks of neighbours; and each step is checked in exact
geometry and cut until no conflict is left.
"""

from __future__ import annotations

import numpy as np

from packwork.arrays import IntArray
from packwork.compaction.arrangement import Arrangement
from packwork.compaction.kernels import distances, interior_point, steps
from packwork.compaction.kernels.steps import ACCURACY, RETURN_WEIGHT, TRAVEL, Objective


def compact(
    arrangement: Arrangement,
    objective: Objective,
    items: IntArray,
    trust: float,
    gap: float,
    hair: float,
) -> bool:
    """Move some items by the best step for them all, as far as it goes; False if nowhere.

    The arrangement has no conflicts and gets none.

    Parameters
    ----------
    arrangement
        Changed in place.
    objective
        Bounds and worths of all items.
    items
        ``(m,)`` indices of those that move, neighbours near each other in the list.
    trust
        Bound of each move, and of turns and growths at an item's farthest vertex.
    gap
        Least distance that the check asks for.
    hair
        The part of it that was not asked for.
    """
    board = arrangement.board
    pairs = distances.pairs_of(board.boxes, items, gap + TRAVEL * trust)
    # One after another, not in one kernel: what several steps share is compiled once.
    rows = steps.rows_of(board, items, pairs, trust, gap, hair)
    z = interior_point.maximise(
        rows, *steps.gains_and_bounds(board, objective, items, trust), ACCURACY
    )
    step = steps.step_of(board, items, z, trust)
    return bool(steps.apply_step(board, items, step, pairs, gap, trust) >= 0)


def worth(arrangement: Arrangement, objective: Objective, items: IntArray) -> float:
    """Worth of items ``(m,)`` together; less for those out of their bounds.

    Examples
    --------
    >>> from packwork.geometry.outline import Outline
    >>> box = Outline.from_rings([np.array([[-1.0, -1], [1, -1], [1, 1], [-1, 1]])])
    >>> one = Arrangement([box], box, np.zeros((1, 4)))
    >>> free = np.full(1, 9.0)
    >>> areas = Objective(-free, free, -free, free, 2 * np.full(1, box.area), 2.0, np.zeros((1, 2)))
    >>> worth(one, areas, np.array([0]))
    4.0
    """
    growth = arrangement.places[items, 3]
    value = objective.weights[items] * np.exp(objective.power * growth)
    below = np.maximum(objective.smallest[items] - growth, 0.0)
    above = np.maximum(growth - objective.largest[items], 0.0)
    return float((value / objective.power - RETURN_WEIGHT * value * (below + above)).sum())
