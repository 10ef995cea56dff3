"""Few icons lie near upright, in sizes that are alike, unless they are asked to lie otherwise."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from packwork import pipeline
from packwork.geometry.simplify import hull_areas
from packwork.pipeline.state import RunContext, RunState
from packwork.recipe import make_recipe
from packwork.uses import read
from packwork.uses.icons import ALIKE, FEW, MANY, NEAR_UPRIGHT, STARTS, alike_upright


def few(count: int, **options: Any) -> pipeline.Run:
    return pipeline.run(read(make_recipe(container="heart", count=count, **options)))


@pytest.mark.parametrize("count", [3, 5])
def test_few_icons_are_near_upright_and_alike(count: int) -> None:
    layout = few(count).layout
    turned = np.abs(np.remainder(layout.poses.angle + math.pi, 2 * math.pi) - math.pi)
    assert layout.manifest["certified"]
    assert np.degrees(turned).max() <= NEAR_UPRIGHT + 0.1
    seen = layout.poses.scale * np.sqrt(hull_areas([item.outline for item in layout.items]))
    assert seen.max() <= 1.1 * ALIKE**2 * seen.min()


def test_turns_and_sizes_are_let_go_ever_more_from_few_to_many() -> None:
    plans = []
    for count in (FEW, FEW + 1, 12, 25, 40, MANY - 1):
        job = read(make_recipe(container="heart", count=count))
        plans.append(alike_upright(job)[0][0].run(RunState.of(job), RunContext()).job.plan)
    turns = [math.degrees(plan.rotation.limit or 0) for plan in plans]
    ratios = [plan.size_ratio for plan in plans]
    assert turns == sorted(turns)
    assert ratios == sorted(ratios)
    assert turns[0] == pytest.approx(NEAR_UPRIGHT)
    assert turns[4] < 45 < 160 < turns[5] < 180
    assert ratios[0] == ALIKE < ratios[5] < 2


def test_forty_icons_lie_nearly_upright_and_keep_what_was_asked_in_their_plan() -> None:
    done = few(40, effort="draft")
    turned = np.abs(np.remainder(done.layout.poses.angle + math.pi, 2 * math.pi) - math.pi)
    assert np.degrees(turned).max() < 45
    assert done.layout.manifest["certified"]
    assert done.layout.manifest["recipe"]["rotate"] == "free"


@pytest.mark.parametrize(
    ("options", "starts"),
    [
        ({"count": 3}, STARTS["normal"]),
        ({"count": FEW + 1}, STARTS["normal"] - 1),
        ({"count": MANY - 1}, 1),
        ({"count": MANY}, 0),
        ({"count": 3, "effort": "draft"}, 1),
        ({"count": 28, "container": "page", "tile": "half-drop", "canvas": "200x200"}, 0),
        ({"count": 3, "time": 2.0}, 1),
        ({"count": 3, "target_coverage": 0.9}, 0),
        ({"count": 3, "force": "down"}, 0),
        ({"count": 3, "epochs": 20}, 0),
    ],
)
def test_what_is_asked_of_places_stays_as_it_is(options: dict[str, Any], starts: int) -> None:
    assert len(alike_upright(read(make_recipe(**{"container": "heart", **options})))) == starts


@pytest.mark.parametrize(("rotate", "ratio"), [("none", 3.0), ("180", 2.0), ("90", 3.0)])
def test_angles_and_ratios_that_are_asked_for_are_kept(rotate: str, ratio: float) -> None:
    job = read(make_recipe(container="heart", count=3, rotate=rotate, size_ratio=ratio))
    tried = alike_upright(job)
    assert tried
    for first, *_ in tried:
        plan = first.run(RunState.of(job), RunContext()).job.plan
        assert plan.rotation == job.plan.rotation
        assert plan.size_ratio == ratio
