"""What Python people expect of values: sequences, colours, seeds, columns, displays, help."""

from __future__ import annotations

import inspect
import logging
import pickle
import re
import sys
import typing
import xml.etree.ElementTree as ET
from collections import Counter
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
import shapely
from PIL import Image

import packwork as pw
from packwork.api.inputs import handed_over
from packwork.batches.seeds import best_first
from packwork.errors import RecipeError

DRAFT: dict[str, Any] = {"effort": "draft", "levels": "50"}


@pytest.fixture(scope="module")
def layout() -> pw.Layout:
    return pw.fill("heart", ["star", "circle"], count=6, seed=0, **DRAFT)


def test_a_layout_is_a_sequence_of_placements(layout: pw.Layout) -> None:
    assert isinstance(layout, Sequence)
    assert layout[1].name == "circle"
    assert layout[-1] == list(layout)[5]
    assert list(reversed(layout)) == list(layout)[::-1]
    assert layout.index(layout[3]) == 3
    with pytest.raises(IndexError, match="there is no item 6: the layout has 6 items"):
        layout[6]
    with pytest.raises(TypeError, match="items of a layout have numbers, not 'star'"):
        layout["star"]  # type: ignore[call-overload]
    for odd in ([[0, 1]], [0.5], ["a"], [True, False], [9]):
        with pytest.raises(IndexError, match="the layout has 6 items: give numbers below that"):
            layout[odd]  # type: ignore[index]


def test_a_slice_is_a_layout_of_some_items(layout: pw.Layout) -> None:
    some = layout[1:4]
    assert [one.pose for one in some] == [one.pose for one in layout][1:4]
    assert "certified" not in some.manifest
    assert layout[::2].items == layout.items[::2]
    assert layout[(0, 1)] == layout[:2]
    assert len(layout[()]) == 0


def test_layouts_are_equal_by_what_they_hold(layout: pw.Layout) -> None:
    again = pw.fill("heart", ["star", "circle"], count=6, seed=0, **DRAFT)
    assert again == layout
    assert hash(again) == hash(layout)
    assert pickle.loads(pickle.dumps(layout)) == layout  # noqa: S301
    moved = replace(layout, poses=replace(layout.poses, x=layout.poses.x + 1))
    assert moved != layout
    assert moved[0] != layout[0]
    assert layout != replace(layout, weights=layout.weights * 2)
    assert layout != "layout"


def test_pixels_as_a_picture_and_as_an_array(layout: pw.Layout) -> None:
    shown = layout.to_image(pixels=120, background="white")
    assert (shown.mode, max(shown.size)) == ("RGBA", 120)
    assert (layout.to_array(pixels=120, background="white") == np.asarray(shown)).all()
    assert layout.to_array(pixels=40, background="none")[0, 0, 3] == 0


def test_a_frame_of_geopandas_has_outlines_in_place(layout: pw.Layout) -> None:
    pytest.importorskip("geopandas")
    frame = layout.to_geodataframe()
    assert frame.area.to_numpy() == pytest.approx(layout.areas, rel=1e-9)
    assert frame["item"].tolist() == [item.name for item in layout.items]


def test_patches_as_matplotlib_knows_them(layout: pw.Layout) -> None:
    pytest.importorskip("matplotlib")
    axes = layout.plot(ec="red", alpha=0.5)
    assert {patch.get_edgecolor()[:3] for patch in axes.patches} == {(1.0, 0.0, 0.0)}
    assert len({patch.get_facecolor() for patch in axes.patches}) == 2
    assert {p.get_facecolor() for p in layout.plot(color="teal").patches} == {
        (0, 128 / 255, 128 / 255, 1)
    }


def test_title_and_keys_of_a_chart_are_on_the_axes() -> None:
    pytest.importorskip("matplotlib")
    sold = {"kg": [3, 1, 2], "kind": ["a", "b", "a"]}
    chart = pw.chart("heart", sold, size_by="kg", color_by="kind", title="Fruit", **DRAFT)
    axes = chart.plot()
    assert axes.get_title() == "Fruit"
    assert [text.get_text() for text in axes.get_legend().get_texts()] == ["a", "b"]


@pytest.mark.parametrize(
    ("palette", "first"),
    [
        ([(1, 0, 0), (0, 0.5, 1)], "#ff0000"),
        (np.array([[1, 0, 0], [0, 0.5, 1]]), "#ff0000"),
        ((0, 0, 1), "#0000ff"),
        ("okabe-ito", "okabe-ito"),
    ],
)
def test_colours_are_rgb_or_names(palette: Any, first: str) -> None:
    made = pw.fill("heart", "star", count=3, palette=palette, **DRAFT)
    asked = made.manifest["recipe"]["palette"]
    assert (asked if isinstance(asked, str) else asked[0]) == first


def test_colormaps_run_their_own_way() -> None:
    matplotlib = pytest.importorskip("matplotlib")
    data = {"kg": [1.0, 2.0, 3.0]}
    by_name = pw.chart("heart", data, color_by="kg", palette="magma_r", **DRAFT)
    made = pw.chart("heart", data, color_by="kg", palette=matplotlib.colormaps["magma_r"], **DRAFT)
    colours = [item.art.fill for item in by_name.items]  # type: ignore[attr-defined]
    assert colours == [item.art.fill for item in made.items]  # type: ignore[attr-defined]
    light = [sum(Image.new("RGB", (1, 1), one).getpixel((0, 0))) for one in colours]  # type: ignore[arg-type]
    assert light == sorted(light, reverse=True)


def test_colours_by_category_may_be_numbers() -> None:
    data = {"kg": [3, 1], "kind": ["a", "b"]}
    made = pw.chart("heart", data, color_by="kind", palette={"a": (1, 0, 0), "b": "navy"}, **DRAFT)
    assert {i.art.fill for i in made.items} == {"#ff0000", "#000080"}  # type: ignore[attr-defined]


@pytest.mark.parametrize("palette", [[(2, 0, 0)], [(1, 0)], "no colour", 3, [3, 4]])
def test_what_is_no_colour_is_refused(palette: Any) -> None:
    with pytest.raises(RecipeError, match="palette: "):
        pw.fill("heart", "star", palette=palette, **DRAFT)


def test_a_session_takes_the_same_colours(layout: pw.Layout) -> None:
    with layout.edit() as session:
        session.recolor("star#1", (1.0, 0.0, 0.0))
    assert session.layout.to_dataframe()["color"][0] == "#ff0000"


def test_seeds_of_generators_and_of_the_system() -> None:
    def seed_of(seed: Any) -> int:
        made = pw.fill("circle", "star", seed=seed, effort="draft", levels="16")
        return int(made.manifest["seed"])

    assert seed_of(np.random.default_rng(5)) == seed_of(np.random.default_rng(5))
    assert seed_of(np.random.SeedSequence(5)) == seed_of(np.random.default_rng(5))
    assert len({seed_of(None) for _ in range(3)}) > 1
    assert seed_of(np.int64(7)) == 7


def test_weights_are_a_series_a_dict_or_numbers_in_order() -> None:
    pandas = pytest.importorskip("pandas")
    items, asked = ["star", "circle"], {"sizes": "shared", **DRAFT}
    plain = pw.fill("heart", items, weights={"star": 3, "circle": 1}, **asked)
    for weights in (pandas.Series({"star": 3, "circle": 1}), np.array([3, 1]), [3, 1]):
        assert pw.fill("heart", items, weights=weights, **asked) == plain
    with pytest.raises(RecipeError, match="weights: takes a number for each of 2 items"):
        pw.fill("heart", items, weights=[1, 2, 3], **asked)


def test_cells_may_stand_where_a_column_may() -> None:
    pandas = pytest.importorskip("pandas")
    asked = {"size_by": "kg", "color_by": "kind", **DRAFT}
    plain = pw.chart("heart", {"kg": [3, 1], "kind": ["a", "b"]}, **asked)
    cells = {**asked, "size_by": np.array([3, 1])}
    made = pw.chart("heart", {"kind": ["a", "b"]}, **cells)
    assert made.areas == pytest.approx(plain.areas, rel=1e-9)
    cells["color_by"] = pandas.Series(["a", "b"], name="kind")
    made = pw.chart("heart", pandas.DataFrame({"fig": [1, 2]}), **cells)
    assert made.to_dataframe()["category"].tolist() == ["a", "b"]
    of_rows = pw.chart("heart", [{"fig": 1}, {"fig": 2}], **{**cells, "color_by": None})
    assert of_rows.areas == pytest.approx(plain.areas, rel=0.2)
    sizes = pandas.Series([3, 1], index=pandas.Index(["fig", "kiwi"], name="fruit"), name="kg")
    assert pw.chart("heart", sizes, **DRAFT).to_dataframe().loc["fig", "kg"] == 3
    with pytest.raises(RecipeError, match="size_by: must be a column's name"):
        pw.chart("heart", "table.csv", size_by=[1, 2])


@pytest.mark.parametrize("kind", [list, tuple, iter, np.array])
def test_words_are_counted(kind: Any) -> None:
    tokens = ["bear", "fox", "bear", "owl"]
    cased = ["The", "the", "the", "NATO"]
    assert {item.name for item in pw.words("heart", kind(cased), **DRAFT).items} == set(cased)
    assert pw.words("heart", kind(tokens), **DRAFT) == pw.words("heart", Counter(tokens), **DRAFT)


def test_the_best_of_several_seeds() -> None:
    asked = {"count": 5, "seed": 3, **DRAFT}
    tried = [pw.fill("heart", "star", **{**asked, "seed": seed}) for seed in (3, 4, 5)]
    best = pw.fill("heart", "star", best_of=3, **asked)
    assert best == max(tried, key=lambda one: one.metrics["exact"]["coverage"])
    even = pw.fill("heart", pw.read_items("star"), best_of=3, best_by="-unevenness", **asked)
    assert even.metrics["LnU"] == min(one.metrics["LnU"] for one in tried)
    with pytest.raises(RecipeError, match="best_of: must be a whole number"):
        pw.fill("heart", best_of=0)


def test_what_is_told_of_several_seeds_is_told_once(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    (tmp_path / "a.svg").write_text("broken", encoding="utf-8")
    (tmp_path / "b.svg").write_text(pw.fill("circle", "star", **DRAFT).to_svg(), encoding="utf-8")
    pw.fill("heart", tmp_path, best_of=3, **DRAFT)
    assert caplog.text.count("left out") == 1


def test_a_failure_of_one_of_several_seeds_is_not_passed_over() -> None:
    made = [RecipeError("seed", "has no meaning here"), ZeroDivisionError()]
    with pytest.raises(ZeroDivisionError):
        best_first(made)
    with pytest.raises(RecipeError, match="has no meaning here"):
        best_first(made[:1])


def test_a_hero_has_both_coordinates_or_none() -> None:
    with pytest.raises(RecipeError, match="hero: has a place if both"):
        pw.fill("circle", "star", hero=pw.Hero("star", x=0.5))


def test_a_hero_a_force_and_an_anchor_are_values() -> None:
    items = ["owl", "star"]
    hero = pw.Hero("owl", x=0.5, y=0.45, size=0.35)
    asked: dict[str, Any] = {"count": 6, **DRAFT}
    assert pw.fill("heart", items, hero=hero, **asked) == pw.fill(
        "heart", items, hero="owl@50%,45%=35%", **asked
    )
    force = [pw.Force("towards", (0.2, 0.3), strength=2, items="star"), pw.Force(30)]
    made = pw.fill("heart", items, force=force, **asked)
    assert made.manifest["recipe"]["force"] == ["towards 20%,30% strength=2 items=star", "30deg"]
    near = {"star": [1.0, 0.0], "owl": [0.0, 1.0]}
    placed = pw.fill("heart", items, embeddings=near, anchors=pw.Anchor("left", "star"), **asked)
    assert placed.manifest["recipe"]["anchors"] == ["left=star"]


@pytest.mark.parametrize(
    ("force", "text"),
    [
        (
            pw.Force("away", [(0.1, "20mm"), (0.5, 0.5)], by_weight=True),
            "away 10%,20mm 50%,50% by=weight",
        ),
        (
            pw.Force("towards", "my curves/arc.svg", reach="30mm"),
            'towards "my curves/arc.svg" reach=30mm',
        ),
        (pw.Force("align", "horizontal"), "align horizontal"),
    ],
)
def test_a_force_is_written_as_on_the_command_line(force: pw.Force, text: str) -> None:
    assert str(force) == text


def test_measures_have_full_names(layout: pw.Layout) -> None:
    for table in (layout.metrics, layout.metrics["exact"]):
        assert table["coverage"] == table["LC"]
        assert table["overlap"] == table["OO"]
        assert table["outside"] == table["EA"]
    assert pw.measure(layout)["unevenness"] == layout.metrics["LnU"]


def test_values_show_themselves(layout: pw.Layout) -> None:
    item, container = layout.items[0], layout.container
    for shown in (item, container, layout.edit()):
        root = ET.fromstring(shown._repr_svg_())  # type: ignore[union-attr]  # noqa: S314
        assert root.find(".//{*}path") is not None
    years = {1999: {"bear": 3, "fox": 2}, 2000: {"bear": 2, "owl": 2}}
    assert pw.series("heart", years)._repr_png_().startswith(b"\x89PNG")


def test_reprs_are_short(layout: pw.Layout) -> None:
    assert repr(layout.items[0]) == "<Item: star, 95.11 x 90.45>"
    assert repr(layout.container) == "<Container: heart, 600 x 552 px>"
    assert repr(layout.items[0].outline) == "<Outline: 1 ring, 10 points>"
    assert repr(layout.poses) == "<Poses: 6>"
    assert repr(layout.edit()) == "<Session: 6 items in heart>"


def test_types_of_verbs_can_be_read() -> None:
    kinds = (pw.Session, pw.Series, pw.Batch, pw.History, pw.Nest)
    verbs = [
        (kind, name, verb)
        for kind in kinds
        for name, verb in inspect.getmembers(kind, inspect.isfunction)
        if not name.startswith("_")
    ]
    assert len(verbs) > 40
    for _, _, verb in verbs:
        typing.get_type_hints(verb)
    assert typing.get_type_hints(pw.Layout.to_dataframe)["return"] is Any


def test_items_are_called_by_arrays_and_columns(layout: pw.Layout) -> None:
    session = layout.edit()
    session.hold(np.array([0, 1]))
    session.hold(name for name in ("star#2",))
    assert session.document.held.all(axis=1).sum() == 3


def test_a_ring_is_fitted() -> None:
    assert pw.fit_outline([(0, 0), (0, 2), (2, 2), (2, 0)]).controls
    with pytest.raises(pw.ShapeError, match="an outline is a Shapely polygon"):
        pw.fit_outline(3)


def test_help_says_what_each_option_does() -> None:
    said = pw.fill.__doc__ or ""
    assert "size_ratio\n    With free sizes: 2 lets an item be" in said
    assert "command line" not in said
    assert " --" not in said


def test_messages_name_options_as_python_does() -> None:
    with pytest.raises(RecipeError, match=r"graded sets words.*leave out force, or") as refused:
        pw.words("heart", {"a": 2, "b": 1}, sizes="graded", force="down")
    assert "--" not in refused.value.problem + str(refused.value)


def test_notices_name_options_as_python_does(caplog: pytest.LogCaptureFixture) -> None:
    with handed_over():
        logging.getLogger("packwork").warning("%d are smaller than --size-ratio allows", 3)
    logging.getLogger("packwork").warning("use --size-ratio")
    assert caplog.messages == ["3 are smaller than size_ratio allows", "use --size-ratio"]


def test_a_container_that_is_given_has_the_margin_too() -> None:
    sheet = pw.Container("sheet", outline=shapely.box(0, 0, 100, 80))
    layout = pw.fill(sheet, "star", count=4, margin=10, effort="draft", levels="50")
    assert layout.container.outline.bounds == (10.0, 10.0, 90.0, 70.0)
    with pytest.raises(pw.RecipeError, match="margin"):
        pw.fill(sheet, "star", count=4, margin=45, effort="draft")


def test_columns_of_cells_leave_those_of_the_table_alone() -> None:
    table = {"size": ["L", "S"], "kg": [1, 2]}
    layout = pw.chart("circle", table, size_by=[3, 1], label_by="size")
    assert sorted(item.name for item in layout.items) == ["L", "S"]
    with pytest.raises(RecipeError, match="size_by: has 3 cells for 2 rows"):
        pw.chart("circle", table, size_by=[3, 1, 2])


def test_no_colour_is_no_colour() -> None:
    with pytest.raises(RecipeError, match="palette: 'none'"):
        pw.fill("circle", "star", count=1, palette="none", effort="draft")


def test_items_are_picked_as_numpy_and_pandas_pick(layout: pw.Layout) -> None:
    frame = layout.to_dataframe()
    stars = layout[frame["item"] == "star"]
    assert {one.name for one in stars} == {"star"}
    assert layout[[4, 1]].poses.x.tolist() == layout.poses.x[[4, 1]].tolist()
    assert len(layout[layout.areas > layout.areas.max()]) == 0
    with pytest.raises(IndexError):
        layout[[0, 9]]


@pytest.mark.parametrize(
    "weights",
    [
        {"bear": 3, "owl": 1, "fox": 0, "elk": None},
        [("bear", 2), ("owl", 1), ("bear", 1), ("fox", float("nan"))],
        {"word": ["bear", "owl", None, "bear"], "n": [1, 1, 5, 2]},
    ],
)
def test_words_without_a_weight_are_left_out_and_repeated_ones_summed(
    weights: Any, caplog: pytest.LogCaptureFixture
) -> None:
    if no_word := "word" in weights:
        weights = pytest.importorskip("pandas").DataFrame(weights)
    made = pw.words("circle", weights, **DRAFT)
    assert made == pw.words("circle", {"bear": 3, "owl": 1}, **DRAFT)
    said = "left out 1 weight without a word: 5" if no_word else " without a weight: fox"
    assert said in caplog.text


@pytest.mark.parametrize(
    ("source", "said"),
    [
        ([("a", 1, 2)], "a word must be a text, not ('a', 1, 2)"),
        ([["a", "b", "c"]], "a word must be a text, not ['a', 'b', 'c']"),
        ([b"x", b"y"], "a word must be a text, not b'x'"),
        ({("x", "y"): 1}, "a word must be a text, not ('x', 'y')"),
        ([], "holds no words; use a text"),
        (["a", 3], "holds 3 as a word; use a text"),
    ],
)
def test_what_is_no_word_is_refused(source: Any, said: str) -> None:
    with pytest.raises(pw.RecipeError, match=re.escape(said)):
        pw.words("circle", source)


def test_words_of_a_column_with_gaps() -> None:
    pandas = pytest.importorskip("pandas")
    column = pandas.Series(["bear", None, "owl", float("nan"), "bear"])
    assert pw.words("circle", column, **DRAFT) == pw.words("circle", {"bear": 2, "owl": 1}, **DRAFT)


def test_steps_are_weights_of_pandas_too() -> None:
    pandas = pytest.importorskip("pandas")
    years = {1999: {"bear": 3, "fox": 2}, 2000: {"bear": 2, "owl": 2, "fox": 3}}
    plain = pw.series("heart", years, **DRAFT)
    made = pw.series("heart", {year: pandas.Series(one) for year, one in years.items()}, **DRAFT)
    assert made.layouts == plain.layouts


def test_columns_have_names_of_any_kind() -> None:
    pandas = pytest.importorskip("pandas")
    arrow = pytest.importorskip("pyarrow")
    plain = pw.chart("heart", {"kg": [3.0, 1.0]}, size_by="kg", **DRAFT).areas
    numbered = pandas.DataFrame([[0.5, 3], [0.5, 1]])
    levels = pandas.DataFrame({("kg", "sum"): [3, 1], ("kg", "mean"): [1, 1]})
    for table, size_by in (
        (numbered, 1), (levels, ("kg", "sum")), (arrow.table({"a": ["x", "y"]}), [3, 1])
    ):  # fmt: skip
        assert pw.chart("heart", table, size_by=size_by, **DRAFT).areas == pytest.approx(plain)


def test_numbers_that_are_named_in_a_palette_are_categories() -> None:
    data = {"kg": [3, 1, 2], "year": [2020, 2021, 2020]}
    palette = {2020: "red", 2021: (0, 0, 1)}
    made = pw.chart("heart", data, size_by="kg", color_by="year", palette=palette, **DRAFT)
    assert [i.art.fill for i in made.items] == ["#ff0000", "#0000ff", "#ff0000"]  # type: ignore[attr-defined]


def test_palettes_of_seaborn_by_name(monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("matplotlib")
    theirs = SimpleNamespace(color_palette={"deep": [(1, 0, 0), (0, 0, 1)]}.__getitem__)
    monkeypatch.setitem(sys.modules, "seaborn", theirs)
    with pytest.raises(RecipeError, match="'depe' is no colour"):
        pw.fill("heart", "star", palette="depe")  # a KeyError there
    asked = pw.fill("heart", "star", count=2, palette="deep", **DRAFT).manifest["recipe"]
    assert asked["palette"] == ["#ff0000", "#0000ff"]


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"n": 3}, "n: no such option; did you mean count?"),
        ({"hero": ["star", "star"]}, "hero: must be a text, not"),
        ({"seed": 1j}, "seed: must be a whole number, not"),
        ({"best_of": 2, "best_by": len}, "best_by: must be one of"),
        ({"weights": ["a"]}, "weights: takes numbers, not"),
        ({"weights": [1, None]}, "weights: takes numbers, not [1, None]"),
        (
            {"weights": np.array([[1], [np.nan]])},
            "weights: takes numbers, not array([[ 1.], [nan]])",
        ),
        ({"weights": {"star": None}}, "weights: star: must be a number, not None"),
        ({"background": "white"}, "background: no such option; give it to save"),
        ({"canvas": (300, "x")}, "canvas: use a length such as 600"),
        ({"losses": {"overlp": 1}}, "losses: no loss is called 'overlp'"),
    ],
)
def test_messages_speak_of_what_was_written(options: Any, said: str) -> None:
    with pytest.raises(RecipeError, match=re.escape(said)):
        pw.fill("heart", "star", **{"count": 2, **DRAFT, **options})


def test_a_canvas_is_a_pair_of_lengths_too() -> None:
    made = pw.fill("page", "star", count=2, canvas=(300, 200), **DRAFT)
    assert made.manifest["recipe"]["canvas"] == "300x200"


def test_categories_of_pandas_are_some_though_they_are_numbers() -> None:
    pandas = pytest.importorskip("pandas")
    data = pandas.DataFrame({"kg": [3, 1, 2], "year": pandas.Categorical([2020, 2021, 2020])})
    made = pw.chart("heart", data, size_by="kg", color_by="year", **DRAFT)
    assert [i.datum.category for i in made.items if i.datum] == ["2020", "2021", "2020"]
    assert pw.run(made.manifest["recipe"]) == made


class Lazy:
    """A frame that is computed when it is asked for, as polars has it."""

    columns = ("word", "n")

    def __init__(self, rows: int) -> None:
        self.rows = rows

    def head(self, most: int) -> Lazy:
        return Lazy(min(self.rows, most))

    def collect(self) -> Any:
        assert self.rows <= 1_000_001
        words = ["bear", "owl"] * (self.rows // 2 + 1)
        cells = {"word": words[: self.rows], "n": range(self.rows, 0, -1)}
        return pytest.importorskip("pandas").DataFrame(cells)


def test_lazy_frames_are_tables_and_no_more_of_them_is_read_than_may_be() -> None:
    weights = {"bear": 2, "owl": 1}
    assert pw.words("circle", Lazy(2), **DRAFT) == pw.words("circle", weights, **DRAFT)
    assert len(pw.chart("heart", Lazy(3), size_by=[3, 1, 2], **DRAFT)) == 3
    with pytest.raises(RecipeError, match="data: has more than 1,000,000 rows"):
        pw.words("circle", Lazy(10**9))


def test_a_table_with_a_column_for_each_step_is_told_what_would_do() -> None:
    pandas = pytest.importorskip("pandas")
    wide = pandas.DataFrame({1999: [3, 2], 2000: [2, 3]}, index=["bear", "fox"])
    with pytest.raises(RecipeError, match=r"no column 'year' of steps.*a row for each word and"):
        pw.series("heart", wide, "year")
    assert pw.series("heart", wide.to_dict(), "year", **DRAFT).labels == ("1999", "2000")
