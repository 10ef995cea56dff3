"""The poster in the gallery: its recipe is read, and every key that it uses is explained."""

from __future__ import annotations

from pathlib import Path

import pytest

from packwork import uses
from packwork.readers.recipe import read_recipe
from packwork.recipe import make_recipe
from packwork.recipe.rules import Pin, Rule

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "guide" / "rules.md").read_text(encoding="utf-8")


def test_the_recipe_of_the_poster_can_be_run() -> None:
    folder = ROOT / "examples" / "poster"
    job = uses.read(make_recipe(**read_recipe(folder / "recipe.toml")))
    names = [item.name for item in job.items]
    assert len(names) == job.recipe.count
    assert [names.count(name) for name in ("owl", "moon", "star")] == [1, 1, 22]
    assert len(job.regions) == 2
    assert (folder / "expected.png").stat().st_size < 150_000


@pytest.mark.parametrize("key", [*Rule.model_fields, *Pin.model_fields])
def test_every_key_of_a_rule_is_explained(key: str) -> None:
    assert f"`{key}`" in PAGE


@pytest.mark.parametrize("key", Rule.model_fields)
def test_every_key_of_a_rule_says_what_it_means(key: str) -> None:
    description = Rule.model_fields[key].description
    assert description
    assert description.endswith(".")
