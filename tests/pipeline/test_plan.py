"""A plan: numbers of one run, of which a part of it changes some and the recipe none."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest

from packwork import uses
from packwork.pipeline.plan.plan import Plan
from packwork.recipe import make_recipe
from scenes import round_container


def plan(**options: Any) -> Plan:
    return Plan.of(make_recipe(container="round", **options), round_container(50.0))


def test_lengths_are_those_of_the_canvas() -> None:
    found = plan(padding="2%", target_coverage=0.9, smallest="5%")
    side = round_container(50.0).side
    assert found.gap == pytest.approx(0.02 * side)
    assert found.voids.fills
    assert found.voids.smallest == pytest.approx(0.05 * side)
    assert not plan().voids.fills


def test_stage_options_follow_a_changed_field() -> None:
    whole = plan(effort="best")
    part = replace(whole, effort="draft", sizes="fixed", gap=4.0)
    assert part.solve_options().epochs < whole.solve_options().epochs
    assert part.solve_options().sizes == "fixed"
    assert part.solve_options().margin == 2.0
    assert "evenness" in whole.solve_options().losses
    assert "evenness" not in part.solve_options().losses


def test_the_recipe_of_a_run_is_what_was_asked() -> None:
    asked = make_recipe(
        container="circle", items=["star"], count=1, epochs=5, levels="16", rotate="free"
    )
    # One item by itself is tried upright too; that is nothing anybody asked for.
    run = uses.fill(asked)
    assert run.layout.manifest["recipe"] == asked.plain()
