"""Bytes to an opened font: the gate that every font file passes."""

from __future__ import annotations

import logging
from collections.abc import Iterator
from contextlib import contextmanager
from io import BytesIO
from typing import Any, TypeAlias

from fontTools.ttLib import TTFont  # type: ignore[import-untyped]

from packwork.readers.unfit import UnfitError

MAX_FONT_BYTES = 50_000_000
"""Largest font file. Collections for East Asian scripts have 20 MB. Chosen."""

Font: TypeAlias = Any
"""A fontTools ``TTFont`` (fontTools ships no types)."""

_SIGNATURES = (b"\0\1\0\0", b"true", b"OTTO", b"ttcf")
_COMPRESSED = (b"wOFF", b"wOF2")
_TABLES = ("head", "maxp", "hhea", "hmtx", "cmap")

# What is wrong with a font is said once, by us.
logging.getLogger("fontTools").addHandler(logging.NullHandler())


def open_font(data: bytes) -> Font:
    """Font of a TTF's or OTF's bytes, or the first one of a collection; read lazily.

    Glyphs are called by their numbers, ``"0"`` to ``"65535"``: the names in a file may
    be missing, repeated or derived from tables without a bound on their size.

    Raises
    ------
    UnfitError
        If it is no font that can be read.

    Examples
    --------
    >>> open_font(b"nonsense")
    Traceback (most recent call last):
    packwork.readers.unfit.UnfitError: is not a font; give a TTF, an OTF or a TTC
    """
    if data[:4] in _COMPRESSED:
        # Their tables may unpack to a thousand times the file's size.
        raise UnfitError("is a font packed for the web (WOFF); unpack it to a TTF or an OTF")
    if data[:4] not in _SIGNATURES:
        raise UnfitError("is not a font; give a TTF, an OTF or a TTC")
    with damaged_font():
        font = TTFont(BytesIO(data), fontNumber=0, lazy=True)
        missing = [tag for tag in _TABLES if tag not in font.reader]
        if missing:
            raise UnfitError(f"is a font without its table {missing[0]!r}; give an intact one")
        font.setGlyphOrder([str(number) for number in range(font["maxp"].numGlyphs)])
    return font


@contextmanager
def damaged_font() -> Iterator[None]:
    """Turn whatever parsing meets inside the block into a refusal.

    Raises
    ------
    UnfitError
        For any failure.

    Examples
    --------
    >>> with damaged_font():
    ...     {}["glyf"]
    Traceback (most recent call last):
    packwork.readers.unfit.UnfitError: is a damaged font (KeyError); give an intact one
    """
    try:
        yield
    except UnfitError:
        raise
    except Exception as error:  # fontTools lets any failure of parsing through
        raise UnfitError(
            f"is a damaged font ({type(error).__name__}); give an intact one"
        ) from error
