"""Glyphs of OpenType fonts with PostScript outlines: cubic charstrings, from ``CFF``."""

from __future__ import annotations

from io import BytesIO
from typing import Any

from fontTools.cffLib import CFFFontSet  # type: ignore[import-untyped]
from fontTools.misc.psCharStrings import T2OutlineExtractor  # type: ignore[import-untyped]

from packwork.readers.text.pen import Draw, RingPen
from packwork.readers.text.sfnt import Font
from packwork.readers.unfit import UnfitError

MAX_PROGRAM = 200_000
"""Bytes of program that one glyph may run, each call of a subroutine counted: ten calls
of ten calls ... end here. Twenty times what the busiest glyphs need. Chosen."""

REREADS = 4
"""How often the whole table may be read; once is usual. Chosen."""


def cff_drawer(font: Font) -> Draw:
    """Function that draws the glyph of a name.

    Raises
    ------
    UnfitError
        If the table holds no font that can be read.
    """
    fonts = CFFFontSet()
    fonts.decompile(_Metered(font.reader["CFF "]), font, isCFF2=False)
    top = fonts[0]
    # The names in the file are not used; making them unique can take minutes.
    top.charset = [str(number) for number in range(top.numGlyphs)]
    programs = top.CharStrings

    def draw(name: str, pen: RingPen) -> None:
        if name not in programs:
            raise UnfitError("is a font whose glyphs refer to others by name; give a newer one")
        program = programs[name]
        program.outlineExtractor = _metered_extractor
        program.draw(pen)

    return draw


class _Metered(BytesIO):
    """Bytes that can be read only a few times over, and never to an unstated end."""

    def __init__(self, data: bytes) -> None:
        super().__init__(data)
        self._left = REREADS * len(data) + 1_000

    def read(self, size: int | None = -1, /) -> bytes:
        if size is None or size < 0:
            raise UnfitError("is a damaged font (a length is negative); give an intact one")
        self._left -= size + 1
        if self._left < 0:
            raise UnfitError("is a damaged font (its parts overlap); give an intact one")
        return super().read(size)


def _metered_extractor(*arguments: Any) -> Any:
    """FontTools' interpreter of glyph programs, with an end to its patience."""
    extractor = T2OutlineExtractor(*arguments)
    run = extractor.execute
    left = MAX_PROGRAM

    def execute(program: Any) -> None:
        nonlocal left
        left -= 1 + len(program.bytecode or program.program or ())
        if left < 0:
            raise UnfitError(f"is a font with a glyph of more than {MAX_PROGRAM:,} steps")
        run(program)

    extractor.execute = execute
    return extractor
