"""Words as text: runs, fonts and places, for files in which they can be selected and found."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, eq=False)
class FontFile:
    """One face of a font, as its file holds it.

    Parameters
    ----------
    index
        Which face of a collection.
    weight
        Where its weight axis is held; None if it has none, or stands at its default.
    """

    data: bytes
    name: str
    index: int = 0
    weight: float | None = None


@dataclass(frozen=True, eq=False)
class TextRun:
    """Characters of one font and one direction.

    Parameters
    ----------
    text
        In the order in which it is read.
    font
        That draws it.
    x, y
        Where its base line begins, at its left end whatever its direction; units of the
        text, y down.
    size
        Height of an em, in the same units.
    steps
        Where each glyph's origin stands, from the left, as shares of an em.
    advance
        From the left end to the right one, as a share of an em.
    is_leftward
        Whether it is read from right to left.
    """

    text: str
    font: FontFile
    x: float
    y: float
    size: float
    steps: tuple[float, ...]
    advance: float
    is_leftward: bool = False


@dataclass(frozen=True, eq=False)
class LiveText:
    """Text of a word, beside the curves that draw it.

    Parameters
    ----------
    runs
        In the order in which they are read; in the units of the word's markup.
    path
        SVG path data of the same letters, filled non-zero, in the same units.
    language
        As in ``lang``; empty if it is not known.
    """

    runs: tuple[TextRun, ...]
    path: str
    language: str = ""
