"""The paper's pixel measures against rectangles that can be counted by hand."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial import cKDTree

from packwork.geometry.outline import Outline
from packwork.metrics.pixel import DISTANCE_CANVAS, RESOLUTION, pixel_metrics
from packwork.scene.container import Container
from scenes import box, square_container

SIDE = 60.0
"""Twenty pixels to a canvas unit, so that whole units are whole pixels."""


def canvas(margin: float = 0.0) -> Container:
    return square_container(SIDE, margin)


def test_nothing_placed_covers_nothing() -> None:
    met = pixel_metrics([], canvas())
    assert (met.LC, met.LC_ratio, met.OO, met.EA, met.LnU) == (0, 0, 0, 0, 0)


def test_all_covered_is_an_infinite_ratio_and_even() -> None:
    met = pixel_metrics([box(0, 0, SIDE, SIDE)], canvas())
    assert (met.LC, met.LC_ratio, met.OO, met.EA, met.LnU) == (1, float("inf"), 0, 0, 0)


def test_two_rectangles_apart() -> None:
    met = pixel_metrics([box(0, 0, 30, 20), box(30, 40, 60, 60)], canvas())
    assert pytest.approx(1200 / 3600) == met.LC
    assert met.LC_ratio == pytest.approx(1200 / 2400)
    assert (met.OO, met.EA) == (0, 0)


def test_what_is_covered_three_times_counts_once() -> None:
    met = pixel_metrics([box(0, 0, 30, 30), box(20, 0, 50, 30), box(25, 0, 40, 30)], canvas())
    assert pytest.approx(1500 / 3600) == met.LC
    assert pytest.approx(600 / 3600) == met.OO


def test_overlap_outside_the_container_counts_too() -> None:
    met = pixel_metrics([box(0, 0, 20, 60), box(0, 0, 20, 60)], canvas(margin=15))
    assert pytest.approx(1200 / 900) == met.OO
    assert pytest.approx((1200 - 150) / 900) == met.EA
    assert pytest.approx(150 / 900) == met.LC


def test_what_sticks_out_is_counted_on_the_canvas() -> None:
    met = pixel_metrics([box(-30, 20, 20, 40)], canvas(margin=10))
    assert pytest.approx(200 / 1600) == met.EA
    assert pytest.approx(200 / 1600) == met.LC


def test_holes_are_not_covered() -> None:
    ring = Outline.from_region(box(10, 10, 50, 50).region - box(20, 20, 40, 40).region)
    assert pytest.approx(1200 / 3600) == pixel_metrics([ring], canvas()).LC


def test_unevenness_of_a_half_covered_canvas() -> None:
    met = pixel_metrics([box(0, 0, 30, 60)], canvas())
    # Centres of uncovered columns are 1, 2, ... 600 pixels from the last covered column.
    distances = np.arange(1, RESOLUTION // 2 + 1) * DISTANCE_CANVAS / RESOLUTION
    assert met.LnU == pytest.approx(np.mean(distances**2))


def test_unevenness_by_brute_force(rng: np.random.Generator) -> None:
    corners = np.sort(rng.integers(0, 60, (4, 2, 2)), axis=1)
    boxes = [(*low, *(high + 2)) for low, high in corners.astype(float)]
    met = pixel_metrics([box(*b) for b in boxes], canvas(margin=5))
    centres = (np.indices((RESOLUTION, RESOLUTION)) + 0.5) * SIDE / RESOLUTION
    rows, columns = centres
    covered = np.zeros(rows.shape, dtype=bool)
    for left, top, right, bottom in boxes:
        covered |= (columns > left) & (columns < right) & (rows > top) & (rows < bottom)
    inside = (np.abs(rows - SIDE / 2) < 25) & (np.abs(columns - SIDE / 2) < 25)
    tree = cKDTree(centres[:, covered].T)
    gaps = centres[:, inside & ~covered].T[::97]
    expected = np.mean((tree.query(gaps)[0] * DISTANCE_CANVAS / SIDE) ** 2)
    assert met.LnU == pytest.approx(expected, rel=0.01)
    assert pytest.approx(np.mean(covered[inside])) == met.LC


def test_measures_do_not_depend_on_the_size_of_the_canvas() -> None:
    outlines = [(5, 5, 30, 40), (20, 30, 50, 58)]
    for factor in (0.1, 7.0):
        region = square_container(SIDE * factor, 5 * factor)
        scaled = [box(*(factor * v for v in b)) for b in outlines]
        small = pixel_metrics([box(*b) for b in outlines], canvas(5))
        assert pixel_metrics(scaled, region) == small


def test_a_canvas_may_be_longer_than_high() -> None:
    wide = Container("wide", "wide", box(0, 0, 60, 20), 60.0, 20.0)
    assert pytest.approx(0.25) == pixel_metrics([box(0, 0, 15, 20)], wide).LC
