"""Outlines as a level sees them."""

from __future__ import annotations

import numpy as np
import pytest

from packwork.geometry.outline import Outline
from packwork.solve.outlines import CLEFT_PX, DETAIL_PX, MARGIN_RUNGS, simplify_at_scales
from scenes import box, disc, square


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
