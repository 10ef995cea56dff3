"""Tables to marks: what is shown, what is left out and told, what is refused."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import pytest

from packwork import uses
from packwork.errors import PackworkError, ReadError, RecipeError
from packwork.readers.charts import ChartOptions
from packwork.readers.tables.table import read_table
from packwork.recipe.refusals import validated
from packwork.uses import chart_recipe
from packwork.uses.charts.marks import ChartRead, read_chart

LANDS = ({"land": "Peru", "kg": 25, "kind": "Red"}, {"land": "Kenya", "kg": 10, "kind": "blue"})


def chart(rows: Any = LANDS, **options: Any) -> ChartRead:
    return read_chart(validated(ChartOptions, {"data": rows, **options}))


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("t.csv", "land,kg\nPeru,2\nKenya,1\n"),
        ("t.tsv", "land\tkg\nPeru\t2\nKenya\t1\n"),
        ("t.json", json.dumps([{"land": "Peru", "kg": 2}, {"land": "Kenya", "kg": 1}])),
        ("t.json", json.dumps({"land": ["Peru", "Kenya"], "kg": [2, 1]})),
    ],
)
def test_all_tables_give_the_same_marks(name: str, text: str, tmp_path) -> None:
    file = tmp_path / name
    file.write_text(text, encoding="utf-8")
    read = chart(str(file), size_by="kg", label_by="land")
    assert [item.name for item in read.items] == ["Peru", "Kenya"]
    assert read.areas.tolist() == [1.0, 0.5]


def test_a_frame_is_taken_by_what_it_can_do() -> None:
    class Frame:
        columns = ("kg",)

        def to_dict(self, orient: str) -> list[dict[str, Any]]:
            assert orient == "records"
            return [{"kg": np.float64(2)}, {"kg": float("nan")}, {"kg": np.int64(4)}]

    read = chart(Frame(), size_by="kg")
    assert read.values.tolist() == [2.0, 4.0]
    assert read.notices == ("left out 1 row of 3 whose kg is missing: row 2",)


@pytest.mark.parametrize("ending", [".parquet", ".pq", ".json"])
def test_what_pandas_writes_is_read(ending: str, tmp_path) -> None:
    pandas = pytest.importorskip("pandas")
    days = pandas.to_datetime(["2020-05-01", None, "2021-02-03"])
    frame = pandas.DataFrame(
        {"land": ["Peru", "Kenya", "Mali"], "kg": [2.5, None, 1.0], "day": days, "n": [1, 2, 3]}
    )
    file = tmp_path / f"t{ending}"
    if ending == ".json":
        frame.to_json(file, orient="records", date_format="iso")
    else:
        frame.to_parquet(file)
    read = chart(str(file), size_by="kg", label_by="land")
    assert [item.name for item in read.items] == ["Peru", "Mali"]
    assert read.values.tolist() == [2.5, 1.0]
    assert str(read.rows[0]["day"]).startswith("2020-05-01")
    assert [row["n"] for row in read.rows] == [1, 3]
    assert read.notices == ("left out 1 row of 3 whose kg is missing: Kenya",)
    assert chart(frame, size_by="n").values.tolist() == [1.0, 2.0, 3.0]


def test_nested_and_odd_columns_of_parquet_are_read_as_text(tmp_path) -> None:
    pandas = pytest.importorskip("pandas")
    frame = pandas.DataFrame({"a": [[1, 2], [3]], "b": pandas.Categorical(["x", "y"]), 3: [1, 2]})
    frame.columns = frame.columns.map(str)
    frame.to_parquet(tmp_path / "t.parquet")
    read = chart(str(tmp_path / "t.parquet"), size_by="3", label_by="b")
    assert [item.name for item in read.items] == ["x", "y"]


def test_a_unit_has_whole_marks_and_a_part_of_that_area() -> None:
    read = chart(size_by="kg", unit=10, label_by="land")
    areas = [item.outline.area for item in read.items]
    assert read.values.tolist() == [10, 10, 5, 10]
    assert areas[2] / areas[0] == pytest.approx(0.5, rel=1e-9)
    assert read.values.sum() == 35


def test_rows_that_are_shown_alike_are_counted() -> None:
    read = chart([{"kind": "a"}] * 25 + [{"kind": "b"}] * 10, unit=10, color_by="kind")
    assert read.colour_of == ("a", "a", "a", "b")
    assert read.values.tolist() == [10, 10, 5, 10]


@pytest.mark.parametrize("side", ["height", "width"])
def test_a_side_is_in_proportion(side: str) -> None:
    read = chart(size_by="kg", size_is=side, mark=("circle", "heart"), mark_by="land")
    sides = []
    for item, area in zip(read.items, read.areas, strict=True):
        left, top, right, bottom = item.outline.bounds
        scale = np.sqrt(area / item.outline.area)
        sides.append(scale * (bottom - top if side == "height" else right - left))
    assert sides[0] / sides[1] == pytest.approx(2.5, rel=1e-9)


def test_what_cannot_be_shown_is_told_by_name() -> None:
    rows = [
        {"land": land, "kg": kg} for land, kg in zip("abcde", [1, 0, -2, "many", ""], strict=True)
    ]
    read = chart(rows, size_by="kg", label_by="land")
    assert [item.name for item in read.items] == ["a"]
    assert [notice.split("whose kg ")[1] for notice in read.notices] == [
        "is 0: b", "is negative: c", "is no number: d", "is missing: e",
    ]  # fmt: skip


def test_numbers_that_no_computation_holds_are_left_out_and_told() -> None:
    rows = [{"a": 1e308}, {"a": 1e-308}, {"a": 3}]
    read = chart(rows, size_by="a", size_is="height")
    assert read.values.tolist() == [3.0]
    assert read.notices == ("left out 2 rows of 3 whose a is beyond 1e+60: row 1, row 2",)


@pytest.mark.parametrize(
    "odd",
    ["1e-320", "1e300", 10**400],
)
def test_numbers_that_floating_point_would_lose_are_told(odd: Any) -> None:
    read = chart([{"kg": 2.5}, {"kg": odd}], size_by="kg")
    assert read.areas.tolist() == [1.0]
    assert read.notices == ("left out 1 row of 2 whose kg is beyond 1e+60: row 2",)


@pytest.mark.parametrize("unit", [1e-300, 1e300])
def test_units_that_floating_point_would_lose_are_refused(unit: float) -> None:
    with pytest.raises(RecipeError, match="unit"):
        chart_recipe("circle", LANDS, size_by="kg", unit=unit)


def test_categories_in_odd_case_are_one_and_told() -> None:
    read = chart([{"k": "Red"}, {"k": "red"}, {"k": "Red"}], color_by="k")
    assert read.colour_of == ("Red",) * 3
    assert read.notices == ("k: 'red' (1 row) counts as 'Red'",)


def test_marks_go_to_the_values_of_their_names() -> None:
    rows = [{"k": "star"}, {"k": "other"}, {"k": "other"}]
    read = chart(rows, mark=("circle", "star"), mark_by="k")
    assert {name: mark.name for name, mark in read.marks.items()} == {
        "star": "star", "other": "circle",
    }  # fmt: skip


@pytest.mark.parametrize(
    ("rows", "options", "message"),
    [
        (LANDS, {"size_by": "mass"}, "no column 'mass'; there are land, kg, kind"),
        (LANDS, {"size_by": "KG"}, "no column 'KG'; did you mean kg. there are land, kg"),
        (LANDS, {"color_by": "mass"}, "color_by: there is no column"),
        (LANDS, {"size_by": "land"}, "holds text such as 'Peru', no numbers; those of numbers"),
        ([{"a": 0}, {"a": 0}], {"size_by": "a"}, "no row can be shown: 'a' is 0 in 2 rows"),
        ([{"a": 1}] * 100_001, {}, r"100,001 marks; at most 5,000 .* --unit 50 or more"),
        (
            [{"a": 1}] * 100_000,
            {"mark": "star"},
            r"100,000 marks; at most 5,000 .* --unit 20 or more",
        ),
        (LANDS, {"size_by": "kg", "unit": 1e-99}, "more than 1,000,000,000 marks; .* --unit 0.01"),
        ([{"a": 1}, {"a": 1e9}], {"size_by": "a"}, "at most 1e\\+06 can be shown"),
        (LANDS, {"mark": ("circle", "star")}, "say which row has which"),
        (LANDS, {"mark": ("star",), "mark_by": "land"}, "2 values for 1 mark;"),
        ([], {}, "has no rows"),
        (LANDS, {"paper": "x"}, "paper: 'x' is no colour"),
    ],
)
def test_bad_data_are_one_clear_line(rows: Any, options: dict[str, Any], message: str) -> None:
    with pytest.raises(PackworkError, match=message) as caught:
        chart(rows, **options)
    assert "\n" not in str(caught.value)


def test_more_marks_than_levels_can_place_are_taken_as_circles_that_jam() -> None:
    rows = [{"a": 1}] * 6_000
    jammed = uses.read(chart_recipe("circle", rows))
    assert "JamDiscs" in [type(step).__name__ for step in jammed.use.steps(jammed)]
    drawn = uses.read(chart_recipe("circle", rows, force=["down"]))
    with pytest.raises(PackworkError, match="6,000 marks; more than 5,000 have to be circles"):
        drawn.use.steps(drawn)


def test_the_unit_that_is_offered_is_enough() -> None:
    rows = [{"a": 1}] * 100_000
    assert len(chart(rows, unit=20).items) == 5_000


@pytest.mark.parametrize(
    ("name", "text", "message"),
    [
        ("t.csv", "a,a\n1,2\n", "names the column 'a' twice"),
        ("t.csv", "a,b\n1,2,3\n", "line 2: has 3 cells"),
        ("t.csv", "", "has no rows"),
        ("t.json", "{", "is not JSON"),
        ("t.json", "[1]", "holds no rows"),
        ("t.txt", "a", "has no rows"),
        ("t.doc", "a", "is no table"),
        ("t.parquet", "a", "parquet: (needs pandas|is not Parquet)"),
    ],
)
def test_bad_tables_are_one_clear_line(name: str, text: str, message: str, tmp_path) -> None:
    file = tmp_path / name
    file.write_text(text, encoding="utf-8")
    with pytest.raises(ReadError, match=message):
        read_table(str(file))


def test_a_size_that_is_shown_is_of_each_row() -> None:
    rows = [{"g": "ab"[k > 2], "v": v} for k, v in enumerate((5, 5, 5, 20, 20))]
    read = chart(rows, size_by="v", color_by="v", by="g", unit=5)
    assert {item.datum.row["v"] for item in read.items if item.datum} == {5, 20}
