"""A font as its letters: what each covers, and how far it moves the next."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from packwork.geometry.polygon import Region, region
from packwork.readers.svg.ink import FLATTENING
from packwork.readers.text.cff import cff_drawer
from packwork.readers.text.characters import glyph_numbers
from packwork.readers.text.pen import Draw, RingPen, check_glyph
from packwork.readers.text.sfnt import Font, damaged_font, open_font
from packwork.readers.text.truetype import truetype_drawer
from packwork.readers.unfit import UnfitError

MOST_NAMED = 6
"""Characters that a message about missing ones names. Chosen."""


@dataclass(frozen=True, eq=False)
class Letter:
    """One character as a font draws it, in ems, y down, the baseline at 0.

    Parameters
    ----------
    region
        What it covers, with holes and parts; empty for a space.
    advance
        How far the next letter stands to the right.
    """

    region: Region
    advance: float


def letters(data: bytes, characters: Iterable[str]) -> dict[str, Letter]:
    """Letters of a font file's bytes, by character.

    Raises
    ------
    UnfitError
        If it is no font that can be read, or has no glyph for a character.
    """
    wanted = sorted(set(characters))
    font = open_font(data)
    with damaged_font():
        numbers = glyph_numbers(font.reader["cmap"], wanted)
        missing = [character for character in wanted if numbers[character] == 0]
        if missing:
            raise UnfitError(f"has no glyph for {named(missing)}; choose another font")
        em = float(font["head"].unitsPerEm)
        if not em > 0:
            raise UnfitError("is a damaged font (an em of 0 units); give an intact one")
        draw = _drawer(font)
        return {
            character: _letter(font, str(number), draw, em) for character, number in numbers.items()
        }


def named(characters: Iterable[str]) -> str:
    """Characters as a person can find them again.

    Examples
    --------
    >>> named("aé")
    "'a' (U+0061), 'é' (U+00E9)"
    """
    listed = list(characters)
    more = f" and {len(listed) - MOST_NAMED} more" if len(listed) > MOST_NAMED else ""
    return ", ".join(f"{c!r} (U+{ord(c):04X})" for c in listed[:MOST_NAMED]) + more


def _drawer(font: Font) -> Draw:
    if "glyf" in font.reader:
        return truetype_drawer(font)
    if "CFF " in font.reader:
        return cff_drawer(font)
    if "CFF2" in font.reader:
        raise UnfitError("is a variable font with CFF2 outlines; give its TTF or a static OTF")
    raise UnfitError("is a font without outlines; give a TTF or an OTF")


def _letter(font: Font, name: str, draw: Draw, em: float) -> Letter:
    pen = RingPen(draw, em, FLATTENING * em)
    draw(name, pen)
    pen.closePath()
    # Up is positive in fonts, down on our canvas.
    rings = [ring * (1.0, -1.0) / em for ring in pen.rings]
    check_glyph(rings)
    advance = float(np.clip(font["hmtx"].metrics[name][0] / em, 0.0, 8.0))
    return Letter(region(rings, "nonzero"), advance)
