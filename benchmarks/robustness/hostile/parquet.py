"""Parquet files of a few kilobytes that hold much, say what is not so, or note odd things.

Each is made by formula, in a copy of the process: who makes them needs memory, too.
"""

from __future__ import annotations

import io
import random
from collections.abc import Callable, Iterator, Mapping
from decimal import Decimal
from functools import partial
from pathlib import Path
from typing import Any

from benchmarks.robustness.hostile.running import Line

USES = (
    ("--size-by", "n"),
    ("--size-by", "n", "--label-by", "name"),
    ("--size-by", "n", "--by", "name", "--color-by", "name"),
)


def lines(count: int, seed: int) -> Iterator[Line]:
    """So many charts, each of a file of its own."""
    for number in range(count):
        dice = random.Random(f"parquet {seed} {number}")  # noqa: S311 - nothing secret
        sort = sorted(_FILES)[number % len(_FILES)]
        words = ("chart", "circle", "t.parquet", *dice.choice(USES), "--effort", "draft",
                 "--levels", "16,32", "-o", "a.svg", "--report", "report.out")  # fmt: skip
        write = partial(_write, sort, dice.random())
        yield Line(number, "Parquet", words, {"t.parquet": write})


def _write(sort: str, chance: float, path: Path) -> None:
    path.write_bytes(_FILES[sort](random.Random(chance)))  # noqa: S311


def repeated(dice: random.Random) -> bytes:
    """One long text in every row."""
    rows, length = dice.choice(((20, 1_000_000), (20_000, 5_000), (900_000, 100), (100, 10)))
    arrow = _arrow()
    names = arrow.DictionaryArray.from_arrays(
        arrow.array([0] * rows, arrow.int32()), ["x" * length]
    )
    return _file({"name": names, "n": arrow.array(range(1, rows + 1))}, dice)


def of_nothing(dice: random.Random) -> bytes:
    """Very many rows that hold nothing, or no rows, or no columns."""
    rows = dice.choice((0, 1, 1_000, 900_000, 20_000_000))
    arrow = _arrow()
    columns = {"name": arrow.nulls(rows, arrow.string()), "n": arrow.nulls(rows, arrow.int8())}
    return _file(dice.choice((columns, {})), dice)


def packed(dice: random.Random) -> bytes:
    """A column that is a thousand times larger once it is unpacked."""
    arrow = _arrow()
    size = dice.choice((1, 20, 90, 200)) * 1_000_000
    big = arrow.array([b"\0" * size, b""], arrow.binary())
    return _file({"name": big, "n": [1, 2]}, dice, use_dictionary=False)


def lying(dice: random.Random) -> bytes:
    """Sizes and counts in the file's own account that are not so."""
    rows, size = dice.choice(((1_234, 40), (1, 800_000_000), (3, 90_000_000), (12_345, 3)))
    arrow = _arrow()
    columns = {"name": arrow.array([b"\0" * size] * rows, arrow.binary()), "n": range(rows)}
    data = _file(columns, dice, use_dictionary=False)
    told = _parquet().read_metadata(io.BytesIO(data))
    chunk = told.row_group(0).column(dice.choice((0, 1)))
    known = (
        chunk.total_uncompressed_size, chunk.total_compressed_size, told.num_rows, chunk.num_values
    )  # fmt: skip
    claim = dice.choice((0, 1, 5, -1, 1_000, 10**8, 2**31, 2**62))
    return with_claim(data, dice.choice(known), claim)


def with_claim(data: bytes, known: int, claim: int) -> bytes:
    """The file with one number of its footer changed, wherever it stands there."""
    length = int.from_bytes(data[-8:-4], "little")
    footer = data[-8 - length : -8].replace(_number(known), _number(claim))
    return data[: -8 - length] + footer + len(footer).to_bytes(4, "little") + data[-4:]


def _number(value: int) -> bytes:
    """As Thrift's compact protocol writes it: zigzag, seven bits a byte."""
    left = (value << 1) ^ (value >> 63)
    found = bytearray()
    while True:
        found.append(left & 0x7F | (0x80 if left > 0x7F else 0))
        left >>= 7
        if not left:
            return bytes(found)


def prefixed(dice: random.Random) -> bytes:
    """Texts that are told by how much they share with the one before."""
    rows, length = dice.choice(((90, 30_000), (60, 1_000_000), (300, 1_000_000), (40_000, 10)))
    columns = {"name": ["x" * length] * rows, "n": range(1, rows + 1)}
    coding = {"name": "DELTA_BYTE_ARRAY", "n": "DELTA_BINARY_PACKED"}
    return _file(columns, dice, use_dictionary=False, column_encoding=coding)


def noted(dice: random.Random) -> bytes:
    """What pandas and Arrow note for themselves, spoilt."""
    key = dice.choice((b"pandas", b"ARROW:schema"))
    said = dice.choice((b"", b"{", b"[]", b'{"index_columns": 3}', b"\xff" * 400, b"[" * 99_999,
                        b'{"columns": [{"name": {}}], "index_columns": [[]]}'))  # fmt: skip
    table = _arrow().table({"name": ["a", "b"], "n": [1, 2], "__index_level_0__": [1, 2]})
    return _file(table.replace_schema_metadata({key: said}), dice)


def wide(dice: random.Random) -> bytes:
    """Thousands of columns, or names as long as books."""
    many = {f"c{k}": [k] for k in range(dice.choice((50, 3_000)))}
    long = {"x" * dice.choice((300, 1_000_000)): [1]}
    return _file({"name": ["a"], "n": [1], **dice.choice((many, long))}, dice)


def nested(dice: random.Random) -> bytes:
    """Lists in lists, structures, maps, in place of numbers and names."""
    arrow = _arrow()
    value, kind = 1, arrow.int64()
    for _ in range(dice.choice((1, 3, 30, 90))):
        value, kind = [value], arrow.list_(kind)  # type: ignore[assignment]
    odd = arrow.array([value, value], kind)
    many = arrow.array([[1] * dice.choice((5, 2_000_000)), []], arrow.list_(arrow.int8()))
    table = {"name": dice.choice((odd, many, arrow.array([{"a": 1}, None]))), "n": [1, 2]}
    return _file(table if dice.random() < 0.7 else {"n": odd, "name": ["a", "b"]}, dice)


def typed(dice: random.Random) -> bytes:
    """Numbers, times and decimals at their ends."""
    arrow = _arrow()
    numbers = dice.choice((
        arrow.array([2**63 - 1, -(2**63)]), arrow.array([float("nan"), float("inf")]),
        arrow.array([5e-324, 1e308]), arrow.array([True, False]),
        arrow.array([2**63 - 1, 0], arrow.timestamp("us")),
        arrow.array([2**62, 1], arrow.duration("ns")), arrow.array([1, 2], arrow.date32()),
        arrow.array([Decimal(10**70), Decimal(1)], arrow.decimal256(76, 0)),
    ))  # fmt: skip
    return _file({"name": ["a", "b\0\x1b[31m"], "n": numbers}, dice)


_FILES: Mapping[str, Callable[[random.Random], bytes]] = {
    make.__name__: make
    for make in (repeated, of_nothing, packed, lying, prefixed, noted, wide, nested, typed)
}


def _arrow() -> Any:
    import pyarrow

    return pyarrow


def _parquet() -> Any:
    import pyarrow.parquet

    return pyarrow.parquet


def _file(columns: Any, dice: random.Random, **options: Any) -> bytes:
    arrow = _arrow()
    table = columns if isinstance(columns, arrow.Table) else arrow.table(columns)
    packing = dice.choice(("zstd", "snappy", "gzip", "none"))
    file = io.BytesIO()
    _parquet().write_table(table, file, compression=packing, **options)
    return file.getvalue()
