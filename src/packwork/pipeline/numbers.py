"""Numbers as charts write them."""

from __future__ import annotations


def spoken(number: float) -> str:
    """Number as people say it.

    Examples
    --------
    >>> spoken(5e8), spoken(2000), spoken(0.5)
    ('500 million', '2,000', '0.5')
    """
    for name, size in (("billion", 1e9), ("million", 1e6)):
        if abs(number) >= size:
            return f"{number / size:,.4g} {name}"
    # Numbers of four digits may be years.
    return f"{number:,.6g}" if abs(number) >= 1e3 else f"{number:.4g}"
