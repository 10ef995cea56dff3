"""What may be asked of single items: every key refuses what has no meaning, by its place."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from packwork.errors import RecipeError
from packwork.readers.photo_options import PhotoOptions
from packwork.recipe import make_recipe
from packwork.recipe.rules import HERO_SIZE, UPRIGHT, Rotation, Rule, hero_rule, usual_padding

BAD: list[tuple[dict[str, Any], str]] = [
    ({"items": []}, "items: use a name, a pattern"),
    ({"items": [3]}, "items: use a name"),
    ({}, "items: must be given"),
    ({"items": "star", "colour": "red"}, "there is no 'colour'; did you mean color?"),
    ({"itmes": "star"}, "there is no 'itmes'; did you mean items?"),
    ({"items": "star", "count": -1}, "count: must be at least 0, not -1"),
    ({"items": "star", "count": 2.5}, "count: must be a whole number"),
    ({"items": "star", "count": 100_001}, "count: must be at most 100000"),
    ({"items": "star", "scale": 2}, "scale: use the smallest and the largest size"),
    ({"items": "star", "scale": [2]}, "scale: use the smallest"),
    ({"items": "star", "scale": [2, 0.5]}, "scale: is empty, from 2 to 0.5"),
    ({"items": "star", "scale": [0, 1]}, "scale: must be within 0.01 and 100"),
    ({"items": "star", "scale": [1, float("inf")]}, "scale: must be within"),
    ({"items": "star", "scale": [float("nan"), 1]}, "scale: must be within"),
    ({"items": "star", "scale": ["a", 1]}, "scale: must be a number"),
    ({"items": "star", "rotate": "twist"}, "rotate: use free, upright, none, 30"),
    ({"items": "star", "rotate": [30, "x"]}, "rotate: use free"),
    ({"items": "star", "weight": 0}, "weight: must be more than 0"),
    ({"items": "star", "weight": float("inf")}, "weight: must be"),
    ({"items": "star", "pin": "middle"}, "pin: must be a table such as"),
    ({"items": "star", "pin": {"X": 1}}, "pin: there is no 'X'; did you mean x?"),
    ({"items": "star", "pin": {"x": "wide"}}, "pin.x: use a length"),
    ({"items": "star", "pin": {"y": -3}}, "pin.y: use a length"),
    ({"items": "star", "pin": {"y": True}}, "pin.y: use a length"),
    ({"items": "star", "pin": {"size": "0mm"}}, "pin.size: must be more than 0"),
    ({"items": "star", "pin": {"angle_deg": "up"}}, "pin.angle_deg: must be a number"),
    ({"items": "star", "pin": {"angle_deg": float("nan")}}, "pin.angle_deg: must be"),
    ({"items": "star", "region": 3}, "region: use a container or"),
    ({"items": "star", "region": [1, 2, 3]}, "region: use a container or"),
    ({"items": "star", "region": [1, 2, 3, "wide"]}, "region: use a length"),
    ({"items": "star", "color": "puce"}, "color: 'puce' is no colour"),
    ({"items": "star", "color": "okabe-it"}, "did you mean okabe-ito?"),
    ({"items": "star", "color": "none"}, "color: 'none' cannot be seen"),
    ({"items": "star", "color": []}, "color: use colours such as"),
    ({"items": "star", "color": 3}, "color: use colours such as"),
    ({"items": "star", "name": 3}, "name: must be a text, not 3"),
    ({"items": "star", "title": "x" * 2_001}, "title: may have 2000 characters"),
    ({"items": "star", "link": "javascript:alert(1)"}, "link: must begin with http:"),
    ({"items": "star", "link": " https://a.example"}, "link: must begin with http:"),
]


@pytest.mark.parametrize(("rule", "problem"), BAD, ids=[problem for _, problem in BAD])
def test_a_bad_rule_is_refused_by_its_place_on_one_line(rule: dict[str, Any], problem: str) -> None:
    with pytest.raises(RecipeError) as refusal:
        make_recipe(container="heart", rules=[{"items": "moon"}, rule])
    assert str(refusal.value).startswith("rules: rule 2: ")
    assert problem in str(refusal.value)
    assert refusal.value.key == "rules"
    assert "\n" not in str(refusal.value)
    assert len(str(refusal.value)) < 220


@pytest.mark.parametrize("sizes", ["shared", "fixed"])
def test_a_range_of_sizes_needs_free_sizes(sizes: str) -> None:
    with pytest.raises(RecipeError, match=f"rule 1: scale bounds free sizes, not {sizes} ones"):
        make_recipe(container="heart", sizes=sizes, rules=[{"items": "a", "scale": [1, 2]}])


def test_numbers_and_single_names_are_taken_as_they_are_meant() -> None:
    rule = Rule(items="b*", rotate=30, region=[0, "10%", "5mm", 4], color=["red", "blue"])
    assert rule.items == ("b*",)
    assert rule.rotate == "30"
    assert rule.region == (0, "10%", "5mm", 4)
    assert rule.color == ("red", "blue")


@pytest.mark.parametrize(
    ("pin", "is_for_one"),
    [
        (None, False),
        ({"x": 1}, False),
        ({"size": 3, "angle_deg": 0}, False),
        ({"x": 1, "y": 2}, True),
    ],
)
def test_only_a_point_is_for_one(pin: dict[str, float] | None, is_for_one: bool) -> None:
    assert Rule(items="a", pin=pin).is_for_one is is_for_one


@pytest.mark.parametrize(
    ("text", "pose"),
    [
        ("bear", (None, None, HERO_SIZE)),
        ("bear=25%", (None, None, "25%")),
        ("bear@50%,40%", ("50%", "40%", HERO_SIZE)),
        (" stripe:6 @ 10mm , 2in = 30 ", ("10mm", "2in", "30")),
    ],
)
def test_heroes(text: str, pose: tuple[str | None, str | None, str]) -> None:
    rule = hero_rule(text)
    assert rule.items == (text.split("@")[0].split("=")[0].strip(),)
    assert rule.pin is not None
    assert (rule.pin.x, rule.pin.y, rule.pin.size) == pose
    assert rule.pin.angle_deg == 0


@given(text=st.text(max_size=20) | st.text("ab@,=%1 ", max_size=14))
def test_any_text_is_a_hero_or_refused(text: str) -> None:
    try:
        rule = hero_rule(text)
    except RecipeError as refusal:
        assert refusal.key == "hero"  # noqa: PT017
    else:
        assert rule.items[0]


def test_upright_is_a_word_for_a_limit() -> None:
    assert make_recipe(container="heart", rotate="upright").rotation == Rotation.parse("30")
    assert Rotation.parse(f"{UPRIGHT:g}") == Rotation.parse(" Upright ")


@pytest.mark.parametrize(
    ("photos", "gap"),
    [
        (PhotoOptions(sources=("a.jpg",), border="4%", edge="crop"), "0.4%"),
        (PhotoOptions(sources=("a.jpg",), edge="crop"), "0"),
        ({"border": "4%"}, "0"),
        ({"border": ["x"], "edge": "crop"}, "0.4%"),
        ("x", "0"),
    ],
)
def test_photos_with_borders_lie_apart_whatever_a_file_says_of_them(photos: Any, gap: str) -> None:
    assert usual_padding({"photos": photos}) == gap
