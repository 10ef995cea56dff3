"""One item by itself keeps its own pose where that costs no room."""

from __future__ import annotations

import numpy as np
import pytest

from packwork import uses
from packwork.recipe import make_recipe
from packwork.scene.container import Container
from scenes import box, flat_item


def _angle_and_scale(container: Container, width: float, **options: object) -> tuple[float, float]:
    item = flat_item("bar", box(-width / 2, -10, width / 2, 10))
    recipe = make_recipe(
        container="tile", items=["bar"], effort="draft", levels="50,100", **options
    )
    run = uses.fill(recipe, [item], container)
    assert run.certified
    assert run.layout.manifest["recipe"]["rotate"] == options.get("rotate", "free")
    poses = run.layout.poses
    return float(np.degrees(poses.angle[0])), float(poses.scale[0])


TILE = Container("tile", "tile", box(10, 30, 90, 70), 100.0, 100.0)
TOWER = Container("tower", "tower", box(30, 10, 70, 90), 100.0, 100.0)


@pytest.mark.parametrize("seed", [0, 1])
def test_one_item_that_fits_upright_stays_upright(seed: int) -> None:
    angle, scale = _angle_and_scale(TILE, 40.0, seed=seed)
    assert angle == 0
    assert scale == pytest.approx(2.0, rel=0.02)


def test_one_item_that_fits_better_turned_is_turned() -> None:
    angle, scale = _angle_and_scale(TOWER, 40.0)
    assert scale > 1.5
    assert abs(abs(angle) % 180 - 90) < 15


def test_an_angle_that_is_asked_for_holds() -> None:
    angle, _ = _angle_and_scale(TILE, 40.0, rules=[{"items": "bar", "pin": {"angle_deg": 30}}])
    assert angle == pytest.approx(30)
