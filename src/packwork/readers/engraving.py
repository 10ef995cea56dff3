"""Colours and layers of a drawing for a machine that are engraved in place of cut."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

from packwork.errors import RecipeError
from packwork.scene.colour import css_colour

BLACK, WHITE = (0, 0, 0), (255, 255, 255)

MOST_TOLD = 12
"""Colours and layers that a message names, together. Chosen."""


@dataclass(frozen=True, eq=False)
class Engraving:
    """Colours and names of layers that are engraved, and which of a drawing's were met.

    Examples
    --------
    >>> engraving = Engraving(["red", "Inner"])
    >>> engraving.holds("#f00", "outline"), engraving.holds("black", "inner")
    (True, True)
    """

    asked: Iterable[str] = ()
    colours: dict[tuple[int, ...], str] = field(default_factory=dict)
    layers: dict[str, str] = field(default_factory=dict)
    met: set[str] = field(default_factory=set)
    others: dict[str, None] = field(default_factory=dict)

    def __post_init__(self) -> None:
        for text in self.asked:
            colour = rgb_of(text)
            if colour is None:
                self.layers[text.strip().casefold()] = text
            else:
                self.colours[colour] = text

    def holds(self, colour: str, layer: str = "") -> bool:
        """Whether what is drawn in a colour, on a layer, is engraved; both may be empty."""
        rgb = rgb_of(colour)
        found = self.layers.get(layer.casefold()) or (rgb and self.colours.get(rgb))
        if found:
            self.met.add(found)
        else:
            self.others.update(dict.fromkeys(one[:40] for one in (colour, layer) if one))
        return bool(found)

    def check_met(self) -> None:
        """Raise RecipeError for a colour or layer that no part has."""
        for text in (*self.colours.values(), *self.layers.values()):
            if text not in self.met:
                there = ", ".join(list(self.others)[:MOST_TOLD]) or "no lines of their own"
                raise RecipeError(
                    "engrave", f"no part has lines in the colour or on the layer {text[:40]!r}; "
                    f"others have {there}",
                )  # fmt: skip


def rgb_of(text: str) -> tuple[int, ...] | None:
    """Red, green and blue of a colour in words; None if the text is none."""
    try:
        *rgb, opacity = css_colour(text)
    except ValueError:
        return None
    return tuple(rgb) if opacity else None
