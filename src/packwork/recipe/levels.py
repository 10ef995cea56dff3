"""Resolutions of the levels: as text, and fine enough for small items."""

from __future__ import annotations

import math

from packwork.errors import RecipeError
from packwork.solve.options import MAX_RESOLUTION, MIN_RESOLUTION

LEAST_PITCH_PX = 25.0
"""Pixels of the finest level that the default gives an item to each side. Fewer leave overlaps
that the finish pays for with coverage; more cost time and gain nothing. Tried."""

MOST_REFINED = 2.0
"""How much finer than usual the levels may get for that: twice takes four times the pixels.
More gains little. Tried."""


def parse_levels(text: str) -> tuple[tuple[int, ...], tuple[float, ...]]:
    """Resolutions and their shares of the epochs from ``50:9,200:23,600:68``.

    Examples
    --------
    >>> parse_levels("50,600")
    ((50, 600), (1.0, 1.0))
    """
    levels, shares = [], []
    for part in text.split(","):
        resolution, _, share = part.partition(":")
        try:
            levels.append(int(resolution))
            shares.append(float(share or 1))
        except ValueError:
            raise _bad_levels(text) from None
    if not all(MIN_RESOLUTION <= level <= MAX_RESOLUTION for level in levels):
        raise RecipeError(
            "levels", f"a level has {MIN_RESOLUTION} to {MAX_RESOLUTION} px, not {text!r}"
        )
    if not all(math.isfinite(share) and share > 0 for share in shares):
        raise _bad_levels(text)
    return tuple(levels), tuple(shares)


def checked_levels(text: str | None) -> str | None:
    """The same text, if it can be parsed; None is none.

    Examples
    --------
    >>> checked_levels("50,600")
    '50,600'
    """
    if text is not None:
        parse_levels(text)
    return text


def refined_levels(
    levels: tuple[int, ...], side: float, room: float, count: int
) -> tuple[int, ...]:
    """Levels fine enough for small items.

    Parameters
    ----------
    levels
        Resolutions, coarse to fine.

    Examples
    --------
    >>> refined_levels((50, 200, 600), 600.0, 600.0**2 / 2, 100)
    (50, 200, 600)
    >>> refined_levels((50, 200, 600), 600.0, 600.0**2 / 2, 1_000)
    (93, 373, 1118)
    """
    pitch_px = math.sqrt(room / count) * levels[-1] / side
    factor = min(max(LEAST_PITCH_PX / pitch_px, 1.0), MOST_REFINED)
    return tuple(round(level * factor) for level in levels)


def _bad_levels(text: str) -> RecipeError:
    return RecipeError(
        "levels", f"use resolutions like 50,200,600 or 50:9,200:23,600:68, not {text!r}"
    )
