"""How many items a container takes, and what is said of a result that does not show it."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import shapely

from packwork import pipeline
from packwork.errors import RecipeError
from packwork.geometry.outline import Outline
from packwork.metrics.shape import ShapeMetrics
from packwork.pipeline.advising import advice, remarks
from packwork.pipeline.charting import chart_recipe
from packwork.pipeline.counting import LEAST, MOST, counted, items_needed
from packwork.pipeline.piling import pile_recipe
from packwork.pipeline.wording import words_recipe
from packwork.recipe import Recipe, make_recipe
from packwork.scene.container import Container
from packwork.scene.layout import Layout
from packwork.scene.pose import Poses
from scenes import round_container, square_container

TAILLESS = ShapeMetrics(bare=0.1, shape=0.7, parts=1, bare_parts=0)
QUICK: dict[str, Any] = {"epochs": 3, "levels": "16,32"}


def with_tail(width: float, factor: float = 1.0) -> Container:
    """A square body with a tail to its right, as large as itself if it were wider."""
    body = shapely.box(0, 0, 60, 60)
    region = shapely.union(body, shapely.box(60, 30 - width / 2, 120, 30 + width / 2))
    region = shapely.affinity.scale(region, factor, factor, origin=(0, 0))
    outline = Outline.from_region(region)
    return Container("tail", "tail", outline, 120 * factor, 60 * factor)


def recipe(**options: Any) -> Recipe:
    return make_recipe(container="tail", **options)


def advised(recipe: Recipe, container: Container, seen: ShapeMetrics = TAILLESS) -> str:
    """The one sentence that is said of a layout in which everything lies at one place."""
    job = pipeline.read(recipe, container=container)
    one = np.ones(len(job.items))
    layout = Layout(container, job.items, Poses(one, one, one * 0, one), one)
    return " ".join(advice(job, layout, seen))


def test_thin_parts_take_more_items() -> None:
    counts = [items_needed(with_tail(width), recipe()).count for width in (40, 12, 6)]
    assert LEAST <= counts[0] < counts[1] < counts[2] <= MOST
    widths = [items_needed(with_tail(width), recipe()).width_cu for width in (12, 6)]
    assert widths == pytest.approx([12, 6], rel=0.25)


def test_tips_that_nobody_misses_take_no_more() -> None:
    assert (
        items_needed(with_tail(1), recipe()).count == items_needed(with_tail(0.5), recipe()).count
    )


def test_items_of_one_size_are_more() -> None:
    free, shared, wide = (
        items_needed(with_tail(12), recipe(**options)).count
        for options in ({}, {"sizes": "shared"}, {"size_ratio": 4})
    )
    assert wide < free < shared


@pytest.mark.parametrize("factor", [0.01, 40.0])
def test_the_canvas_changes_nothing(factor: float) -> None:
    needed = items_needed(with_tail(9, factor), recipe())
    assert needed.count == pytest.approx(items_needed(with_tail(9), recipe()).count, abs=1)


def test_a_number_that_is_given_stays() -> None:
    asked = recipe(count=7)
    assert counted(asked, round_container(), ()) is asked


def test_all_different_items_are_there() -> None:
    items = pipeline.read(recipe(), container=round_container()).items
    found = counted(recipe(count="auto"), round_container(), items).count
    assert found == max(len(items), items_needed(round_container(), recipe()).count)


def test_without_a_container_there_is_nothing_to_count_by() -> None:
    with pytest.raises(RecipeError, match="count: auto needs a container"):
        counted(make_recipe(container="none", count="auto"), None, ())


def test_a_heap_leaves_room_above_it() -> None:
    job = pipeline.read(
        pile_recipe("square", ["circle"], count="auto", size="10%"), container=square_container()
    )
    area = len(job.items) * np.pi * 5**2
    assert 0.3 < area / square_container().outline.area < 0.5


def test_auto_runs_and_says_what_it_chose() -> None:
    runs = [
        pipeline.fill(make_recipe(container="circle", items=["star"], count="auto", **QUICK))
        for _ in range(2)
    ]
    assert [len(run.layout.items) for run in runs] == [LEAST, LEAST]
    assert runs[0].remarks[0].startswith(f"auto chose {LEAST} items, to reach into parts ")
    assert runs[0].report()["remarks"] == list(runs[0].remarks)
    assert runs[0].layout.manifest["recipe"]["count"] == "auto"


def test_auto_words_are_those_that_there_are() -> None:
    asked = words_recipe("heart", {"ox": 2, "bee": 1}, count="auto")
    job = pipeline.read(asked)
    assert [item.name for item in job.items] == ["ox", "bee"]
    assert remarks(job) == ("auto chose 2 words",)


def test_a_good_result_gets_no_advice() -> None:
    good = ShapeMetrics(bare=0.01, shape=0.9, parts=9, bare_parts=2)
    assert advised(recipe(), with_tail(8), good) == ""


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"count": 3}, "10 % of the container lies far from any item; -n "),
        ({"count": 3, "sizes": "shared"}, "--sizes free -n "),
        ({"count": 3, "sizes": "fixed"}, "--sizes free would show it"),
        ({"count": 900}, "--target-coverage 0.85, "),
        ({"count": 900, "target_coverage": 0.85}, "--smallest 0.3%, "),
        ({"count": 900, "target_coverage": 0.85, "max_items": 950}, "--max-items 1900 "),
    ],
)
def test_advice_is_an_option_that_is_not_yet_used(options: dict[str, Any], words: str) -> None:
    assert words in advised(recipe(items=["star"], **options), with_tail(8))


def test_advice_names_what_is_poor() -> None:
    parts = ShapeMetrics(bare=0.3, shape=0.5, parts=33, bare_parts=27)
    ragged = ShapeMetrics(bare=0.01, shape=0.7, parts=1, bare_parts=0)
    asked = recipe(items=["star"], count=3)
    assert advised(asked, with_tail(8), parts).startswith(
        "27 of the container's 33 parts are empty;"
    )
    assert advised(asked, with_tail(8), ragged).startswith(
        "the container's shape shows to 70 % only;"
    )


def test_more_words_are_the_advice_as_long_as_there_are_some() -> None:
    weights = {f"word{k}": float(90 - k) for k in range(70)}
    few = words_recipe("tail", weights, count=9)
    assert "; -n 70 would show more of it" in advised(few, with_tail(4))
    every = words_recipe("tail", weights)
    assert "; --target-coverage 0.6," in advised(every, with_tail(4))


def test_data_and_heaps_are_as_many_as_they_are() -> None:
    assert "a container without thin parts" in advised(
        chart_recipe("tail", {"n": [3, 2, 1]}), with_tail(8)
    )
    assert advised(pile_recipe("square", ["circle"], size="9%"), square_container()) == ""
