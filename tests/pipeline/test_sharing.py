"""Words, photos and icons in one layout, each kind with its share of the area."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import packwork as pw
from packwork.errors import RecipeError
from packwork.pipeline.plan.copies import kinds_of
from packwork.recipe.pictures import share_of_kinds
from packwork.uses import read, words_recipe

WORDS = {"honey": 3, "bear": 2, "bee": 1}
QUICK = {"effort": "draft", "levels": "50", "seed": 0}


@pytest.fixture
def album(tmp_path: Path) -> Path:
    for name, size in (("sea", (90, 60)), ("sky", (60, 90))):
        Image.new("RGB", size, "teal").save(tmp_path / f"{name}.jpg")
    return tmp_path


def areas_by_kind(layout: pw.Layout) -> dict[str, float]:
    words = [item for item in layout.items if item.text is not None]
    kinds = kinds_of(layout.items, words)
    return {name: float(layout.areas[kinds == name].sum()) for name in ("words", "photos", "items")}


def test_areas_are_in_the_shares_asked_for(album: Path) -> None:
    layout = pw.words(
        "circle", WORDS, add=["star", "moon"], photos={"sources": [str(album)]},
        share="words=50%,photos=30%,items=20%", **QUICK,
    )  # fmt: skip
    areas = areas_by_kind(layout)
    total = sum(areas.values())
    found = {name: area / total for name, area in areas.items()}
    assert found == pytest.approx({"words": 0.5, "photos": 0.3, "items": 0.2}, rel=1e-6)
    heights = {item.name: layout.poses.scale[k] for k, item in enumerate(layout.items)}
    assert heights["honey"] / heights["bee"] == pytest.approx(3)


def test_an_icon_called_as_a_word_is_has_its_own_area_and_colours() -> None:
    weights = {"bear": 3.0, "star": 2.0, "owl": 1.0}
    layout = pw.words("circle", weights, add=["star", "moon"], color_by="weight", **QUICK)
    assert [item.name for item in layout.items] == ["bear", "star", "owl", "star", "moon"]
    word, icon, other = (layout.areas[k] for k in (1, 3, 4))
    assert icon == pytest.approx(other)
    assert icon != pytest.approx(word, rel=0.1)
    scales = layout.poses.scale[:3]
    assert scales / scales[-1] == pytest.approx([3, 2, 1])
    assert layout.items[3].art == pw.read_items(["star"])[0].art


def test_shares_count_an_icon_called_as_a_word_is_as_an_icon() -> None:
    recipe = words_recipe("circle", {"star": 2, "owl": 1}, add=["star"], share="words=3,items=1")
    job = read(recipe)
    assert job.weights[:2].sum() == pytest.approx(0.75)
    assert job.weights[2] == pytest.approx(0.25)


def test_words_have_no_other_weights() -> None:
    with pytest.raises(RecipeError, match="weights: words have the weights of their source"):
        read(words_recipe("circle", WORDS, weights={"honey": 2}))


def test_items_that_were_read_are_mixed_in_with_photos(album: Path) -> None:
    layout = pw.fill("circle", pw.read_items(["star"]), photos={"sources": [str(album)]}, **QUICK)
    assert sorted(item.name for item in layout.items) == ["sea", "sky", "star"]


@pytest.mark.parametrize(
    ("share", "reason"),
    [
        ({"words": 1}, "says nothing of photos; give shares of photos, words"),
        ({"words": 1, "photos": 1, "items": 1}, "there are no items here"),
    ],
)
def test_shares_are_of_what_is_there(album: Path, share: dict[str, float], reason: str) -> None:
    with pytest.raises(RecipeError, match=reason):
        pw.words("circle", WORDS, photos={"sources": [str(album)]}, share=share, **QUICK)


@pytest.mark.parametrize("text", ["", "words", "words=0", "words=-3%", "trees=50%", "words=inf"])
def test_shares_without_a_meaning_are_refused(text: str) -> None:
    with pytest.raises(RecipeError, match="use shares such as"):
        share_of_kinds(text)


def test_kinds_that_have_shares_are_mixed_over_the_area(tmp_path: Path) -> None:
    for k in range(6):
        size = (90, 60) if k % 2 else (60, 90)
        Image.new("RGB", size, "teal").save(tmp_path / f"p{k}.png")
    words = {f"word{k}": 10 / (k + 2) for k in range(14)}
    layout = pw.words(
        "square", words, add=["star", "moon", "heart", "drop"],
        photos={"sources": [str(tmp_path)]}, share="words=45%,photos=35%,items=20%",
        effort="draft", seed=0,
    )  # fmt: skip
    spoken = [item for item in layout.items if item.text is not None]
    kinds = kinds_of(layout.items, spoken)
    heights = layout.poses.y / layout.container.height
    for name in ("words", "photos", "items"):
        own = heights[kinds == name]
        # Layers would lie in one half.
        assert 0.1 < np.mean(own < 0.5) < 0.9, name
