"""A finish that knows the forces keeps what they did, and makes no item pay with its size."""

from __future__ import annotations

import numpy as np
import pytest

from packwork.compaction.objective import FreeSizes, SharedSize
from packwork.finish.finish import finish
from packwork.finish.objective import YIELDING, force_term_of
from packwork.finish.options import FinishOptions
from packwork.forces.bonds import Alignment
from packwork.forces.forces import NO_FORCES, BondForce, Forces
from scenes import disc, poses, square, square_container, star

COUNT = 12
KINDS = np.arange(COUNT) % 2
ROW = Forces([], [BondForce(Alignment(1), np.where(KINDS, 3.0, 0.0))], KINDS, 100.0)


def _begun() -> tuple[list, object]:
    """Four rows of three, every second item of the row kind."""
    x, y = np.meshgrid([20.0, 50.0, 80.0], [16.0, 39.0, 61.0, 84.0])
    outlines = [[star(), disc()][kind] for kind in KINDS]
    return outlines, poses(x.ravel(), y.ravel(), 0.1, 8.0)


@pytest.mark.parametrize(("sizes", "most"), [("free", 0.3), ("shared", 0.95)])
def test_the_row_gets_closer(sizes: str, most: float) -> None:
    outlines, start = _begun()
    options = FinishOptions(sizes=sizes, trials=60, rounds=8)  # type: ignore[arg-type]
    spreads = []
    for forces in (NO_FORCES, ROW):
        done = finish(square_container(), outlines, start, options, forces=forces)
        assert done.clean
        spreads.append(float(done.poses.y[KINDS == 1].std()))
    assert spreads[1] < most * spreads[0]


def test_where_sizes_are_common_no_push_outweighs_growing() -> None:
    free = (np.full(2, -np.inf), np.full(2, np.inf))
    sizing = SharedSize(np.full(2, 4.0), free)
    strong = Forces([], [BondForce(Alignment(1), np.full(2, 900.0))], np.zeros(2, int), 100.0)
    force_term = force_term_of(strong, sizing)
    assert force_term is not None
    arrangement = _two()
    objective = sizing.objective(arrangement.places[:, 3], 0.1)
    push = force_term.with_push(objective, arrangement).push
    growth = objective.weights / arrangement.radii
    np.testing.assert_allclose(np.hypot(*push.T), YIELDING * growth)
    assert push[0, 1] > 0 > push[1, 1]


def test_where_sizes_are_free_pushes_are_as_strong_as_they_are() -> None:
    sizing = FreeSizes(np.full(2, 4.0), (np.zeros(2), np.zeros(2)), -np.ones(2), np.ones(2))
    force_term = force_term_of(ROW.subset(np.array([1, 3])), sizing)
    assert force_term is not None
    arrangement = _two()
    push = force_term.with_push(sizing.objective(np.zeros(2), 0.1), arrangement).push
    slopes = force_term.forces.cost(arrangement.places[:, :2], sizing.areas).slopes
    np.testing.assert_allclose(push, -slopes)
    assert force_term.gains(arrangement.places, 0, np.array([1])).tolist() == [0.0]
    assert force_term_of(NO_FORCES, sizing) is None


def _two():
    from packwork.compaction.arrangement import Arrangement

    places = np.array([[30.0, 20.0, 0.0, 0.0], [60.0, 80.0, 0.0, 0.0]])
    return Arrangement([square()] * 2, square_container().outline, places)
