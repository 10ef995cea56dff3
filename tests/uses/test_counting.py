"""How many items a container takes, and what is said of a result that does not show it."""

from __future__ import annotations

import math
import re
from dataclasses import replace
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest
import shapely

from packwork import uses
from packwork.errors import RecipeError
from packwork.geometry.outline import Outline
from packwork.metrics.pixel import ShapeMetrics
from packwork.pipeline.plan.counts import LEAST, MOST, items_needed
from packwork.pipeline.state import RunContext, RunState
from packwork.recipe import Recipe, make_recipe
from packwork.scene.container import Container, repeating
from packwork.scene.item import VectorArt
from packwork.scene.layout import Layout
from packwork.scene.pose import Poses
from packwork.steps import shortfalls
from packwork.steps.measure import RemarkCount
from packwork.steps.shortfalls import Advise, TellOneColour
from packwork.uses.charts.recipe import chart_recipe
from packwork.uses.icons import KnownContainer
from packwork.uses.piles.recipe import pile_recipe
from packwork.uses.words.recipe import words_recipe
from packwork.uses.words.use import RemarkWords
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
    job = uses.read(recipe, container=container)
    one = np.ones(len(job.items))
    layout = Layout(container, job.items, Poses(one, one, one * 0, one), one)
    metrics = cast(Any, SimpleNamespace(seen=seen))
    state = replace(RunState.of(job), layout=layout, metrics=metrics)
    return " ".join(map(str, Advise().run(state, RunContext()).findings))


@pytest.mark.parametrize(("between", "count"), [(0.0, 1), (1.0, 0)])
def test_items_of_one_colour_run_together_only_where_they_touch(between: float, count: int) -> None:
    container = with_tail(12)
    job = uses.read(recipe(items=["circle", "square"], count=2), container=container)
    arts = (VectorArt(f'<path d="M0 0h{k}v9z"/>', np.eye(2, 3)) for k in (8, 9))
    items = tuple(replace(one, art=art) for one, art in zip(job.items, arts, strict=True))
    one = np.ones(2)
    beside = job.items[0].outline.bounds[2] - job.items[1].outline.bounds[0] + between
    layout = Layout(container, items, Poses(np.array([0, beside]), 0 * one, 0 * one, one), one)
    state = replace(RunState.of(job), layout=layout, metrics=cast(Any, SimpleNamespace()))
    assert len(TellOneColour().run(state, RunContext()).findings) == count


def test_thin_parts_take_more_items() -> None:
    counts = [items_needed(with_tail(width)).count for width in (40, 12, 6)]
    assert LEAST <= counts[0] < counts[1] < counts[2] <= MOST
    widths = [items_needed(with_tail(width)).width_cu for width in (12, 6)]
    assert widths == pytest.approx([12, 6], rel=0.25)


def test_tips_that_nobody_misses_take_no_more() -> None:
    assert items_needed(with_tail(1)).count == items_needed(with_tail(0.5)).count


def test_items_of_one_size_are_more() -> None:
    free, shared, wide = (
        items_needed(with_tail(12), *options).count for options in ((), ("shared",), ("free", 4.0))
    )
    assert wide < free < shared


@pytest.mark.parametrize("factor", [0.01, 40.0])
def test_the_canvas_changes_nothing(factor: float) -> None:
    needed = items_needed(with_tail(9, factor))
    assert needed.count == pytest.approx(items_needed(with_tail(9)).count, abs=1)


def test_a_number_that_is_given_stays() -> None:
    assert len(uses.read(recipe(count=7), container=round_container()).items) == 7


def test_all_different_items_are_there() -> None:
    items = uses.read(recipe(), container=round_container()).items
    found = KnownContainer(round_container()).needed(recipe(count="auto"), items)
    assert found == max(len(items), items_needed(round_container()).count)


def test_thin_and_branched_items_are_more() -> None:
    room, auto = KnownContainer(round_container()), recipe(count="auto")
    by_name = {one.name: one for one in uses.read(recipe(), container=round_container()).items}
    few, many = (room.needed(auto, [by_name[name]]) for name in ("apple", "anchor"))
    assert LEAST <= few < 1.5 * LEAST < 2 * LEAST < many


def test_without_a_container_there_is_nothing_to_count_by() -> None:
    with pytest.raises(RecipeError, match="count: auto needs a container"):
        KnownContainer(None).needed(make_recipe(container="none", count="auto"), ())


def test_a_heap_leaves_room_above_it() -> None:
    job = uses.read(
        pile_recipe("square", ["circle"], count="auto", size="10%"), container=square_container()
    )
    area = len(job.items) * np.pi * 5**2
    assert 0.3 < area / square_container().outline.area < 0.5


def test_auto_runs_and_says_what_it_chose() -> None:
    runs = [
        uses.fill(make_recipe(container="circle", items=["square"], count="auto", **QUICK))
        for _ in range(2)
    ]
    assert [len(run.layout.items) for run in runs] == [LEAST, LEAST]
    # What is the least that there are reaches into parts of no width.
    assert runs[0].remarks == (f"auto chose {LEAST} items",)
    assert runs[0].report()["remarks"] == list(runs[0].remarks)
    assert runs[0].layout.manifest["recipe"]["count"] == "auto"


def test_auto_words_are_those_that_there_are() -> None:
    asked = words_recipe("heart", {"ox": 2, "bee": 1}, count="auto")
    job = uses.read(asked)
    assert [item.name for item in job.items] == ["ox", "bee"]
    (found,) = RemarkWords().run(RunState.of(job), RunContext()).findings
    assert str(found) == "auto chose 2 words"


def test_auto_words_are_no_fewer_than_without_it() -> None:
    weights = {f"w{k}": 200.0 - k for k in range(200)}
    auto, plain = (
        uses.read(words_recipe("heart", weights, count=count)).items for count in ("auto", 100)
    )
    assert len(auto) == len(plain) == 100


def test_the_width_is_told_that_gave_the_number() -> None:
    def told(container: Container, **options: Any) -> str:
        job = uses.read(recipe(count="auto", **options), container=container)
        return str(RemarkCount().run(RunState.of(job), RunContext()).findings[0])

    told_tail = told(with_tail(6))
    assert re.fullmatch(r"auto chose \d+ items, to reach into parts \d.* px wide", told_tail)
    # As many as there are.
    assert told(round_container(), items=["icons"]).endswith(" items")


def test_a_good_result_gets_no_advice() -> None:
    good = ShapeMetrics(bare=0.01, shape=0.9, parts=9, bare_parts=2)
    assert advised(recipe(), with_tail(8), good) == ""


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"count": 3}, "10 % of the container lies far from any item; -n "),
        ({"count": 3, "sizes": "shared"}, "--sizes free -n "),
        ({"count": 3, "sizes": "fixed"}, "--sizes free would show it"),
        ({"count": 900}, "-n 1800 would show more of it"),
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
    assert "; -n 70 would show more of it; --sizes graded, " in advised(few, with_tail(4))
    every = words_recipe("tail", weights, sizes="shared")
    assert "; --sizes graded, " in advised(every, with_tail(4))
    # Automatic sizes have tried that.
    assert "; --repeat auto," in advised(words_recipe("tail", weights), with_tail(4))
    most = words_recipe("tail", weights, count=65)
    assert "-n 70" not in advised(most, with_tail(4))
    six = words_recipe("tail", dict(list(weights.items())[:6]))
    assert "--sizes graded" not in advised(six, with_tail(4))
    assert "; --repeat auto," in advised(six, with_tail(4))
    graded = words_recipe("tail", weights, sizes="graded")
    assert "; --repeat auto," in advised(graded, with_tail(4))


def test_where_the_most_items_may_not_do_another_container_is_advised(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(shortfalls, "items_needed", lambda *_: SimpleNamespace(count=MOST))
    told = advised(recipe(items=["star"], count=9), with_tail(12))
    assert told.endswith("; a container of fewer and larger parts would show")


def test_what_a_run_cannot_do_is_no_advice() -> None:
    weights = {f"word{k}": float(20 - k) for k in range(6)}
    again = words_recipe("tail", weights, repeat="auto")
    assert advised(again, with_tail(4)) == ""
    tile = repeating(square_container(), "square")
    few = words_recipe("page", weights, tile="square", sizes="shared")
    assert advised(few, tile).endswith("; --sizes free would show it")
    assert advised(words_recipe("page", weights, tile="square", sizes="free"), tile) == ""
    many = make_recipe(container="page", items=["star"], count=400, tile="square", sizes="free")
    assert advised(many, tile) == ""


def test_of_a_container_of_thin_lines_more_items_are_not_the_advice() -> None:
    rim = shapely.Point(50, 50).buffer(50).difference(shapely.Point(50, 50).buffer(49.8))
    ring = Container("tail", "tail", Outline.from_region(rim), 100, 100)
    assert "; it is lines 0.2 px wide; " in advised(recipe(), ring)


def test_data_and_heaps_are_as_many_as_they_are() -> None:
    asked = chart_recipe("tail", {"n": list(range(1, 31))})
    assert "a container without thin parts" in advised(asked, with_tail(8))
    heap = uses.read(pile_recipe("square", ["circle"], size="9%"), container=square_container())
    assert not any(isinstance(step, Advise) for step in heap.use.steps(heap))


@pytest.mark.parametrize(("rows", "container"), [(3, with_tail(8)), (30, round_container())])
def test_a_chart_is_not_sent_to_a_container_that_would_not_do(
    rows: int, container: Container
) -> None:
    told = advised(chart_recipe("tail", {"n": list(range(1, rows + 1))}), container)
    assert told.endswith("; more marks, of more rows or of a smaller --unit, would show more of it")


def _guitar(neck: float) -> Container:
    body = shapely.union_all(
        [shapely.Point(150, 480).buffer(120), shapely.Point(150, 330).buffer(90)]
    )
    neck_and_head = shapely.union_all(
        [
            shapely.box(150 - neck / 2, 40, 150 + neck / 2, 330),
            shapely.box(150 - neck, 0, 150 + neck, 60),
        ]
    )
    return Container("guitar", outline=Outline.of(body.union(neck_and_head)))


@pytest.mark.parametrize("neck", [50, 60, 70])
def test_a_long_neck_is_more_than_one_column(neck: float) -> None:
    container = _guitar(neck)
    count = items_needed(container).count
    mean_side = math.sqrt(container.outline.area / count)
    assert neck / mean_side > 1.2
    assert count <= 100


def test_a_plain_shape_takes_no_more_for_it() -> None:
    disc = Container("disc", outline=Outline.of(shapely.Point(300, 300).buffer(300)))
    assert items_needed(disc).count == 20
