"""The estimate that keeps scribbles from taking minutes."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from packwork.readers.budget.crossings import Allowance, estimated_crossings
from packwork.readers.reading import TooRichError


@pytest.mark.parametrize("count", [30, 300, 900])
def test_crossings_are_estimated_well(count):
    ring = np.random.default_rng(count).random((count, 2))
    edges = shapely.linestrings(np.stack([ring, np.roll(ring, -1, axis=0)], axis=1))
    true = shapely.STRtree(edges).query(edges, predicate="crosses").shape[1] / 2
    assert estimated_crossings([ring]) == pytest.approx(true, rel=0.25)


def test_allowance_is_for_all_rings_together():
    allowance = Allowance(150_000)
    ring = np.random.default_rng(0).random((900, 2))
    allowance.spend([ring])
    with pytest.raises(TooRichError, match="crosses itself about"):
        allowance.spend([ring])
