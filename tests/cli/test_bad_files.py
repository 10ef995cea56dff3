"""Files that strangers or hands made: read as well as can be and said, or refused in a line."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from typer.testing import Result

Command = Callable[..., Result]

HEAD = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 1000 1000">'
QUICK = "--epochs 2 --levels 16 --finish none -q"
MANY = 1_000_000


def assert_refused(result: Result, problem: str) -> None:
    assert result.exit_code == 2
    assert problem in result.stderr
    assert result.stderr.startswith("packwork: ")
    assert result.stderr.count("\n") == 1


def test_letters_of_a_missing_font_are_set_in_another_and_that_is_said(
    folder: Path, packwork: Command
) -> None:
    text = f'{HEAD}<text y="500" font-size="400" font-family="No Such Font">Abc</text></svg>'
    (folder / "abc.svg").write_text(text, encoding="utf-8")
    result = packwork(f"fill square abc.svg -n 2 {QUICK} -o out.geojson")
    assert result.exit_code in {0, 1}
    assert "abc.svg: the font 'No Such Font' is not installed; its letters are set" in result.stderr
    drawn = json.loads((folder / "out.geojson").read_text(encoding="utf-8"))["features"][1]
    assert len(drawn["geometry"]["coordinates"]) == len("Abc")


@pytest.mark.parametrize(
    ("body", "problem"),
    [
        (f'<path d="M0 0{"h1" * MANY}v9z"/>', "has more path segments than can be followed"),
        (f'<path d="M0 0{"h1" * (MANY // 8)}v9z"/>' * 8, "has more path segments than can be"),
        ("<g/>" * MANY, "has more than 200,000 elements"),
        ('<path d="M0 0h1v1z"/>' * MANY, "is larger than 20 MB"),
        ('<path d="M0 0h1v1z"/>' * (MANY // 8), "grows to 125,000 elements; 30,000 are the most"),
    ],
    ids=["one path", "eight paths", "elements", "bytes", "shapes"],
)
def test_a_million_nodes_are_refused(
    body: str, problem: str, folder: Path, packwork: Command
) -> None:
    (folder / "many.svg").write_text(f"{HEAD}{body}</svg>", encoding="utf-8")
    assert_refused(packwork(f"fill heart many.svg {QUICK} -o out.svg"), f"many.svg: {problem}")
    assert not (folder / "out.svg").exists()


def test_weights_of_nobody_are_named(folder: Path, packwork: Command) -> None:
    (folder / "weights.csv").write_text("name,weight\nstar,2\nbear,3\n", encoding="utf-8")
    result = packwork(f"fill heart star circle {QUICK} --weights weights.csv -o out.svg")
    assert_refused(result, "--weights: no item is called 'bear'; there are circle, star")
    assert not (folder / "out.svg").exists()


PIN = '[[rules]]\nitems = "star"\npin = {{ {} }}\n'


@pytest.mark.parametrize(
    ("rules", "problem"),
    [
        (PIN.format("x = 1, y = 1"), "rule 1: pins star at 1, 1, outside the container"),
        (
            PIN.format('x = "30%", y = "50%", angle_deg = 0, size = "90%"'),
            "lies outside the container",
        ),
        (PIN.format("x = 300, y = 300") + "region = [0, 0, 100, 100]\n", "outside its region"),
        (PIN.format("x = 300, y = 300, size = 200")
         + PIN.format("x = 310, y = 300, size = 200").replace("star", "circle"),
         "rule 2: pins circle onto star of rule 1"),
        (PIN.format("x = 300, y = 300") * 2, "rule 2: pins star, but rule 1 pins the only copy"),
        ('[[rules]]\nitems = "*"\ncount = 3\n', "count: rules count 6 items in all, this 2"),
        ('[[rules]]\nitems = "star"\nscale = [2, 1]\n', "scale"),
    ],
)  # fmt: skip
def test_contradictions_are_named(
    rules: str, problem: str, folder: Path, packwork: Command
) -> None:
    text = f'container = "circle"\nitems = ["star", "circle"]\ncount = 2\n{rules}'
    (folder / "recipe.toml").write_text(text, encoding="utf-8")
    assert_refused(packwork("run recipe.toml -q -o out.svg"), problem)
    assert not (folder / "out.svg").exists()


@pytest.fixture
def edit(folder: Path, packwork: Command) -> Callable[[tuple[str | int, ...], Any], None]:
    """Write ``edited.geojson``, a saved layout in which a hand has changed one entry."""
    packwork(f"fill heart star circle -n 2 {QUICK} -o saved.geojson")
    saved = json.loads((folder / "saved.geojson").read_text(encoding="utf-8"))

    def change(place: tuple[str | int, ...], value: Any) -> None:
        within: Any = saved
        for key in place[:-1]:
            within = within[key]
        within[place[-1]] = value
        (folder / "edited.geojson").write_text(json.dumps(saved), encoding="utf-8")

    return change


BOWTIE = [[[0, 0], [90, 90], [90, 0], [0, 90], [0, 0]]]


@pytest.mark.parametrize("line", ["measure edited.geojson", "fill heart star circle -n 2 --start"])
@pytest.mark.parametrize(
    ("place", "value", "problem"),
    [
        (("features",), [], "must have one feature of role container, not 0"),
        (("features", 1, "properties", "role"), "hero", "features[1]: role must be container or"),
        (("features", 1, "properties", "x"), "left", "features[1].x: must be a number, not 'left'"),
        (
            ("features", 2, "properties", "scale"),
            -1,
            "features[2].scale: must be positive, 1e-15 to",
        ),
        (
            ("features", 1, "geometry", "coordinates"),
            BOWTIE,
            "features[1]: its outline is no clean",
        ),
        (("features", 1, "geometry", "type"), "Point", "features[1]: geometry must be a Polygon"),
        (("canvas", "width"), 0, "canvas.width: must be positive"),
        (("canvas", "unit"), "parsec", "canvas.unit: must be one of px"),
    ],
)
def test_layouts_edited_into_nonsense(
    line: str,
    place: tuple[str | int, ...],
    value: Any,
    problem: str,
    edit: Callable[[tuple[str | int, ...], Any], None],
    packwork: Command,
) -> None:
    edit(place, value)
    if line.startswith("fill"):
        line += f" edited.geojson {QUICK}"
    assert_refused(packwork(line), problem)


def test_a_start_with_too_few_items(
    edit: Callable[[tuple[str | int, ...], Any], None], packwork: Command
) -> None:
    edit(("canvas", "note"), "the same otherwise")
    result = packwork(f"fill heart star circle -n 9 --start edited.geojson {QUICK}")
    assert_refused(result, "edited.geojson has 2 items, this run 9; give as many")
