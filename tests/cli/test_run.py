"""Recipe files: written by one run, repeated by another, refused where they are wrong."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from packwork.readers.recipe import read_recipe
from packwork.recipe import make_recipe
from packwork.scene.palette import PALETTES
from packwork.writers import recipe_bytes

QUICK = "--levels 32 --epochs 6 --effort draft"


def items_of(path: Path) -> list[object]:
    features = json.loads(path.read_text(encoding="utf-8"))["features"]
    return [f for f in features if f["properties"]["role"] == "item"]


def test_a_saved_recipe_repeats_the_run_from_any_folder(folder, packwork, monkeypatch) -> None:
    weights = folder / "weights.csv"
    weights.write_text("star,2\n", encoding="utf-8")
    first = packwork(
        f"fill heart star circle -n 5 --seed 4 --rotate 0,90 --weights weights.csv {QUICK} "
        "-q -o a.geojson --save-recipe kept/recipe.toml"
    )
    assert first.exit_code == 0, first.output
    away = folder / "away"
    away.mkdir()
    monkeypatch.chdir(away)
    again = packwork("run ../kept/recipe.toml -q -o b.geojson")
    assert again.exit_code == 0, again.output
    assert items_of(away / "b.geojson") == items_of(folder / "a.geojson")


def test_paths_in_a_recipe_are_its_own_folders(folder, packwork) -> None:
    (folder / "set").mkdir()
    (folder / "set" / "dot.svg").write_text(
        '<svg viewBox="0 0 9 9"><circle cx="4" cy="4" r="3"/></svg>', encoding="utf-8"
    )
    (folder / "set" / "r.toml").write_text(
        'container = "circle"\nitems = ["dot.svg"]\ncount = 2\nlevels = [32]\nepochs = 4\n',
        encoding="utf-8",
    )
    result = packwork("run set/r.toml -q -o out.geojson")
    assert result.exit_code == 0, result.output
    assert len(items_of(folder / "out.geojson")) == 2


RULES = """
container = "circle"
items = ["star", "circle"]
count = 9
levels = [32]
epochs = 6
hero = "star=30%"
palette = ["red", "blue"]

[[rules]]
items = "circle"
region = "low.svg"
pin = { angle_deg = 0.0 }
title = "A & B"
"""


def test_rules_survive_being_saved(folder, packwork, monkeypatch) -> None:
    (folder / "set").mkdir()
    drawing = '<svg viewBox="0 0 10 10"><path d="M0 4h10v6H0z"/></svg>'
    (folder / "set" / "low.svg").write_text(drawing, encoding="utf-8")
    (folder / "set" / "r.toml").write_text(RULES, encoding="utf-8")
    first = packwork("run set/r.toml -q -o a.geojson -o a.svg")
    assert first.exit_code in {0, 1}, first.output
    assert "<title>A &amp; B</title>" in (folder / "a.svg").read_text(encoding="utf-8")
    options = read_recipe(folder / "set" / "r.toml")
    saved = recipe_bytes(make_recipe(**options).plain(), folder / "set")
    (folder / "set" / "again.toml").write_bytes(saved)
    monkeypatch.chdir(folder / "set")
    packwork("run again.toml -q -o b.geojson")
    assert items_of(folder / "set" / "b.geojson") == items_of(folder / "a.geojson")


def test_hero_palette_and_apart_on_the_command_line(folder, packwork) -> None:
    result = packwork(
        f"fill square star circle -n 9 --hero star@50%,50%=40% --palette okabe-ito --apart {QUICK}"
        " -q -o a.geojson --save-recipe r.toml --report r.json"
    )
    assert result.exit_code in {0, 1}, result.output
    stars = [f["properties"] for f in items_of(folder / "a.geojson")
             if f["properties"]["item"] == "star"]  # fmt: skip
    assert [(one["x"], one["y"], one["angle"]) for one in stars] == [(300.0, 300.0, 0.0)]
    assert stars[0]["fill"] in PALETTES["okabe-ito"]
    assert "apart = true" in (folder / "r.toml").read_text(encoding="utf-8")
    assert json.loads((folder / "r.json").read_text(encoding="utf-8"))["beside"] >= 0


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        ("container = ", "is not TOML"),
        ('container = "heart"\ncuont = 3', "did you mean count?"),
        ("count = 3", "container: must be given"),
        ('container = "heart"\ngap = 3', "gap: no such option; did you mean padding?"),
        ('container = "heart"\nequal = true', 'did you mean sizes = "shared"?'),
        ('container = "heart"\ncount = 0', "r.toml: count: must be at least 1, not 0"),
        ('container = "heart"\nlevels = []', "levels"),
        ('container = "heart"\nrules = 3', "r.toml: rules: must be a list of tables"),
        ('container = "heart"\n[[rules]]\nitems = "star"\npni = 3', "rules: rule 1: there is no"),
        ('container = "heart"\n[[rules]]\nitems = "stra"', "rule 1: no item is called 'stra'"),
        ('container = "heart"\nlevels = [0]', "levels"),
    ],
)
def test_a_bad_recipe_is_one_line(folder, packwork, text: str, problem: str) -> None:
    (folder / "r.toml").write_text(text, encoding="utf-8")
    result = packwork("run r.toml -o out.svg")
    assert result.exit_code == 2
    assert problem in result.stderr
    assert result.stderr.count("\n") == 1
    assert not (folder / "out.svg").exists()


@pytest.mark.parametrize(
    "outputs",
    ["-o a.svg -o a.svg", "-o a.svg --report a.svg", "-o d.svg -o d.svg/b.svg", "-o star.svg"],
)
def test_outputs_that_collide_or_are_inputs_are_refused(folder, packwork, outputs: str) -> None:
    drawing = '<svg viewBox="0 0 9 9"><path d="M0 0h9v9z"/></svg>'
    (folder / "star.svg").write_text(drawing, encoding="utf-8")
    result = packwork(f"fill circle star.svg {QUICK} {outputs}")
    assert result.exit_code == 2
    assert result.stderr.count("\n") == 1
    assert (folder / "star.svg").read_text(encoding="utf-8") == drawing
    assert [file.name for file in folder.iterdir()] == ["star.svg"]
