"""Items in an order: along directions, from the middle, round it; refusals."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import packwork as pw
from packwork import uses
from packwork.errors import PackworkError, RecipeError
from packwork.pipeline.run import run
from packwork.recipe import make_recipe
from packwork.recipe_paths import with_paths
from packwork.scene.contrast import oklabs_of_light
from packwork.scene.swatch import mean_lights

QUICK = {"levels": "50", "epochs": 40, "effort": "draft", "seed": 0}
NAMES = ["star", "heart", "moon", "owl", "leaf", "cat", "fish", "cloud"]
CHANCE = 0.5
"""Rank correlation that forty items in no order reach once in a thousand times."""


@pytest.fixture
def ages(tmp_path: Path) -> str:
    """A number for each name, in no order of the names."""
    lines = [f"{name},{(5 * k) % len(NAMES) - 3}" for k, name in enumerate(NAMES)]
    (tmp_path / "ages.csv").write_text("name,value\n" + "\n".join(lines), encoding="utf-8")
    return str(tmp_path / "ages.csv")


def _numbers(layout: pw.Layout) -> np.ndarray:
    return np.array([(5 * NAMES.index(item.name)) % len(NAMES) for item in layout.items])


def _away(layout: pw.Layout) -> np.ndarray:
    x, y = layout.container.outline.centroid
    return np.hypot(layout.poses.x - x, layout.poses.y - y)


def _order(first: np.ndarray, second: np.ndarray) -> float:
    return float(np.corrcoef(_ranks(first), _ranks(second))[0, 1])


def _ranks(values: np.ndarray) -> np.ndarray:
    """Ranks; those that are equal share one."""
    _, which, counts = np.unique(values, return_inverse=True, return_counts=True)
    return (np.cumsum(counts) - counts / 2)[which]


@pytest.mark.parametrize(
    ("way", "axis", "sign"), [("right", "x", 1), ("left", "x", -1), ("90deg", "y", 1)]
)
def test_numbers_rise_along_a_direction(ages: str, way: str, axis: str, sign: int) -> None:
    layout = pw.fill("square", NAMES, count=40, arrange=f'{way} by="{ages}"', **QUICK)
    assert sign * _order(_numbers(layout), getattr(layout.poses, axis)) > CHANCE
    assert layout.manifest["certified"]


@pytest.mark.parametrize(("way", "sign"), [("outwards", 1), ("inwards", -1)])
def test_numbers_rise_from_the_middle(ages: str, way: str, sign: int) -> None:
    layout = pw.fill("circle", NAMES, count=40, arrange=f'{way} by="{ages}"', **QUICK)
    assert sign * _order(_numbers(layout), _away(layout)) > CHANCE


def test_the_file_of_numbers_is_read_once(ages: str) -> None:
    recipe = make_recipe(container="square", items=NAMES, count=8, arrange=f'by="{ages}"', **QUICK)
    job = uses.read(recipe)
    Path(ages).unlink()
    assert run(job).layout.items


def test_numbers_rise_along_a_letter(ages: str) -> None:
    """From one end of a C to the other, though both ends lie on the right."""
    layout = pw.fill("text:C", NAMES, count=40, arrange=f'along by="{ages}"', **QUICK)
    x, y = layout.container.outline.centroid
    angles = np.arctan2(layout.poses.y - y, layout.poses.x - x) % (2 * np.pi)
    assert abs(_order(_numbers(layout), angles)) > CHANCE


def test_a_container_of_parts_has_a_way_too(ages: str) -> None:
    layout = pw.fill("text:II", NAMES, count=24, arrange=f'along by="{ages}"', **QUICK)
    first = layout.poses.x < layout.container.width / 2
    assert _numbers(layout)[first].mean() < _numbers(layout)[~first].mean() - 2


def test_without_there_is_no_such_order(ages: str) -> None:
    layout = pw.fill("square", NAMES, count=40, **QUICK)
    assert abs(_order(_numbers(layout), layout.poses.x)) < CHANCE


def test_hues_go_round_the_middle() -> None:
    colours = ["#d22", "#d92", "#8b2", "#2a8", "#28d", "#63c", "#c3a"]
    layout = pw.fill("circle", _discs(colours), count=42, arrange="hue", **QUICK)
    x, y = layout.container.outline.centroid
    angles = np.arctan2(layout.poses.y - y, layout.poses.x - x)
    _, a, b = oklabs_of_light(mean_lights(layout.items)).T
    hues = np.arctan2(b, a)
    # Neighbours round the middle have hues that are near each other.
    turn = np.argsort(angles)
    steps = np.abs(np.angle(np.exp(1j * np.diff(hues[turn]))))
    by_chance = np.abs(np.angle(np.exp(1j * (hues[:, None] - hues))))
    assert np.median(steps) < np.median(by_chance) / 2
    assert layout.manifest["certified"]


def _discs(colours: list[str]) -> list[pw.Item]:
    from io import BytesIO

    from PIL import Image, ImageDraw

    found = []
    for colour in colours:
        image = Image.new("RGBA", (40, 40))
        ImageDraw.Draw(image).ellipse((0, 0, 39, 39), fill=colour)
        data = BytesIO()
        image.save(data, "PNG")
        found += pw.read_items([image])
    return found


def test_heavy_words_come_first() -> None:
    table = {f"word{k}": float(20 - k) for k in range(16)}
    layout = pw.words("square", table, arrange="left by=weight", effort="draft")
    weights = [table[item.name] for item in layout.items]
    # Six seeds had -0.5 to -0.97, and about 0.4 without.
    assert _order(np.array(weights), layout.poses.x) < 0
    assert layout.manifest["certified"]


def test_words_lie_by_a_column_of_their_table(tmp_path: Path) -> None:
    rows = [f"word{k};{20 - k};{1900 + 7 * k % 80},5;{'abc'[k % 3]}" for k in range(18)]
    table = tmp_path / "words.csv"
    table.write_text("Wort;weight;Jahr;Art\r\n" + "\r\n".join(rows), encoding="utf-8-sig")
    years, kinds = (
        pw.words("square", table, arrange=arrange, effort="draft")
        for arrange in ("right by=Jahr", "down by=Art")
    )
    told = np.array([1900 + 7 * int(item.name[4:]) % 80 for item in years.items])
    of_kind = np.array([int(item.name[4:]) % 3 for item in kinds.items])
    # Each by its own column, and not by the other's.
    assert _order(told, years.poses.x) > abs(_order(told, years.poses.y))
    assert _order(of_kind, kinds.poses.y) > abs(_order(of_kind, kinds.poses.x))
    with pytest.raises(RecipeError, match=r"nothing is measured by 'Jahre'; .*\(Jahr, Art\)"):
        pw.words("square", table, arrange="right by=Jahre")
    table.write_text(table.read_text("utf-8-sig").replace(";1907,5;", ";;"), encoding="utf-8")
    with pytest.raises(RecipeError, match="word1 has nothing in 'Jahr'"):
        pw.words("square", table, arrange="right by=Jahr")


@pytest.mark.parametrize(
    ("arrange", "said"),
    [
        ("sideways", "there is no way 'sideways'"),
        ("outward", "did you mean outwards"),
        ("right by=mood", "nothing is measured by 'mood'"),
        ("right left", "use a way and a measure"),
        ("right by=weight", "all have the same weight"),
    ],
)
def test_what_has_no_meaning_is_refused(arrange: str, said: str) -> None:
    with pytest.raises(RecipeError, match=said):
        pw.fill("circle", ["star", "moon"], count=4, arrange=arrange, **QUICK)


def test_colours_that_a_palette_replaces_give_no_order() -> None:
    with pytest.raises(RecipeError, match="palette gives them others"):
        pw.fill("circle", ["star", "moon"], arrange="hue", palette="okabe-ito", **QUICK)


@pytest.mark.parametrize(
    ("text", "said"),
    [("star,1\n", "no number for 'moon'"), ("star,1\nmoon,x\n", "ages.csv"), ("", "ages.csv")],
)
def test_a_bad_file_is_one_line(tmp_path: Path, text: str, said: str) -> None:
    (tmp_path / "ages.csv").write_text(text, encoding="utf-8")
    arrange = f'right by="{tmp_path / "ages.csv"}"'
    with pytest.raises(PackworkError, match=said) as refused:
        pw.fill("circle", ["star", "moon"], count=4, arrange=arrange, **QUICK)
    assert "\n" not in str(refused.value)


def test_files_of_recipes_are_found_beside_them() -> None:
    changed = with_paths({"arrange": "outwards by=ages.csv"}, "sets/{}".format)
    assert changed["arrange"] == 'outwards by="sets/ages.csv"'
    assert with_paths({"arrange": "right by=hue"}, "x/{}".format)["arrange"] == "right by=hue"
