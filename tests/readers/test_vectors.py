"""Vectors of items: arrays and tables, by name and in order, and what is refused."""

from __future__ import annotations

import io
from pathlib import Path

import numpy as np
import pytest

from packwork.errors import ReadError
from packwork.readers.vectors import Vectors, in_order, read_vectors

ROWS = [[1.0, 0.5], [0.25, -2.0]]


def _array(rows: object) -> bytes:
    stream = io.BytesIO()
    np.save(stream, np.asarray(rows), allow_pickle=True)
    return stream.getvalue()


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("a.csv", "name,x,y\nowl,1,0.5\nfox,0.25,-2\n"),
        ("a.csv", "word;x;y\nowl;1;0,5\nfox;0,25;-2\n"),
        ("a.tsv", "name\tx\ty\nowl\t1\t0.5\nfox\t0.25\t-2\n"),
        ("a.json", '[{"name": "owl", "x": 1, "y": 0.5}, {"name": "fox", "x": 0.25, "y": -2}]'),
    ],
)
def test_tables_with_names(tmp_path: Path, name: str, text: str) -> None:
    (tmp_path / name).write_text(text, encoding="utf-8")
    found = read_vectors(str(tmp_path / name))
    assert found.names == ("owl", "fox")
    assert found.rows.tolist() == ROWS


@pytest.mark.parametrize("text", ["x,y\n1,0.5\n0.25,-2\n", "1,0.5\n0.25,-2\n"])
def test_tables_of_numbers_alone(tmp_path: Path, text: str) -> None:
    """Whether a first line names the columns or is the first row."""
    (tmp_path / "a.csv").write_text(text, encoding="utf-8")
    found = read_vectors(str(tmp_path / "a.csv"))
    assert found.names is None
    assert found.rows.tolist() == ROWS


@pytest.mark.parametrize("kind", ["<f4", ">f8", "<i2"])
def test_arrays(tmp_path: Path, kind: str) -> None:
    rows = (np.array(ROWS) * 4).astype(kind)
    (tmp_path / "a.npy").write_bytes(_array(np.asfortranarray(rows)))
    assert read_vectors(str(tmp_path / "a.npy")).rows.tolist() == rows.tolist()


def test_parquet(tmp_path: Path) -> None:
    pandas = pytest.importorskip("pandas")
    frame = pandas.DataFrame({"name": ["owl", "fox"], "x": [1.0, 0.25], "y": [0.5, -2.0]})
    frame.to_parquet(tmp_path / "a.parquet")
    found = read_vectors(str(tmp_path / "a.parquet"))
    assert (found.names, found.rows.tolist()) == (("owl", "fox"), ROWS)


@pytest.mark.parametrize(
    ("name", "data", "said"),
    [
        ("a.npy", b"no array", "is no array of NumPy"),
        ("a.npy", _array([[1.0, 2.0]])[:-3], "is cut off, or too long"),
        ("a.npy", _array([1.0, 2.0]), "is an array of shape (2,)"),
        ("a.npy", _array([[{}]]), "holds object, not numbers"),
        ("a.npy", _array([[1.0, np.nan], [1, 2]]), "row 1: number 2 is none"),
        ("a.npy", _array([[1.0, 2.0], [2.0, 4.0]]), "of one direction alone"),
        ("a.npy", _array(np.zeros((3, 2))), "holds zeros alone"),
        ("a.csv", b"name,x\nowl,1\nowl,2\n", "has 'owl' twice"),
        ("a.csv", b"name,x,y\nowl,1,2\nfox,,3\n", "'fox': number 1 is none"),
        ("a.csv", b"name,x\nowl,one\nfox,2\n", "'owl': number 1 is none"),
        ("a.csv", b"name\nowl\nfox\n", "has names alone"),
        ("a.ods", b"PK", "is a spreadsheet"),
        ("a.xlsx", b"PK", "is no workbook of Excel"),
        ("a.bin", b"PK", "is no table"),
    ],
)
def test_what_cannot_be_used(tmp_path: Path, name: str, data: bytes, said: str) -> None:
    (tmp_path / name).write_bytes(data)
    with pytest.raises(ReadError) as met:
        read_vectors(str(tmp_path / name))
    assert said in str(met.value)
    assert "\n" not in str(met.value)


def test_a_header_that_promises_much_takes_no_memory(tmp_path: Path) -> None:
    head = {"descr": "<f8", "fortran_order": False, "shape": (10**9, 10**9)}
    stream = io.BytesIO()
    np.lib.format.write_array_header_1_0(stream, head)  # type: ignore[arg-type]
    (tmp_path / "a.npy").write_bytes(stream.getvalue())
    with pytest.raises(ReadError, match="is cut off, or too long"):
        read_vectors(str(tmp_path / "a.npy"))


def test_rows_in_order_must_be_as_many() -> None:
    vectors = Vectors("a.npy", None, np.array(ROWS))
    assert in_order(vectors, [["a"], ["b"]])[0].tolist() == ROWS
    with pytest.raises(ReadError, match="has 2 rows, and there are 3 items"):
        in_order(vectors, [["a"], ["b"], ["c"]])


def test_names_first_exactly_then_in_any_case() -> None:
    vectors = Vectors("a.csv", ("Owl", "owl", "fox.svg"), np.eye(3))
    rows, known = in_order(vectors, [["owl", "owl.svg"], ["OWL", "x"], ["fox", "fox.svg"], ["bee"]])
    assert rows.argmax(axis=1).tolist() == [1, 0, 2, 0]
    assert known.tolist() == [True, True, True, False]
    with pytest.raises(ReadError, match="names none of the items"):
        in_order(vectors, [["bee", "bee.svg"]])
