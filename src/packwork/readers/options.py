"""Options of reading files of containers and items, and the check of colours that options name."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pydantic import AfterValidator, BeforeValidator


def check_colour(key: str, text: str) -> str:
    """The same text, if it is a colour as CSS has them.

    Examples
    --------
    >>> check_colour("border_color", "ivory")
    'ivory'
    >>> check_colour("paper", "x")
    Traceback (most recent call last):
    packwork.errors.RecipeError: paper: 'x' is no colour; use one such as ivory or #102030
    """
    # Loads the picture library, which the command line's help can do without.
    from packwork.scene.colour import parse_colour

    parse_colour(key, text)
    return text


def colour_of(key: str) -> AfterValidator:
    """Validator of a colour; None is kept, too."""
    return AfterValidator(lambda text: None if text is None else check_colour(key, text))


def texts_of(what: str) -> BeforeValidator:
    """Validator of one text or path, or of several; None is none of them."""

    def several(value: Any) -> Any:
        listed = [value] if isinstance(value, str | Path) else () if value is None else value
        if not isinstance(listed, Iterable):
            raise ValueError(f"use a {what} or a list of them, not {value!r}")
        return tuple(map(str, listed))

    return BeforeValidator(several)


TEXT_PREFIX = "text:"
"""Beginning of a container that is made of words."""

GAPS_AUTO, GAPS_NONE = "auto", "none"
"""How slits are closed, where no length is given."""

HALF = 0.5
"""Opacity from which paint belongs to an outline."""


@dataclass(frozen=True)
class ReadOptions:
    """Choices that a file cannot state itself, as the options of those names.

    None leaves ``trim`` and ``keep_page`` to what the drawing looks like. ``is_plane``: whether
    coordinates of GeoJSON are lengths, however small, and no degrees.
    """

    trim: bool | None = None
    close_gaps: str = GAPS_AUTO
    keep_page: bool | None = None
    alpha_threshold: float = HALF
    is_plane: bool = False


AS_DRAWN = ReadOptions(trim=False, close_gaps=GAPS_NONE)
"""Of what lies on another container's canvas, or has been read before."""
