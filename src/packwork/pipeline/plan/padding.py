"""Room that a padding leaves: the container drawn in, and wishes that nothing can meet."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from packwork.compaction.conflicts import Conflict
from packwork.errors import RecipeError
from packwork.geometry.simplify import grown
from packwork.phrasing import number_of
from packwork.scene.container import Container

BEARABLE = 0.2
"""Padding that is proposed, over the side of an item's share of the container. Larger leaves
items that can hardly be seen. Chosen."""

MOST_STUCK = 0.5
"""Share of the items that may have found no room and the layout be shown all the same. Larger
shows specks, smaller refuses what could be mended by hand. Chosen."""


def padded(container: Container, padding: float) -> Container:
    """Container drawn in by half the padding; the items' own margins are the other half."""
    return replace(container, outline=grown(container.outline, -padding / 2))


def check_padding(container: Container, padding: float, count: int, whose: str = "") -> None:
    """Refuse a padding with which not even items as small as points could be placed.

    Points that keep a distance from each other are centres of discs of half that size, which
    do not overlap and keep half of it from the edge; their area cannot be more than there is.

    Parameters
    ----------
    padding
        Canvas units.
    whose
        What is said of the container; `` of a group`` for one of several.

    Raises
    ------
    RecipeError
        If there is no such room.

    Examples
    --------
    >>> from packwork.geometry.outline import Outline
    >>> tile = Outline.from_rings([np.array([[0.0, 0], [100, 0], [100, 100], [0, 100]])])
    >>> square = Container("square", "square", tile, 100.0, 100.0)
    >>> check_padding(square, 10.0, 25)
    >>> check_padding(square, 20.0, 25)
    Traceback (most recent call last):
    packwork.errors.RecipeError: padding: 20 px is too much for 25 items: ...
    """
    if padding <= 0:
        return
    unit, outline = container.unit, container.outline
    if grown(outline, -padding) is outline:
        raise RecipeError(
            "padding",
            f"{padding:g} {unit} leaves nothing of the container{whose}; use a smaller one, "
            "or a larger canvas",
        )
    if count * np.pi * (padding / 2) ** 2 > grown(outline, -padding / 2).area:
        raise _too_much(container, padding, count, "even as points they would not find room")


def check_found(
    container: Container, padding: float, conflicts: Sequence[Conflict], count: int
) -> None:
    """Refuse a padding with which most items found no room, however small they were made.

    Raises
    ------
    RecipeError
        If that is so.
    """
    stuck = len({found.item for found in conflicts})
    if padding > 0 and stuck > MOST_STUCK * count:
        why = f"{stuck} of {count} found no room, however small"
        raise _too_much(container, padding, count, why)


def _too_much(container: Container, padding: float, count: int, why: str) -> RecipeError:
    unit, better = container.unit, BEARABLE * np.sqrt(container.outline.area / count)
    return RecipeError(
        "padding",
        f"{padding:g} {unit} is too much for {number_of(count, 'item')}: {why}; "
        f"use {better:.2g} {unit} or less, or fewer items",
    )
