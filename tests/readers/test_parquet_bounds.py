"""Parquet files that hold more than memory does, or odd things."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from packwork.errors import ReadError
from packwork.readers.tables import parquet as reader
from packwork.readers.tables.json_rows import MAX_JSON_BYTES
from packwork.readers.tables.table import read_table

pa = pytest.importorskip("pyarrow")
parquet = pytest.importorskip("pyarrow.parquet")


@pytest.fixture
def written(tmp_path: Path) -> Any:
    def write(columns: dict[str, Any], **options: Any) -> str:
        file = str(tmp_path / "t.parquet")
        table = columns if isinstance(columns, pa.Table) else pa.table(columns)
        parquet.write_table(table, file, **options)
        return file

    return write


def test_far_too_many_rows_are_refused_by_the_metadata(written: Any) -> None:
    # A few kilobytes on disk.
    file = written({"n": pa.nulls(1_000_001, pa.int64())})
    with pytest.raises(ReadError, match="has more than 1,000,000 rows"):
        read_table(file)


def test_lists_count_by_their_values(written: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("packwork.readers.tables.delimited.MOST_CELLS", 1_000)
    file = written({"n": [[0] * 501, [0] * 500]})
    with pytest.raises(ReadError, match="has more than 1,000 cells"):
        read_table(file)


def test_large_columns_are_refused_before_they_are_read(
    written: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(reader, "MOST_DECODED_BYTES", 100_000)
    file = written({"n": ["x" * 200_000, "y"], "m": [1, 2]}, compression="zstd")
    with pytest.raises(ReadError, match="MB in the columns that are read"):
        read_table(file)


def test_texts_that_repeat_are_held_once(written: Any) -> None:
    long = "peru" * 5_000
    table = read_table(written({"land": [long] * 2_000, "n": list(range(2_000))}))
    assert len({id(row["land"]) for row in table.rows}) == 1
    assert table.rows[7] == {"land": long, "n": 7}


def test_of_large_files_only_what_is_needed_is_read(
    written: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(reader, "ALL_COLUMNS_CELLS", 5)
    file = written({"a": [1, 2], "b": ["x", None], "c": [1.5, 2.5]})
    assert read_table(file, needed=["b", "c"]).columns == ("b", "c")
    assert read_table(file).columns == ("a", "b", "c")


@pytest.mark.parametrize(
    "noted", [b"{", b"[]", b'{"index_columns": 3}', b'{"columns": [{"name": 1}]}', b"\xff"]
)
def test_what_pandas_notes_for_itself_is_passed_over(noted: bytes, written: Any) -> None:
    table = pa.table({"n": [1], "__index_level_0__": ["x"]}).replace_schema_metadata(
        {b"pandas": noted}
    )
    assert read_table(written(table)).rows == ({"n": 1},)


def test_times_and_nested_values_become_texts(written: Any) -> None:
    columns = {
        "t": pa.array([1, None], pa.timestamp("ns")),
        "d": pa.array([0, 19_000], pa.date32()),
        "s": pa.array([{"a": 1}, None]),
        "b": pa.array([b"\xff", b"x"]),
        "k": pa.array(["x", "y"]).dictionary_encode(),
    }
    rows = read_table(written(columns)).rows
    assert rows[0]["t"].startswith("1970-01-01 00:00:00")
    assert rows[1] == {"t": None, "d": "2022-01-08", "s": None, "b": "b'x'", "k": "y"}


def test_json_is_bounded_before_it_is_parsed(tmp_path: Path) -> None:
    file = tmp_path / "t.json"
    with file.open("wb") as stream:
        stream.truncate(MAX_JSON_BYTES + 1)
    with pytest.raises(ReadError, match="larger than 30 MB"):
        read_table(str(file))
