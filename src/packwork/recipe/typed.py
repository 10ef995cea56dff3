"""Options that command lines write as one text, as values of their parts."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, TypeAlias

from packwork.errors import RecipeError

Share: TypeAlias = str | float
"""A length as ``"30mm"`` or ``"45%"``; a number is a share of the canvas, 0.45 for 45 %."""

Point: TypeAlias = tuple[Share, Share]
"""From the canvas' left and top edge."""


def _length(share: Share) -> str:
    return share if isinstance(share, str) else f"{100 * share:.12g}%"


def _direction(way: str | float) -> str:
    return way if isinstance(way, str) else f"{way:.12g}deg"


@dataclass(frozen=True)
class Hero:
    """One item larger than the rest and upright.

    Parameters
    ----------
    x, y
        Where its middle lies, both or neither; where it has most room unless given.
    size
        Its longer side, of the canvas' longer side.

    Examples
    --------
    >>> print(Hero("owl", x=0.5, y=0.45, size=0.35))
    owl@50%,45%=35%
    """

    name: str
    x: Share | None = None
    y: Share | None = None
    size: Share | None = None

    def __str__(self) -> str:
        if (self.x is None) != (self.y is None):
            raise RecipeError("hero", "has a place if both x and y are given, not one of them")
        is_put = self.x is not None and self.y is not None
        place = f"@{_length(self.x or 0.0)},{_length(self.y or 0.0)}" if is_put else ""
        return f"{self.name}{place}" + ("" if self.size is None else f"={_length(self.size)}")


@dataclass(frozen=True)
class Force:
    """A pull on items.

    Parameters
    ----------
    kind
        ``"down"`` and other words of docs/guide/forces.md; a number is a direction, in degrees
        clockwise from the right.
    at
        Of ``"towards"``, ``"away"`` and ``"balance"``: a point, several, or a text such as
        ``"horizontal"`` or a curve's file.
    reach
        Length within which it fades.
    items
        Names or patterns of those that it pulls; all if none are given.

    Examples
    --------
    >>> print(Force("towards", (0.2, 0.5), strength=2, items=["star"]))
    towards 20%,50% strength=2 items=star
    >>> print(Force(45, reach=0.3))
    45deg reach=30%
    """

    kind: str | float
    at: str | Point | Iterable[Point] = ()
    strength: float = 1.0
    reach: Share | None = None
    items: Iterable[str] = ()
    by_weight: bool = False

    def __str__(self) -> str:
        if isinstance(self.at, str):
            words = [f'"{self.at}"' if " " in self.at and self.at.endswith(".svg") else self.at]
        else:
            given: tuple[Any, ...] = tuple(self.at)
            points = (given,) if given and not isinstance(given[0], tuple | list) else given
            words = [",".join(map(_length, point)) for point in points]
        if self.strength != 1.0:
            words.append(f"strength={self.strength:.12g}")
        if self.reach is not None:
            words.append(f"reach={_length(self.reach)}")
        if names := [self.items] if isinstance(self.items, str) else list(self.items):
            words.append(f"items={','.join(names)}")
        if self.by_weight:
            words.append("by=weight")
        return " ".join([_direction(self.kind), *words])


@dataclass(frozen=True)
class Anchor:
    """Place to which items like a row, a column or a word of the embeddings are drawn.

    Parameters
    ----------
    where
        ``"left"``, ``"middle"`` and the like, or degrees clockwise from the right.

    Examples
    --------
    >>> print(Anchor("left", "warm"), Anchor(45, "sun"))
    left=warm 45deg=sun
    """

    where: str | float
    name: str

    def __str__(self) -> str:
        return f"{_direction(self.where)}={self.name}"
