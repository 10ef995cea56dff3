"""A hero finds its own best place."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
import shapely

import packwork as pw
from packwork import uses
from packwork.geometry.outline import Outline
from packwork.recipe import make_recipe
from packwork.scene.container import Container
from packwork.scene.item import Item

QUICK: dict[str, Any] = {"effort": "draft", "levels": "50", "count": 20}

CROSS = shapely.union_all([shapely.box(-5, -1, 5, 1), shapely.box(-1, -5, 1, 5)])
SPEAR = shapely.box(-5, -1, 5, 1)


def blob(arms: int) -> Container:
    """A disc with thin arms, its middle off the canvas's."""
    disc = shapely.Point(130, 170).buffer(90)
    ends = [
        (130 + 230 * math.cos(2 * math.pi * k / arms), 170 + 230 * math.sin(2 * math.pi * k / arms))
        for k in range(arms)
    ]
    lines = [shapely.LineString([(130, 170), end]).buffer(12) for end in ends]
    return Container("blob", outline=Outline.of(shapely.union_all([disc, *lines])))


def made(container: Container, hero: Any, size: str, **more: Any) -> Any:
    recipe = make_recipe(container="square", hero=f"hero={size}", **{**QUICK, **more})
    items = [Item("hero", outline=hero), *pw.read_items(["star", "circle"])]
    return uses.fill(recipe, items=items, container=container)


def size_of_hero(run: Any) -> float:
    """Longer side over the canvas's."""
    layout = run.layout
    k = next(k for k, item in enumerate(layout.items) if item.name == "hero")
    return float(layout.items[k].outline.extent * layout.poses.scale[k] / layout.container.side)


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("size", ["25%", "33%"])
def test_a_hero_without_a_place_has_its_size(size: str, seed: int) -> None:
    run = made(blob(3), CROSS, size, seed=seed)
    assert size_of_hero(run) == pytest.approx(float(size[:-1]) / 100, rel=1e-3)
    assert run.is_as_asked


def test_it_turns_only_where_it_does_not_fit_upright() -> None:
    wide = Container("wide", outline=[(0, 0), (100, 0), (100, 30), (0, 30)])
    tall = Container("tall", outline=[(0, 0), (30, 0), (30, 100), (0, 100)])
    angles = []
    for container in (wide, tall):
        run = made(container, SPEAR, "80%")
        assert size_of_hero(run) == pytest.approx(0.8, rel=1e-3)
        k = [item.name for item in run.layout.items].index("hero")
        angles.append(abs(float(run.layout.poses.angle[k])))
    assert angles[0] == pytest.approx(0.0)
    assert math.radians(60) < angles[1] < math.radians(120)


def test_it_does_not_turn_further_than_items_may() -> None:
    tall = Container("tall", outline=[(0, 0), (30, 0), (30, 100), (0, 100)])
    run = made(tall, SPEAR, "80%", rotate="none")
    assert not run.is_as_asked
    assert "no place at that size" in " ".join(run.broken)


def test_of_items_of_one_kind_one_is_the_hero() -> None:
    recipe = make_recipe(container="square", hero="hero=40%", **QUICK)
    run = uses.fill(recipe, items=[Item("hero", outline=CROSS)])
    extents = np.sort(run.layout.poses.scale * run.layout.items[0].outline.extent)
    assert extents[-1] == pytest.approx(0.4 * run.layout.container.side, rel=1e-3)
    assert extents[-2] < 0.7 * extents[-1]
    assert run.is_as_asked
