"""Checks of font files before shaping, and of glyphs before they become regions.

HarfBuzz checks all tables that it reads and is tried against damaged ones all the time. It is
silent, though: what it cannot read is empty to it. Here a font is refused for that.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, TypeAlias

import numpy as np

from packwork.arrays import FloatArray
from packwork.readers.budget.crossings import Allowance
from packwork.readers.reading import TooRichError, UnfitError

MAX_FONT_BYTES = 50_000_000
"""Largest font file. Collections for East Asian scripts have 20 MB. Chosen."""

MAX_SEGMENTS = 20_000
"""Lines and curves in one glyph, its components counted. Ornaments have thousands. Chosen."""

MAX_REACH = 32.0
"""How far from its origin a glyph may reach, in ems: more is damage. Chosen."""

MAX_CROSSINGS = 2_000
"""Places where the contours of one glyph may cross themselves and each other, by estimate: larger
lets a scribble of 100 letters take minutes. Letters put together of strokes have tens. Chosen."""

MAX_POINTS = 400_000
"""Points of one glyph's flattened contours. An ornament has a tenth of it. Chosen."""

Face: TypeAlias = Any
"""A ``uharfbuzz.Face`` (which ships no types)."""

_SIGNATURES = (b"\0\1\0\0", b"true", b"OTTO", b"ttcf")
_COMPRESSED = (b"wOFF", b"wOF2")
_TABLES = ("head", "maxp", "hhea", "hmtx", "cmap")
_OUTLINES = ("glyf", "CFF ", "CFF2")
_EM, _FORM = slice(18, 20), slice(50, 52)
_EMS = range(16, 16_385)
"""Units in an em that the format allows; HarfBuzz takes any other number for 1,000."""


def checked_face(data: bytes, index: int = 0) -> Face:
    """Face of a TTF's or OTF's bytes, or of a collection's.

    Raises
    ------
    UnfitError
        If it is no font that can be read.

    Examples
    --------
    >>> checked_face(b"nonsense")
    Traceback (most recent call last):
    packwork.readers.reading.UnfitError: is not a font; give a TTF, an OTF or a TTC
    """
    import uharfbuzz as hb

    if data[:4] in _COMPRESSED:
        # Their tables may unpack to a thousand times the file's size.
        raise UnfitError("is a font packed for the web (WOFF); unpack it to a TTF or an OTF")
    if data[:4] not in _SIGNATURES:
        raise UnfitError("is not a font; give a TTF, an OTF or a TTC")
    face = hb.Face(data, index)
    missing = [tag for tag in _TABLES if not _has(face, tag)]
    if missing:
        raise UnfitError(f"is a font without its table {missing[0]!r}; give an intact one")
    if not (face.has_color_png or any(_has(face, tag) for tag in _OUTLINES)):
        raise UnfitError("is a font without outlines; give a TTF or an OTF")
    if face.glyph_count == 0:
        raise UnfitError("is a damaged font (it has no glyphs); give an intact one")
    _check_numbers(face)
    return face


def _has(face: Face, table: str) -> bool:
    # Names of tables cannot be asked for: those of damaged fonts are no text.
    return len(face.reference_table(table)) > 0


def _check_numbers(face: Face) -> None:
    """Refuse an em of no size, and places of glyphs that run backwards: those draw nothing."""
    head = face.reference_table("head").data
    em = int.from_bytes(head[_EM], "big")
    if em not in _EMS:
        raise UnfitError(f"is a damaged font (an em of {em} units); give an intact one")
    form = ">u4" if int.from_bytes(head[_FORM], "big") else ">u2"
    table = face.reference_table("loca").data
    count = min(face.glyph_count + 1, len(table) // np.dtype(form).itemsize)
    places = np.frombuffer(table, form, count).astype(np.int64)
    if (np.diff(places) < 0).any():
        raise UnfitError("is a damaged font (its glyphs overlap in the file); give an intact one")


def check_drawing(count: int, points: FloatArray, em: float) -> None:
    """Refuse a glyph of too many lines and curves, or one that reaches too far.

    Parameters
    ----------
    points
        Ends and handles of the lines and curves that were kept.
    em
        In the units of the points.

    Raises
    ------
    UnfitError
        If it is so.

    Examples
    --------
    >>> check_drawing(2, np.array([[0.0, 9.0], [1e9, 0.0]]), 1000.0)
    Traceback (most recent call last):
    packwork.readers.reading.UnfitError: is a font with a glyph that reaches too far; ...
    """
    if count > MAX_SEGMENTS:
        raise UnfitError(
            f"is a font with a glyph of {count:,} pieces, more than {MAX_SEGMENTS:,}; "
            "give a plainer one"
        )
    if not (np.abs(points) <= MAX_REACH * em).all():
        raise UnfitError("is a font with a glyph that reaches too far; give an intact one")


def check_glyph(rings: Sequence[FloatArray]) -> None:
    """Refuse a glyph whose flattened contours would take minutes, and all memory, to resolve.

    Raises
    ------
    UnfitError
        If they are too many points, or cross too often.

    Examples
    --------
    >>> check_glyph([np.random.default_rng(0).random((1000, 2))])
    Traceback (most recent call last):
    packwork.readers.reading.UnfitError: is a font with a glyph whose lines cross ...
    """
    points = sum(map(len, rings))
    if points > MAX_POINTS:
        raise UnfitError(f"is a font with a glyph of {points:,} points; give a plainer one")
    try:
        Allowance(MAX_CROSSINGS).spend([ring for ring in rings if len(ring)])
    except TooRichError as error:
        raise UnfitError(
            f"is a font with a glyph whose lines cross too often ({error.what}); give a plainer one"
        ) from None
