"""Progress goes from 0 to 1 once, whatever a run does; losses of one's own see what they need."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import packwork as pw
from packwork.arrays import Image

QUICK: dict[str, Any] = {"epochs": 40, "levels": "32,64", "seed": 1}
CALLS: dict[str, Any] = {
    "fill": lambda told: pw.fill("circle", ["star"], count=5, observer=told, **QUICK),
    "gaps": lambda told: pw.fill(
        "circle", ["star"], count=5, max_items=9, observer=told, **QUICK
    ),
    "words": lambda told: pw.words("circle", {"owl": 2, "fox": 1}, observer=told, **QUICK),
    "pile": lambda told: pw.pile("square", "circle", count=4, size="20%", observer=told),
    "goes on": lambda told: pw.fill(
        "circle", ["star"], count=3, start=pw.Poses([200, 400, 300], [300, 300, 450], scale=0.2),
        observer=told, **QUICK,
    ),
}  # fmt: skip


@pytest.mark.parametrize("call", CALLS.values(), ids=CALLS)
def test_progress_goes_from_0_to_1_once(call: Any) -> None:
    steps: list[pw.Step] = []
    layout = call(steps.append)
    told = [step.progress for step in steps]
    assert told == sorted(told)
    assert 0 <= told[0] <= told[-1] == 1
    assert told.count(1) == 1
    assert steps[-1].stage == "done"
    np.testing.assert_array_equal(steps[-1].poses.x, layout.poses.x)
    assert steps[-1].coverage == pytest.approx(layout.metrics["exact"]["LC"])


def test_steps_name_their_stage() -> None:
    stages: list[str] = []
    CALLS["gaps"](lambda step: stages.append(step.stage))
    assert list(dict.fromkeys(stages)) == ["levels", "finish", "gaps", "done"]
    stages.clear()
    CALLS["pile"](lambda step: stages.append(step.stage))
    assert list(dict.fromkeys(stages)) == ["pile", "done"]


def test_an_observer_is_told_something_or_refused() -> None:
    with pytest.raises(pw.RecipeError, match="observer: is int; give a function of a step"):
        pw.fill("circle", "star", observer=3, **QUICK)  # type: ignore[arg-type]


def zero(density: Image, container: Image) -> pw.Term:
    return pw.Term(0.0, np.zeros_like(density))


def rest(placed: pw.PosedItems) -> pw.PoseTerm:
    return pw.PoseTerm(0.0, np.zeros(len(placed.poses)), np.zeros(len(placed.poses)))


def to_one_side(sign: float) -> Any:
    def price(placed: pw.PosedItems) -> pw.PoseTerm:
        count = len(placed.poses)
        value = sign * float(placed.poses.x.mean()) / 600
        return pw.PoseTerm(value, np.full(count, sign / 600), np.zeros(count))

    return price


@pytest.mark.parametrize("loss", [zero, rest])
@pytest.mark.parametrize("sizes", ["free", "shared"])
def test_a_loss_that_is_always_zero_changes_nothing(
    loss: Any, sizes: str, caplog: pytest.LogCaptureFixture
) -> None:
    asked = {"count": 6, "sizes": sizes, "seed": 1, "effort": "draft"}
    plain = pw.fill("circle", ["star", "heart"], **asked)
    weighed = pw.fill("circle", ["star", "heart"], losses={loss: 5.0}, **asked)
    np.testing.assert_array_equal(weighed.poses.x, plain.poses.x)
    np.testing.assert_array_equal(weighed.poses.scale, plain.poses.scale)
    assert f"the loss {loss.__name__} is zero wherever items are" in caplog.text


def test_a_loss_may_see_the_poses() -> None:
    left, right = (
        pw.fill(
            "page", ["star"], count=4, sizes="fixed", finish="none",
            losses={to_one_side(sign): 5.0}, **QUICK,
        )
        for sign in (1, -1)
    )  # fmt: skip
    assert left.poses.x.mean() < right.poses.x.mean() - 50


@pytest.mark.parametrize(
    ("returned", "said"),
    [
        (3, "must return a PoseTerm, not int"),
        (pw.PoseTerm(0.0, np.ones(2), np.ones(2)), r"must have shape \(3,\), not \(2,\)"),
        (pw.PoseTerm(0.0, np.full(3, np.nan), np.ones(3)), "must be finite"),
    ],
)
def test_losses_of_poses_are_checked(returned: Any, said: str) -> None:
    with pytest.raises(pw.RecipeError, match=said):
        pw.fill("circle", ["star"], count=3, losses={lambda placed: returned: 1.0}, **QUICK)
