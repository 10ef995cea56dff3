"""Which items count as trapped, and where they are moved."""

from __future__ import annotations

import numpy as np
import pytest

from packwork.arrays import FloatArray
from packwork.geometry.outline import Outline
from packwork.solve.level import Level
from packwork.solve.relocate_trapped import (
    MOST_AT_ONCE,
    SNUGNESS,
    relocate_trapped,
    violation_shares,
)
from scenes import disc, overlap_area, placed, poses, square, square_container, taken


def level_of(outlines: list[Outline], margin: float = 5.0) -> tuple[Level, FloatArray]:
    level = Level(square_container(100.0, margin), outlines, 200)
    return level, np.array([outline.area for outline in outlines])


@pytest.mark.parametrize(
    ("x", "y", "share"),
    [
        (50.0, 50.0, 0.0),
        (5.0, 50.0, 0.5),
        (5.0, 5.0, 0.75),
        (0.0, 50.0, 1.0),
        (-5.0, 50.0, 1.0),
        (-50.0, 250.0, 1.0),
    ],
    ids=["inside", "half out", "in a corner", "at the canvas' edge", "over it", "off it"],
)
def test_share_outside_the_container_counts(x: float, y: float, share: float) -> None:
    level, _ = level_of([square()])
    where = poses([x], [y], 0.0, 5.0)
    assert violation_shares(level, where, level.density(where))[0] == pytest.approx(share, abs=1e-3)


def test_share_overlapped_counts_for_each_of_the_two() -> None:
    level, _ = level_of([square(), square()])
    where = poses([40.0, 50.0], [50.0, 50.0], 0.0, [10.0, 5.0])
    shares = violation_shares(level, where, level.density(where))
    np.testing.assert_allclose(shares, [50 / 400, 0.5], atol=1e-3)


def test_a_clean_layout_is_left_alone() -> None:
    level, areas = level_of([square(), disc()])
    where = poses([30.0, 70.0], [50.0, 50.0], 0.0, 10.0)
    after, relocations = relocate_trapped(level, where, areas, where.scale, where.scale)
    assert not relocations
    assert after is where


def test_the_rescued_shrinks_to_fit_the_void_within_its_bounds() -> None:
    outlines = [square(), disc()]
    level, areas = level_of(outlines)
    where = poses([38.0, 38.0], [50.0, 50.0], 0.0, [32.0, 20.0], [1.0, 1.5])
    after, (relocation,) = relocate_trapped(level, where, areas, where.scale / 8, where.scale)
    assert relocation.item == 1
    free = (95 - 70) / 2
    assert after.scale[1] == pytest.approx(np.sqrt(SNUGNESS * np.pi / areas[1]) * free, rel=0.05)
    assert after.x[1] == pytest.approx(82.5, abs=1)
    assert (after.x[0], after.scale[0]) == (38.0, 32.0)
    assert after.stretch.tolist() == [1.0, 1.5]


def test_a_fixed_size_is_kept_even_where_it_does_not_fit() -> None:
    level, areas = level_of([square(), disc()])
    where = poses([38.0, 38.0], [50.0, 50.0], 0.0, [32.0, 20.0])
    after, _ = relocate_trapped(level, where, areas, where.scale, where.scale)
    assert after.scale[1] == 20.0


def test_only_the_worst_few_move_at_once_each_to_a_place_of_its_own() -> None:
    outlines: list[Outline] = [square()] + [disc() for _ in range(29)]
    level, areas = level_of(outlines)
    where = poses(np.full(30, 25.0), np.full(30, 50.0), 0.0, [18.0, *np.full(29, 4.0)])
    after, relocations = relocate_trapped(level, where, areas, where.scale, where.scale)
    assert len(relocations) == int(MOST_AT_ONCE * 30)
    moved = [relocation.item for relocation in relocations]
    ends = placed([outlines[k] for k in moved], taken(after, moved))
    assert overlap_area(ends) == 0


def test_nobody_is_moved_when_there_is_no_void() -> None:
    level, areas = level_of([square(), disc()])
    where = poses([50.0, 50.0], [50.0, 50.0], 0.0, [80.0, 5.0])
    after, relocations = relocate_trapped(level, where, areas, where.scale, where.scale)
    assert not relocations
    np.testing.assert_array_equal(after.x, where.x)
