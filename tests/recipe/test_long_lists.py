"""Recipes whose lists are as long as a file may be: done or refused by work in line with them."""

from __future__ import annotations

from pathlib import Path

import pytest

from packwork import recipe_paths
from packwork.errors import RecipeError
from packwork.recipe import make_recipe
from packwork.recipe_paths import files_outside, with_paths


@pytest.mark.parametrize("palette", ["red," * 250_000, "a=red," * 160_000, "(" * 900_000 + ",red"])
def test_a_palette_without_end_is_refused_before_it_is_parted(palette: str) -> None:
    with pytest.raises(RecipeError, match=r"palette: takes 20,000 characters at most") as refused:
        make_recipe(container="circle", items=["star"], palette=palette)
    assert len(str(refused.value)) < 200


def test_forces_without_end_are_parted_in_one_go() -> None:
    # By the square of the words this would take minutes.
    force = "in " + "1,1 " * 200_000
    assert with_paths({"force": force}, lambda name: name)["force"].split()[:2] == ["in", "1,1"]


def test_a_name_that_is_repeated_is_looked_up_once(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    looked_up: list[Path] = []
    monkeypatch.setattr(recipe_paths, "_is_there", looked_up.append)
    files_outside({"items": ["no such"] * 1_000}, [tmp_path])
    assert looked_up == [Path("no such")]
