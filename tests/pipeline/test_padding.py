"""Paddings that nothing can keep are refused, at once or after little work."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import packwork as pw
from packwork.errors import RecipeError
from packwork.finish.finish import finish
from packwork.finish.options import FinishOptions
from packwork.geometry.outline import Outline
from packwork.pipeline.plan.limits import check_padding
from packwork.readers.builtin import builtin_item
from packwork.readers.svg.item import item_of_svg
from packwork.recipe import make_recipe
from packwork.scene.container import Container
from packwork.scene.pose import Poses
from packwork.scene.recolour import recoloured, run_together
from packwork.uses import fill, words_recipe

WORDS = {f"word{k}": 100 // (k + 1) + 1 for k in range(25)}


def square(side: float) -> Outline:
    half = side / 2
    corners = [[-half, -half], [half, -half], [half, half], [-half, half]]
    return Outline.from_rings([np.array(corners)])


ROOM = Container("square", "square", square(100.0), 100.0, 100.0)


def test_a_padding_that_even_points_cannot_keep_is_refused() -> None:
    # Four by four points at 20 px from the edge and each other.
    check_padding(ROOM, 20.0, 16)
    with pytest.raises(RecipeError, match=r"even as points .* use 2.6 px or less"):
        check_padding(ROOM, 20.0, 60)
    with pytest.raises(RecipeError, match="leaves nothing of the container of a group"):
        check_padding(ROOM, 51.0, 1, " of a group")


@pytest.mark.parametrize("padding", ["50%", "20%"])
def test_words_are_refused_before_anything_is_placed(padding: str) -> None:
    began: list[object] = []

    class Observer:
        every = 1

        def on_step(self, step: object) -> None:
            began.append(step)

    with pytest.raises(RecipeError, match="padding: "):
        fill(words_recipe("circle", WORDS, padding=padding), observer=Observer())
    assert began == []


@pytest.mark.parametrize("by", [None, "kind"])
def test_charts_are_refused_at_once(tmp_path: Path, by: str | None) -> None:
    table = tmp_path / "t.csv"
    rows = "".join(f"n{k},{k + 1},{'ab'[k % 2]}\n" for k in range(12))
    table.write_text(f"name,n,kind\n{rows}", encoding="utf-8")
    with pytest.raises(RecipeError, match="padding: "):
        pw.chart("circle", str(table), size_by="n", by=by, padding="50%")


def test_a_finish_that_has_no_room_gives_up_before_its_first_round() -> None:
    rng = np.random.default_rng(0)
    x, y = 80 * rng.random((2, 30)) - 40
    poses = Poses(x, y, np.zeros(30), np.ones(30))
    done = finish(ROOM, [square(2.0)] * 30, poses, FinishOptions(gap_cu=18.0, sizes="shared"))
    assert not done.clean
    assert done.rounds == 0


def test_most_items_without_room_are_an_error_that_says_what_would_do() -> None:
    with pytest.raises(
        RecipeError, match=r"padding: 90 px is too much for 25 items: 2. of 25 found"
    ):
        fill(words_recipe("circle", WORDS, padding="15%", effort="draft", levels="50"))


def test_wide_paddings_work_on_coarse_outlines() -> None:
    run = fill(words_recipe("circle", WORDS, padding="10%", effort="draft", count=9))
    assert run.certified
    assert run.metrics.exact.min_gap >= 60


@pytest.fixture
def one_colour(tmp_path: Path) -> Path:
    """A folder of two drawings in black."""
    for name, path in (("bar", "M0 0H9V3H0Z"), ("block", "M0 0H5V5H0Z")):
        svg = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9"><path d="{path}"/></svg>'
        (tmp_path / f"{name}.svg").write_text(svg, encoding="utf-8")
    return tmp_path


@pytest.mark.parametrize(
    ("more", "told"),
    [
        ({}, "stand"),
        ({"padding": "0"}, "touch"),
        ({"padding": "1%"}, ""),
        ({"palette": "okabe-ito"}, "stand"),
        ({"palette": "#e63946"}, "stand"),
    ],
)
def test_neighbours_of_one_colour_do_not_touch_unasked(
    one_colour: Path, more: dict[str, str], told: str
) -> None:
    recipe = make_recipe(
        container="circle", items=[str(one_colour)], count=12, effort="draft", levels="50", **more
    )
    run = fill(recipe)
    assert run.certified
    sentences = {
        word: any(word in one for one in (*run.remarks, *run.advice))
        for word in ("drawings stand", "colour and touch")
    }
    assert sentences == {"drawings stand": told == "stand", "colour and touch": told == "touch"}
    assert (run.metrics.exact.min_gap > 3) == (told == "stand" or more == {"padding": "1%"})


@pytest.mark.parametrize("is_pinned", [False, True])
def test_what_is_kept_apart_unasked_is_never_refused(
    one_colour: Path, tmp_path: Path, is_pinned: bool
) -> None:
    where = tmp_path / "where"
    where.mkdir()
    zigzag = "M0 0" + "".join(f"H{600 * (k % 2 == 0)}v10" for k in range(9))
    line = f'<path d="{zigzag}" fill="none" stroke="#000" stroke-width="3"/>'
    svg = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="-5 -5 610 110">{line}</svg>'
    (where / "line.svg").write_text(svg, encoding="utf-8")
    asked = (
        {"container": "square", "count": 8, "hero": "bar=99%"}
        if is_pinned
        else {"container": str(where / "line.svg"), "count": 4}
    )
    run = fill(make_recipe(items=[str(one_colour)], effort="draft", levels="50", **asked))
    assert run.certified


def test_a_good_share_of_one_colour_runs_together(one_colour: Path) -> None:
    black = [
        item_of_svg(file.read_bytes(), file.stem, file.name)
        for file in sorted(one_colour.glob("*.svg"))
    ]
    coloured = [recoloured(builtin_item("star"), f"#{k}00000") for k in range(1, 9)]
    assert run_together([*black, *coloured[:1]])
    assert not run_together([*black, *coloured])
    # Copies are alike without that.
    assert not run_together(coloured[:4] * 5)
    assert not run_together(black[:1] * 5)


def test_an_earlier_layout_keeps_its_gaps(one_colour: Path, tmp_path: Path) -> None:
    asked = {"count": 12, "effort": "draft", "levels": "50"}
    earlier = tmp_path / "earlier.geojson"
    pw.fill("circle", str(one_colour), padding="0", **asked).save(earlier)
    later = pw.fill("circle", str(one_colour), start=str(earlier), stay=True, **asked)
    assert later.metrics["exact"]["min_gap"] < 1


def test_auto_is_what_suits_what_is_placed(one_colour: Path) -> None:
    side = ROOM.side
    words = words_recipe("square", WORDS)
    assert words.padding_cu(ROOM) == words_recipe("square", WORDS, padding="auto").padding_cu(ROOM)
    assert words.padding_cu(ROOM) == pytest.approx(0.003 * side)
    assert words_recipe("square", WORDS, padding="0").padding_cu(ROOM) == 0
    asked = {"count": 4, "effort": "draft", "levels": "50", "padding": "0"}
    lines, icons = pw.fill("circle", str(one_colour), **asked), pw.fill("circle", "icons", **asked)
    for layout, is_wide in ((lines, True), (icons, False)):
        with layout.edit() as session:
            session.set(padding="auto")
            assert (session.document.options.padding > 1) == is_wide
    # What a run has found by itself is known, and what a gap would take room from has none.
    many = {f"word{chr(97 + k % 26)}{chr(97 + k // 26)}": 1 for k in range(150)}
    cloud = pw.words("circle", many, effort="draft", count=150)
    fixed = pw.fill("circle", str(one_colour), sizes="fixed", **asked)
    hero = pw.fill("circle", str(one_colour), hero="bar", **asked)
    for layout in (cloud, fixed, hero):
        with layout.edit() as session:
            before = session.document.options.padding
            assert before < 1.2
            session.set(padding="auto")
            assert session.document.options.padding == before
    with pytest.raises(RecipeError, match="use auto or a length such as"):
        make_recipe(container="circle", padding="wide")
