"""Tables of pandas and its like: files that only it reads, and its frames."""

from __future__ import annotations

import importlib
import io
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from packwork.errors import ReadError, RecipeError

_MOST_REASON = 120


def rows_of_parquet(file: str, data: bytes) -> list[dict[str, Any]]:
    """Rows of a Parquet file, read by pandas.

    Raises
    ------
    ReadError
        If it is none, or pandas or what it reads Parquet with is not installed.
    """
    try:
        pandas = importlib.import_module("pandas")
        importlib.import_module("pyarrow")
    except ModuleNotFoundError as error:
        if error.name not in {"pandas", "pyarrow"}:
            raise
        raise ReadError(
            file, "needs pandas and pyarrow; install them: pip install packwork[data], or give CSV"
        ) from None
    try:
        frame = pandas.read_parquet(io.BytesIO(data))
    except (ValueError, OSError) as error:
        raise ReadError(file, f"is not Parquet ({str(error)[:_MOST_REASON]})") from None
    return rows_of_frame(frame)


def rows_of_frame(data: Any) -> list[dict[str, Any]]:
    """Rows of a data frame (by its ``to_dict``), of a dict of columns, or of a list of dicts.

    Raises
    ------
    RecipeError
        If it is none of these.

    Examples
    --------
    >>> rows_of_frame({"land": ["Peru", "Kenya"], "kg": [2, 3]})
    [{'land': 'Peru', 'kg': 2}, {'land': 'Kenya', 'kg': 3}]
    """
    if hasattr(data, "to_dict") and hasattr(data, "columns"):
        return [_plain(row) for row in data.to_dict("records")]
    if isinstance(data, Mapping):
        if not all(_is_column(cells) for cells in data.values()):
            raise RecipeError("data", "use a list of cells for each column, all equally long")
        columns = {str(name): list(cells) for name, cells in data.items()}
        if len({len(cells) for cells in columns.values()}) == 1:
            rows = zip(*columns.values(), strict=True)
            return [_plain(dict(zip(columns, cells, strict=True))) for cells in rows]
    elif isinstance(data, Sequence) and all(isinstance(row, Mapping) for row in data):
        return [_plain(row) for row in data]
    raise RecipeError(
        "data", "use a file, a data frame, or rows such as [{'land': 'Peru', 'kg': 2}]"
    )


def _is_column(cells: Any) -> bool:
    return isinstance(cells, Iterable) and not isinstance(cells, str | bytes)


def _plain(row: Mapping[Any, Any]) -> dict[str, Any]:
    """Cells that files can hold: numbers and truth as they are, all else as its text."""
    return {str(key): _cell(cell) for key, cell in row.items()}


def _cell(cell: Any) -> Any:
    # Scalars of NumPy alone: cells may hold whole arrays.
    value = cell.item() if getattr(cell, "shape", None) == () else cell
    if value is None or isinstance(value, bool | int | str):
        return value
    if isinstance(value, float):
        # What is not there is not a number in frames.
        return None if value != value else value
    text = str(value)
    return None if text in {"NaT", "<NA>"} else text
