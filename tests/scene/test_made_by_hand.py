"""Items, containers and poses that users make themselves."""

from __future__ import annotations

import copy
import pickle
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import pytest
import shapely

from packwork.errors import ShapeError
from packwork.scene.container import Container
from packwork.scene.item import FlatArt, Item
from packwork.scene.pose import Poses

BOX = shapely.box(0, 0, 4, 2)
RING = [(0, 0), (4, 0), (4, 2), (0, 2)]


@pytest.mark.parametrize(
    "shape",
    [BOX, RING, RING[::-1], [RING], shapely.force_3d(BOX)],
)
def test_an_item_takes_any_outline(shape: Any) -> None:
    item = Item("tile", outline=shape, art="teal")
    assert (item.outline.area, item.ink.area, item.art) == (8.0, 8.0, FlatArt("teal"))


def test_holes_stay_holes() -> None:
    ring = BOX - shapely.box(1, 0.5, 2, 1)
    assert Item("ring", outline=ring).outline.area == 7.5
    rings = [list(BOX.exterior.coords), list(shapely.box(1, 0.5, 2, 1).exterior.coords)]
    assert Item("ring", outline=rings).outline.area == 7.5


def test_values_are_copied_replaced_and_pickled() -> None:
    item = replace(Item("tile", outline=BOX), weight=4.0)
    room = replace(Container("room", outline=BOX), unit="mm")
    for value in (item, room):
        again = pickle.loads(pickle.dumps(copy.copy(value)))  # noqa: S301
        assert again.outline.area == 8.0
    assert item.weight == 4.0
    assert (room.width, room.unit) == (4.0, "mm")


@pytest.mark.parametrize(
    ("made", "said"),
    [
        (lambda: Item("x"), "the item 'x' needs an outline"),
        (lambda: Item("x", outline=shapely.Point(0, 0)), "has no area"),
        (lambda: Item("x", outline="star"), "is a Shapely polygon, a ring of points"),
        (lambda: Item("x", outline=BOX, art="reddish"), "'reddish' is no colour"),
        (lambda: Container("x"), "a container needs an outline"),
        (lambda: Container("x", outline=BOX, width=-1), "positive size, not -1 x 2"),
        (lambda: Poses([1, 2], [1]), r"as many numbers of y as of x \(2\), not \(1,\)"),
    ],
)
def test_what_has_no_meaning_is_refused(made: Callable[[], object], said: str) -> None:
    with pytest.raises(ShapeError, match=said):
        made()


def test_one_number_is_that_of_all_poses() -> None:
    poses = Poses([1, 2, 3], 5, scale=[1, 2, 3])
    assert (poses.y.tolist(), poses.angle.tolist()) == ([5.0] * 3, [0.0] * 3)
