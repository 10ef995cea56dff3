"""Options of reading: how files of containers and items are understood."""

from __future__ import annotations

from dataclasses import dataclass

TEXT_PREFIX = "text:"
"""Beginning of a container that is made of words."""

GAPS_AUTO, GAPS_NONE = "auto", "none"
"""How slits are closed, where no length is given."""

HALF = 0.5
"""Opacity from which paint belongs to an outline."""


@dataclass(frozen=True)
class ReadOptions:
    """What a file cannot say of itself.

    Parameters
    ----------
    trim
        Whether a container's canvas is its drawing alone; None: where that is small.
    close_gaps
        Slits of a container that are closed: ``auto``, ``none`` or a width.
    keep_page
        Whether the page behind an item's drawing is part of it; None: what it looks like.
    alpha_threshold
        Opacity from which a picture's paint belongs to the outline.

    Examples
    --------
    >>> ReadOptions().trim is None
    True
    """

    trim: bool | None = None
    close_gaps: str = GAPS_AUTO
    keep_page: bool | None = None
    alpha_threshold: float = HALF


AS_DRAWN = ReadOptions(trim=False, close_gaps=GAPS_NONE)
"""Of what lies on another container's canvas, or has been read before."""
