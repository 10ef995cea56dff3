"""Colours that options name."""

from __future__ import annotations


def check_colour(key: str, text: str) -> str:
    """The same text, if it is a colour as CSS has them.

    Raises
    ------
    RecipeError
        About the option ``key``, if it is none.

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
