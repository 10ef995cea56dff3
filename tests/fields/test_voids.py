"""The loop of relocation: which item chooses when, what is taken, and when it ends."""

from __future__ import annotations

import numpy as np

from packwork.fields.voids import Clearance, largest_voids


def _room(side: int = 40) -> Clearance:
    return Clearance(np.ones((side, side), dtype=bool))


def test_each_item_in_turn_takes_the_largest_void_that_is_left() -> None:
    radii = {4: 9.0, 2: 5.0, 7: 3.0}
    found = list(largest_voids(_room(), radii, lambda item, _: radii[item]))
    assert [void.item for void in found] == [4, 2, 7]
    assert [void.radius for void in found] == sorted((v.radius for v in found), reverse=True)
    for k, one in enumerate(found):
        for other in found[:k]:
            apart = np.hypot(one.x - other.x, one.y - other.y)
            assert apart >= radii[other.item] + one.radius - 1


def test_what_is_taken_may_depend_on_the_void() -> None:
    room = Clearance(np.ones((9, 30), dtype=bool))
    found = list(largest_voids(room, range(9), lambda _, radius: radius, least_px=1.0))
    assert found[0].radius == 4.5
    assert len(found) > 1
    assert all(void.radius >= 1.0 for void in found)


def test_it_ends_without_a_void_but_for_items_bound_to_pixels() -> None:
    bound = {1: np.array([0]), 3: np.array([39])}
    found = largest_voids(_room(), [1, 1, 3, 2, 0], lambda *_: 30.0, least_px=0.1, among=bound.get)
    # The second cannot have the pixel that the first has; the fourth finds nothing at all.
    assert [void.item for void in found] == [1, 3, 2]


def test_without_a_least_void_items_lie_where_they_overlap_least() -> None:
    assert len(list(largest_voids(_room(9), range(4), lambda *_: 9.0))) == 4
