"""Outlines as a level sees stretched items: detail and margin as on the canvas."""

from __future__ import annotations

import numpy as np
import pytest

from packwork.geometry.affine import stretched
from packwork.solve.outlines import DETAIL_PX, simplify_at_scales, simplify_for_level
from scenes import disc, placed, poses, square, star


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
