"""Words one under another: inside, apart, and in the order and at the sizes that cover most."""

from __future__ import annotations

from itertools import combinations, permutations

import numpy as np
import pytest
import shapely

from packwork.geometry.outline import Outline
from packwork.readers.builtin import builtin_container
from packwork.start.stacked_lines import stacked_lines

SIZES = np.array([[330.0, 80], [150, 75], [200, 90], [300, 110]])
BOXES = np.column_stack([SIZES * [-0.5, -0.8], SIZES * [0.5, 0.2]])


def boxes_of(found: tuple[np.ndarray, np.ndarray], boxes: np.ndarray = BOXES) -> np.ndarray:
    scale, shifts = found
    return np.asarray(shapely.box(*(scale[:, None] * boxes + np.tile(shifts, 2)).T))


@pytest.mark.parametrize("name", ["circle", "heart", "square", "bear", "star", "bird", "tree"])
def test_lines_lie_inside_and_apart_and_are_not_too_uneven(name: str) -> None:
    room = builtin_container(name).outline
    found = stacked_lines(room, BOXES, 9.0, 30.0)
    if found is None:
        assert name in ("star", "bird", "tree")
        return
    boxes = boxes_of(found)
    assert shapely.covers(room.region.buffer(1e-6), boxes).all()
    for one, other in combinations(range(len(boxes)), 2):
        # Words of one line stand on one base line.
        is_abreast = abs(found[1][one, 1] - found[1][other, 1]) < 2.0
        least = found[0][one] * 30 - 1e-6 if is_abreast else 9.0 - 1e-6
        assert boxes[one].distance(boxes[other]) >= least
    assert found[0].max() <= 3.6 * found[0].min()


def test_words_stand_on_either_side_of_a_notch_and_side_by_side_in_wide_lines() -> None:
    heart = builtin_container("heart").outline
    boxes = np.tile([[-100.0, -70, 100, 0]], (6, 1))
    found = stacked_lines(heart, boxes, 5.0, 30.0)
    assert found is not None
    placed = boxes_of(found, boxes)
    assert shapely.covers(heart.region.buffer(1e-6), placed).all()
    rows = np.unique(found[1][:, 1].round(3))
    assert len(rows) < 6
    on_top = found[1][found[1][:, 1] < rows[0] + 1e-2, 0]
    middle = heart.bounds[0] + heart.bounds[2]
    assert (on_top < middle / 2).any()
    assert (on_top > middle / 2).any()


def test_lines_keep_out_of_slits_between_the_rows_that_are_looked_at() -> None:
    slits = [shapely.box(x, 0, x + 0.5, 600) for x in (100, 250, 400)]
    flat = [shapely.box(0, y, 420, y + 0.2) for y in (101.7, 303.4)]
    room = Outline.from_region(
        shapely.difference(shapely.box(0, 0, 600, 600), shapely.union_all([*flat, *slits[:1]]))
    )
    found = stacked_lines(room, BOXES, 9.0)
    assert found is None or shapely.covers(room.region.buffer(1e-6), boxes_of(found)).all()


def test_the_order_of_words_makes_no_difference_to_what_they_cover() -> None:
    room = builtin_container("circle").outline
    covered = []
    for order in permutations(range(3)):
        found = stacked_lines(room, BOXES[list(order)], 9.0)
        assert found is not None
        covered.append((found[0] ** 2 * SIZES[list(order)].prod(axis=1)).sum())
    np.testing.assert_allclose(covered, covered[0], rtol=1e-9)


def test_a_room_of_two_parts_has_lines_in_none_that_would_leave_it() -> None:
    left, right = Outline.box(0, 0, 40, 90).region, Outline.box(60, 0, 90, 90).region
    room = Outline.from_region(shapely.union(left, right))
    found = stacked_lines(room, BOXES, 1.0)
    assert found is not None
    assert shapely.covers(left, boxes_of(found)).all()
