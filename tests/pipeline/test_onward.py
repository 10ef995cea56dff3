"""Progress of a whole run: from 0 to 1, once."""

from __future__ import annotations

from typing import Any

import pytest

import packwork as pw
from packwork.progress import Step

QUICK: dict[str, Any] = {"epochs": 40, "levels": "16,32", "progress": False}


class Diary:
    """Observer that keeps how far a run was."""

    every = 1

    def __init__(self) -> None:
        self.shares: list[float] = []

    def on_step(self, step: Step) -> None:
        self.shares.append(step.progress)


@pytest.mark.parametrize(
    "asked",
    [
        {},
        {"finish": "none"},
        {"target_coverage": 0.8, "max_items": 40},
    ],
)
def test_progress_goes_from_nothing_to_all_and_never_back(asked: dict[str, Any]) -> None:
    diary = Diary()
    pw.fill("circle", "star", count=8, observer=diary, **QUICK, **asked)
    assert diary.shares == sorted(diary.shares)
    assert diary.shares[0] < 0.1
    assert 0.75 <= diary.shares[-1] <= 1.0


def test_progress_of_a_pile_never_goes_back() -> None:
    diary = Diary()
    pw.pile("square", "circle", count=4, size="20%", observer=diary, progress=False)
    assert diary.shares == sorted(diary.shares)
