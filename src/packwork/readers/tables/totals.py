"""Rows of a table that are totals of its others, as spreadsheets end with."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence

NAMES = frozenset(
    {
        *("total", "totals", "grand total", "all", "sum", "summe", "gesamt", "insgesamt"),
        *("gesamtergebnis", "gesamtsumme", "endsumme", "somme", "total général", "total general"),
        *("summa", "totaal", "totale", "totalt", "suma", "razem", "celkem", "összesen", "toplam"),
        *("итого", "всего", "σύνολο", "合計", "总计", "總計", "합계"),
    }
)
"""What such rows are called, in small letters."""

PARTIAL = frozenset(
    {
        *("subtotal", "subtotals", "sub-total", "sub total", "zwischensumme", "teilergebnis"),
        *("sous-total", "subtotale", "subtotaal", "小計", "소계"),
    }
)
"""What totals of some rows are called."""

_FIRST = re.compile(r"(?:grand )?(?:total|summe|somme|suma|totale|totaal|итого)\b", re.IGNORECASE)
"""What names of totals begin with, as "Total 2024"; "All Saints" is none."""

ROUNDING = 2e-3
"""How far, as a share, a sum may lie from that of rounded numbers. Larger takes chance for a
sum. Chosen."""

SHORT = 0.02
"""By how much, as a share, a row that is called a total may fall short of the rows shown: of many
small numbers that were each rounded. Larger leaves out a firm of that name. Chosen."""

LEAST_ROWS = 4
"""Rows beside the last one from which on it is taken for their sum by its number alone: 1, 2, 3
is no table with a total. Chosen."""


def total_rows(texts: Sequence[Sequence[str]], numbers: Sequence[float]) -> list[int]:
    """Indices of rows that are totals by their texts and numbers alike.

    A row that is called a total counts as one if all such rows come to the others' sum or to
    more, as of a table that was cut short; a firm of that name seldom does. So does the last row
    if it has no text where others have, and their sum.

    Parameters
    ----------
    texts
        Of each row, what its cells say that are no numbers.
    numbers
        Of each row; NaN for none.

    Examples
    --------
    >>> total_rows([["Peru"], ["Kenya"], ["Total"]], [2.0, 3.0, 5.0])
    [2]
    >>> total_rows([["Shell"], ["Total"], ["BP"]], [3.0, 2.0, 1.5])
    []
    >>> total_rows([["a"], ["b"], ["c"], ["d"], [""]], [1.0, 2.0, 3.0, 4.0, 10.0])
    [4]
    """
    told = [[text.strip(" :").casefold() for text in row] for row in texts]
    parts = {k for k, row in enumerate(told) if PARTIAL.intersection(row)}
    called = {k for k, row in enumerate(told) if any(map(_is_total, row))} - parts
    rest = [k for k in range(len(told)) if k not in called | parts]
    whole = _sum([numbers[k] for k in called])
    if not 0.0 < _sum([numbers[k] for k in rest]) * (1.0 - SHORT) <= whole:
        called = set()
    last = len(told) - 1
    if last in rest and not any(told[last]) and any(map(any, told)):
        called |= {last} if is_sum_last([numbers[k] for k in rest]) else set()
    return sorted(called | parts) if len(rest) > (last in called) else []


def is_sum_last(numbers: Sequence[float]) -> bool:
    """Whether the last of some numbers is the sum of the others, be it by chance.

    Examples
    --------
    >>> is_sum_last([1.0, 2.0, 3.0, 4.0, 10.0]), is_sum_last([1.0, 2.0, 3.0])
    (True, False)
    """
    last, rest = numbers[-1], _sum(numbers[:-1])
    return len(numbers) > LEAST_ROWS and last > 0 and abs(last - rest) <= ROUNDING * rest


def _is_total(text: str) -> bool:
    return text in NAMES or _FIRST.match(text) is not None


def _sum(numbers: Sequence[float]) -> float:
    return math.fsum(number for number in numbers if number > 0)
