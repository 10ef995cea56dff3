"""Vectors in memory: of arrays, of dicts by name and of data frames."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from packwork.arrays import FloatArray
from packwork.readers.unfit import UnfitError


@dataclass(frozen=True, eq=False)
class GivenVectors:
    """Rows of numbers from memory.

    Parameters
    ----------
    names
        One per row; None where they have none.
    rows
        ``(n, d)``.
    columns
        What their numbers are called, where that is said.
    groups
        Of what group each row is, where a column of texts says so.
    """

    names: tuple[str, ...] | None
    rows: FloatArray
    columns: tuple[str, ...] = ()
    groups: tuple[str, ...] | None = None


def vectors_of(value: Any) -> GivenVectors:
    """Vectors of an array, a row an item; or by name, of a dict or a data frame's index.

    Where a data frame's index only counts, a first column of texts, none twice, has the names, as
    in a file. Another column of texts says of what group each is.

    Raises
    ------
    UnfitError
        If they are no rows of numbers.

    Examples
    --------
    >>> vectors_of({"bear": [1, 0], "fox": [0, 1]}).names
    ('bear', 'fox')
    >>> vectors_of(np.eye(3)).rows.shape
    (3, 3)
    """
    names: tuple[str, ...] | None = None
    columns: tuple[str, ...] = ()
    groups: tuple[str, ...] | None = None
    if isinstance(value, Mapping):
        names, value = tuple(map(str, value)), list(value.values())
    elif hasattr(value, "columns") and hasattr(value, "index"):
        # An index of numbers only counts the rows.
        has_numbers = getattr(getattr(value.index, "dtype", None), "kind", "O") in "iuf"
        names = None if has_numbers else tuple(map(str, value.index))
        first = value.columns[0] if len(value.columns) else None
        if has_numbers and first is not None and _is_text(value[first]):
            cells = tuple(map(str, value[first]))
            if len(set(cells)) == len(cells):
                names, value = cells, value[list(value.columns[1:])]
        texts = [k for k in value.columns if _is_text(value[k])]
        if len(texts) == 1:
            groups = tuple("" if cell is None else str(cell) for cell in value[texts[0]])
            value = value[[k for k in value.columns if k not in texts]]
        columns = tuple(map(str, value.columns))
        value = value.to_numpy()
    try:
        rows = np.asarray(value, dtype=np.float64)
    except (TypeError, ValueError):
        raise UnfitError(
            "is no array of numbers; give a row of as many numbers for each item"
        ) from None
    if rows.ndim != 2 or min(rows.shape) < 1:
        raise UnfitError(f"has the shape {rows.shape}; give one row of numbers an item")
    return GivenVectors(names, rows, columns, groups)


def _is_text(column: Any) -> bool:
    """Whether a column of a data frame holds texts, and none that is a number."""
    cells = [cell for cell in column if cell is not None and cell == cell]
    return bool(cells) and all(
        isinstance(cell, str) and any(map(str.isalpha, cell)) for cell in cells
    )
