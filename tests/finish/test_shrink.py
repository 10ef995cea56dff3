"""Fillers: all who stay are free of conflicts, the others are as they were."""

from __future__ import annotations

import numpy as np
import pytest

from packwork.compaction.arrangement import find_conflicts
from packwork.compaction.options import HAIR
from packwork.finish.shrink import admit_fillers
from packwork.scene.pose import Poses
from scenes import disc, poses, square, square_container, star


@pytest.mark.parametrize("gap", [0.0, 1.5])
def test_who_stays_is_free_and_the_old_stay_as_they_are(
    rng: np.random.Generator, gap: float
) -> None:
    old = poses([30.0, 70.0], [50.0, 50.0], 0.3, [15.0, 12.0])
    new = Poses(rng.uniform(0, 100, 30), rng.uniform(0, 100, 30), rng.uniform(0, 6, 30),
                rng.uniform(1, 9, 30))  # fmt: skip
    outlines = [disc(), star(), *[star(), square(), disc()] * 10]
    who, stay = admit_fillers(square_container(), outlines, old.followed_by(new), 30, gap)
    assert 4 < len(who) < 32
    assert who[:2].tolist() == [0, 1]
    np.testing.assert_array_equal(stay.scale[:2], old.scale)
    assert np.all(stay.scale[2:] <= new.scale[who[2:] - 2])
    kept = [outlines[k] for k in who]
    assert find_conflicts(square_container(), kept, stay, gap + HAIR * 100) == ()


def test_nobody_comes_nobody_goes() -> None:
    old = poses([30.0, 70.0], [50.0, 50.0], 0.3, [15.0, 12.0])
    who, stay = admit_fillers(square_container(), [disc(), disc()], old, 0, 0.0)
    assert who.tolist() == [0, 1]
    np.testing.assert_array_equal(stay.scale, old.scale)
