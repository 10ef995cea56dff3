"""Colours and layers of a drawing for a machine that are engraved in place of cut."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

from packwork.errors import RecipeError
from packwork.scene.colour import css_colour

MOST_TOLD = 12
"""Colours and layers that a message names, together. Chosen."""


@dataclass(frozen=True, eq=False)
class Engraving:
    """Colours and names of layers that are engraved, and which of the drawings' were met.

    ``stated``: SVGs that were read, and whether each says in real units how large it is.

    Examples
    --------
    >>> engraving = Engraving(["red", "Inner"])
    >>> engraving.holds("#f00", "outline"), engraving.holds("black", "inner")
    (True, True)
    """

    asked: Iterable[str] = ()
    wanted: dict[str, set[object]] = field(default_factory=dict)
    met: set[object] = field(default_factory=set)
    others: dict[str, None] = field(default_factory=dict)
    stated: dict[str, bool] = field(default_factory=dict)

    def __post_init__(self) -> None:
        for text in self.asked:
            # Layers are often named after their colour.
            self.wanted[text] = _keys(text, text.strip())

    def holds(self, colour: str, layer: str = "") -> bool:
        """Whether what is drawn in a colour, on a layer, is engraved; both may be empty."""
        found = _keys(colour, layer).intersection(set[object]().union(*self.wanted.values()))
        self.met.update(found)
        if not found:
            self.others.update(dict.fromkeys(one[:40] for one in (colour, layer) if one))
        return bool(found)

    def check_met(self) -> None:
        """Raise RecipeError for a colour or layer that no part has."""
        for text, keys in self.wanted.items():
            if not keys & self.met:
                there = ", ".join(list(self.others)[:MOST_TOLD]) or "no lines of their own"
                raise RecipeError(
                    "engrave", f"no part has lines in the colour or on the layer {text[:40]!r}; "
                    f"others have {there}",
                )  # fmt: skip


def _keys(colour: str, layer: str) -> set[object]:
    """Texts by which a colour and a layer are compared."""
    return {key for key in (rgb_of(colour), layer.casefold()) if key}


def rgb_of(text: str) -> tuple[int, ...] | None:
    """Red, green and blue of a colour in words; None if the text is none."""
    try:
        *rgb, opacity = css_colour(text)
    except ValueError:
        return None
    return tuple(rgb) if opacity else None
