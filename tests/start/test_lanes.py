"""Lanes of words along limbs: order, sizes, what is set again, and no two on one place."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import shapely

from packwork.geometry.curves import Curve
from packwork.start.lane_sizes import LARGER
from packwork.start.lanes import SPACE, Lanes, WordOnLine, WordShape
from packwork.start.limbs import Limb

ANGLES = np.linspace(0.0, 4 * np.pi, 4_000)
SPIRAL = Limb(
    Curve((100 - 4 * ANGLES)[:, None] * np.column_stack([np.cos(ANGLES), np.sin(ANGLES)])),
    np.full(4_000, 10.0),
)
SHAPES = [WordShape(2.0 + k % 4, 0.75) for k in range(60)]


def filled(wanted: np.ndarray, limb: Limb = SPIRAL, least: float = 2.0) -> Lanes:
    lanes = Lanes(SHAPES, wanted, least, 0.5)
    lanes.fill(limb)
    return lanes


def boxes(found: list[WordOnLine]) -> list[shapely.Polygon]:
    """Words as strips along their lines."""
    strips = []
    for one in found:
        line = one.line.at(np.linspace(one.start, one.end, 60))
        strips.append(shapely.LineString(line).buffer(0.74 * one.size / 2, cap_style="flat"))
    return strips


def test_all_words_come_once_before_any_comes_again() -> None:
    lanes = filled(np.geomspace(14.0, 3.0, 60))
    assert lanes.left == []
    assert {one.word for one in lanes.found} == set(range(60))


def test_words_do_not_meet() -> None:
    strips = np.array(boxes(filled(np.geomspace(14.0, 3.0, 60)).found))
    first, second = shapely.STRtree(strips).query(strips, predicate="intersects")
    shared = shapely.area(shapely.intersection(strips[first], strips[second]))
    assert shared[first != second].max(initial=0.0) < 0.1


def test_sizes_go_by_what_is_wanted_and_by_the_width() -> None:
    lanes = filled(np.geomspace(14.0, 3.0, 60))
    sizes = {one.word: one.size for one in lanes.found}
    assert sizes[0] > 2 * sizes[59]
    assert max(sizes.values()) * 0.75 < 20


def test_no_word_is_smaller_than_the_least() -> None:
    thin = Limb(SPIRAL.axis, np.linspace(10.0, 0.0, 4_000))
    lanes = filled(np.geomspace(14.0, 3.0, 60), thin, 3.0)
    assert min(one.size for one in lanes.found) >= 3.0


def test_words_read_from_left_to_right() -> None:
    for one in filled(np.full(60, 8.0)).found:
        middle = (one.start + one.end) / 2
        assert np.cos(one.line.angle(middle, one.size)) > -0.3


def test_few_words_are_set_again_until_the_limb_is_full() -> None:
    lanes = Lanes(SHAPES[:4], np.full(4, 27.0), 2.0, 0.5)
    lanes.fill(SPIRAL)
    assert len(lanes.found) > 8
    length = sum(one.end - one.start for one in lanes.found)
    assert length > 0.75 * SPIRAL.axis.length


def test_a_heavy_word_that_is_held_down_leaves_no_gap_after_lighter_ones() -> None:
    # Letters that reach below the line make the heaviest smaller than the lane allows others.
    shapes = [WordShape(3.0, 1.5), *[WordShape(3.0, 0.75)] * 3]
    lanes = Lanes(shapes, np.array([40.0, 35.0, 34.0, 33.0]), 2.0, 0.5)
    lanes.fill(Limb(Curve(np.array([[0.0, 0.0], [160.0, 0.0]])), np.array([10.0, 10.0])))
    sizes = {one.word: one.size for one in lanes.found[::-1]}
    assert max(sizes.values()) <= LARGER * sizes[0] + 1e-9
    firsts = {one.word: one for one in lanes.found[::-1]}.values()
    rooms = [b.start - a.end for a, b in pairwise(sorted(firsts, key=lambda one: one.start))]
    assert np.ptp(rooms) < 0.2 * sizes[0]


def test_words_set_again_go_round_a_bend_in_thinner_lanes() -> None:
    turn = np.linspace(np.pi / 2, -np.pi / 2, 400)
    bend = np.column_stack([300 + 30 * np.cos(turn), 30 * np.sin(turn)])
    points = np.concatenate([[[0.0, 30.0]], bend, [[0.0, -30.0]]])
    lanes = Lanes(SHAPES[:6], np.geomspace(24.0, 8.0, 6), 2.0, 0.5)
    lanes.fill(Limb(Curve(points), np.full(len(points), 20.0)))
    assert lanes.left == []
    strips = shapely.union_all(boxes(lanes.found))
    room = shapely.LineString(bend).buffer(19, cap_style="flat")
    assert shapely.area(shapely.intersection(strips, room)) > 0.65 * room.area


def test_a_word_that_fits_nowhere_is_left() -> None:
    short = Limb(Curve(np.array([[0.0, 0.0], [20.0, 0.0]])), np.array([10.0, 10.0]))
    lanes = filled(np.full(60, 20.0), short, 10.0)
    assert lanes.left


def test_words_begin_half_a_space_from_the_top_of_a_loop_however_wide_it_is() -> None:
    angles = np.linspace(0.5, 2.5, 2_001) * np.pi
    circle = 100 * np.column_stack([np.cos(angles), np.sin(angles)])
    loop = Limb(Curve(circle), np.full(len(circle), 40.0), is_loop=True)
    found = filled(np.full(60, 6.0), loop).found
    heights = [-one.line.at(np.array([one.start, one.end])) for one in found]
    at_top = [
        (np.abs(ends[:, 0]).min(), one.size)
        for one, ends in zip(found, heights, strict=True)
        if ends[:, 1].min() > 0 and np.abs(ends[:, 0]).min() < one.size
    ]
    lanes = 80 / max(one.size for one in found)
    assert len(at_top) >= lanes
    assert max(away / size for away, size in at_top) < SPACE
