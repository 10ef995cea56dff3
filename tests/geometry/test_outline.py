"""Outlines: measures, and the way from a region to rings and back."""

from __future__ import annotations

import copy
import pickle
from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import given

from packwork.arrays import FloatArray
from packwork.errors import ShapeError
from packwork.geometry.affine import similarity
from packwork.geometry.outline import PORTION, Outline, joined, regions
from packwork.geometry.polygon import Region, region, signed_area
from strategies import rounded_sets, star_rings

FRAME = shapely.box(0, 0, 20, 20) - shapely.box(2, 2, 18, 18)
ISLANDS = (
    FRAME | (shapely.box(5, 5, 15, 15) - shapely.box(8, 8, 12, 12)) | shapely.box(9, 9, 10, 10)
)
PINCHED = shapely.Polygon([(0, 0), (8, 0), (8, 8), (0, 8)], [[(4, 0), (5, 3), (3, 3)]])
KISSING = shapely.box(0, 0, 4, 4) | shapely.box(4, 4, 8, 8)
REGIONS = pytest.mark.parametrize(
    "shape", [shapely.box(1, 2, 4, 4), FRAME, ISLANDS, PINCHED, KISSING],
    ids=["box", "frame", "islands", "pinched", "kissing"],
)  # fmt: skip


@REGIONS
def test_region_to_outline_and_back(shape: Region) -> None:
    outline = Outline.from_region(shape)
    assert outline.region.equals(shape)
    assert outline.area == pytest.approx(shape.area)
    assert outline.bounds == shape.bounds
    np.testing.assert_allclose(outline.centroid, shapely.get_coordinates(shape.centroid)[0])


@given(rings=rounded_sets())
def test_any_region_survives_the_way_back(rings: list[FloatArray]) -> None:
    shape = region(rings, "evenodd")
    if shape.area < 1e-6:
        return
    outline = Outline.from_region(shape)
    assert outline.area == pytest.approx(shape.area)
    assert shapely.symmetric_difference(outline.region, shape).area < 1e-9


def test_rings_of_an_outline() -> None:
    outline = Outline.from_region(ISLANDS)
    assert [signed_area(r) > 0 for r in outline.rings].count(True) == 3
    assert len(outline.rings) == 5
    assert np.shares_memory(outline.rings[1], outline.points)
    assert sum(len(r) for r in outline.rings) == len(outline.points) == outline.starts[-1]


def test_points_are_read_only() -> None:
    outline = Outline.from_region(ISLANDS)
    assert len(outline.rings) == 5
    again = pickle.loads(pickle.dumps(outline))  # noqa: S301
    for one in (outline, again, copy.deepcopy(outline), outline.mapped(similarity(1, 2, 0, 3))):
        for points in (one.points, one.rings[2]):
            with pytest.raises(ValueError, match="read-only"):
                points[0] = 1.0
        assert np.shares_memory(one.rings[1], one.points)


def test_measures_of_a_square() -> None:
    square = Outline.from_rings([np.array([[-3.0, -1], [5, -1], [5, 4], [-3, 4]])])
    assert square.area == 40
    assert square.centroid.tolist() == [1.0, 1.5]
    assert square.bounds == (-3.0, -1.0, 5.0, 4.0)
    assert square.extent == 8
    assert square.radius == pytest.approx(np.hypot(5, 4))


@given(ring=star_rings())
def test_mapping_scales_area_and_carries_the_centroid(ring: FloatArray) -> None:
    outline = Outline.from_rings([ring])
    matrix = similarity(3.0, -2.0, 0.7, 1.5)
    mapped = outline.mapped(matrix)
    assert mapped.area == pytest.approx(outline.area * 1.5**2)
    np.testing.assert_allclose(mapped.centroid, matrix[:, :2] @ outline.centroid + matrix[:, 2])


def test_trouble_that_geos_overcomes_is_not_told(monkeypatch: pytest.MonkeyPatch) -> None:
    whole = shapely.build_area

    def troubled(lines: Region) -> Region:
        np.divide(np.zeros(1), np.zeros(1))
        return whole(lines)

    monkeypatch.setattr(shapely, "build_area", troubled)
    assert Outline.from_region(FRAME).region.equals(FRAME)


def test_joined_outlines_count_on() -> None:
    outlines = [Outline.from_region(shape) for shape in (FRAME, ISLANDS, KISSING)]
    points, starts = joined(outlines)
    rings = np.split(points, starts[1:-1])
    expected = [ring for outline in outlines for ring in outline.rings]
    assert len(rings) == len(expected)
    assert all((a == b).all() for a, b in zip(rings, expected, strict=True))


def test_no_outlines_join_to_nothing() -> None:
    points, starts = joined([])
    assert points.shape == (0, 2)
    assert starts.tolist() == [0]


def test_regions_made_together_are_those_made_one_by_one() -> None:
    shapes = [shapely.box(1, 2, 4, 4), FRAME, ISLANDS, PINCHED, KISSING]
    outlines = [Outline.from_region(shape) for shape in shapes]
    # A hole first, and one that lies in a later ring: by nesting alone.
    for order in ([1, 0], [0, 2, 1]):
        ring = (FRAME.exterior, FRAME.interiors[0], shapely.box(30, 0, 40, 9).exterior)
        rings = [shapely.get_coordinates(ring[k])[:-1] for k in order]
        turned = [
            r if (signed_area(r) > 0) == (k != 1) else r[::-1]
            for k, r in zip(order, rings, strict=True)
        ]
        outlines.append(Outline.from_rings(turned))
    found = regions(outlines)
    assert not any("region" in one.__dict__ for one in outlines[:5])
    expected = [copy.copy(one).region for one in outlines]
    assert [shapely.to_wkb(one) for one in found] == [shapely.to_wkb(one) for one in expected]
    many = regions(outlines[:1] * (PORTION + 1))
    assert shapely.area(many).tolist() == [6.0] * (PORTION + 1)


def test_a_silhouette_has_no_holes() -> None:
    silhouette = Outline.from_region(ISLANDS).without_holes()
    assert silhouette.region.equals(shapely.box(0, 0, 20, 20))
    assert len(Outline.from_region(KISSING).without_holes().rings) == 2


@pytest.mark.parametrize(
    ("points", "starts", "problem"),
    [
        ([[0, 0], [1, 0]], [0, 2], "at least three points"),
        (np.zeros((0, 2)), [0], "at least three points"),
        ([[0, 0], [1, 0], [1, np.nan]], [0, 3], "finite"),
        ([[0, 0], [1, 0], [1, 1]], [0, 4], "ring starts"),
    ],
)
def test_what_is_no_outline_is_refused(points: Any, starts: Any, problem: str) -> None:
    with pytest.raises(ShapeError, match=problem):
        Outline(points, starts)


@pytest.mark.parametrize(
    "shape", [shapely.Polygon(), shapely.LineString([(0, 0), (1, 1)]), shapely.Point(0, 0)]
)
def test_a_region_without_area_is_refused(shape: Region) -> None:
    with pytest.raises(ShapeError, match="no area"):
        Outline.from_region(shape)
