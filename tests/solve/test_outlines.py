"""Outlines as levels see them, and all items in one array."""

from __future__ import annotations

import numpy as np
import pytest

from numerics import assert_gradient
from packwork.arrays import FloatArray
from packwork.geometry.affine import stretched
from packwork.geometry.outline import Outline
from packwork.geometry.simplify import hull
from packwork.solve import outlines as module
from packwork.solve.outlines import (
    CLEFT_PX,
    DETAIL_PX,
    MARGIN_RUNGS,
    Ensemble,
    simplify_at_scales,
    simplify_for_level,
    stand_ins,
)
from scenes import as_array, box, disc, from_array, placed, poses, square, star


def test_exact_gives_the_outlines_themselves() -> None:
    outlines = [star(), disc()]
    assert all(a is b for a, b in zip(stand_ins(outlines, "exact"), outlines, strict=True))


def test_a_hull_has_no_bays() -> None:
    (found,) = stand_ins([star()], "hull")
    assert found.area == pytest.approx(hull(star()).area)
    assert len(found.points) == 5


def test_hulls_of_copies_are_made_once(monkeypatch: pytest.MonkeyPatch) -> None:
    made: list[Outline] = []
    monkeypatch.setattr(module, "hull", lambda outline: made.append(outline) or hull(outline))
    first, second = star(), square()
    found = stand_ins([first, second, first, first], "hull")
    assert made == [first, second]
    assert found[0] is found[2] is found[3]


def test_a_fine_level_keeps_more_points_than_a_coarse_one() -> None:
    fine_disc = disc(1.0, 512)
    coarse, fine = (
        len(simplify_at_scales([fine_disc], np.ones(1), px_per_cu)[0].points)
        for px_per_cu in (5.0, 500.0)
    )
    assert coarse < fine <= 512


def test_nothing_a_pixel_could_tell_is_lost() -> None:
    outline = disc(1.0, 512)
    seen = simplify_at_scales([outline], np.ones(1), 10.0)[0]
    apart = outline.region.hausdorff_distance(seen.region)
    assert apart <= (DETAIL_PX + CLEFT_PX) / 10.0 * 1.01


def test_copies_of_about_one_size_share_one_outline() -> None:
    outline = disc()
    seen = simplify_at_scales([outline, outline, outline], np.array([1.0, 1.01, 9.0]), 10.5)
    assert seen[0] is seen[1]
    assert seen[0] is not seen[2]


def test_margins_of_many_sizes_are_made_once_a_step_of_size() -> None:
    """Of 3,000 marks of a chart each had one of its own."""
    outline = disc()
    scales = np.geomspace(1.0, 4.0, 500)
    seen = simplify_at_scales([outline] * 500, scales, 50.0, margin_cu=0.2)
    assert len({id(one) for one in seen}) <= 2 * MARGIN_RUNGS + 1
    margins = (np.array([one.extent for one in seen]) - outline.extent) / 2 * scales
    assert np.abs(margins / 0.2 - 1).max() < 2 ** (1 / MARGIN_RUNGS) - 1 + 0.03


@pytest.mark.parametrize(("px_per_cu", "is_closed"), [(0.5, True), (200.0, False)])
def test_clefts_below_a_pixel_are_closed(px_per_cu: float, is_closed: bool) -> None:
    cleft = Outline.from_region(square(10.0).region - box(-0.1, -10, 0.1, 5).region)
    seen = simplify_at_scales([cleft], np.ones(1), px_per_cu)[0]
    assert bool(seen.area > 398.5) == is_closed


def test_without_a_stretch_outlines_are_as_a_level_sees_them() -> None:
    outlines = [disc(1.0, 256), star()]
    where = poses([0.0, 0.0], 0.0, 0.0, [3.0, 5.0])
    seen = simplify_for_level(outlines, where, 2.0)
    for got, expected in zip(seen, simplify_at_scales(outlines, where.scale, 2.0), strict=True):
        np.testing.assert_array_equal(got.points, expected.points)


@pytest.mark.parametrize("stretch", [1.0, 1.7, 0.2])
def test_a_margin_is_as_wide_on_all_sides_on_the_canvas(stretch: float) -> None:
    where = poses([0.0], [0.0], 0.0, 4.0, stretch)
    seen = simplify_for_level([square()], where, 50.0, margin_cu=0.5)
    true, grown = placed([square()], where)[0], placed(seen, where)[0]
    assert np.abs(np.subtract(true.bounds, grown.bounds)).tolist() == pytest.approx(
        [0.5] * 4, abs=DETAIL_PX / 50.0
    )


def test_a_stretched_outline_has_the_detail_of_its_shape() -> None:
    wide = disc(1.0, 512).mapped(stretched(16.0))
    where = poses([0.0, 0.0], 0.0, 0.0, 10.0, [16.0, 1.0])
    in_pose, as_drawn = simplify_for_level([disc(1.0, 512), wide], where, 1.0)
    np.testing.assert_allclose(in_pose.mapped(stretched(16.0)).points, as_drawn.points, atol=1e-12)


def test_copies_stretched_about_alike_share_one_outline() -> None:
    outline = disc()
    where = poses(np.zeros(4), 0.0, 0.0, 1.0, [1.9, 2.1, 1.0, 0.5])
    first, second, plain, upright = simplify_for_level([outline] * 4, where, 9.0)
    assert first is second
    assert len({id(o) for o in (first, plain, upright)}) == 3


PX_PER_CU = 0.75


def holed() -> Outline:
    """Square with a square hole off its middle."""
    return Outline.from_region(box(-3, -3, 3, 3).region - box(-1, -2, 2, 1).region)


def test_points_stand_where_the_matrix_puts_them(rng: np.random.Generator) -> None:
    outlines = [square(), holed(), star()]
    where = poses(*rng.normal(size=(3, 3)), [0.5, 2.0, 3.0], [1.0, 0.4, 2.5])
    points = Ensemble(outlines).place(where, PX_PER_CU)
    expected = np.concatenate([outline.points for outline in placed(outlines, where)])
    np.testing.assert_allclose(points, PX_PER_CU * expected, atol=1e-12)


def test_rings_start_where_their_items_put_them() -> None:
    starts = Ensemble([square(), holed(), square()]).ring_starts
    assert starts.tolist() == [0, 4, 8, 12, 16]


@pytest.mark.parametrize("outlines", [[star()], [square(), holed(), disc(2.0, 7), star()]])
def test_gather_is_the_transpose_of_the_derivative_of_place(
    outlines: list[Outline], rng: np.random.Generator
) -> None:
    n = len(outlines)
    ensemble = Ensemble(outlines)
    at = np.column_stack([rng.normal(size=(n, 3)), rng.uniform(-1, 1, (n, 2))])
    pull = rng.normal(size=ensemble.place(from_array(at), PX_PER_CU).shape)

    def value(numbers: FloatArray) -> float:
        return float(np.vdot(pull, ensemble.place(from_array(numbers), PX_PER_CU)))

    ensemble.place(from_array(at), PX_PER_CU)
    gathered = ensemble.gather(pull, from_array(at), PX_PER_CU).copy()
    assert_gradient(value, gathered, at, error=1e-7)


def test_as_array_and_from_array_are_inverse(rng: np.random.Generator) -> None:
    where = poses(rng.normal(size=4), 1.0, 2.0, rng.uniform(1, 2, 4), rng.uniform(1, 2, 4))
    again = from_array(as_array(where))
    np.testing.assert_allclose(again.scale, where.scale)
    np.testing.assert_allclose(again.stretch, where.stretch)
    np.testing.assert_array_equal(again.x, where.x)


def test_sums_per_item_are_sums_over_its_rings() -> None:
    ensemble = Ensemble([square(), holed(), square()])
    assert ensemble.per_item(np.array([1.0, 20.0, 300.0, 4.0])).tolist() == [1.0, 320.0, 4.0]
