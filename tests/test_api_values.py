"""Layouts are values: they are listed, measured, written anywhere, and never change."""

from __future__ import annotations

import copy
import io
import json
import pickle
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely

import packwork as pw
from packwork import writers
from packwork.recipe import make_recipe
from packwork.uses.words.recipe import words_recipe

QUICK: dict[str, Any] = {"epochs": 25, "levels": "32,64", "effort": "draft"}
FORMATS = [ending for ending in writers.WRITERS if ending not in {".jpeg", ".tif"}]


@pytest.fixture(scope="module")
def layout() -> pw.Layout:
    return pw.fill("heart", ["star", "circle"], count=5, seed=2, **QUICK)


def heap(layout: pw.Layout) -> pw.Layout:
    """All items in one place."""
    middle = np.full(len(layout), 300.0)
    return replace(layout, poses=replace(layout.poses, x=middle, y=middle))


def test_placed_items_are_listed(layout: pw.Layout) -> None:
    assert len(layout) == 5
    for k, placed in enumerate(layout):
        assert (placed.name, placed.weight) == (layout.items[k].name, 1.0)
        assert placed.pose.angle == layout.poses.angle[k]
        assert placed.area == pytest.approx(layout.areas[k])
        assert placed.outline.region.contains(shapely.Point(placed.pose.x, placed.pose.y))


def test_nothing_of_a_layout_can_be_changed(layout: pw.Layout) -> None:
    again = pickle.loads(pickle.dumps(copy.deepcopy(layout)))  # noqa: S301
    for one in (layout, again):
        outlines = (one.outlines[0], one.inks[0], one.items[0].outline, one.container.outline)
        points = [outline.points for outline in outlines]
        for array in (one.poses.x, one.poses.stretch, one.weights, *points):
            with pytest.raises(ValueError, match="read-only"):
                array[0] = 1.0
        for table in (one.metrics, one.metrics["exact"], one.manifest, one.manifest["recipe"]):
            with pytest.raises(TypeError, match="read-only"):
                table["LC"] = 1.0
            with pytest.raises(TypeError, match="read-only"):
                table.pop("LC")
    assert json.loads(json.dumps(layout.metrics)) == layout.metrics


def test_arrays_that_were_given_stay_the_givers(layout: pw.Layout) -> None:
    mine = np.array(layout.poses.x)
    moved = replace(layout, poses=replace(layout.poses, x=mine))
    mine += 9
    np.testing.assert_array_equal(moved.poses.x, layout.poses.x)


def test_a_changed_layout_has_no_certificate(layout: pw.Layout, tmp_path: Path) -> None:
    assert layout.certified
    assert layout.manifest["certified"]
    assert replace(layout, notes=()).manifest["certified"]
    changed = heap(layout)
    changed.save(tmp_path / "heap.geojson")
    kept = json.loads((tmp_path / "heap.geojson").read_text(encoding="utf-8"))["manifest"]
    assert not {"certified", "metrics"} & kept.keys()
    assert not changed.certified
    assert not pw.Layout.load(tmp_path / "heap.geojson").certified
    assert changed.metrics["OO"] > layout.metrics["OO"]
    # What was measured of it holds for it and for no other.
    assert "certified" not in replace(changed, track=None).manifest


def test_a_heap_is_finished(layout: pw.Layout) -> None:
    done = pw.finish(heap(layout))
    assert done.certified
    assert done.manifest["certified"]
    assert done.metrics["LC"] > heap(layout).metrics["LC"]
    still = pw.finish(layout, grow=False, padding=2)
    assert still.certified
    assert still.metrics["exact"]["min_gap"] >= 2
    assert (still.poses.scale <= layout.poses.scale * (1 + 1e-9)).all()


def test_measuring_needs_a_layout_or_a_file(layout: pw.Layout, tmp_path: Path) -> None:
    assert pw.measure(layout) == layout.metrics
    for ending in ("geojson", "svg", "dxf"):
        file = tmp_path / f"layout.{ending}"
        layout.save(file)
        assert pw.measure(file)["LC"] == pytest.approx(layout.metrics["LC"], abs=1e-3)
        assert len(pw.Layout.load(file)) == 5
    with pytest.raises(pw.ReadError, match="there is no such file"):
        pw.measure(tmp_path / "none.geojson")


def test_recipes_are_run(layout: pw.Layout, tmp_path: Path) -> None:
    file = tmp_path / "heart.toml"
    options = make_recipe(container="heart", items=["star", "circle"], count=5, seed=2, **QUICK)
    file.write_bytes(writers.recipe_bytes(options.plain(), tmp_path))
    for asked in (file, str(file), options.plain(), layout.manifest["recipe"]):
        np.testing.assert_array_equal(pw.run(asked).poses.x, layout.poses.x)
    assert len(pw.run(file, count=2)) == 2
    assert len(pw.run({"container": shapely.box(0, 0, 2, 1), "items": ["star"], **QUICK})) == 1
    with pytest.raises(pw.RecipeError, match="cuont: no such option"):
        pw.run({"container": "heart", "cuont": 3})


@pytest.mark.parametrize("ending", FORMATS)
def test_a_layout_is_saved_to_whatever_is_open(
    ending: str, layout: pw.Layout, tmp_path: Path
) -> None:
    file = tmp_path / f"layout{ending}"
    layout.save(file)
    buffer = io.BytesIO()
    layout.save(buffer, format=ending)
    assert buffer.getvalue() == file.read_bytes()
    with (tmp_path / f"open{ending}").open("wb") as opened:
        layout.save(opened)
    assert (tmp_path / f"open{ending}").read_bytes() == file.read_bytes()
    layout.save(tmp_path / "without", format=ending.lstrip("."))
    assert (tmp_path / "without").read_bytes() == file.read_bytes()


def test_layouts_become_values_of_python(layout: pw.Layout) -> None:
    text = io.StringIO()
    layout.save(text, "svg")
    assert layout.to_svg() == text.getvalue()
    assert layout.to_png(pixels=40, background="ivory")[1:4] == b"PNG"
    made = layout.to_geojson()
    assert made == layout.__geo_interface__
    shapes = [shapely.geometry.shape(one["geometry"]) for one in made["features"]]
    assert shapes[1].area == pytest.approx(layout.areas[0], rel=1e-6)
    with pytest.raises(pw.RecipeError, match="format: a buffer has no ending"):
        layout.save(io.BytesIO())
    with pytest.raises(pw.WriteError, match="docx"):
        layout.save(io.BytesIO(), format="docx")
    with pytest.raises(pw.RecipeError, match="pixls: no such option"):
        layout.to_png(pixls=3)


def recorded() -> pw.Layout:
    return pw.fill("heart", ["star", "owl"], count=4, seed=1, record=True, **QUICK)


@pytest.fixture(scope="module")
def twins() -> tuple[pw.Layout, pw.Layout]:
    return recorded(), recorded()


@pytest.mark.parametrize("ending", [*FORMATS, ".csv"])
def test_the_same_seed_gives_the_same_bytes(
    ending: str, twins: tuple[pw.Layout, pw.Layout], monkeypatch: pytest.MonkeyPatch
) -> None:
    first, second = (_bytes_at(layout, ending, monkeypatch) for layout in twins)
    assert first() == second()


@pytest.mark.parametrize("ending", writers.FILMS)
def test_the_same_seed_gives_the_same_films(
    ending: str, twins: tuple[pw.Layout, pw.Layout], tmp_path: Path
) -> None:
    for name, layout in zip("ab", twins, strict=True):
        layout.save_film(tmp_path / f"{name}{ending}", seconds=0.5, fps=8, film_pixels=60)
    assert (tmp_path / f"a{ending}").read_bytes() == (tmp_path / f"b{ending}").read_bytes()


def _bytes_at(
    layout: pw.Layout, ending: str, monkeypatch: pytest.MonkeyPatch
) -> Callable[[], bytes]:
    """What is written of a layout at some other time of the clock."""
    later = 86_400.0 * id(layout)

    def made() -> bytes:
        if ending == ".csv":
            return layout.to_dataframe().to_csv().encode()
        monkeypatch.setattr(time, "time", lambda: later % 2e9)
        buffer = io.BytesIO()
        layout.save(buffer, ending)
        return buffer.getvalue()

    return made


def test_the_version_is_known() -> None:
    assert pw.__version__.count(".") == 2


def test_a_font_of_words_is_given_as_on_the_command_line() -> None:
    for given in ({"font": "a.ttf"}, {"fonts": "a.ttf"}, {"fonts": ["a.ttf"], "font": None}):
        recipe = words_recipe("heart", {"owl": 1}, **given)
        assert recipe.words is not None
        assert recipe.words.fonts == ("a.ttf",)
        assert recipe.font is None


def test_indexes_and_tables_of_arrow_survive() -> None:
    pandas = pytest.importorskip("pandas")
    arrow = pytest.importorskip("pyarrow")
    frame = pandas.DataFrame({"kg": [3, 1]}, index=pandas.Index(["fig", "kiwi"], name="fruit"))
    for data in (frame, arrow.Table.from_pandas(frame.reset_index()), frame.reset_index()):
        made = pw.chart("circle", data, size_by="kg", label_by="fruit", **QUICK).to_dataframe()
        assert (made.index if data is frame else made["fruit"]).tolist() == ["fig", "kiwi"]
        words = pw.words("circle", data, min_count=1, **QUICK)
        assert [item.name for item in words.items] == ["fig", "kiwi"]


@pytest.mark.parametrize(
    ("call", "said"),
    [
        (lambda: pw.measure(3), "layout: is int; give a layout or its file"),
        (lambda: pw.Layout.load(None), "layout: is NoneType; give a layout or its file"),
        (lambda: pw.finish("heart"), "layout: is str; give a layout, such as"),
        (lambda: pw.run(None), "recipe: is NoneType; give a recipe file, or options as a dict"),
        (lambda: pw.photos("heart", []), "sources: none were given; give photos"),
        (lambda: pw.words("heart", [3, 4]), "source: holds 3 as a word; use a text, a file, or"),
        (lambda: pw.fill("heart", "star", **QUICK).save(None), "path: is NoneType; give a path"),
        (
            lambda: pw.fill("heart", "star", start=pw.Poses([1], [float("nan")])),
            "poses: y must be finite; that of item 0 is nan",
        ),
        (
            lambda: pw.fill("heart", "star", start=pw.Poses([1, 1], [2, 2], scale=[1, 0])),
            r"poses: scale must be finite and positive; that of item 1 is 0\.0",
        ),
    ],
)
def test_what_is_no_such_value_is_told_in_one_line(call: Callable[[], Any], said: str) -> None:
    with pytest.raises(pw.PackworkError, match=rf"^{said}") as met:
        call()
    assert "\n" not in str(met.value)


def test_a_layout_has_numbers_that_can_be_drawn(layout: pw.Layout) -> None:
    with pytest.raises(pw.ShapeError, match="poses: scale must be finite and positive"):
        replace(layout, poses=replace(layout.poses, scale=-layout.poses.scale))
