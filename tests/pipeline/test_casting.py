"""How many copies of each item there are, and which rules each copy hears."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from packwork.errors import RecipeError
from packwork.pipeline.plan.copies import Cast, RuleSource, expand_copies, matching, turns
from packwork.recipe import make_recipe
from packwork.scene.item import Item
from scenes import disc, flat_item

ITEMS: list[Item] = [flat_item(name, disc()) for name in ("bear", "bird", "cat", "owl")]
MIDDLE = {"x": "50%", "y": "50%"}


def made(*rules: dict[str, Any], items: list[Item] = ITEMS, **options: Any) -> Cast:
    return expand_copies(make_recipe(container="heart", rules=rules, **options), items)


def names(one: Cast) -> list[str]:
    return [item.name for item in one.items]


@given(
    counts=st.lists(st.none() | st.integers(0, 5), min_size=1, max_size=6),
    more=st.none() | st.integers(0, 9),
)
def test_counts_are_exact_and_the_rest_is_shared_evenly(
    counts: list[int | None], more: int | None
) -> None:
    given_ones = sum(count for count in counts if count is not None)
    others = counts.count(None)
    total = None if more is None else given_ones + more
    try:
        which = turns(counts, total)
    except RecipeError:
        assert (total == 0) or (others == 0 and bool(more)) or given_ones + others == 0
        return
    met = np.bincount(which, minlength=len(counts))
    shares = [met[k] for k, count in enumerate(counts) if count is None]
    assert all(met[k] == count for k, count in enumerate(counts) if count is not None)
    assert len(which) == (given_ones + others if total is None else total)
    assert not shares or max(shares) - min(shares) <= 1


def test_without_rules_items_repeat_in_turn() -> None:
    assert names(made(count=6)) == ["bear", "bird", "cat", "owl", "bear", "bird"]
    assert all(not one.sources for one in made(count=6).asked)


def test_counted_items_are_there_as_often_as_asked() -> None:
    one = made({"items": "owl", "count": 3}, {"items": "cat", "count": 0}, count=9)
    assert sorted(names(one)) == [*["bear"] * 3, *["bird"] * 3, *["owl"] * 3]


def test_a_pattern_counts_each_of_its_items() -> None:
    assert sorted(names(made({"items": "b*", "count": 2}))) == [
        "bear", "bear", "bird", "bird", "cat", "owl",
    ]  # fmt: skip


def test_the_later_rule_holds_for_what_it_says() -> None:
    one = made(
        {"items": "*", "color": "red", "scale": [0.5, 1.0]},
        {"items": "b*", "color": "blue", "pin": {"angle_deg": 30}},
        {"items": "bird", "pin": {"size": 10}},
    )
    colours = [asked.values["color"] for asked in one.asked]
    assert colours == ["blue", "blue", "red", "red"]
    assert {asked.values["scale"] for asked in one.asked} == {(0.5, 1.0)}
    assert [dict(asked.pin) for asked in one.asked] == [
        {"angle_deg": 30}, {"angle_deg": 30, "size": 10}, {}, {},
    ]  # fmt: skip
    assert one.asked[1].sources["color"].place == "rule 2: "
    assert one.asked[1].sources["pin.size"].place == "rule 3: "


def test_a_pinned_point_is_for_one_copy_with_all_that_the_rule_says() -> None:
    one = made({"items": "bear", "pin": MIDDLE, "color": "red"}, count=12)
    assert names(one).count("bear") == 3
    assert [bool(asked.values) for asked in one.asked] == [True, *[False] * 11]


def test_two_pins_take_two_copies() -> None:
    one = made(
        {"items": "bear", "count": 2, "pin": MIDDLE}, {"items": "bear", "pin": {"x": 1, "y": 2}}
    )
    pins = [dict(asked.pin) for asked, item in zip(one.asked, one.items, strict=True)
            if item.name == "bear"]  # fmt: skip
    assert pins == [MIDDLE, {"x": 1, "y": 2}]


def test_weights_of_rules_stand_above_the_table() -> None:
    one = made({"items": "b*", "weight": 3}, weights={"bear": 2, "cat": 5})
    assert one.weights.tolist() == [3, 3, 5, 1]


def test_a_hero_stands_alone_where_others_can_stand_in() -> None:
    assert names(made(hero="owl", count=9)).count("owl") == 1
    assert names(made({"items": "owl", "count": 3}, hero="owl", count=9)).count("owl") == 3
    assert names(made(items=ITEMS[:1], hero="bear", count=9)) == ["bear"] * 9


@pytest.mark.parametrize("hero", ["x/owl.svg", "/my art@home/owl.svg", "owl.svg"])
def test_a_hero_may_be_called_by_its_path(hero: str) -> None:
    assert names(made(hero=f"{hero}@50%,50%=35%", count=9)).count("owl") == 1


def test_of_many_names_the_nearest_are_told() -> None:
    known = [f"icon-{k}" for k in range(40)] + ["crow-black"]
    with pytest.raises(RecipeError, match="'rook'; there are 41, the nearest crow-black, icon"):
        matching(["rook"], RuleSource("hero"), known)


@pytest.mark.parametrize(
    ("rules", "options", "problem"),
    [
        ([{"items": "bare"}], {}, "rules: rule 1: no item is called 'bare'; did you mean bear?"),
        ([{"items": ["bear", "x*"]}], {}, "no item is called 'x*'; there are bear, bird, cat"),
        ([{"items": "*", "count": 2}], {"count": 7}, "count: rules count 8 items in all, this 7"),
        ([{"items": "*", "count": 2}], {"count": 9}, "count: rules count 8 items in all, this 9"),
        ([{"items": "*", "count": 0}], {}, "rules: count 0 items; use 1 to 100000"),
        ([{"items": "*", "count": 99_999}], {}, "rules: count 399996 items"),
        ([{"items": "cat", "count": 0}, {"items": "cat", "pin": MIDDLE}], {},
         "rules: rule 2: pins cat, of which there is no copy; count at least 1"),
        ([{"items": "cat", "pin": MIDDLE}, {"items": "c*", "pin": {"x": 1, "y": 2}}], {},
         "rules: rule 2: pins cat, but rule 1 pins the only copy of it; count 2 or more"),
        ([{"items": "cat", "pin": MIDDLE}], {"hero": "cat@10%,10%"},
         "hero: pins cat, but rule 1 pins the only copy"),
        ([], {"hero": "b*"}, "hero: names 2 items (bear, bird ...); name one"),
        ([], {"hero": "bera"}, "hero: no item is called 'bera'; did you mean bear?"),
        ([{"items": "cat", "weight": 1e7}], {}, "weights: the largest may be 1e+06 times"),
    ],
)  # fmt: skip
def test_contradictions_are_named(
    rules: list[dict[str, Any]], options: dict[str, Any], problem: str
) -> None:
    with pytest.raises(RecipeError) as refusal:
        made(*rules, **options)
    assert problem in str(refusal.value)
    assert "\n" not in str(refusal.value)
