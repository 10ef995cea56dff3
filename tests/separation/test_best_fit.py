"""Rectangles by best fit: nothing overlaps, counts are right, tilings are found."""

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from packwork.geometry.outline import Outline
from packwork.metrics.exact import exact_metrics
from packwork.separation.best_fit import best_fit

SIDES = st.integers(1, 12).map(float)
TRIES = 60
"""Of each preference, and at random: enough, for what lies wrongly may in any of them."""


@settings(deadline=None, max_examples=60)
@given(
    st.lists(st.tuples(SIDES, SIDES, st.integers(1, 5), st.booleans()), min_size=1, max_size=5),
    st.booleans(),
)
def test_all_that_has_room_lies_apart_on_the_sheets(
    kinds: list[tuple[float, float, int, bool]], is_strip: bool
) -> None:
    sizes = [[(w, h), (h, w)] if turns else [(w, h)] for w, h, _, turns in kinds]
    counts = [count for _, _, count, _ in kinds]
    sheet = math.inf if is_strip else 15.0, 12.0
    tries = iter(range(TRIES))
    found, _ = best_fit(sizes, counts, sheet, math.inf, 0, lambda: next(tries, None) is None)
    assert found.left == (0,) * len(kinds)
    laid = [one.kind for placed in found.sheets for one in placed]
    assert [laid.count(kind) for kind in range(len(kinds))] == counts
    for placed in found.sheets:
        boxes = []
        for one in placed:
            w, h = sizes[one.kind][one.turn]
            boxes.append(Outline.box(one.x, one.y, one.x + w, one.y + h))
        ground = Outline.box(0, 0, found.length if is_strip else 15.0, 12.0)
        assert exact_metrics(boxes, ground).is_clean


@pytest.mark.parametrize(
    ("sizes", "counts", "sheet"),
    [
        ([(100.0, 100.0)], [12], (400.0, 300.0)),
        ([(50.8 / 25.4, 50.8 / 25.4)], [25], (10.0, 10.0)),
        ([(0.1, 0.1)], [21], (0.7, 0.3)),
        ([(200.0, 100.0), (100.0, 100.0)], [4, 4], (400.0, 300.0)),
        ([(300.0, 100.0), (100.0, 200.0), (100.0, 100.0), (50.0, 100.0)], [2, 2, 1, 2], (400, 300)),
    ],
)
def test_tilings_are_found(
    sizes: list[tuple[float, float]], counts: list[int], sheet: tuple[float, float]
) -> None:
    turned = [[(w, h), (h, w)] for w, h in sizes]
    found, is_least = best_fit(turned, counts, sheet, 1, 0)
    assert (is_least, sum(found.left)) == (True, 0)
    assert found.length == pytest.approx(sheet[0], rel=1e-12)


def test_tries_end_where_they_are_stopped() -> None:
    asked = list[int]()

    def stop() -> bool:
        asked.append(1)
        return len(asked) == 2

    found, is_least = best_fit([[(2.0, 2.0)], [(9.0, 1.0)]], [5, 1], (4.0, 4.0), 1, 0, stop)
    assert (found.left, is_least, len(asked)) == ((1, 1), False, 2)


def test_what_has_no_room_is_left() -> None:
    found, is_least = best_fit([[(2.0, 2.0)], [(9.0, 1.0)]], [5, 1], (4.0, 4.0), 1, 0)
    assert (found.left, len(found.sheets[0]), is_least) == ((1, 1), 4, False)
