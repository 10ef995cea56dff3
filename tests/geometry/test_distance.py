"""Distances by an index agree with those of all pairs, and clearance with GEOS's."""

from __future__ import annotations

import math

import numpy as np
import pytest
import shapely

from packwork.geometry import distance as distance_module
from packwork.geometry.distance import clearance, distance, is_clear
from packwork.geometry.overlay import polygon_parts, valid


def _star(rng: np.random.Generator) -> shapely.Geometry:
    """A ragged region of one ring or, where that crosses itself, several."""
    count = int(rng.integers(3, 40))
    angle, radius = np.sort(rng.random(count)) * 2 * np.pi, 0.2 + rng.random(count)
    ring = np.column_stack([radius * np.cos(angle), radius * np.sin(angle)])
    return valid(shapely.Polygon(ring))


def test_an_index_tells_the_same_distance(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of regions, lines, regions that meet, and one inside another."""
    monkeypatch.setattr(distance_module, "FEW_PAIRS", 0)
    rng = np.random.default_rng(0)
    for _ in range(100):
        first, second = _star(rng), shapely.affinity.translate(_star(rng), 4 * rng.random())
        for one in (first, first.boundary):
            for pair in ((one, second), (second, one)):
                assert distance(*pair) == pytest.approx(shapely.distance(*pair), abs=1e-12)
    assert distance(shapely.box(0, 0, 9, 9), shapely.box(4, 4, 5, 5)) == 0
    assert distance(shapely.Polygon(), shapely.box(0, 0, 1, 1)) == math.inf


def test_edges_that_are_far_enough_are_told_from_those_that_are_not(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Just below and just above the clearance that GEOS finds, holes and parts included."""
    rng = np.random.default_rng(1)
    for _ in range(100):
        shape = shapely.union_all([_star(rng), shapely.affinity.translate(_star(rng), 1.5)])
        region = shapely.MultiPolygon(polygon_parts(shape))
        found = float(shapely.minimum_clearance(region))
        assert clearance(region, 9.0) == pytest.approx(found, rel=1e-12)
        assert clearance(region, found / 2) == found / 2
        for few in (0, 20_000):
            monkeypatch.setattr(distance_module, "FEW_VERTICES", few)
            assert is_clear(region, found * (1 - 1e-9))
            assert not is_clear(region, found * (1 + 1e-9))


def test_a_spiral_of_many_turns_is_looked_at_once() -> None:
    """Turns that are all equally near: each edge has its own neighbours to look at, no more."""
    turn = np.linspace(2 * np.pi, 200 * np.pi, 20_000)
    line = np.column_stack([turn * np.cos(turn), turn * np.sin(turn)])
    out = line * (1 + 0.2 * 2 * np.pi / turn)[:, None]
    spiral = shapely.Polygon(np.concatenate([line, out[::-1]]))
    assert shapely.is_valid(spiral)
    assert is_clear(spiral, 1e-3)
    assert not is_clear(spiral, 2.0)
