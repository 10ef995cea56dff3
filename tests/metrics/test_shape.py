"""Whether a layout shows its container: rectangles that can be counted by hand."""

from __future__ import annotations

import pytest
import shapely

from packwork.geometry.outline import Outline
from packwork.metrics.pixel import REACH, shape_metrics
from packwork.scene.container import Container
from scenes import box, square_container

SIDE = 100.0


def with_tail() -> Container:
    """A square body with a thin tail to its right, half as long again."""
    body = shapely.box(0, 0, 60, 60)
    region = shapely.union(body, shapely.box(60, 25, 100, 35))
    return Container("tail", "tail", Outline.from_region(region), SIDE, SIDE)


def test_what_is_covered_shows_and_is_not_bare() -> None:
    found = shape_metrics([box(0, 0, SIDE, SIDE)], square_container(SIDE, 0))
    assert (found.bare, found.shape, found.parts, found.bare_parts) == (0, 1, 1, 0)


def test_nothing_placed_shows_nothing() -> None:
    found = shape_metrics([], square_container(SIDE, 0))
    assert (found.bare, found.shape, found.bare_parts) == (1, 0, 1)


def test_a_tail_without_items_is_missing() -> None:
    without = shape_metrics([box(0, 0, 60, 60)], with_tail())
    tail = 400 / 4000
    assert without.shape == pytest.approx(1 - tail, abs=0.01)
    assert without.bare == pytest.approx(tail * (1 - 3 / 40), abs=0.01)
    both = shape_metrics([box(0, 0, 60, 60), box(60, 25, 100, 35)], with_tail())
    assert (both.bare, both.shape) == (0, 1)


def test_gaps_that_the_eye_closes_do_not_count() -> None:
    gap = 2 * REACH * SIDE
    for width, closes in ((0.9 * gap, True), (1.2 * gap, False)):
        half = (SIDE - width) / 2
        halves = [box(0, 0, half, SIDE), box(SIDE - half, 0, SIDE, SIDE)]
        found = shape_metrics(halves, square_container(SIDE, 0))
        assert (found.shape > 0.995) == closes


def test_narrow_bays_of_the_container_count_for_neither() -> None:
    bars = [box(20.0 * k, 0, 20.0 * k + 17, SIDE) for k in range(5)]
    comb = shapely.union_all([bar.region for bar in bars] + [shapely.box(0, 90, 97, 100)])
    container = Container("comb", "comb", Outline.from_region(comb), SIDE, SIDE)
    assert shape_metrics(bars, container).shape > 0.97


def test_what_lies_outside_spoils_the_shape() -> None:
    container = square_container(SIDE, 20)
    within = shape_metrics([box(20, 20, 80, 80)], container)
    beyond = shape_metrics([box(20, 20, 82, 80)], container)
    assert within.shape == 1
    assert beyond.shape == pytest.approx(60 / 62, abs=0.01)


def test_empty_parts_are_counted_and_specks_are_not() -> None:
    islands = shapely.union_all(
        [shapely.box(0, 0, 40, 40), shapely.box(60, 0, 100, 40), shapely.box(50, 90, 50.4, 90.4)]
    )
    container = Container("islands", "islands", Outline.from_region(islands), SIDE, SIDE)
    found = shape_metrics([box(5, 5, 35, 35)], container)
    assert (found.parts, found.bare_parts) == (2, 1)


@pytest.mark.parametrize("factor", [0.01, 30.0])
def test_measures_do_not_depend_on_the_canvas(factor: float) -> None:
    region = shapely.affinity.scale(with_tail().outline.region, factor, factor, origin=(0, 0))
    large = Container("tail", "tail", Outline.from_region(region), SIDE * factor, SIDE * factor)
    items = [box(0, 0, 60 * factor, 60 * factor)]
    assert shape_metrics(items, large) == shape_metrics([box(0, 0, 60, 60)], with_tail())


def test_a_container_thinner_than_a_pixel_is_not_judged() -> None:
    hair = Container("hair", "hair", box(10, 50.1, 90, 50.11), SIDE, SIDE)
    assert shape_metrics([], hair).bare_parts == 0
