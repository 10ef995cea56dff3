"""Search for larger items of one common scale: never worse, within what was asked, repeated."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
import shapely

from packwork import uses
from packwork.pipeline.state import RunContext, RunState, run_steps
from packwork.recipe import make_recipe
from packwork.steps import finish
from packwork.steps.separate import ROUNDS, Separate

pytestmark = pytest.mark.compiled

ICONS = ["anchor", "bell", "cactus", "guitar", "kite", "leaf", "snail", "spiral", "teacup", "whale"]


def before(**options: Any) -> RunState:
    asked = {"container": "heart", "items": ["star", "moon", "bell"], "count": 6}
    job = uses.read(make_recipe(**asked | {"sizes": "shared"} | options))
    steps = job.use.steps(job)
    at = next(k for k, step in enumerate(steps) if isinstance(step, Separate))
    return run_steps(steps[:at], RunState.of(job), RunContext())


def outlines(state: RunState) -> list[Any]:
    return [
        item.outline.mapped(state.poses.matrix(k)).region for k, item in enumerate(state.job.items)
    ]


@pytest.mark.parametrize(
    "options",
    [
        {},
        {"rotate": "20", "padding": 4},
        {"rotate": "0,90"},
        {"container": "square"},
        {"container": "ring"},
        {"weights": {"star": 3, "moon": 1, "bell": 2}},
    ],
)
def test_items_grow_by_one_factor_or_stay_and_keep_to_what_was_asked(
    options: dict[str, Any],
) -> None:
    state = before(**options)
    found = Separate().run(state, RunContext())
    factors = found.poses.scale / state.poses.scale
    assert factors[0] >= 1.0
    np.testing.assert_allclose(factors, factors[0], rtol=1e-12)
    assert not found.conflicts
    regions, room = outlines(found), state.job.container.outline.region
    gap = state.job.plan.gap
    for k, region in enumerate(regions):
        assert room.buffer(1e-6).covers(region)
        assert all(shapely.distance(region, other) >= gap - 1e-6 for other in regions[:k])
        assert all(region.intersection(other).area < 1e-9 for other in regions[:k])
    if options.get("rotate") == "20":
        assert np.abs(found.poses.angle).max() <= math.radians(20) + 1e-9
    if options.get("rotate") == "0,90":
        assert set(np.degrees(found.poses.angle).round(6)) <= {0.0, 90.0}


def test_thirty_items_come_out_larger() -> None:
    growths = []
    for seed in range(3):
        state = before(container="whale", items=ICONS, count=30, seed=seed)
        found = Separate().run(state, RunContext())
        growths.append(found.poses.scale[0] / state.poses.scale[0])
    # How much goes by the layout that it is given, which no two machines make alike.
    assert np.mean(growths) > 1.005


def test_no_round_makes_trials_whatever_the_effort(monkeypatch: pytest.MonkeyPatch) -> None:
    state, trials = before(effort="best", count=4), list[int]()
    real = finish.finish

    def counted(*args: Any, **more: Any) -> Any:
        trials.append(args[3].trials)
        return real(*args, **more)

    monkeypatch.setattr(finish, "finish", counted)
    found = Separate().run(state, RunContext())
    assert len(trials) == ROUNDS
    assert set(trials) == {0}
    assert found.job is state.job


def test_a_search_repeats_and_a_stop_leaves_all_as_it_is() -> None:
    state = before()
    first, second = (Separate().run(state, RunContext()) for _ in range(2))
    np.testing.assert_array_equal(first.poses.x, second.poses.x)
    np.testing.assert_array_equal(first.poses.scale, second.poses.scale)
    assert Separate().run(state, RunContext(stop=lambda: True)) is state
