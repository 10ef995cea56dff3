"""Lists of steps: what was not asked is not on them, and what steps of steps do."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from packwork import uses
from packwork.pipeline.state import RunContext, RunState, RunStep, run_steps, share_of
from packwork.progress import Step
from packwork.recipe import make_recipe
from packwork.steps.control import BestOf, Replan, Retry, UnlessTight
from packwork.uses.icons import MANY

PLAIN = [
    "Place", "Levels", "Finish", "TellShortfalls", "Measure", "Advise", "TellOneColour",
]  # fmt: skip


def job(**options: Any) -> Any:
    return uses.read(
        make_recipe(**{"container": "circle", "items": ["star"], "count": MANY} | options)
    )


def names(**options: Any) -> list[str]:
    one = job(**options)
    return [type(step).__name__ for step in one.use.steps(one)]


def test_a_plain_run_is_six_steps() -> None:
    assert names() == PLAIN


@pytest.mark.parametrize("options", [{"count": 3}, {"count": MANY - 1, "effort": "draft"}])
def test_few_icons_are_begun_upright_and_alike_first(options: dict[str, Any]) -> None:
    assert names(**options) == ["Retry", "Replan", *PLAIN[3:]]
    assert names(**options, apart=True).count("Retry") == 0


@pytest.mark.parametrize(
    ("options", "more"),
    [
        ({"arrange": "right by=name", "items": ["star", "moon"], "padding": "0"}, {"UnlessTight"}),
        ({"force": ["down"]}, {"UnlessTight"}),
        ({"apart": True}, {"KindsApart", "CountBeside"}),
        ({"palette": "okabe-ito"}, {"Dress"}),
        ({"target_coverage": 0.8}, {"FillVoids"}),
        ({"stroke_width": "even"}, {"FinishThinner", "EvenLines"}),
        ({"count": "auto", "apart": True}, {"KindsApart", "CountBeside", "RemarkCount"}),
        ({"least_dpi": 90}, {"TellCoarse"}),
        ({"items": ["star", "moon"], "weights": {"star": 9, "moon": 1}}, {"TellLooseWeights"}),
        ({"sizes": "shared", "count": 8}, {"Separate"}),
        ({"sizes": "shared", "count": 8, "effort": "draft"}, set()),
        ({"sizes": "shared", "count": 41}, set()),
        ({"sizes": "shared", "force": ["down"]}, {"UnlessTight"}),
    ],
)
def test_each_wish_is_a_step_of_its_own(options: dict[str, Any], more: set[str]) -> None:
    extra = names(**options)
    for name in PLAIN:
        extra.remove(name)
    assert set(extra) == more


def test_lines_are_looked_at_where_most_items_are_drawn_in_lines(tmp_path: Path) -> None:
    line, filled = tmp_path / "line.svg", tmp_path / "filled.svg"
    line.write_text('<svg><path d="M0 0h99" stroke="red"/></svg>', encoding="utf-8")
    filled.write_text('<svg><path d="M0 0h99v99z" stroke="red"/></svg>', encoding="utf-8")
    found = names(items=[str(line), str(line), str(filled)], padding="0")
    assert set(found) - set(PLAIN) == {"TellLineWeights"}
    assert names(items=[str(line), str(filled)], padding="0") == PLAIN
    assert names(items=[str(line)], sizes="fixed").count("TellLineWeights") == 0


def test_a_film_is_recorded_by_steps_of_its_own() -> None:
    one = replace(job(), is_recorded=True)
    found = [type(step).__name__ for step in one.use.steps(one)]
    assert [name for name in found if name not in PLAIN] == ["StartRecording", "KeepTrack"]


def test_a_picture_is_shown_by_steps_of_its_own(tmp_path: Any) -> None:
    Image.linear_gradient("L").save(tmp_path / "grey.png")
    extra = set(names(picture=str(tmp_path / "grey.png"))) - set(PLAIN)
    assert extra == {"ShowPicture"}
    # A tint tells neighbours apart.
    assert "TellOneColour" not in names(picture=str(tmp_path / "grey.png"))


def test_without_an_exact_finish_nothing_of_it_is_listed() -> None:
    assert names(finish="none") == [
        name for name in PLAIN if name not in {"Finish", "TellShortfalls"}
    ]


DISCS = {"container": "circle", "items": ["circle"], "count": MANY, "sizes": "shared"}


def test_discs_in_proportion_jam_in_one_step() -> None:
    assert names(**DISCS) == ["JamDiscs", "TellShortfalls", "Measure", "Advise", "TellOneColour"]


@pytest.mark.parametrize(
    "wish",
    [
        {"count": 5},
        {"sizes": "free"},
        {"items": ["circle", "star"]},
        {"rules": [{"items": ["circle"], "rotate": "30"}]},
        {"force": ["down"]},
        {"apart": True},
        {"epochs": 3},
        {"start": "scatter"},
        {"finish": "none"},
    ],
)
def test_discs_of_which_more_is_asked_go_the_way_of_all_items(wish: dict[str, Any]) -> None:
    found = names(**DISCS | wish)
    assert "JamDiscs" not in found
    assert {"Place", "Levels"} <= set(found)


class Grow(RunStep):
    """Makes all items larger, and tells of it."""

    share = 1.0

    def __init__(self, factor: float) -> None:
        self._factor = factor

    def run(self, state: RunState, context: RunContext) -> RunState:
        poses = replace(state.poses, scale=state.poses.scale * self._factor)
        context.observer.on_step(
            Step(0, 1, 1, 1, 1.0, poses, lambda: (0.0, 0.0, 0.0), stage="levels")
        )
        return replace(state, poses=poses)


class Told:
    every = 1

    def __init__(self) -> None:
        self.progress: list[float] = []

    def on_step(self, step: Step) -> None:
        self.progress.append(step.progress)


@pytest.fixture(scope="module")
def state() -> RunState:
    found = RunState.of(job(count=3))
    return replace(found, poses=replace(found.poses, scale=np.ones(3)))


def largest(tried: Any, context: RunContext) -> RunState:
    del context
    return max(tried, key=lambda one: one.poses.scale[0])


def test_steps_share_the_progress(state: RunState) -> None:
    told = Told()
    found = run_steps([Grow(2.0), Grow(3.0)], state, RunContext(told))
    assert told.progress == [0.5, 1.0]
    assert found.poses.scale.tolist() == [6.0, 6.0, 6.0]
    assert state.poses.scale.tolist() == [1.0, 1.0, 1.0]


def test_the_best_list_is_gone_on_with_and_a_stop_leaves_the_first(state: RunState) -> None:
    best = BestOf([[Grow(2.0)], [Grow(5.0)], [Grow(3.0)]], largest)
    assert share_of([best]) == 1.0
    assert best.run(state, RunContext()).poses.scale[0] == 5.0
    assert best.run(state, RunContext(stop=lambda: True)).poses.scale[0] == 2.0


@pytest.mark.parametrize(("will_do", "expected"), [(True, 2.0), (False, 4.0)])
def test_a_second_try_begins_where_the_first_did(
    state: RunState, will_do: bool, expected: float
) -> None:
    step = Retry([Grow(2.0)], [Grow(4.0)], lambda _: will_do, largest)
    assert step.run(state, RunContext()).poses.scale[0] == expected


def test_what_is_tight_is_left_as_it_is(state: RunState) -> None:
    step = UnlessTight(Grow(2.0))
    assert step.run(replace(state, is_tight=True), RunContext()).poses.scale[0] == 1.0
    assert step.run(state, RunContext()).poses.scale[0] == 2.0


def test_a_new_plan_leaves_the_recipe(state: RunState) -> None:
    found = Replan(seed=9).run(state, RunContext())
    assert (found.job.plan.seed, state.job.plan.seed) == (9, 0)
    assert found.job.recipe is state.job.recipe


@pytest.mark.parametrize(
    "options",
    [
        {"stroke_width": "even"},
        {"apart": True},
        {"largest": "20"},
        {"smallest": "4"},
        {"repeat": "auto"},
        {"sizes": "graded"},
        {"hero": "mast=40%"},
        {"target_coverage": 0.6},
        {"finish": "none"},
    ],
)
def test_each_list_of_words_runs(options: dict[str, Any]) -> None:
    weights = {"mast": 3, "sail": 2, "oar": 1}
    quick = {"effort": "draft", "levels": "50", "epochs": 4} if "finish" in options else {}
    asked = uses.words_recipe("circle", weights, **{"effort": "draft"} | quick | options)
    found = uses.fill(asked)
    assert found.words is not None
    assert found.words.found == 3
    assert len(found.layout.items) + len(found.unplaced) >= 3
