"""Tables of pandas and its like."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence, Sized
from typing import Any

from packwork.errors import RecipeError
from packwork.readers.tables.delimited import MOST_ROWS


def rows_of_frame(data: Any, *, has_row_numbers: bool = True) -> list[dict[str, Any]]:
    """Rows of a data frame (pandas, polars, pyarrow), a dict of columns, or dicts.

    An index of pandas that is more than numbers of rows becomes columns, as ``reset_index`` has
    it; unless ``has_row_numbers`` is false, numbers of rows that were sorted or left out as
    well.

    Examples
    --------
    >>> rows_of_frame({"land": ["Peru", "Kenya"], "kg": [2, 3]})
    [{'land': 'Peru', 'kg': 2}, {'land': 'Kenya', 'kg': 3}]
    """
    if isinstance(data, Sized) and len(data) > MOST_ROWS:
        raise RecipeError("data", f"has {len(data):,} rows; {MOST_ROWS:,} are the most")
    if hasattr(data, "columns") and hasattr(data, "to_dicts"):
        return [plain_row(row) for row in data.to_dicts()]
    if hasattr(data, "column_names") and hasattr(data, "to_pylist"):
        return [plain_row(row) for row in data.to_pylist()]
    if hasattr(data, "columns") and hasattr(data, "to_dict"):
        return [plain_row(row) for row in _with_index(data, has_row_numbers).to_dict("records")]
    if isinstance(data, Mapping):
        if not all(_is_column(cells) for cells in data.values()):
            raise RecipeError("data", "use a list of cells for each column, all equally long")
        columns = {str(name): list(cells) for name, cells in data.items()}
        if len({len(cells) for cells in columns.values()}) == 1:
            rows = zip(*columns.values(), strict=True)
            return [plain_row(dict(zip(columns, cells, strict=True))) for cells in rows]
    elif isinstance(data, Sequence) and all(isinstance(row, Mapping) for row in data):
        return [plain_row(row) for row in data]
    raise RecipeError(
        "data", "use a file, a data frame, or rows such as [{'land': 'Peru', 'kg': 2}]"
    )


def is_frame(data: Any) -> bool:
    """Whether something is a table of pandas, polars or pyarrow.

    Examples
    --------
    >>> is_frame({"land": ["Peru"]})
    False
    """
    ways = ("to_dict", "to_dicts", "to_pylist")
    return hasattr(data, "columns") and any(hasattr(data, way) for way in ways)


def index_of_frame(data: Any) -> dict[str, str]:
    """Columns that were the index of a data frame of pandas, with their types; else none.

    Examples
    --------
    >>> index_of_frame({"land": ["Peru"]})
    {}
    """
    with_index = _with_index(data, has_row_numbers=True)
    if with_index is data:
        return {}
    names = with_index.columns[: data.index.nlevels]
    return {str(name): str(with_index[name].dtype) for name in names}


def is_count(index: Any) -> bool:
    """Whether an index of pandas has no name and counts rows from 0."""
    is_range = type(index).__name__ == "RangeIndex" and index.name is None
    return is_range and (index.start, index.step) == (0, 1)


def _with_index(frame: Any, has_row_numbers: bool) -> Any:
    """The frame with its index among the columns, unless that only counts the rows."""
    index: Any = getattr(frame, "index", None)
    if index is None or not hasattr(frame, "reset_index"):
        return frame
    has_numbers = index.name is None and getattr(index.dtype, "kind", "") in "iu"
    if is_count(index) or (has_numbers and not has_row_numbers):
        return frame
    try:
        return frame.reset_index()
    except ValueError:
        # A column is called so already.
        return frame


def _is_column(cells: Any) -> bool:
    return isinstance(cells, Iterable) and not isinstance(cells, str | bytes)


def plain_row(row: Mapping[Any, Any]) -> dict[str, Any]:
    """Cells that files can hold: numbers and truth as they are, all else as its text.

    Examples
    --------
    >>> import datetime
    >>> plain_row({"n": 2, "day": datetime.date(2024, 5, 1), "x": float("nan")})
    {'n': 2, 'day': '2024-05-01', 'x': None}
    """
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
