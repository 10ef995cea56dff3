"""Options of a PDF for a print shop."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Literal, TypeAlias

from packwork.errors import RecipeError

if TYPE_CHECKING:
    from packwork.writers.prepress.profile import PressProfile

_EXAMPLE = "'PANTONE 186 C=#c8102e'"

MarksChoice: TypeAlias = Literal["none", "crop", "all"]
"""Marks beside the sheet: none, where it is trimmed, or registration marks too."""

X4_VERSION = "1.6"
"""Version of PDF on which PDF/X-4 is based."""


@dataclass(frozen=True, kw_only=True)
class PrintOptions:
    """Wishes of a print shop; ``bleed`` is a length beyond the sheet on each side.

    ``press`` is the profile to whose inks colours are brought; ``spots`` are names of spot inks by
    the colour, ``#rrggbb``, that is printed in them.
    """

    bleed: str | None = None
    marks: MarksChoice = "none"
    press: PressProfile | None = None
    spots: Mapping[str, str] = field(default_factory=dict)

    def given(self) -> list[str]:
        """Names of the options that ask for anything.

        Examples
        --------
        >>> PrintOptions(bleed="3mm", marks="all").given()
        ['bleed', 'marks']
        """
        wishes = {
            "bleed": self.bleed is not None,
            "marks": self.marks != "none",
            "icc": self.press is not None,
            "spot": bool(self.spots),
        }
        return [name for name, is_given in wishes.items() if is_given]


def spot_inks(value: str | Mapping[str, str] | None) -> dict[str, str]:
    """Names of spot inks by colour, of ``Gold=#b58b2a`` or a dict of colours by name.

    Examples
    --------
    >>> spot_inks("PANTONE 186 C=#c8102e, Gold=goldenrod")
    {'#c8102e': 'PANTONE 186 C', '#daa520': 'Gold'}
    """
    if value is None:
        return {}
    # Loads the picture library, which the command line's help can do without.
    from packwork.scene.palette import check_ink, colours_by_name

    try:
        named = colours_by_name(value)
        for name in named or ():
            check_ink(name)
    except ValueError as error:
        raise RecipeError("spot", str(error)) from None
    if named is None:
        raise RecipeError(
            "spot", f"give each ink its colour, as {_EXAMPLE}, not {str(value)[:40]!r}"
        )
    inks = {colour: name for name, colour in named.items()}
    if len(inks) < len(named) or any(len(colour) > len("#rrggbb") for colour in inks):
        raise RecipeError("spot", "each ink has a solid colour of its own")
    return inks
