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
    """

    names: tuple[str, ...] | None
    rows: FloatArray
    columns: tuple[str, ...] = ()


def vectors_of(value: Any) -> GivenVectors:
    """Vectors of an array, a row an item; or by name, of a dict or a data frame's index.

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
    if isinstance(value, Mapping):
        names, value = tuple(map(str, value)), list(value.values())
    elif hasattr(value, "columns") and hasattr(value, "index"):
        # An index of numbers only counts the rows.
        has_numbers = getattr(getattr(value.index, "dtype", None), "kind", "O") in "iuf"
        names = None if has_numbers else tuple(map(str, value.index))
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
    return GivenVectors(names, rows, columns)
