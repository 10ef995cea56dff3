"""Distances from lines of few and of many pieces are those of a look at all pieces."""

from __future__ import annotations

import numpy as np
import pytest

from packwork.forces import field as distance_module
from packwork.forces.field import FEW_PIECES, Distance


@pytest.mark.parametrize("pieces", [FEW_PIECES, FEW_PIECES + 1, 300])
def test_an_index_finds_the_nearest_piece(
    pieces: int, rng: np.random.Generator, monkeypatch: pytest.MonkeyPatch
) -> None:
    line = np.cumsum(rng.normal(size=(pieces + 1, 2)), axis=0)
    points = 10 * rng.normal(size=(500, 2))
    heights, slopes = Distance.from_line(line)(points)
    monkeypatch.setattr(distance_module, "FEW_PIECES", 10**6)
    expected, away = Distance.from_line(line)(points)
    assert heights == pytest.approx(expected, abs=1e-9)
    assert (slopes * away).sum(axis=1) == pytest.approx(np.ones(500), abs=1e-6)
