"""The road that uses share: how far it is from a run to its levels, and who follows it."""

from __future__ import annotations

import importlib
import inspect
from typing import Any

import numpy as np
import pytest

import packwork as pw
from packwork import uses
from packwork.pipeline.state import RunContext
from packwork.progress import NOBODY, Step, together
from packwork.recipe import make_recipe
from packwork.scene.pose import Poses
from packwork.solve.solver import solve

QUICK: dict[str, Any] = {"effort": "draft", "levels": "50", "epochs": 4, "items": ["star"]}

ONE = np.ones(1)


class Told:
    """Keeps how far a run is said to be."""

    every = 1

    def __init__(self) -> None:
        self.progress: list[float] = []

    def on_step(self, step: Step) -> None:
        self.progress.append(step.progress)


def step(progress: float) -> Step:
    return Step(0, 1, 50, 1, progress, Poses(ONE, ONE, ONE, ONE), lambda: (0.0, 0.0, 0.0))


def test_few_calls_lead_from_a_run_to_its_levels(monkeypatch: pytest.MonkeyPatch) -> None:
    ways: list[list[str]] = []

    def seen(*given: Any) -> Any:
        names = [frame.function for frame in inspect.stack()[1:]]
        ways.append(names[: names.index("fill")][::-1])
        return solve(*given)

    monkeypatch.setattr(importlib.import_module("packwork.steps.levels"), "solve", seen)
    uses.fill(make_recipe(container="circle", count=3, **QUICK))
    assert ways == [["run", "run_steps", "run"]]


def test_several_that_are_tried_share_the_progress() -> None:
    told = Told()
    for turn, _ in RunContext(told).part(0.5, 1.0).turns("ab"):
        turn.observer.on_step(step(1.0))
    assert told.progress == [0.75, 1.0]


def test_after_a_stop_no_other_is_tried() -> None:
    assert [one for _, one in RunContext(stop=lambda: True).turns("abc")] == ["a"]


def test_nobody_is_told_of_anything_and_is_no_part_of_an_audience() -> None:
    told = Told()
    assert together(NOBODY, told) is told
    NOBODY.on_step(step(0.5))
    assert NOBODY.every % (7 * 11 * 13) == 0


def test_a_run_that_is_not_recorded_has_no_track() -> None:
    assert pw.fill("circle", "star", count=2, effort="draft", levels="50").track is None
