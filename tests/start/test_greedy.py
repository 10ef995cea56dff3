"""Discs one after another: how they are shifted, and where preferred pixels put them."""

from __future__ import annotations

import numpy as np

from packwork.fields.voids import Clearance
from packwork.start.places import JITTER, place_discs


def _room() -> Clearance:
    return Clearance(np.ones((9, 9), dtype=bool))


def test_no_disc_is_shifted_further_than_the_room_round_it() -> None:
    radii, rng = np.full(50, 1.0), np.random.default_rng(0)
    tight, _ = place_discs(Clearance(np.zeros((9, 9), dtype=bool)), radii, rng)
    assert set(tight % 1) == {0.5}
    wide = [place_discs(_room(), np.ones(1), rng)[0][0] for _ in range(20)]
    assert 0 < np.abs(np.array(wide) - 4.5).max() <= JITTER


def test_preferred_pixels_are_taken_while_discs_fit_there() -> None:
    corner, rng = np.array([0, 1]), np.random.default_rng(0)
    small, _ = place_discs(_room(), np.full(1, 0.4), rng, preferred=corner)
    large, _ = place_discs(_room(), np.full(1, 3.0), rng, preferred=corner)
    assert small[0] < 2
    assert abs(large[0] - 4.5) < 1
