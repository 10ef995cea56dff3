"""Copies for voids: in the void, of the right turn, none where nothing fits."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from packwork.fields.distance_transform import distance_inside
from packwork.geometry.outline import Outline
from packwork.scene.container import Container
from packwork.start.voids import SECTORS, copies_for_voids, fitted, free_rays, void_centres
from scenes import disc, square, star

ANY = np.ones(SECTORS, dtype=bool)
UPRIGHT = np.arange(SECTORS) == 0


def board(*holes: shapely.Geometry) -> tuple[Container, list[Outline]]:
    """A square of 100, all taken but for some holes."""
    whole = shapely.box(0, 0, 100, 100)
    solid = whole.difference(shapely.union_all(list(holes)))
    return Container("board", "", Outline.from_region(whole), 100, 100), [
        Outline.from_region(solid)
    ]


def copies(holes: list[shapely.Geometry], sorts: list[Outline], **changes: object) -> object:
    container, placed = board(*holes)
    count = len(sorts)
    asked = {
        "most": 10, "smallest": np.full(count, 0.5), "largest": np.full(count, 50.0), "gap": 0.0,
        "rng": np.random.default_rng(1),
    } | changes  # fmt: skip
    return copies_for_voids(container, placed, sorts, ANY, **asked)


def test_each_void_gets_a_copy_as_large_as_it_is() -> None:
    centres = np.array([[20.0, 30.0], [70.0, 60.0]])
    found = copies([shapely.Point(c).buffer(r) for c, r in zip(centres, (15, 9), strict=True)],
                   [disc()])  # fmt: skip
    np.testing.assert_allclose(np.column_stack([found.poses.x, found.poses.y]), centres, atol=0.2)
    assert np.all((found.poses.scale > [14.2, 8.2]) & (found.poses.scale <= [15, 9]))


def test_a_gap_is_kept_and_bounds_hold() -> None:
    hole = [shapely.Point(50, 50).buffer(20)]
    assert copies(hole, [disc()], gap=3.0).poses.scale[0] <= 17
    assert copies(hole, [disc()], largest=np.full(1, 4.0)).poses.scale[0] == 4.0
    assert len(copies(hole, [disc()], smallest=np.full(1, 21.0)).sort) == 0


def test_the_sort_that_covers_most_is_taken() -> None:
    found = copies([shapely.box(40, 40, 60, 60)], [star(), square()])
    assert found.sort.tolist() == [1]
    assert np.sin(4 * found.poses.angle[0]) == pytest.approx(0, abs=1e-9)


def test_a_long_item_lies_along_a_long_void() -> None:
    bar = Outline.from_rings([np.array([[-8.0, -1], [8, -1], [8, 1], [-8, 1]])])
    container, placed = board(shapely.box(10, 10, 16, 80))
    options = {"most": 1, "smallest": np.full(1, 0.1), "largest": np.full(1, 50.0), "gap": 0.0,
               "rng": np.random.default_rng(0)}  # fmt: skip
    along = copies_for_voids(container, placed, [bar], ANY, **options).poses
    across = copies_for_voids(container, placed, [bar], UPRIGHT, **options).poses
    assert abs(np.sin(along.angle[0])) > 0.9
    assert across.angle[0] == 0
    assert along.scale[0] > 4 * across.scale[0]
    assert 40 < along.y[0] < 50


def test_no_void_no_copy() -> None:
    container, placed = board()
    found = copies_for_voids(
        container, placed, [disc()], ANY, most=5, smallest=np.zeros(1), largest=np.ones(1),
        gap=0.0, rng=np.random.default_rng(0),
    )  # fmt: skip
    assert len(found.sort) == len(found.poses) == 0


def test_an_empty_container_is_one_void() -> None:
    container, _ = board()
    found = copies_for_voids(
        container, [], [disc()], ANY, most=5, smallest=np.zeros(1), largest=np.full(1, 99.0),
        gap=0.0, rng=np.random.default_rng(0),
    )  # fmt: skip
    assert 48 < found.poses.scale[0] <= 50.2


def test_rays_end_at_the_edge(rng: np.random.Generator) -> None:
    rows, columns = np.indices((80, 90))
    distance = distance_inside((rows - 40.0) ** 2 + (columns - 45.0) ** 2 < 30**2)
    (centre,) = void_centres(distance, 1)
    assert np.abs(free_rays(distance, centre[None]) - 30).max() < 1.5


def test_fits_are_those_of_the_farthest_point() -> None:
    scales, _ = fitted(np.full((1, SECTORS), 10.0), [disc(), star()], ANY)
    np.testing.assert_allclose(scales[0], [10, 10], rtol=0.01)
