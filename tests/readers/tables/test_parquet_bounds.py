"""Parquet files that hold more than memory does, or odd things."""

from __future__ import annotations

import contextlib
from pathlib import Path
from typing import Any

import pytest

from packwork.errors import ReadError
from packwork.readers.tables import parquet as reader
from packwork.readers.tables.decoding import MAX_JSON_BYTES
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


def lying(data: bytes, known: int, claim: int) -> bytes:
    """The file with one number of its footer changed."""
    length = int.from_bytes(data[-8:-4], "little")
    said = data[-8 - length : -8]
    assert said.count(varint(2 * known)) >= 1
    footer = said.replace(varint(2 * known), varint(2 * claim))
    return data[: -8 - length] + footer + len(footer).to_bytes(4, "little") + data[-4:]


def varint(value: int) -> bytes:
    found = b""
    while value > 0x7F:
        found += bytes([value & 0x7F | 0x80])
        value >>= 7
    return found + bytes([value])


@pytest.mark.parametrize("version", ["1.0", "2.0"])
def test_what_a_file_says_of_its_sizes_is_not_believed(
    version: str, written: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    file = written(
        {"n": [b"x" * 200_000, b"y"], "m": [1, 2]}, compression="zstd", use_dictionary=False,
        data_page_version=version, write_statistics=False,
    )  # fmt: skip
    size = parquet.read_metadata(file).row_group(0).column(0).total_uncompressed_size
    path = Path(file)
    path.write_bytes(lying(path.read_bytes(), size, 5))
    assert parquet.read_metadata(file).row_group(0).column(0).total_uncompressed_size == 5
    assert len(read_table(file).rows) == 2
    monkeypatch.setattr(reader, "MOST_DECODED_BYTES", 100_000)
    with pytest.raises(ReadError, match="MB in the columns that are read"):
        read_table(file)


def test_an_account_that_ends_arrow_is_not_asked(written: Any) -> None:
    # Where these disagree, asking pyarrow for a column's account ends the process.
    file = written({"n": list(range(1_234)), "name": [b"\0" * 40] * 1_234}, use_dictionary=False)
    path = Path(file)
    whole = path.read_bytes()
    for claim in (0, 1, 5, 10**8, 2**40):
        path.write_bytes(lying(whole, 1_234, claim))
        with contextlib.suppress(ReadError):
            read_table(file)


@pytest.mark.parametrize(
    "spoil", [lambda d: d[:-8] + b"\xff\xff\xff\x7fPAR1", lambda d: b"PAR1" + b"\xff" * 99 + d[-8:]]
)
def test_a_spoilt_end_is_refused(spoil: Any, written: Any) -> None:
    path = Path(written({"n": [1]}))
    path.write_bytes(spoil(path.read_bytes()))
    with pytest.raises(ReadError, match="is not Parquet that can be read"):
        read_table(str(path))
    with pytest.raises(ValueError, match="account of itself"):
        reader.pieces_of(path.read_bytes())


def test_texts_told_by_the_one_before_are_counted_as_they_are_unpacked(
    written: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    long = "peru" * 2_000
    coding = {"land": "DELTA_BYTE_ARRAY", "n": "PLAIN"}
    columns = {"land": [long] * 500, "n": list(range(500))}
    file = written(columns, use_dictionary=False, column_encoding=coding, write_statistics=False)
    assert read_table(file).rows[499] == {"land": long, "n": 499}
    # The pages are small, what they unpack to is not.
    monkeypatch.setattr(reader, "MOST_DECODED_BYTES", 1_000_000)
    with pytest.raises(ReadError, match="MB in the columns that are read"):
        read_table(file)


def test_a_text_as_long_as_a_book_is_no_name(written: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(reader, "MOST_BYTES_OF_CELL", 50)
    for long in ("x" * 51, b"\xff" * 51):
        with pytest.raises(ReadError, match="a text of 51 bytes, 50 are the most"):
            read_table(written({"n": [1, 2], "name": [long, None]}))
    assert len(read_table(written({"n": [1], "name": ["x" * 50]})).rows) == 1


@pytest.mark.parametrize("coding", ["PLAIN", "DELTA_LENGTH_BYTE_ARRAY", "DELTA_BYTE_ARRAY"])
def test_texts_of_every_encoding_are_read(coding: str, written: Any) -> None:
    file = written({"name": ["a", "b", None]}, use_dictionary=False, column_encoding=coding)
    assert [row["name"] for row in read_table(file).rows] == ["a", "b", None]


def test_pages_are_counted(written: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    file = written({"n": list(range(5_000))}, use_dictionary=False, data_page_size=64)
    assert len(read_table(file).rows) == 5_000
    monkeypatch.setattr(reader, "MOST_PAGES", 3)
    with pytest.raises(ReadError, match="more than 3 pages"):
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
