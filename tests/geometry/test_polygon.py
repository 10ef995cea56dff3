"""Raw rings to regions: fill rules by winding number, orientation, areas."""

from __future__ import annotations

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from numerics import winding_numbers
from packwork.arrays import FloatArray
from packwork.geometry import polygon
from packwork.geometry.polygon import (
    FillRule,
    Region,
    oriented_rings,
    polygon_parts,
    region,
    signed_area,
    silhouette,
    silhouette_area,
)
from strategies import (
    SEEDS,
    generators,
    lattice_rings,
    rounded,
    rounded_sets,
    star_rings,
    wild_rings,
)

RULES = pytest.mark.parametrize("rule", ["nonzero", "evenodd"])
BOW_TIE = np.array([[0, 0], [2, 2], [2, 0], [0, 2.0]])


def _square(low: float, high: float) -> FloatArray:
    return np.array([[low, low], [high, low], [high, high], [low, high]], dtype=np.float64)


def _is_filled(rings: list[FloatArray], points: FloatArray, rule: FillRule) -> FloatArray:
    winding = np.sum([winding_numbers(points, ring) for ring in rings], axis=0)
    return np.asarray(winding != 0 if rule == "nonzero" else winding % 2 != 0)


def _assert_fills(rings: list[FloatArray], rule: FillRule, shape: Region, side: int) -> None:
    """Compare with the rule on a lattice of points over (-6, 15), off the boundary."""
    ticks = -6 + 21 * (np.arange(side) + 0.5) / side
    points = np.stack(np.meshgrid(ticks, ticks), axis=-1).reshape(-1, 2)
    edges = shapely.MultiLineString([[*ring, ring[0]] for ring in rings])
    clear = shapely.distance(shapely.points(points), edges) > 1e-6
    expected = _is_filled(rings, points[clear], rule)
    np.testing.assert_array_equal(shapely.contains_xy(shape, *points[clear].T), expected)
    # A pixel that no edge crosses is judged right by its centre: the rest bounds the area.
    pixel = 21 / side
    near = shapely.distance(shapely.points(points), edges) <= pixel
    sampled = np.count_nonzero(_is_filled(rings, points, rule)) * pixel**2
    assert abs(sampled - shape.area) <= np.count_nonzero(near) * pixel**2 + 1e-9


@RULES
def test_a_bow_tie_keeps_both_halves(rule: FillRule) -> None:
    shape = region([BOW_TIE], rule)
    assert shape.area == 2.0
    assert len(polygon_parts(shape)) == 2
    assert shape.is_valid


@pytest.mark.parametrize(
    ("inner", "rule", "area"),
    [
        (_square(2, 4), "nonzero", 36.0),
        (_square(2, 4)[::-1], "nonzero", 32.0),
        (_square(2, 4), "evenodd", 32.0),
        (_square(2, 4)[::-1], "evenodd", 32.0),
    ],
    ids=["same way", "other way", "same way, even-odd", "other way, even-odd"],
)
def test_rules_differ_by_the_inner_ring(inner: FloatArray, rule: FillRule, area: float) -> None:
    assert region([_square(0, 6), inner], rule).area == area
    assert region([inner, _square(0, 6)], rule).area == area


def test_nested_rings_make_holes_and_islands() -> None:
    rings = [_square(0, 8), _square(1, 7)[::-1], _square(2, 6), _square(3, 5)[::-1]]
    for rule in ("nonzero", "evenodd"):
        shape = region(rings, rule)
        assert shape.area == 64 - 36 + 16 - 4
        assert len(polygon_parts(shape)) == 2


def test_a_pentagram_is_whole_or_hollow() -> None:
    turns = 2 * np.pi * np.arange(5) * 2 / 5
    star = np.column_stack([np.cos(turns), np.sin(turns)])
    whole, hollow = region([star], "nonzero"), region([star], "evenodd")
    assert len(polygon_parts(whole)) == 1
    assert len(polygon_parts(hollow)) == 5
    assert whole.contains(shapely.Point(0, 0))
    assert not hollow.contains(shapely.Point(0, 0))


@pytest.mark.parametrize(
    "ring",
    [
        np.repeat(_square(0, 2), 3, axis=0),
        np.concatenate([_square(0, 2), _square(0, 2)[:1]]),
        np.concatenate([_square(0, 2), [[0, 2], [0, 1]]]),
        np.concatenate([_square(0, 2), [[-3, 2], [0, 2]]]),
    ],
    ids=["every point thrice", "closed", "point on an edge", "spike"],
)
@RULES
def test_repeats_and_spikes_change_nothing(ring: FloatArray, rule: FillRule) -> None:
    shape = region([ring], rule)
    assert shape.area == pytest.approx(4.0)
    assert shape.is_valid


@pytest.mark.parametrize(
    "rings",
    [[], [np.zeros((0, 2))], [np.ones((5, 2))], [np.array([[0, 0], [3, 1.0]])],
     [np.array([[0, 0], [3, 1], [6, 2.0]])]],
    ids=["none", "empty", "one place", "two points", "straight"],
)  # fmt: skip
@RULES
def test_what_has_no_area_is_empty(rings: list[FloatArray], rule: FillRule) -> None:
    shape = region(rings, rule)
    assert shape.area == 0
    assert polygon_parts(shape) == []
    assert oriented_rings(shape) == []


@RULES
@given(ring=wild_rings().map(rounded))
def test_fills_what_the_rule_says(ring: FloatArray, rule: FillRule) -> None:
    _assert_fills([ring], rule, region([ring], rule), 24)


@RULES
@given(ring=lattice_rings(-5, 14))
def test_fills_what_the_rule_says_on_a_lattice(ring: FloatArray, rule: FillRule) -> None:
    """Edges that overlap, touch and cross in each other's ends."""
    _assert_fills([ring], rule, region([ring], rule), 24)


@RULES
@given(rings=rounded_sets())
def test_fills_what_the_rule_says_for_several_rings(
    rings: list[FloatArray], rule: FillRule
) -> None:
    shape = region(rings, rule)
    _assert_fills(rings, rule, shape, 24)
    assert shape.is_valid


@RULES
@given(rings=rounded_sets(), seed=SEEDS, turn=st.integers(1, 7))
def test_order_and_start_of_rings_do_not_matter(
    rings: list[FloatArray], seed: int, turn: int, rule: FillRule
) -> None:
    order = np.random.default_rng(seed).permutation(len(rings))
    other = [np.roll(rings[k], turn, axis=0) for k in order]
    assert region(other, rule).area == pytest.approx(region(rings, rule).area, abs=1e-9)


@given(rings=rounded_sets())
def test_oriented_rings_run_as_they_should(rings: list[FloatArray]) -> None:
    shape = region(rings, "evenodd")
    parts = polygon_parts(shape)
    turned = oriented_rings(shape)
    assert len(turned) == sum(1 + len(p.interiors) for p in parts)
    assert sum(signed_area(r) > 0 for r in turned) == len(parts)
    assert sum(map(signed_area, turned)) == pytest.approx(shape.area, abs=1e-9)
    assert all((ring[0] != ring[-1]).any() for ring in turned)


def test_clockwise_on_screen_is_positive() -> None:
    assert signed_area(_square(0, 3)) == 9
    assert signed_area(_square(0, 3)[::-1]) == -9


@given(ring=star_rings(), turn=st.integers(0, 12), away=st.floats(-1e6, 1e6))
def test_area_does_not_depend_on_start_or_place(ring: FloatArray, turn: int, away: float) -> None:
    area = shapely.Polygon(ring).area
    assert signed_area(np.roll(ring, turn, axis=0)) == pytest.approx(area)
    assert signed_area(ring + away) == pytest.approx(area, abs=1e-12 * (1e3 + abs(away)) * 10)


def test_polygon_parts_of_mixtures() -> None:
    mixture = shapely.GeometryCollection(
        [
            shapely.box(0, 0, 1, 1),
            shapely.LineString([(0, 0), (1, 1)]),
            shapely.MultiPolygon([shapely.box(2, 0, 3, 1), shapely.box(4, 0, 5, 1)]),
            shapely.Point(9, 9),
            shapely.Polygon(),
        ]
    )
    assert [p.area for p in polygon_parts(mixture)] == [1.0, 1.0, 1.0]


@given(generators())
@settings(deadline=None, max_examples=40)
def test_the_area_of_a_silhouette_is_that_area(rng: np.random.Generator) -> None:
    boxes = [shapely.box(x, y, x + w, y + w) for x, y, w in rng.uniform(1, 9, (6, 3))]
    shape = shapely.union_all(boxes[:3]) - shapely.union_all(boxes[3:5])
    assert silhouette_area(shape) == pytest.approx(silhouette(shape).area)
    ring = shapely.box(0, 0, 30, 30) - shapely.box(0.5, 0.5, 29, 29)
    assert silhouette_area(ring.union(shape)) == pytest.approx(900)


def test_few_and_many_edges_are_found_alike() -> None:
    """Each point's ray meets the boxes of the same edges with an index and without one."""
    rng = np.random.default_rng(3)
    a = rng.integers(0, 9, (60, 2)).astype(float)
    b = a + rng.integers(-3, 4, (60, 2))
    queries = rng.integers(0, 18, (25, 2)) / 2
    found = [
        set(zip(*(part.tolist() for part in near(queries, a, b)), strict=True))
        for near in (polygon._beside, polygon._beside_each)
    ]
    assert found[0] == found[1]
    assert len(found[0]) > 100
