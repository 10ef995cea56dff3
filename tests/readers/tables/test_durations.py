"""Lengths of time: numbers where numbers are asked for, else as they are written."""

from __future__ import annotations

import math
from datetime import timedelta
from pathlib import Path

import numpy as np
import pytest

from packwork.errors import ReadError, RecipeError
from packwork.readers.charts import ChartOptions
from packwork.readers.fonts.fallback import open_fonts
from packwork.readers.tables.cells import is_numeric, written_numbers
from packwork.readers.tables.format import TableFormat
from packwork.readers.tables.pairs import pairs_of_rows, read_weights
from packwork.readers.tables.table import plain_row, read_table, rows_of_frame
from packwork.readers.words.options import WordOptions
from packwork.readers.words.shaping import word_item
from packwork.readers.words.source import ranked_words, read_words
from packwork.uses.charts.groups import read_groups
from packwork.uses.words.recipe import words_recipe


@pytest.mark.parametrize(
    ("cells", "hours"),
    [
        (["8:00", "0:45", ""], [8.0, 0.75, math.nan]),
        (["1:30:00", "0:00:36"], [1.5, 0.01]),
        (["8:00", 3], [math.nan, 3.0]),
        (["1:02:00", "57:00"], [math.nan, math.nan]),
        (["8:00", "3"], [math.nan, 3.0]),
        (["8:60"], [math.nan]),
    ],
)
def test_lengths_of_time_are_hours(cells: list[object], hours: list[float]) -> None:
    assert written_numbers(cells, "t.csv", "time") == pytest.approx(hours, nan_ok=True)


def test_lengths_of_time_are_weights_and_sizes(tmp_path: Path) -> None:
    file = tmp_path / "t.csv"
    file.write_text("task,time\nSleep,8:00\nSport,0:45\n", encoding="utf-8")
    assert read_weights(str(file), TableFormat()) == {"Sleep": 8.0, "Sport": 0.75}
    table = read_table(str(file)).with_numbers("time", None, whole=True)
    assert [row["time"].number for row in table.rows] == [8.0, 0.75]


def test_lengths_of_time_are_numbers_of_no_colours_and_groups(tmp_path: Path) -> None:
    file = tmp_path / "t.csv"
    file.write_text("train,leaves\nA,08:00\nB,14:30\n", encoding="utf-8")
    table = read_table(str(file)).with_numbers("leaves", None, whole=True)
    assert not is_numeric(table.rows, "leaves")
    groups = read_groups(table, ChartOptions(data=str(file), by="leaves"), range(2))
    assert groups is not None
    assert groups.names == ("08:00", "14:30")


def test_lengths_of_time_in_memory_are_written() -> None:
    cells = [timedelta(minutes=90), np.timedelta64(90, "m"), np.timedelta64(5400 * 10**9, "ns")]
    pandas = pytest.importorskip("pandas")
    assert [plain_row({"t": cell})["t"] for cell in cells] == ["1:30:00"] * 3
    frame = pandas.DataFrame({"t": pandas.to_timedelta(["1:30:00", None, "26:00:00"])})
    assert [row["t"] for row in rows_of_frame(frame)] == ["1:30:00", None, "26:00:00"]


@pytest.mark.parametrize(
    ("cells", "odd"),
    [
        (["1:30", 90], "90"),
        (["1:30", "2", "0:45"], "'2'"),
        (["1:30", "1:75"], "'1:75'"),
        (["1:75", "1:30"], "'1:75'"),
        (["1:02:00", "57:00"], "'57:00'"),
    ],
)
def test_other_cells_beside_lengths_of_time_are_named(cells: list[object], odd: str) -> None:
    rows = [{"word": str(k), "weight": cell} for k, cell in enumerate(cells)]
    said = f"column 'weight' holds {odd} beside lengths of time such as '1:"
    with pytest.raises(ReadError, match=said):
        pairs_of_rows(rows)
    with pytest.raises(ReadError, match=said):
        read_table(rows).with_numbers("weight", None, whole=False)
    assert read_table(rows).with_numbers("weight", None, whole=True).rows


def test_words_tell_lengths_of_time_as_they_are_written(tmp_path: Path) -> None:
    file = tmp_path / "t.csv"
    file.write_text("word,time\nox,1:30\nyak,0:30\nelk,2:00\nelk,1:00\n", encoding="utf-8")
    words = ranked_words(WordOptions(source=str(file))).words
    assert [(word.text, word.weight, word.written) for word in words] == [
        ("elk", 3.0, ""), ("ox", 1.5, "1:30"), ("yak", 0.5, "0:30")
    ]  # fmt: skip
    assert word_item(words[1], open_fonts([])).label.title == "ox: 1:30"


def test_a_series_of_lengths_of_time_is_no_list_of_words() -> None:
    pandas = pytest.importorskip("pandas")
    series = pandas.Series(pandas.to_timedelta(["1:30:00", "0:30:00"]), index=["ox", "yak"])
    with pytest.raises(RecipeError, match="weight of 'ox' must be a positive number, not 1:30:00"):
        words_recipe("heart", series)


@pytest.mark.parametrize(
    "title", ["Time sheet\n", "Time sheet\n\n", "Time sheet\n\n;;\n", "Printed at;14:30\n\n"]
)
def test_a_title_stands_above_lengths_of_time(title: str, tmp_path: Path) -> None:
    file = tmp_path / "t.csv"
    file.write_text(f"{title}task;person;took\nA;Ann;36:30\nB;Bo;12:15\n", encoding="utf-8")
    table = read_table(str(file))
    assert (table.columns, len(table.rows)) == (("task", "person", "took"), 2)
    assert "above the table" in table.notices[-1]


@pytest.mark.parametrize(
    ("text", "hours"),
    [
        ("sleep,8:00\nsport,0:45\n", {"sleep": 8.0, "sport": 0.75}),
        ("my day\nsleep,8:00\nsport,0:45\n", {"sleep": 8.0, "sport": 0.75}),
        ("a;8:00:00,5\nb;0:45:00,5\n", {"a": 8 + 0.5 / 3600, "b": 0.75 + 0.5 / 3600}),
    ],
)
def test_a_first_row_with_a_length_of_time_is_a_row(
    text: str, hours: dict[str, float], tmp_path: Path
) -> None:
    file = tmp_path / "t.csv"
    file.write_text(text, encoding="utf-8")
    assert {word.text: word.weight for word in read_words(WordOptions(source=str(file)))} == hours


def test_times_name_columns_below_a_title(tmp_path: Path) -> None:
    file = tmp_path / "t.csv"
    file.write_text("Seats\n\nroom,8:00,9:00\nA,30,12\nB,5,6\n", encoding="utf-8")
    assert read_table(str(file)).columns == ("room", "8:00", "9:00")
