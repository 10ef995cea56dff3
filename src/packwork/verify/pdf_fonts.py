"""Widths of text in a PDF, by what fonts say of their characters (ISO 32000-1, 9.2.4, 9.7.4)."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Mapping
from dataclasses import dataclass, field
from itertools import islice
from typing import Any, final

import pikepdf

USUAL = 0.5
"""Width of a character, ems, where a font says none: about that of Helvetica."""

MOST_WIDTHS = 500_000
"""Widths that are read of all fonts of a file; of others the usual are taken. A character costs
about a hundred bytes. Chosen: twenty large fonts."""


@final
@dataclass(frozen=True)
class FontWidths:
    """Widths of characters, ems, by their codes, which have so many bytes; ``usual``: of others.

    ``ranges``: first and last of codes that have one width, and that, by the first; the one that
    begins last counts.
    """

    known: Mapping[int, float] = field(default_factory=dict)
    usual: float = USUAL
    size: int = 1
    ranges: tuple[tuple[int, int, float], ...] = ()

    @property
    def count(self) -> int:
        """Number of widths that are kept."""
        return len(self.known) + len(self.ranges)

    @classmethod
    def of(cls, font: Any, most: int = MOST_WIDTHS) -> FontWidths:
        """Up to ``most`` widths of a font; codes of a composite one are numbers of characters."""
        if font.get("/Subtype") == "/Type0":
            drawn = font.DescendantFonts[0]
            known, ranges = _listed(drawn.get("/W", []), most)
            return cls(known, float(drawn.get("/DW", 1000)) / 1000, 2, ranges)
        first = int(font.get("/FirstChar", 0))
        unit = float(font.FontMatrix[0]) if "/FontMatrix" in font else 1 / 1000
        listed = islice(font.get("/Widths", []), most)
        return cls({first + k: unit * float(w) for k, w in enumerate(listed)})

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
                width += sum(self._of(code) + spacing for code in codes)
            else:
                width -= float(part) / 1000
        return width

    def _of(self, code: int) -> float:
        if code in self.known or not self.ranges:
            return self.known.get(code, self.usual)
        place = bisect_right(self.ranges, code, key=lambda one: one[0]) - 1
        _, last, width = self.ranges[place]
        return width if place >= 0 and code <= last else self.usual


def _listed(rows: Any, most: int) -> tuple[dict[int, float], tuple[tuple[int, int, float], ...]]:
    """Widths of the list of a composite font: of several characters each, and of all up to one."""
    found, ranges = dict[int, float](), list[tuple[int, int, float]]()
    left = islice(rows, 3 * most)
    for start in left:
        first, then = int(start), next(left, None)
        if then is None or most <= 0:
            break
        if isinstance(then, pikepdf.Array):
            widths = [float(width) / 1000 for width in islice(then, most)]
            found.update(enumerate(widths, start=first))
            most -= len(widths) + 1
        elif (width := next(left, None)) is not None:
            ranges.append((first, int(then), float(width) / 1000))
            most -= 1
    return found, tuple(sorted(ranges, key=lambda one: one[0]))
