"""Whole runs whose items are put one after another."""

from __future__ import annotations

import numpy as np
import pytest

import packwork as pw
from packwork import uses
from packwork.errors import RecipeError
from packwork.steps.starts import is_only_refined

WORDS = {"harbour": 9, "tide": 7, "gull": 5, "mast": 4, "rope": 3, "sail": 2, "oar": 1}


def _starts(layout: pw.Layout) -> str:
    return str(layout.manifest["start"])


def test_words_are_put_one_after_another_and_certified() -> None:
    layout = pw.words("circle", WORDS, padding=0)
    levels = pw.words("circle", WORDS, padding=0, start="distance-field", effort="draft")
    assert (_starts(layout), _starts(levels)) == ("first-fit", "distance-field")
    assert layout.manifest["certified"]
    assert layout.manifest["levels"] == []
    assert levels.manifest["levels"] != []


@pytest.mark.parametrize(
    "options",
    [
        {"sizes": "free"},
        {"epochs": 50},
        {"levels": "50"},
        {"losses": {"evenness": 0.5}},
        {"force": "together"},
        {"apart": True},
        {"preset": "paper"},
    ],
)
def test_what_only_the_levels_know_is_left_to_them(options: dict[str, object]) -> None:
    layout = pw.words("circle", WORDS, stop=lambda: True, **{"effort": "draft", **options})
    assert _starts(layout) == "distance-field"


@pytest.mark.parametrize("rotate", ["none", "20", "free"])
def test_icons_of_one_size_are_put_so_too(rotate: str) -> None:
    layout = pw.fill(
        "heart", ["star", "cat"], count=12, sizes="shared", rotate=rotate, effort="draft"
    )
    assert _starts(layout) == "first-fit"
    assert layout.manifest["certified"]


def test_many_that_may_turn_any_way_are_left_to_the_levels(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("packwork.steps.starts.MOST_TURNING", 11)
    options = {"count": 12, "sizes": "shared", "effort": "draft"}
    assert _starts(pw.fill("heart", ["star", "cat"], **options)) == "distance-field"
    assert _starts(pw.fill("heart", ["star", "cat"], rotate="none", **options)) == "first-fit"


def test_first_fit_needs_one_size() -> None:
    with pytest.raises(RecipeError, match="use it with sizes shared, not free"):
        pw.fill("heart", ["star"], count=4, start="first-fit")


@pytest.mark.parametrize("options", [{"epochs": 30}, {"force": "align horizontal"}])
def test_levels_that_are_asked_for_run_after_a_first_fit_too(options: dict[str, object]) -> None:
    layout = pw.words("circle", WORDS, start="first-fit", effort="draft", **options)
    assert _starts(layout) == "first-fit"
    assert layout.manifest["levels"] != []
    assert layout.manifest["certified"]


def test_a_film_shows_words_come_in_the_largest_first() -> None:
    layout = pw.words("circle", WORDS, record=True)
    assert layout.track is not None
    early = layout.track.at(0.02).scale
    late = layout.track.at(1.0).scale
    largest = int(np.argmax(layout.weights))
    assert early[largest] > 0
    assert (early == 0).sum() >= 3
    assert (late > 0).all()


def test_thousands_of_words_fill_as_hundreds_do() -> None:
    def ink(count: int) -> float:
        words = {f"w{k}": (k + 3) ** -0.6 for k in range(count)}
        layout = pw.words("circle", words, sizes="shared", effort="draft")
        assert _starts(layout) == "first-fit"
        return float(layout.metrics["LC_ink"])

    assert ink(1_700) > ink(150) / 2


def test_thousands_of_turning_words_are_only_refined(monkeypatch: pytest.MonkeyPatch) -> None:
    """The finish made all of 5,000 much smaller for hairs of conflict between specks."""
    weights = {f"word{k}": 1.0 + k for k in range(60)}
    job = uses.read(uses.words_recipe("circle", weights, count=60, rotate="20", sizes="shared"))
    assert not is_only_refined(job)
    monkeypatch.setattr("packwork.steps.starts.MOST_ANGLES", 100)
    assert is_only_refined(job)
