"""Rows of a table that are totals of its others, as spreadsheets end with."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence

import numpy as np

NAMES = frozenset(
    {
        *("total", "totals", "grand total", "sum", "summe", "gesamt", "insgesamt"),
        *("gesamtergebnis", "gesamtsumme", "endsumme", "somme", "total général", "total general"),
        *("summa", "totaal", "totale", "totalt", "suma", "razem", "celkem", "összesen", "toplam"),
        *("totalsumma", "eindtotaal", "итого", "всего", "общий итог", "σύνολο"),
        *("合計", "総計", "总计", "總計", "합계"),
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

_OF_GROUP = re.compile(
    r"\S.*\s(?:total|sum|result|ergebnis|summe|gesamt|totaal|totale|suma|итог|集計|合計|汇总)",
    re.IGNORECASE,
)
"""What pivot tables call the total of a group, as "Nord Ergebnis" or "North Total"."""

ROUNDING = 2e-3
"""How far, as a share, a sum may lie from that of rounded numbers. Larger takes chance for a
sum. Chosen."""

SHORT = 0.02
"""The same of a row that is called a total, of many small numbers that were each rounded. Larger
leaves out a firm of that name. Chosen."""

LEAST_ROWS = 4
"""Rows beside the last one from which on it is taken for their sum by its number alone: 1, 2, 3
is no table with a total. Chosen."""

MOST_BACK = 366
"""Totals before a row at most from which on its part may begin, beside the table's begin. More
costs time, and no pivot table has them. Chosen."""


def total_rows(texts: Sequence[Sequence[str]], numbers: Sequence[float]) -> dict[int, str]:
    """Indices of rows that are totals by their texts and numbers alike, and what called them so.

    A row that is called a total counts as one if it is the sum of all that are not, or of those
    since another such row; a firm of that name seldom is. So does the last row if it has no text
    where others have, and their sum.

    Parameters
    ----------
    texts
        Of each row, the cells that say its name, of all rows alike many.
    numbers
        Of each row, negative ones too; NaN for none.

    Examples
    --------
    >>> total_rows([["Peru"], ["Kenya"], ["Returns"], ["Total"]], [2.0, 4.0, -1.0, 5.0])
    {3: 'Total'}
    >>> total_rows([["Shell"], ["Total"], ["BP"]], [3.0, 2.0, 1.5])
    {}
    >>> total_rows([["a"], ["b"], ["c"], ["d"], [""]], [1.0, 2.0, 3.0, 4.0, 10.0])
    {4: ''}
    """
    called = {k: text for k, row in enumerate(texts) if (text := called_total(row))}
    plain = [k for k in range(len(texts)) if k not in called]
    taken = _totals_of_parts(called, numbers)
    whole = _sum([numbers[k] for k in plain])
    kept = [k for k in range(len(texts)) if k not in taken]
    rest = _sum([numbers[k] for k in kept])
    for k in (k for k in kept if k in called and plain):
        if any(_is_sum(numbers[k], of, SHORT) for of in (whole, rest - numbers[k])):
            taken[k] = called[k]
    last = len(texts) - 1
    if last in plain[-1:] and not any(texts[last]) and any(map(any, texts)):
        taken |= {last: ""} if is_sum_last([numbers[k] for k in plain]) else {}
    return dict(sorted(taken.items()))


def _totals_of_parts(called: Mapping[int, str], numbers: Sequence[float]) -> dict[int, str]:
    """Those rows that are the sum of the plain ones since another such row, or since the first."""
    values = np.nan_to_num(np.asarray(numbers, dtype=np.float64), posinf=math.inf)
    is_plain = np.ones(len(values), dtype=np.bool_)
    is_plain[list(called)] = False
    with np.errstate(over="ignore", invalid="ignore"):
        sums = np.concatenate([[0.0], np.cumsum(np.where(is_plain, values, 0.0))])
        counts = np.concatenate([[0], np.cumsum(is_plain)])
        taken, starts = dict[int, str](), [0]
        for k, text in called.items():
            from_start = np.array([0, *starts[-MOST_BACK:]])
            many, whole = counts[k] - counts[from_start], sums[k] - sums[from_start]
            least, near = (1, SHORT) if names_a_part(text) else (2, ROUNDING)
            is_sum = np.abs(values[k] - whole) <= near * np.abs(whole)
            if values[k] > 0 and (is_sum & (many >= least)).any():
                taken[k] = text
            starts.append(k + 1)
    return taken


def called_total(row: Sequence[str]) -> str:
    """The text of a row that calls it a total; empty if none does.

    Examples
    --------
    >>> called_total(["Jan", "North Total"]), called_total(["Elsewhere"])
    ('North Total', '')
    """
    return next(filter(_is_total, row), "")


def is_sum_last(numbers: Sequence[float]) -> bool:
    """Whether the last of some numbers is the sum of the others, be it by chance.

    Examples
    --------
    >>> is_sum_last([1.0, 2.0, 3.0, 4.0, 10.0]), is_sum_last([1.0, 2.0, 3.0])
    (True, False)
    """
    return len(numbers) > LEAST_ROWS and _is_sum(numbers[-1], _sum(numbers[:-1]), ROUNDING)


def _is_total(text: str) -> bool:
    said = _plain(text)
    return said in NAMES or _FIRST.match(said) is not None or names_a_part(text)


def names_a_part(text: str) -> bool:
    """Whether a text is what the total of some rows is called.

    Examples
    --------
    >>> names_a_part("Subtotal"), names_a_part("North Total"), names_a_part("Total")
    (True, True, False)
    """
    said = _plain(text)
    return said in PARTIAL or _OF_GROUP.fullmatch(said) is not None


def _plain(text: str) -> str:
    return text.strip(" :").casefold()


def _is_sum(number: float, whole: float, near: float) -> bool:
    return number > 0 and abs(number - whole) <= near * whole


def _sum(numbers: Sequence[float]) -> float:
    return sum(number for number in numbers if not math.isnan(number))
