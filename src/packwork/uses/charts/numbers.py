"""Formatting of numbers in charts."""

from __future__ import annotations

LARGEST_NAMED, SMALLEST_PLAIN = 1e15, 1e-6
"""Numbers from which on, and below which, powers of ten are written. Chosen."""


def spoken(number: float, decimal: str = ".") -> str:
    """Number as people say it, or as the table that it comes from would write it.

    Parameters
    ----------
    decimal
        What parts the fraction: with a comma points group thousands, and no English names stand
        for large numbers.

    Examples
    --------
    >>> spoken(5e8), spoken(2000), spoken(0.5), spoken(2e-5), spoken(3e20)
    ('500 million', '2,000', '0.5', '0.00002', '3e20')
    >>> spoken(5e8, ","), spoken(2000, ","), spoken(0.5, ",")
    ('500.000.000', '2.000', '0,5')
    """
    text = _english(number, is_named=decimal == ".")
    return text if decimal == "." else text.translate(str.maketrans(".,", ",."))


def _english(number: float, *, is_named: bool) -> str:
    size = abs(number)
    if size and not SMALLEST_PLAIN <= size < LARGEST_NAMED:
        digits, _, power = f"{number:.4g}".partition("e")
        return f"{digits}e{int(power)}" if power else f"{number:.4g}"
    for name, unit in (("billion", 1e9), ("million", 1e6)):
        if size >= unit and is_named:
            return f"{number / unit:,.4g} {name}"
    if size >= 1e6:
        return f"{float(f'{number:.6g}'):,.0f}"
    if 0 < size < 1e-4:
        return f"{number:.9f}".rstrip("0")
    # Numbers of four digits may be years.
    return f"{number:,.6g}" if size >= 1e3 else f"{number:.4g}"
