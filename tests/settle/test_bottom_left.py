"""Discs at their lowest places: what is forgotten changes none, and a stop leaves the rest."""

from __future__ import annotations

import numpy as np
import pytest

from packwork.arrays import FloatArray, IntArray
from packwork.compaction.arrangement import Arrangement
from packwork.settle import bottom_left as module
from packwork.settle.bottom_left import bottom_left
from scenes import box, disc


def _discs(count: int, largest: float, seed: int) -> Arrangement:
    radii = np.random.default_rng(seed).uniform(largest / 3, largest, count)
    return Arrangement([disc(r, 12) for r in radii], box(0, 0, 100, 100), np.zeros((count, 4)))


def _down(points: FloatArray, _: int) -> FloatArray:
    return -points[:, 1]


def _inward(points: FloatArray, _: int) -> FloatArray:
    return np.hypot(points[:, 0] - 50, points[:, 1] - 50)


@pytest.mark.parametrize("heights", [_down, _inward])
@pytest.mark.parametrize("seed", range(3))
def test_places_are_those_of_a_room_that_forgets_nothing(
    seed: int, heights: module.HeightOf, monkeypatch: pytest.MonkeyPatch
) -> None:
    found = []
    for every in (1, 10**9):
        monkeypatch.setattr(module, "EVERY", every)
        # More than there is room for, so that the last look everywhere.
        discs, none = _discs(150, 8.0, seed), np.arange(0)
        left = bottom_left(discs, np.arange(150), none, heights, np.zeros(150, int), 0.1)
        found.append((left, discs.places.copy()))
    (few, swept), (all_left, kept) = found
    assert 0 < len(few) < 150
    assert np.array_equal(few, all_left)
    assert np.array_equal(swept, kept)


def test_discs_below_the_surface_are_forgotten() -> None:
    discs = _discs(1, 3.0, 0)
    room = module.FreeRoom(discs, np.arange(0), 0.1)
    radius = float(discs.radii[0])
    for _ in range(350):
        assert room.place(radius, 0, 0, _down) is not None
    room.forget(radius)
    assert len(room._discs) < 200


def test_a_stop_leaves_those_that_are_to_follow(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "EVERY", 2)
    told: list[IntArray] = []
    discs = _discs(9, 5.0, 0)
    left = bottom_left(
        discs, np.arange(9), np.arange(0), _down, np.zeros(9, int), 0.1,
        told.append, lambda: len(told) == 2,
    )  # fmt: skip
    assert left.tolist() == [4, 5, 6, 7, 8]
    assert [placed.tolist() for placed in told] == [[0, 1], [0, 1, 2, 3]]
