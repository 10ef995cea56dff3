"""Limits: what is held, who may be moved, and zones that grow with the items' margins."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from packwork.scene.pose import Limits, Zone
from scenes import box

NAN = np.nan


def four() -> Limits:
    """A free item, one in a zone, one on a line in a zone, one pinned in all."""
    return replace(
        Limits.free(4),
        x=np.array([NAN, NAN, 3.0, 4.0]),
        y=np.array([NAN, NAN, NAN, 5.0]),
        angle=np.array([NAN, 0.3, NAN, 0.0]),
        smallest=np.array([0.0, 1.0, 1.0, 2.0]),
        largest=np.array([np.inf, 2.0, 2.0, 2.0]),
        rigid=np.array([False, False, False, True]),
        zones=(Zone(box(0, 0, 10, 10), np.array([1, 2])),),
    )


def test_what_is_given_is_held_and_nothing_else() -> None:
    assert four().held.astype(int).tolist() == [
        [0, 0, 0, 0, 0],
        [0, 0, 1, 0, 0],
        [1, 0, 0, 0, 0],
        [1, 1, 1, 1, 1],
    ]


def test_items_of_one_zone_may_change_places_and_held_ones_never() -> None:
    assert four().is_movable.tolist() == [True, True, False, False]
    assert four().groups.tolist() == [0, 1, -1, -1]


def test_only_limits_that_limit_nothing_need_not_be_heeded() -> None:
    free = Limits.free(2)
    assert not free.binds
    assert not free.joined_by(3).binds
    assert replace(free, x=np.zeros(2)).binds
    assert four().binds


def test_kinds_are_apart_where_two_are_of_one() -> None:
    assert not four().keeps_kinds_apart
    alike = replace(four(), kinds=np.array([0, 1, 1, 2]))
    assert alike.keeps_kinds_apart
    assert alike.joined_by(2).kinds.tolist() == [0, 1, 1, 2, 3, 4]


def test_zones_grow_by_the_margin_that_items_have() -> None:
    (zone,) = four().widened(2.0).zones
    assert zone.outline.bounds == pytest.approx((-2, -2, 12, 12))
    assert four().zones[0].outline.bounds == (0, 0, 10, 10)
    limits = four()
    assert limits.widened(0.0) is limits
