"""Datum of a chart's mark, and the row of a frame that an item came from."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True, eq=False)
class Datum:
    """Row and number behind one mark.

    Parameters
    ----------
    row
        Cells by column, as they were read.
    value
        What the mark stands for: in the unit of the size column, or a number of rows. The marks
        of one row add up to it.
    category
        What its colour says; empty where colours are numbers or say nothing.
    group
        Which group it is in; empty where there are none.
    """

    row: Mapping[str, Any]
    value: float
    category: str = ""
    group: str = ""


@dataclass(frozen=True, eq=False)
class RowLabel:
    """Label of a row in the index of a data frame of geometries.

    Parameters
    ----------
    label
        As the index has it: of several levels a tuple.
    names
        Of the levels, None for one without a name.
    """

    label: Any
    names: tuple[Any, ...] = (None,)
