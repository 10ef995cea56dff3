"""Parser of forces: ``down``, ``towards 50%,50% strength=2``, ``together``."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from typing import Annotated, Any, TypeAlias

from pydantic import BeforeValidator

from packwork.errors import RecipeError
from packwork.phrasing import meant
from packwork.recipe_paths import split_words
from packwork.units import LONGEST, NUMBER, is_length, split_length

DIRECTIONS = {"right": 0.0, "down": 90.0, "left": 180.0, "up": 270.0}
"""Degrees, clockwise on screen."""

KINDS = (*DIRECTIONS, "45deg", "towards", "away", "inward", "align", "balance", "together")
"""What a force may begin with, for messages."""

LINES = {"horizontal": ("0%,50%", "100%,50%"), "vertical": ("50%,0%", "50%,100%")}
"""Lines across the middle of the canvas."""

CENTRE = "50%,50%"

MOST_STRENGTH = 1_000.0
"""Strongest force; beyond it nothing else counts. Chosen."""

_DEGREES = re.compile(rf"({NUMBER})(?:deg|°)")
_KEYS = ("strength", "reach", "items", "by")


@dataclass(frozen=True)
class ForceSpec:
    """One force, as it was written.

    ``kind``: direction, towards, away, inward, align, balance or together.
    ``angle``: of a direction, degrees clockwise from the right.
    ``places``: pairs ``X,Y`` of lengths, or the file of a curve.
    ``is_line``: whether the pairs are the corners of a line.
    ``axis``: horizontal or vertical, of an alignment or a balance.
    ``strength``: how strong; 1 if nothing is said.
    ``reach``: length within which it fades by e; None if it does not.
    ``items``: patterns of names; all if empty.
    """

    kind: str
    angle: float = 0.0
    places: tuple[str, ...] = ()
    is_line: bool = False
    axis: str = ""
    strength: float = 1.0
    reach: str | None = None
    items: tuple[str, ...] = ()
    by_weight: bool = False

    @property
    def file(self) -> str | None:
        """File of the curve, if it is one."""
        return self.places[0] if self.places and self.places[0].lower().endswith(".svg") else None


def parse_force(text: str) -> ForceSpec:
    """Force of its text.

    Raises ``RecipeError`` about ``force``: what is wrong, what was met, what would do.

    Examples
    --------
    >>> parse_force("down").angle
    90.0
    >>> parse_force("towards 20%,50% 80%,50% strength=2 items=star").places
    ('20%,50%', '80%,50%')
    >>> parse_force("towrds centre")
    Traceback (most recent call last):
        ...
    packwork.errors.RecipeError: force: no force is called 'towrds'; did you mean towards?
    """
    words = split_words(text)
    if not words:
        raise RecipeError("force", f"is empty; use one of {', '.join(KINDS)}")
    said = [word for word in words[1:] if "=" not in word]
    keys = _keys([word for word in words[1:] if "=" in word])
    return ForceSpec(**{**_what(words[0].lower(), said, text), **keys})


def _what(kind: str, said: list[str], text: str) -> dict[str, Any]:
    degrees = _DEGREES.fullmatch(kind)
    if kind in DIRECTIONS or degrees:
        _nothing_more(said, text)
        angle = float(degrees.group(1)) if degrees else DIRECTIONS[kind]
        return {"kind": "direction", "angle": angle % 360.0}
    if kind in {"towards", "away"}:
        return {"kind": kind, **_places(said, text)}
    if kind in {"inward", "together"}:
        _nothing_more(said, text)
        return {"kind": kind}
    if kind == "align":
        if len(said) != 1 or said[0] not in LINES:
            raise RecipeError("force", f"use align horizontal or align vertical, not {text!r}")
        return {"kind": kind, "axis": said[0]}
    if kind == "balance":
        return {"kind": kind, **_balance(said, text)}
    hint = meant(kind, KINDS) or f"use one of {', '.join(KINDS)}"
    raise RecipeError("force", f"no force is called {kind[:40]!r}; {hint}")


def _places(said: list[str], text: str) -> dict[str, Any]:
    if len(said) == 1 and said[0] in LINES:
        return {"places": LINES[said[0]], "is_line": True}
    if len(said) == 1 and said[0].lower().endswith(".svg"):
        return {"places": (said[0],), "is_line": True}
    is_line = bool(said) and said[0] == "line"
    pairs = tuple(CENTRE if word in {"centre", "center"} else word for word in said[is_line:])
    if len(pairs) < 1 + is_line or not all(map(is_pair, pairs)):
        raise RecipeError(
            "force",
            "use towards or away with centre, X,Y (several for the nearest of them), line X,Y X,Y, "
            f"horizontal, vertical or a curve FILE.svg, not {text[:60]!r}",
        )
    if is_line and len(set(pairs)) == 1:
        raise RecipeError("force", f"the line of {text[:60]!r} has no length; give two points")
    return {"places": pairs, "is_line": is_line}


def _balance(said: list[str], text: str) -> dict[str, Any]:
    place = ["50%,50%"] if said in ([], ["centre"], ["center"]) else said
    if len(place) == 1 and place[0] in LINES:
        return {"axis": place[0], "places": (CENTRE,)}
    if len(place) != 1 or not is_pair(place[0]):
        raise RecipeError(
            "force",
            "use balance with centre, X,Y (lengths up to "
            f"{LONGEST:g}), horizontal or vertical, not {text[:60]!r}",
        )
    return {"places": (place[0],)}


def is_pair(word: str) -> bool:
    """Whether a word is ``X,Y``, each a length.

    Examples
    --------
    >>> is_pair("50%,2mm"), is_pair("50%")
    (True, False)
    """
    parts = word.split(",")
    return len(parts) == 2 and all(map(is_length, parts))


def _nothing_more(said: list[str], text: str) -> None:
    if said:
        raise RecipeError(
            "force", f"{text.split()[0]} takes no {said[0]!r}; use KEY=VALUE after it"
        )


def _keys(words: list[str]) -> dict[str, Any]:
    found: dict[str, Any] = {}
    for word in words:
        key, _, value = word.partition("=")
        if key not in _KEYS:
            raise RecipeError("force", f"has no {key!r}; use {', '.join(_KEYS)}")
        found |= _key(key, value)
    return found


def _key(key: str, value: str) -> dict[str, Any]:
    if key == "items":
        return {"items": tuple(filter(None, value.split(",")))}
    if key == "by":
        if value != "weight":
            raise RecipeError("force", f"by: use by=weight, not {value[:40]!r}")
        return {"by_weight": True}
    length = split_length(value)
    if key == "reach":
        if length is None or not (is_length(value) and length[0] > 0):
            raise RecipeError("force", f"reach: use a length such as 30%, not {value[:40]!r}")
        return {"reach": value}
    strength = math.nan if length is None or length[1] else length[0]
    if not 0 < strength <= MOST_STRENGTH:
        raise RecipeError(
            "force",
            f"strength must be above 0 and at most {MOST_STRENGTH:g}, not {value[:40]!r}; "
            "away pushes",
        )
    return {"strength": strength}


def checked_forces(value: object) -> object:
    """Forces as a tuple of texts, if each can be parsed; one text is one force, None is none.

    Raises ``RecipeError`` as for :func:`parse_force`.

    Examples
    --------
    >>> checked_forces("down")
    ('down',)
    """
    several = (value,) if isinstance(value, str) else value
    if several is None:
        return None
    if not isinstance(several, list | tuple):
        raise RecipeError("force", f"must be a text or a list of texts, not {str(value)[:60]!r}")
    for text in several:
        if not isinstance(text, str):
            raise RecipeError("force", f"must be a text such as 'down', not {str(text)[:60]!r}")
        parse_force(text)
    return tuple(several)


ForceTexts: TypeAlias = Annotated[tuple[str, ...] | None, BeforeValidator(checked_forces)]
"""Forces as people write them."""
