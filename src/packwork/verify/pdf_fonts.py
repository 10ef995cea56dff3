"""Widths of text in a PDF, by what fonts say of their characters (ISO 32000-1, 9.2.4, 9.7.4)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, final

import pikepdf

USUAL = 0.5
"""Width of a character, ems, where a font says none: about that of Helvetica."""

_MOST = 200_000
"""Characters of one font that are read. Of a sound one there are no more than 65,536."""


@final
@dataclass(frozen=True)
class FontWidths:
    """Widths of characters, ems, by their codes, which have so many bytes; ``usual``: of others."""

    known: Mapping[int, float] = field(default_factory=dict)
    usual: float = USUAL
    size: int = 1

    @classmethod
    def of(cls, font: Any) -> FontWidths:
        """Widths of a font; codes of a composite one are taken as the numbers of characters."""
        if font.get("/Subtype") == "/Type0":
            drawn = font.DescendantFonts[0]
            known = _listed(drawn.get("/W", []))
            return cls(known, float(drawn.get("/DW", 1000)) / 1000, 2)
        first = int(font.get("/FirstChar", 0))
        unit = float(font.FontMatrix[0]) if "/FontMatrix" in font else 1 / 1000
        return cls({first + k: unit * float(w) for k, w in enumerate(font.get("/Widths", []))})

    def width(self, parts: Any, spacing: float = 0.0) -> float:
        """Width of text, ems: strings, and numbers by which what follows moves back.

        ``spacing`` is room after each character, ems.

        Examples
        --------
        >>> FontWidths({111: 0.75}).width([pikepdf.String("ox"), -500, pikepdf.String("x")])
        2.25
        """
        width = 0.0
        for part in parts:
            if isinstance(part, pikepdf.String):
                text = bytes(part)
                starts = range(0, len(text), self.size)
                codes = (int.from_bytes(text[k : k + self.size]) for k in starts)
                width += sum(self.known.get(code, self.usual) + spacing for code in codes)
            else:
                width -= float(part) / 1000
        return width


def _listed(rows: Any) -> dict[int, float]:
    """Widths of the list of a composite font: of several characters each, or of all up to one."""
    left, found = list(rows), dict[int, float]()
    budget, k = _MOST, 0
    while k + 1 < len(left) and budget > 0:
        first = int(left[k])
        if isinstance(left[k + 1], pikepdf.Array):
            widths = [float(width) / 1000 for width in left[k + 1]]
            k += 2
        else:
            count = min(int(left[k + 1]) - first + 1, budget)
            widths = [float(left[k + 2]) / 1000] * count
            k += 3
        found.update(enumerate(widths, start=first))
        budget -= len(widths) + 1
    return found
