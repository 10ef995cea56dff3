"""Options of a PDF for a print shop."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal, TypeAlias

MarksChoice: TypeAlias = Literal["none", "crop", "all"]
"""Marks beside the sheet: none, where it is trimmed, or registration marks too."""


@dataclass(frozen=True, kw_only=True)
class PrintOptions:
    """Wishes of a print shop; ``bleed`` is a length beyond the sheet on each side.

    ``icc`` is the file of the press's profile, to whose inks colours are brought; ``spots`` are
    names of spot inks by the colour, ``#rrggbb``, that is printed in them.
    """

    bleed: str | None = None
    marks: MarksChoice = "none"
    icc: str | None = None
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
            "icc": self.icc is not None,
            "spot": bool(self.spots),
        }
        return [name for name, is_given in wishes.items() if is_given]
