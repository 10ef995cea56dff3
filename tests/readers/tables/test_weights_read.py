"""Tables of weights."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from packwork.errors import ReadError
from packwork.readers.tables.pairs import read_weights


@pytest.fixture(scope="module")
def table(tmp_path_factory):
    path = tmp_path_factory.mktemp("tables") / "weights.csv"

    def read(content: str | bytes) -> dict[str, float]:
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return read_weights(path)

    return read


@pytest.mark.parametrize(
    "content",
    [
        "a,1\nb,2.5\n",
        "name,weight\na,1\nb,2.5",
        'Name, Weight\r\n\r\na , 1\r\n"b",2.5\r\n',
        b"\xef\xbb\xbfa,1\nb,2.5",
    ],
)
def test_tables(content, table):
    assert table(content) == {"a": 1.0, "b": 2.5}


@pytest.mark.parametrize(
    ("content", "problem"),
    [
        ("", "holds no weights"),
        ("name,weight\n", "holds no weights"),
        ("a,1\nb,zero\n", "line 2: a weight must be a positive number, not 'zero'"),
        ("a,-1", "line 1: a weight must be"),
        ("a,0", "line 1: a weight must be"),
        ("a,nan", "line 1: a weight must be"),
        ("a,1e999", "line 1: a weight must be"),
        ("a,1\na,2", "line 2: 'a' stands there twice"),
        ("a", "line 1: needs a name and a weight"),
        ("a,1,2", "line 1: has 3 cells, not 2; quote those"),
        (",1", "line 1: needs a name and a weight"),
        ('a,"1', "is not CSV"),
        ("a" * 200_000 + ",1", "is not CSV"),
        (b"\xff\xfe", "holds no weights"),
        (b"a\x81\x8d,1", "UTF-8"),
        (b" " * 5_000_001, "larger than 5 MB"),
    ],
)
def test_unusable_tables(content, problem, table):
    with pytest.raises(ReadError, match=problem):
        table(content)


@settings(deadline=None)
@given(st.text(max_size=60) | st.binary(max_size=60))
def test_any_content(table, content):
    data = content if isinstance(content, bytes) else content.encode("utf-8", "replace")
    try:
        weights = table(data)
    except ReadError:
        return
    assert all(weight > 0 for weight in weights.values())


def test_missing_table():
    with pytest.raises(ReadError, match="no such file"):
        read_weights("nowhere.csv")
