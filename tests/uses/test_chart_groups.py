"""Charts in groups: one scale for all, each mark in its own group, true in the files."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely

import packwork as pw
from packwork import pipeline, uses
from packwork.readers.layouts.read import read_written
from packwork.uses.charts.layout import bars, copies

QUICK: dict[str, Any] = {"epochs": 30, "levels": "32,64", "effort": "draft"}
NUMBERS = [3.7, 12.0, 0.9, 5.5, 1.3, 2.0, 2.0, 0.4]
ROWS = {
    "name": list("abcdefgh"),
    "number": NUMBERS,
    "kind": ["x", "y", "x", "z", "y", "x", "x", "z"],
    "year": [1901, 1915, 1908, 1933, 1911, 1909, 1902, 1938],
}
TRUE = 1e-3


def run(container: str, **options: Any) -> pipeline.Run:
    recipe = uses.chart_recipe(container, ROWS, **{**QUICK, **options})
    return uses.fill(recipe)


@pytest.mark.parametrize("container", ["none", "circle", "text:O"])
@pytest.mark.parametrize("ending", [".svg", ".geojson"])
def test_areas_are_in_one_proportion_over_all_groups(
    container: str, ending: str, tmp_path: Path
) -> None:
    layout = pw.chart(container, ROWS, size_by="number", by="kind", mark="heart", **QUICK)
    file = tmp_path / f"chart{ending}"
    layout.save(file)
    again = read_written(file)
    per_number = again.areas / np.array(NUMBERS)
    assert per_number / per_number.mean() == pytest.approx(np.ones(8), rel=TRUE)


@pytest.mark.parametrize("container", ["none", "circle"])
def test_each_mark_lies_in_the_part_of_its_group_and_all_is_certified(container: str) -> None:
    done = run(container, size_by="number", by="kind", color_by="year")
    assert done.certified
    layout = done.layout
    parts = shapely.get_parts(layout.container.outline.region)
    assert len(parts) == 3
    homes: dict[str, set[int]] = {}
    for item, outline in zip(layout.items, layout.outlines, strict=True):
        assert item.datum is not None
        home = [k for k, part in enumerate(parts) if part.contains(outline.region)]
        homes.setdefault(item.datum.group, set()).update(home)
        assert len(home) == 1
    assert sorted(len(home) for home in homes.values()) == [1, 1, 1]
    assert len(set.union(*homes.values())) == 3


def test_the_frame_has_the_group_of_each_mark() -> None:
    pytest.importorskip("pandas")
    layout = pw.chart("none", ROWS, by="year", by_step=10, size_by="number", **QUICK)
    frame = layout.to_dataframe()
    assert frame["group"].tolist() == [f"{year // 10 * 10}s" for year in ROWS["year"]]
    assert frame["name"].tolist() == ROWS["name"]


def test_bars_stand_on_one_line_and_rise_with_their_sums() -> None:
    rows = {"kind": ["a"] * 160 + ["b"] * 80 + ["c"] * 20}
    layout = pw.chart("none", rows, by="kind", **QUICK)
    parts = shapely.get_parts(layout.container.outline.region)
    bounds = np.array([part.bounds for part in parts])
    assert np.ptp(bounds[:, 3]) == pytest.approx(0.0, abs=1e-9)
    assert np.ptp(bounds[:, 2] - bounds[:, 0]) == pytest.approx(0.0, abs=1e-9)
    heights = bounds[:, 3] - bounds[:, 1]
    assert heights[0] / heights[1] == pytest.approx(2.0, rel=0.12)
    assert heights[1] > 2 * heights[2]


def test_marks_of_one_colour_lie_in_layers_the_most_frequent_at_the_bottom() -> None:
    rows = {"bar": ["a"] * 40, "kind": ["few", "many", "many", "many"] * 10}
    layout = pw.chart("none", rows, by="bar", color_by="kind", **QUICK)
    is_many = np.array([item.datum.category == "many" for item in layout.items])
    y = layout.poses.y
    # Rows at the border hold both: what lies above all but one row of the many is few.
    assert np.quantile(y[~is_many], 0.8) < np.quantile(y[is_many], 0.2)


def test_equal_upright_marks_stand_in_rows_those_of_one_kind_together() -> None:
    cells = ["a"] * 7 + ["b"] * 3
    rows = [{"g": cell, "kind": "xy"[k % 2]} for k, cell in enumerate(cells)]
    layout = pw.chart("none", rows, by="g", mark=["owl", "tree"], mark_by="kind", effort="draft")
    assert layout.certified
    feet = [outline.bounds[3] for outline in layout.outlines]
    groups = np.array([item.datum.group for item in layout.items])
    kinds = np.array([item.datum.row["kind"] for item in layout.items])
    for name, count in (("a", 7), ("b", 3)):
        own = np.flatnonzero(groups == name)
        levels = np.unique(np.round(np.array(feet)[own], 3))
        rows_of = [own[np.abs(np.array(feet)[own] - level) < 1e-2] for level in levels[::-1]]
        # Full rows from the foot, the last one begun at the left.
        assert [len(row) for row in rows_of][:-1] == [len(rows_of[0])] * (len(rows_of) - 1)
        assert sum(map(len, rows_of)) == count
        ordered = [kinds[k] for row in rows_of for k in row[np.argsort(layout.poses.x[row])]]
        assert ordered == sorted(ordered)
    assert feet[0] == pytest.approx(feet[7], abs=1e-6)


@pytest.mark.parametrize("colour", [{}, {"color_by": "kind"}])
def test_parts_of_marks_end_those_of_one_colour(colour: dict[str, str]) -> None:
    rows = [{"g": "a", "kind": kind, "n": n} for kind, n in (("x", 34), ("x", 27), ("y", 16))]
    layout = pw.chart(
        "none", rows, by="g", size_by="n", unit=10, mark="tree", effort="draft", **colour
    )
    feet = np.array([outline.bounds[3] for outline in layout.outlines])
    areas = np.array([outline.area for outline in layout.outlines])
    kinds = [item.datum.row["kind"] if colour else "" for item in layout.items]
    ordered = np.lexsort((layout.poses.x, -np.round(feet, 2)))
    read = [(kinds[k], bool(areas[k] < 0.99 * areas.max())) for k in ordered]
    assert read == sorted(read)
    # What is left over of those alike is one part.
    assert sum(is_part for _, is_part in read) == (2 if colour else 1)


def test_marks_that_turn_or_differ_in_size_fall() -> None:
    rows = [{"g": "a", "n": k} for k in range(1, 6)]
    assert layout_method(rows, size_by="n", mark="owl") == "lowest"
    assert layout_method(rows, mark="owl", rotate="free") == "lowest"
    assert layout_method(rows, mark="owl") == "rows"


def layout_method(rows: list[dict[str, Any]], **options: Any) -> str:
    layout = pw.chart("none", rows, by="g", effort="draft", **options)
    return str(layout.manifest["start"])


def test_steps_without_rows_keep_their_place_among_bars() -> None:
    layout = pw.chart("none", ROWS, by="year", by_step=10, **QUICK)
    said = [note.says for note in layout.notes]
    names = ["1900s", "1910s", "1920s", "1930s"]
    assert [name for name in said if name in names] == names
    places = [note.matrix[0, 2] for note in layout.notes if note.says in names]
    assert np.diff(places) == pytest.approx(np.diff(places)[0], rel=0.1)
    # Numbers over bars: none over the step without rows.
    assert [name for name in said if name in {"4", "2", "0"}] == ["4", "2", "2"]


def test_sums_over_bars_have_the_decimals_of_the_table() -> None:
    rows = [
        {"land": "A", "eur": "12345,50"}, {"land": "A", "eur": "12110,75"},
        {"land": "B", "eur": "7000,1"}, {"land": "B", "eur": "0,4"},
    ]  # fmt: skip
    for unit in (1000, None):  # no mark is cut for 10 cents of 1000
        layout = pw.chart("none", rows, size_by="eur", by="land", unit=unit, **QUICK)
        assert {"24.456,25", "7.000,50"} <= {note.says for note in layout.notes}
    thirds = [{"land": name, "eur": 1000 / 3} for name in "AAB"]
    layout = pw.chart("none", thirds, size_by="eur", by="land", **QUICK)
    assert {"666.7", "333.3"} <= {note.says for note in layout.notes}


@pytest.mark.parametrize("width", [200, 297, 331.7])
def test_names_that_just_fit_are_written_in_full(width: float) -> None:
    names = ["Robusta/Arabica", "Arabica", "Arabica/Robusta", "Robusta"]
    layout = pw.chart("none", {"kind": names}, by="kind", canvas=width, **QUICK)
    assert [note.says for note in layout.notes if note.says in names] == names


def test_many_names_are_read_upwards_and_of_a_scale_some_are_written() -> None:
    kinds = [f"Department {k}" for k in range(20)]
    turned = pw.chart("none", {"kind": kinds}, by="kind", **QUICK)
    upwards = [note for note in turned.notes if note.says in kinds]
    assert [note.says for note in upwards] == kinds
    assert all(abs(note.matrix[0, 0]) < 1e-9 for note in upwards)
    scale = pw.chart("none", {"year": list(range(1900, 1950))}, by="year", **QUICK)
    written = [int(note.says) for note in scale.notes if note.says.startswith("19")]
    assert 5 <= len(written) < 50
    assert len(set(np.diff(written))) == 1


def test_one_legend_whose_sizes_are_at_the_scale_of_all() -> None:
    layout = pw.chart("circle", ROWS, size_by="number", by="kind", **QUICK)
    said = [note.says for note in layout.notes]
    assert said.count("number") == 1
    per_number = layout.areas[0] / NUMBERS[0]
    keys = zip(layout.notes, layout.notes[1:], strict=False)
    sizes = {b.says: a for a, b in keys if not a.says and b.says in {"10", "5", "2", "1", "0.5"}}
    assert sizes
    for number, note in sizes.items():
        area = layout.items[0].outline.area * note.matrix[0, 0] ** 2
        assert area == pytest.approx(float(number) * per_number, rel=TRUE)


def test_a_sheet_that_was_asked_for_is_kept() -> None:
    for container in ("none", "circle"):
        layout = pw.chart(container, ROWS, by="kind", canvas="A4-landscape", title="T", **QUICK)
        assert (layout.container.width, layout.container.height) == (297.0, 210.0)
        left, top, right, bottom = layout.container.outline.bounds
        assert 0 < left < right < 297
        assert 0 < top < bottom < 210


def test_the_same_seed_gives_the_same_chart() -> None:
    first, second = (run("none", size_by="number", by="kind", seed=3).layout for _ in range(2))
    assert first.poses.x.tolist() == second.poses.x.tolist()
    assert first.poses.y.tolist() == second.poses.y.tolist()


@pytest.mark.parametrize("container", ["none", "circle"])
def test_a_film_shows_group_after_group(container: str) -> None:
    layout = pw.chart(container, ROWS, by="kind", record=True, **QUICK)
    assert layout.track is not None
    shown = [(layout.track.at(share).scale > 0).sum() for share in (0.01, 0.5, 1.0)]
    assert shown[0] < 8
    assert shown[-1] == 8
    assert layout.track.at(1.0).x.tolist() == layout.poses.x.tolist()


@pytest.mark.parametrize("container", ["none", "circle"])
def test_a_run_that_is_stopped_has_what_it_has(container: str) -> None:
    recipe = uses.chart_recipe(container, ROWS, by="kind", **QUICK)
    done = uses.fill(recipe, stop=lambda: True)
    assert len(done.layout.items) + done.left_out == 8
    assert done.layout.manifest["ending"] == "the run was stopped before its last epoch"
    assert done.is_as_asked == (not done.broken and not done.unplaced)


def test_groups_of_the_same_marks_lie_alike() -> None:
    rows = {"land": list("abcd"), "kg": [2.0, 1.0, 4.0, 2.0], "kind": ["x", "x", "y", "y"]}
    done = uses.fill(uses.chart_recipe("circle", rows, by="kind", size_by="kg", **QUICK))
    x, y = done.layout.poses.x, done.layout.poses.y
    assert done.certified
    assert x[1] - x[0] == pytest.approx(x[3] - x[2])
    assert y[1] - y[0] == pytest.approx(y[3] - y[2])
    assert done.layout.areas[2] == pytest.approx(4 * done.layout.areas[1], rel=TRUE)


def test_time_is_shared_by_the_groups() -> None:
    done = run("circle", by="kind", size_by="number", epochs=None, effort="best", time=1.0)
    assert len(done.layout.items) == 8
    assert done.metrics.exact.is_clean


@pytest.mark.parametrize(
    ("container", "options", "message"),
    [
        ("none", {}, "container: none shows groups as bars: give by COL"),
        ("circle", {"by_step": 10}, "by_step: parts the numbers of a column"),
        ("circle", {"by": "mass"}, "by: there is no column 'mass'"),
        ("around:photo.jpg", {"by": "kind"}, "repeats the container"),
        ("none", {"by": "kind", "finish": "none"}, "bars are settled in exact geometry"),
        ("none", {"by": "kind", "padding": 500}, "padding: leaves no room"),
        (
            "circle",
            {"by": "name", "padding": 150},
            "padding: 150 px leaves nothing of the container",
        ),
        ("none", {"by": "kind", "force": "up"}, "groups of by have their own"),
        ("circle", {"by": "kind", "filler": ["star"]}, "filler: has no meaning in groups"),
        (
            "circle",
            {"by": "kind", "label_by": "name", "rules": [{"items": "a", "pin": {"x": 5, "y": 5}}]},
            "pin has no meaning in groups",
        ),
    ],
)
def test_what_has_no_meaning_is_refused(container: str, options: Any, message: str) -> None:
    with pytest.raises(pw.PackworkError, match=message):
        pw.chart(container, ROWS, **{**QUICK, **options})


def test_many_copies_come_in_rows_and_many_bars_side_by_side() -> None:
    circle = pw.read_container("circle")
    whole, cells = copies(circle, [str(k) for k in range(12)], 0.75, 0.03)
    assert len({round(cell.line, 6) for cell in cells}) == 3
    assert whole.height / whole.width == pytest.approx(0.75, abs=0.15)
    _, many = bars([str(k) for k in range(60)], 0.5, 0.03, "px")
    edges = np.array([cell.room.bounds for cell in many])
    assert (edges[1:, 0] > edges[:-1, 2]).all()


def test_groups_tell_by_which_losses_they_were_filled_and_bars_have_none() -> None:
    rows = {"kg": [4, 3, 2, 1, 2], "sort": list("aabbb")}
    options: dict[str, Any] = {**QUICK, "size_by": "kg", "by": "sort", "losses": {"overlap": 9}}
    layout = pw.chart("circle", rows, **options)
    assert layout.manifest["solve"]["losses"]["overlap"] == 9
    assert {level["resolution"] for level in layout.manifest["levels"]}
    with pytest.raises(pw.RecipeError, match="losses: bars are heaps"):
        pw.chart("none", rows, **options)
