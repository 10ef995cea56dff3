"""Discs one after another: whose place is chosen when, and what is then taken."""

from __future__ import annotations

import numpy as np

from packwork.fields.clearance import Clearance
from packwork.start.greedy import JITTER, Spot, place_discs


def test_the_largest_chooses_first_and_each_sees_what_is_left() -> None:
    room = Clearance(np.ones((40, 40), dtype=bool))
    asked: list[float] = []
    left: list[float] = []

    def spot_for(radius: float) -> Spot:
        asked.append(radius)
        left.append(room.largest()[2])
        return room.largest()

    place_discs(room, np.array([3.0, 9.0, 5.0]), spot_for, np.random.default_rng(0))
    assert asked == [9.0, 5.0, 3.0]
    assert left == sorted(left, reverse=True)


def test_no_disc_is_shifted_further_than_the_room_round_it() -> None:
    room = Clearance(np.ones((9, 9), dtype=bool))
    radii = np.full(50, 1.0)
    tight, wide = (
        place_discs(room, radii, lambda _, r=free: (4.5, 4.5, r), np.random.default_rng(0))
        for free in (-1.0, 5.0)
    )
    assert set(tight[0]) == {4.5}
    assert 0 < np.abs(wide[0] - 4.5).max() <= JITTER
