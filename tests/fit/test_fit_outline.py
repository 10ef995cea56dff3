"""Fitted outlines: near, simple, the same again, and honest about what they are."""

from __future__ import annotations

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

import packwork as pw
import scenes
from packwork.arrays import FloatArray
from packwork.errors import RecipeError, ShapeError
from packwork.fit import fitted
from packwork.fit.chains import flattened
from packwork.fit.fitted import FitEnding, FittedOutline, fit_outline
from packwork.geometry.outline import Outline
from packwork.geometry.polygon import signed_area
from packwork.geometry.simplify import simplified
from strategies import star_rings

FRAME = Outline.from_region(shapely.box(0, 0, 20, 12) - shapely.Point(8, 6).buffer(4))
ISLANDS = Outline.from_region(
    shapely.MultiPolygon([shapely.box(20 * k, 0, 20 * k + 4 + 3 * k, 9) for k in range(3)])
)
LEAST_IOU = {"sunburst": 0.97, "smile": 0.98, "twig": 0.98, "donut": 0.999, "cat": 0.995}


def assert_sound(result: FittedOutline) -> None:
    outline = result.outline
    assert outline.region.is_valid
    assert outline.area == pytest.approx(outline.region.area)
    assert shapely.MultiLineString([shapely.LinearRing(r) for r in outline.rings]).is_simple
    assert len(result.controls) == len(outline.rings)
    for chain, ring in zip(result.controls, outline.rings, strict=True):
        drawn = np.concatenate(flattened(chain, fitted.FLATNESS * outline.extent))
        assert signed_area(drawn) == pytest.approx(signed_area(ring), rel=0.01)


@pytest.mark.parametrize("name", LEAST_IOU)
def test_icons_are_met(name: str) -> None:
    (item,) = pw.read_items([name])
    result = pw.fit_outline(item.outline)
    assert_sound(result)
    assert result.is_fitted
    assert sum(len(chain) for chain in result.controls) == 20
    assert result.iou >= LEAST_IOU[name]


@given(ring=star_rings(), curves=st.integers(4, 24))
def test_a_fit_never_crosses_itself(ring: FloatArray, curves: int) -> None:
    outline = Outline.from_rings([ring])
    result = fit_outline(outline, curves)
    assert_sound(result)
    assert 0.3 < result.iou <= 1 + 1e-9


@given(ring=star_rings())
def test_the_number_is_the_exact_overlap(ring: FloatArray) -> None:
    outline = Outline.from_rings([ring])
    result = fit_outline(outline, 8)
    both = outline.region.union(result.outline.region).area
    shared = outline.region.intersection(result.outline.region).area
    assert result.iou == pytest.approx(shared / both)


def test_a_hole_stays_a_hole() -> None:
    result = fit_outline(FRAME, 12)
    assert_sound(result)
    assert [signed_area(ring) > 0 for ring in result.outline.rings] == [True, False]
    assert result.iou > 0.995


def test_parts_share_the_curves() -> None:
    result = fit_outline(ISLANDS, 20)
    assert_sound(result)
    assert sum(len(chain) for chain in result.controls) == 20
    assert min(len(chain) for chain in result.controls) >= 4
    assert result.kept == 0
    assert result.iou > 0.995


def test_the_smallest_rings_are_kept_where_curves_run_out() -> None:
    result = fit_outline(ISLANDS, 8)
    assert_sound(result)
    assert result.kept == 1
    kept = min(range(3), key=lambda k: abs(signed_area(ISLANDS.rings[k])))
    assert signed_area(result.outline.rings[kept]) == signed_area(ISLANDS.rings[kept])


def test_a_fit_is_the_same_again_and_remembered() -> None:
    first = fit_outline(FRAME, 12)
    assert fit_outline(Outline(FRAME.points.copy(), FRAME.starts), 12) is first
    again = fitted.fit_anew(FRAME, 12)
    for one, two in zip(first.controls, again.controls, strict=True):
        assert np.array_equal(one, two)
    assert fit_outline(FRAME, 13) is not first


@pytest.mark.parametrize("factor", [1e-6, 1e6])
@pytest.mark.parametrize("shift", [0.0, 1e5])
def test_units_do_not_matter(factor: float, shift: float) -> None:
    star = scenes.star()
    there = Outline(factor * (star.points + shift), star.starts)
    result = fit_outline(there, 10)
    assert result.is_fitted
    assert result.iou == pytest.approx(fit_outline(star, 10).iou, abs=2e-3)


def test_a_triangle_is_met() -> None:
    triangle = Outline.from_rings([np.array([[0, 0], [4, 0], [1, 3.0]])])
    for curves in (4, 20):
        assert fit_outline(triangle, curves).iou > 0.995


def test_a_sliver_thinner_than_a_pixel_is_met() -> None:
    sliver = Outline.from_rings([np.array([[0, 0], [1, 0], [1, 1e-3], [0, 1e-3]])])
    result = fit_outline(sliver)
    assert_sound(result)
    assert result.iou > 0.9


@pytest.mark.parametrize(("failures", "curves"), [(1, 10), (3, 10), (4, 8), (7, 8)])
def test_a_coarser_fit_is_taken_where_the_finest_crosses_itself(
    failures: int, curves: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    calls = []

    def not_at_first(chain: FloatArray, tolerance: float) -> FloatArray | None:
        calls.append(tolerance)
        return chain if len(calls) > failures else None

    monkeypatch.setattr(fitted, "without_loops", not_at_first)
    result = fitted.fit_anew(scenes.star(), 10)
    assert result.ending is FitEnding.COARSER
    assert result.is_fitted
    assert len(result.controls[0]) == curves


def test_the_outline_itself_is_the_last_resort(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(fitted, "without_loops", lambda chain, tolerance: None)
    star = scenes.star()
    result = fitted.fit_anew(star, 10)
    assert_sound(result)
    assert result.ending is FitEnding.SIMPLIFIED
    assert not result.is_fitted
    expected = simplified(star, fitted.FALLBACK * star.extent)
    assert np.array_equal(result.outline.points, expected.points)


@pytest.mark.parametrize(
    ("curves", "problem"),
    [
        (1, "must be 4 to 100, not 1"),
        (101, "must be 4 to 100, not 101"),
        (7.5, "must be a whole number such as 20, not 7.5"),
        (True, "must be a whole number such as 20, not True"),
        ("20", "must be a whole number such as 20, not '20'"),
    ],
)
def test_what_cannot_be_asked_is_refused(curves: int, problem: str) -> None:
    with pytest.raises(RecipeError, match=f"^curves: {problem}$"):
        fit_outline(scenes.square(), curves)


def test_numbers_too_large_to_reckon_with_are_refused() -> None:
    for large, said in ((1e300, r"at most 1e\+50"), (np.inf, "finite"), (np.nan, "finite")):
        with pytest.raises(ShapeError, match=f"^points must be {said}"):
            fit_outline([(0, 0), (1, 0), (1, 1), (0, large)])


@pytest.mark.parametrize(
    "points",
    [
        [[0, 0], [4, 4], [4, 0], [0, 4.0]],
        [[0, 0], [1, 0], [2, 0.0]],
        [[0, 0], [0, 3], [3, 0.0]],
    ],
    ids=["bow tie", "no area", "inside out"],
)
def test_what_is_no_region_is_refused(points: list[list[float]]) -> None:
    with pytest.raises(ShapeError, match=r"crosses itself|no area"):
        fit_outline(Outline.from_rings([np.array(points)]))
