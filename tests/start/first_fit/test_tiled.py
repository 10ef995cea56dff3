"""Many items of one common size, on tiles: nothing meets, and room goes by the smaller of two."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from packwork.geometry.outline import Outline
from packwork.metrics.exact import exact_metrics
from packwork.scene.container import Container
from packwork.scene.pose import Poses
from packwork.start.first_fit.tiled import tiled_fit

BAR = Outline.from_rings([np.array([[-2.0, -1], [2, -1], [2, 1], [-2, 1]])])
DISC = Container("", "", Outline.from_rings([50 + 50 * np.array(
    [[np.cos(t), np.sin(t)] for t in np.linspace(0, 2 * np.pi, 90, endpoint=False)]
)]), 100.0, 100.0)  # fmt: skip
SCALES = np.linspace(3.0, 1.0, 60)


@cache
def _fitted(apart: tuple[float, float], turn: float) -> Poses:
    turned = np.where(np.arange(len(SCALES)) % 3, 0.0, turn)
    rng = np.random.default_rng(0)
    found = tiled_fit(DISC, [BAR] * len(SCALES), SCALES, turned, rng, apart=apart, margin_cu=0.1)
    assert found is not None
    return found


@pytest.mark.parametrize("turn", [0.0, np.pi / 2])
def test_nothing_meets_and_proportions_are_kept(turn: float) -> None:
    poses = _fitted((0.0, 0.0), turn)
    placed = [BAR.mapped(poses.matrix(k)) for k in range(len(SCALES))]
    found = exact_metrics(placed, DISC.outline)
    assert found.is_clean
    assert found.min_gap >= 0.05
    assert found.coverage > 0.6
    np.testing.assert_allclose(poses.scale / poses.scale[0], SCALES / SCALES[0])


def test_items_of_a_row_keep_room_by_the_smaller_one_but_not_from_the_edge() -> None:
    poses = _fitted((1.5, 0.0), 0.0)
    half = 2 * poses.scale
    for k in range(len(SCALES)):
        is_beside = np.abs(poses.y - poses.y[k]) < poses.scale[k] + poses.scale
        is_beside[k] = False
        gaps = np.abs(poses.x - poses.x[k]) - half - half[k]
        room = 1.5 * np.minimum(poses.scale, poses.scale[k])
        # Pixels are a tenth of a unit.
        assert (gaps[is_beside] >= room[is_beside] - 0.1).all()
    from_edge = 50 - np.hypot(np.abs(poses.x - 50) + half, np.abs(poses.y - 50) + poses.scale)
    assert from_edge.min() < 1.5 * poses.scale.min() / 2


def test_small_items_spread_where_large_ones_bound_the_size(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    scales = np.array([20.0] * 2 + [1.0] * 60)

    def farthest(seed: int) -> float:
        """From a point inside to the nearest item's middle."""
        rng = np.random.default_rng(seed)
        found = tiled_fit(DISC, [BAR] * 62, scales, np.zeros(62), rng, margin_cu=0.1)
        assert found is not None
        x, y = np.meshgrid(np.arange(100.0), np.arange(100.0))
        is_in = np.hypot(x - 50, y - 50) < 48
        away = np.hypot(x[is_in][:, None] - found.x, y[is_in][:, None] - found.y)
        large = np.abs(y[is_in][:, None] - found.y[:2]) < found.scale[0]
        return float(away[~large.any(axis=1)].min(axis=1).max())

    even = [farthest(seed) for seed in range(3)]
    monkeypatch.setattr("packwork.start.first_fit.tiled.MOST_LOOSE", 0)
    assert np.median(even) < 0.6 * np.median([farthest(seed) for seed in range(3)])


def test_room_takes_ink() -> None:
    assert _fitted((1.5, 0.0), 0.0).scale[0] < _fitted((0.0, 0.0), 0.0).scale[0]


def test_a_run_that_is_stopped_at_once_has_no_size() -> None:
    args = DISC, [BAR] * 9, np.ones(9), np.zeros(9), np.random.default_rng(0)
    assert tiled_fit(*args, stop=lambda: True) is None
