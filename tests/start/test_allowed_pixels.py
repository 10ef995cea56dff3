"""First places of items that may not lie anywhere: zones, lines, points, and the rest."""

from __future__ import annotations

from dataclasses import replace
from typing import Literal, get_args

import numpy as np
import pytest
import shapely

from packwork.geometry.outline import Outline
from packwork.scene.pose import Limits, Poses, Zone
from packwork.start.first_poses import first_poses, relocated
from packwork.start.options import StartOptions
from packwork.start.places import allowed_pixels, around
from scenes import box, disc, overlap_area, placed, poses, round_container, square

NAN = np.nan
Method = Literal["auto", "distance-field", "medial-axis", "scatter"]
METHODS = pytest.mark.parametrize("method", get_args(Method))
CORNER = box(40, 20, 60, 45)


def limits(count: int, **changes: object) -> Limits:
    return replace(Limits.free(count), **changes)


def first(method: Method, outlines: list[Outline], given: Limits, radius: float = 5.0) -> Poses:
    count = len(outlines)
    return first_poses(
        round_container(), outlines, np.full(count, radius), np.zeros(count),
        StartOptions(method=method), np.random.default_rng(0), given,
    ).poses  # fmt: skip


@METHODS
def test_items_of_a_zone_begin_in_it(method: Method) -> None:
    given = limits(20, zones=(Zone(CORNER, np.array([3, 7, 11])),))
    where = first(method, [disc()] * 20, given)
    inside = shapely.contains_xy(CORNER.region.buffer(1), where.x, where.y)
    assert inside[[3, 7, 11]].all()
    assert not inside.all()


@METHODS
def test_what_is_given_is_kept_to_the_bit(method: Method) -> None:
    given = limits(4, x=np.array([33.3, NAN, 44.4, NAN]), y=np.array([66.6, 55.5, NAN, NAN]))
    where = first(method, [disc()] * 4, given)
    assert (where.x[0], where.y[0], where.y[1], where.x[2]) == (33.3, 66.6, 55.5, 44.4)
    assert np.isfinite([where.x, where.y]).all()


@pytest.mark.parametrize("method", ["distance-field", "medial-axis", "auto"])
def test_others_begin_round_what_is_placed_first(method: Method) -> None:
    big = limits(9, x=np.array([50.0, *np.full(8, NAN)]), y=np.array([50.0, *np.full(8, NAN)]))
    outlines = [square(4.0), *[disc()] * 8]
    where = first(method, outlines, big)
    assert overlap_area(placed(outlines, where)) < 0.02 * 8 * 25 * np.pi


@METHODS
def test_all_may_be_placed(method: Method) -> None:
    given = limits(2, x=np.array([30.0, 60.0]), y=np.array([40.0, 50.0]))
    assert first(method, [disc()] * 2, given).x.tolist() == [30.0, 60.0]


def test_lines_and_zones_together() -> None:
    image = np.ones((4, 6))
    given = limits(
        3, x=np.array([2.4, NAN, NAN]), y=np.array([NAN, 3.4, NAN]),
        zones=(Zone(box(0, 0, 4, 2), np.array([0, 2])),),
    )  # fmt: skip
    assert [
        None if home is None else home.tolist() for home in allowed_pixels(given, image, 1.0)
    ] == [
        [2, 8],
        [18, 19, 20, 21, 22, 23],
        [0, 1, 2, 3, 6, 7, 8, 9],
    ]


def test_a_zone_that_no_pixel_shows_is_no_bound_at_the_start() -> None:
    given = limits(1, zones=(Zone(box(0, 0, 0.01, 0.01), np.array([0])),))
    assert allowed_pixels(given, np.ones((4, 4)), 1.0) == [None]


def test_items_that_fill_all_leave_all() -> None:
    image, where = np.ones((4, 4)), poses([2.0], [2.0], 0.0, 9.0)
    assert around(image, 1.0, [square()], where, np.arange(1)) is image


def test_relocating_leaves_held_items_and_keeps_zones(rng: np.random.Generator) -> None:
    heap = poses(np.full(6, 50.0), np.full(6, 50.0), 0.0, 8.0)
    given = limits(6, x=np.array([50.0, *np.full(5, NAN)]), zones=(Zone(CORNER, np.array([1, 2])),))
    after = relocated(round_container(), [disc()] * 6, heap, np.arange(6), rng, given)
    assert (after.x[0], after.y[0]) == (50.0, 50.0)
    assert shapely.contains_xy(CORNER.region.buffer(2), after.x[[1, 2]], after.y[[1, 2]]).all()
    assert np.hypot(after.x - 50, after.y - 50)[3:].min() > 5
