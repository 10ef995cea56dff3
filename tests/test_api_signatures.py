"""Signatures in Python are made of the fields that commands are made of."""

from __future__ import annotations

import inspect
import re
from operator import attrgetter
from pathlib import Path
from typing import get_args, get_type_hints

import pytest

import packwork as pw
from packwork.errors import RecipeError
from packwork.options import Verbs, offered
from packwork.recipe import Recipe
from packwork.recipe.verbs import VERBS, default_of, run_options
from packwork.writers.options import DrawingOptions


@pytest.mark.parametrize("verb", VERBS)
def test_a_verb_shows_the_options_of_its_command_and_rules(verb: Verbs) -> None:
    shown = inspect.signature(getattr(pw, str(verb.name).lower())).parameters
    assert "options" not in shown
    assert shown["rules"].default == ()
    for option in run_options(verb):
        if option.name != "items":
            assert shown[option.name].default == default_of(verb, option)


def test_what_a_value_may_be_is_shown_as_it_is_written() -> None:
    shown = inspect.signature(pw.fill).parameters
    assert shown["time"].annotation == "float | None"
    assert shown["palette"].annotation == "Colours | None"
    assert shown["canvas"].annotation == "str | float | Sequence[float] | None"


@pytest.mark.parametrize(
    "name",
    ["fill", "words", "photos", "pile", "chart", "series", "chart_series"]
    + [f"Layout.{one}" for one in ("save", "save_film", "to_svg", "to_png", "to_image")],
)
def test_types_of_options_can_be_asked_for_as_other_libraries_do(name: str) -> None:
    function = attrgetter(name)(pw)
    (keywords,) = get_args(get_type_hints(function)["options"])
    told = get_type_hints(keywords)
    assert told
    # Series show them by **options alone.
    assert "series" in name or told.keys() <= inspect.signature(function).parameters.keys()


def test_saving_shows_how_layouts_are_drawn() -> None:
    shown = inspect.signature(pw.Layout.save).parameters
    assert list(shown) == [
        "self",
        "path",
        "format",
        *(option.name for option in offered(DrawingOptions)),
    ]


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"pixls": 90}, "pixls: no such option; did you mean pixels?"),
        ({"halo": "some"}, "halo: must be 'none', 'faint' or 'all', not 'some'"),
    ],
)
def test_saving_refuses_what_is_no_option(options: dict, said: str, tmp_path: Path) -> None:
    layout = pw.fill("circle", "star", count=1, effort="draft", levels="16")
    with pytest.raises(RecipeError, match=re.escape(said)):
        layout.save(tmp_path / "a.svg", **options)


def test_a_form_can_be_made_of_what_is_offered() -> None:
    asked = {option.name: option for option in offered(Recipe)}
    assert asked["sizes"].choices == ("free", "shared", "fixed", "graded", "auto")
    assert asked["quiet_share"].bounds == {"ge": 0.02, "le": 0.98}
    assert asked["target_coverage"].bounds == {"gt": 0, "lt": 1}
    assert asked["weights"].forms == (str, dict[str, float])
    assert type(None) not in asked["decimal"].forms
    assert Verbs.CHART not in asked["sizes"].verbs
