"""Detection of total rows: rows that are the sum of the others."""

from __future__ import annotations

import math
from collections.abc import Sequence

NAMES = frozenset(
    {
        *("total", "totals", "grand total", "sum", "summe", "gesamt", "insgesamt", "somme"),
        *("total général", "total general", "summa", "totaal", "totale", "totalt", "suma"),
        *("razem", "celkem", "összesen", "toplam", "итого", "всего", "σύνολο"),
        *("合計", "总计", "總計", "합계"),
    }
)
"""What such rows are called, in small letters."""

ROUNDING = 2e-3
"""How far, as a share, a sum may lie from that of rounded numbers. Larger takes chance for a
sum. Chosen."""

LEAST_ROWS = 4
"""Rows beside the last one from which on it is taken for their sum by its number alone: 1, 2, 3
is no table with a total. Chosen."""


def total_row(names: Sequence[str], numbers: Sequence[float]) -> int | None:
    """Index of the row that is the sum of the others; None if none is.

    Parameters
    ----------
    names
        Empty ones where rows have none.
    numbers
        Positive, or NaN.

    Examples
    --------
    >>> total_row(["Peru", "Kenya", "Total"], [2.0, 3.0, 5.0])
    2
    >>> total_row(["", "", ""], [1.0, 2.0, 3.0]) is None
    True
    """
    held = [0.0 if math.isnan(number) else number for number in numbers]
    whole = math.fsum(held)
    called = [k for k, name in enumerate(names) if name.strip(" :").casefold() in NAMES and held[k]]
    if called:
        return called[-1]
    last = len(held) - 1
    if last >= LEAST_ROWS and held[last] > 0:
        rest = whole - held[last]
        if abs(held[last] - rest) <= ROUNDING * rest:
            return last
    return None
