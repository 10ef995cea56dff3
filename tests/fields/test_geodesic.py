"""Ways inside a region, from one end to the other."""

from __future__ import annotations

import numpy as np

from packwork.fields.distance_transform import lengthwise


def test_it_rises_along_a_bent_corridor() -> None:
    mask = np.zeros((30, 40), dtype=bool)
    mask[2:6, 2:38] = True
    mask[2:28, 34:38] = True
    mask[24:28, 8:38] = True
    away = lengthwise(mask)
    assert np.isnan(away[10, 10])
    ends = sorted([away[4, 2], away[26, 8]])
    assert ends[0] < 5
    assert ends[1] > 70
    middle = away[4, 20], away[4, 36], away[15, 36], away[26, 30]
    steps = np.diff(middle) * (1 if away[4, 2] < away[26, 8] else -1)
    assert (steps > 5).all()


def test_a_straight_one_is_measured_by_its_pixels() -> None:
    assert lengthwise(np.ones((1, 9), dtype=bool)).tolist() == [list(range(9))]


def test_parts_follow_each_other_from_the_left() -> None:
    mask = np.ones((3, 11), dtype=bool)
    mask[:, 5] = False
    away = lengthwise(mask)
    assert away[:, :5].max() < away[:, 6:].min()
