"""Font files as HarfBuzz sees them: words to glyphs in place, glyphs to curves.

HarfBuzz checks all tables that it reads, is tried against damaged fonts all the time, and draws
variable fonts at any weight; it does all of the reading here. It is silent, though: what it cannot
read is empty to it. Here a font is refused for that, and glyphs are checked before they become
regions.
"""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache, cached_property
from pathlib import Path
from typing import Any, TypeAlias
from weakref import WeakValueDictionary

import numpy as np

from packwork.arrays import FloatArray
from packwork.fonts import bundled_file
from packwork.readers.budget.crossings import Allowance
from packwork.readers.cache import cached_by_identity
from packwork.readers.fonts.itemise import MOST_KNOWN
from packwork.readers.reading import TooRichError, UnfitError
from packwork.readers.regions import MAX_POINTS
from packwork.scene.item import FontFile

MAX_FONT_BYTES = 50_000_000
"""Largest font file. Collections for East Asian scripts have 20 MB. Chosen."""

MAX_SEGMENTS = 20_000
"""Lines and curves in one glyph, its components counted. Ornaments have thousands. Chosen."""

MAX_REACH = 32.0
"""How far from its origin a glyph may reach, in ems: more is damage. Chosen."""

MAX_CROSSINGS = 2_000
"""Places where the contours of one glyph may cross themselves and each other, by estimate: larger
lets a scribble of 100 letters take minutes. Letters put together of strokes have tens. Chosen."""

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
    """Face of a TTF's or OTF's bytes, or of a collection's."""
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

    ``points`` are ends and handles of those that were kept; ``em`` is in their units.

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


def check_points(count: int, what: str) -> None:
    """Refuse a glyph or a word of more points than an outline may have."""
    if count > MAX_POINTS:
        raise UnfitError(f"is a font with a {what} of {count:,} points; give a plainer one")


def check_glyph(rings: Sequence[FloatArray]) -> None:
    """Refuse a glyph whose flattened contours would take minutes, and all memory, to resolve."""
    check_points(sum(map(len, rings)), "glyph")
    try:
        Allowance(MAX_CROSSINGS).spend([ring for ring in rings if len(ring)])
    except TooRichError as error:
        raise UnfitError(
            f"is a font with a glyph whose lines cross too often ({error.what}); give a plainer one"
        ) from None


UNKNOWN_LANGUAGE = "und"
"""What HarfBuzz is told where no language is given: it would ask the machine."""

Segment: TypeAlias = tuple[str, tuple[float, ...]]
"""A letter of SVG's paths (M, L, Q, C or Z) and its absolute coordinates, y down."""

MOST_GLYPHS = 2_000
"""Glyphs of one word or phrase: rules of a font may make thousands of one letter. Chosen."""

UPRIGHT_WIDTH = 100.0
"""Width axis of a face that is neither condensed nor expanded, in percent."""


@dataclass(frozen=True)
class Glyph:
    """One glyph of a shaped word.

    Parameters
    ----------
    number
        Which one of the font; 0 shows that the font lacks a character.
    x, y
        Where its origin stands, in the font's units, y down.
    cluster
        Place in the text of the first character that it draws: glyphs of one place, such as
        a letter and its marks, belong together.
    """

    number: int
    x: float
    y: float
    cluster: int = 0


@dataclass(frozen=True)
class Shaped:
    """Glyphs of a run from left to right, and where the next would begin, in the font's units."""

    glyphs: tuple[Glyph, ...]
    advance: float


@dataclass(frozen=True)
class Bitmap:
    """A glyph that is a picture, its box about the glyph's origin in the font's units, y down."""

    png: bytes
    left: float
    top: float
    right: float
    bottom: float


_files = WeakValueDictionary[tuple[Any, ...], FontFile]()
"""Files in use: words that are remembered keep no second copy of one."""


class Typeface:
    """One face of a font, at one weight where it is variable.

    >>> Typeface(b"nonsense", "x.ttf")
    Traceback (most recent call last):
    packwork.readers.reading.UnfitError: is not a font; give a TTF, an OTF or a TTC
    """

    def __init__(self, data: bytes, name: str, index: int = 0, weight: int | None = None) -> None:
        import uharfbuzz as hb

        face = checked_face(data, index)
        self.name = name
        self.units = float(face.upem)
        self._hb = hb
        self._font = hb.Font(face)
        self._known: dict[int, tuple[Segment, ...]] = {}
        axes = {axis.tag: axis for axis in face.axis_infos}
        held = None
        if weight is not None and "wght" in axes:
            axis = axes["wght"]
            held = min(max(float(weight), axis.min_value), axis.max_value)
            self._font.set_variations({"wght": held})
        self._own = FontFile(data, name, index, held)

    @cached_property
    def file(self) -> FontFile:
        """The font as its file holds it; one for all faces of the same content and name."""
        return _files.setdefault((*self.identity, self.name), self._own)

    @cached_property
    def identity(self) -> tuple[bytes, int, float | None]:
        """Key that faces share which draw alike: a hash of the file, the index, the weight.

        >>> bundled_typeface().identity == bundled_typeface().identity
        True
        """
        file = self._own
        return hashlib.blake2b(file.data, digest_size=16).digest(), file.index, file.weight

    @cached_property
    def weight(self) -> float:
        """As the font states it: 400 is regular, 700 bold."""
        return float(self._font.get_style_value(self._hb.StyleTag.WEIGHT))

    @cached_property
    def oddity(self) -> tuple[float, float]:
        """Distances from upright and from the common width."""
        tags = self._hb.StyleTag
        lean = float(self._font.get_style_value(tags.ITALIC) != 0)
        lean += abs(float(self._font.get_style_value(tags.SLANT_ANGLE)))
        return lean, abs(float(self._font.get_style_value(tags.WIDTH)) - UPRIGHT_WIDTH)

    def draws(
        self, run: str, *, is_leftward: bool = False, language: str = UNKNOWN_LANGUAGE
    ) -> bool:
        """Whether there is a glyph for all of a run, as it is shaped."""
        glyphs = self.shaped(run, is_leftward=is_leftward, language=language).glyphs
        return all(glyph.number for glyph in glyphs)

    def has(self, characters: str) -> bool:
        """Whether there is a glyph for each character by itself."""
        return all(self._font.get_nominal_glyph(ord(character)) for character in characters)

    def shaped(
        self, run: str, *, is_leftward: bool = False, language: str = UNKNOWN_LANGUAGE
    ) -> Shaped:
        """Glyphs of one script and direction: ligatures, joined letters, stacked marks.

        >>> face = bundled_typeface()
        >>> found = [face.shaped(text).glyphs for text in ("office", "中")]
        >>> len(found[0]), [glyph.number for glyph in found[1]]
        (6, [0])
        """
        return self._shape(run, is_leftward, language)

    @cached_by_identity(MOST_KNOWN)
    def _shape(self, run: str, is_leftward: bool, language: str) -> Shaped:
        buffer = self._hb.Buffer()
        buffer.add_str(run)
        buffer.language = language
        buffer.guess_segment_properties()
        buffer.direction = "rtl" if is_leftward else "ltr"
        self._hb.shape(self._font, buffer, {"kern": True, "liga": True})
        if len(buffer.glyph_infos) > MOST_GLYPHS:
            raise UnfitError(f"is a font that draws one word with more than {MOST_GLYPHS:,} glyphs")
        x = y = 0.0
        found = []
        for info, place in zip(buffer.glyph_infos, buffer.glyph_positions, strict=True):
            origin = x + place.x_offset, y - place.y_offset
            found.append(Glyph(info.codepoint, *origin, info.cluster))
            x += place.x_advance
            y -= place.y_advance
        return Shaped(tuple(found), x)

    @cached_property
    def has_pictures(self) -> bool:
        """Whether glyphs may be pictures."""
        return bool(self._font.face.has_color_png)

    def bitmap(self, number: int) -> Bitmap | None:
        """Picture of a glyph of a colour font; None if it has none."""
        if not self.has_pictures:
            return None
        blob, box = self._font.get_glyph_color_png(number), self._font.get_glyph_extents(number)
        if blob is None or len(blob) == 0 or box is None:
            return None
        left, top = float(box.x_bearing), -float(box.y_bearing)
        return Bitmap(bytes(blob.data), left, top, left + box.width, top - box.height)

    def drawing(self, number: int) -> tuple[Segment, ...]:
        """Curves of a glyph about its origin, in the font's units, y down."""
        if number not in self._known:
            pen = _CurveRecorder()
            self._font.draw_glyph(number, _draw_functions(), pen)
            check_drawing(pen.count, np.array(pen.values), self.units)
            self._check_whole(number, pen.segments)
            self._known[number] = tuple(pen.segments)
        return self._known[number]

    def _check_whole(self, number: int, drawn: list[Segment]) -> None:
        """Refuse a glyph that HarfBuzz gave up on: it draws a part of it, or nothing."""
        box, face = self._font.get_glyph_extents(number), self._font.face
        if drawn:
            is_whole = box is not None
        elif face.has_color_png or face.has_color_layers or face.has_color_paint:
            # Other tables may draw it.
            is_whole = True
        else:
            is_whole = box is not None and not (box.width and box.height)
        if not is_whole:
            raise UnfitError("is a font with a glyph that cannot be drawn; give an intact one")


def bundled_typeface() -> Typeface:
    """The bundled black sans: Latin, Greek and Cyrillic letters.

    >>> bundled_typeface().has("aяω")
    True
    """
    return Typeface(Path(bundled_file()).read_bytes(), "Inter Display")


class _CurveRecorder:
    """Collects a glyph's segments, y turned down, and counts those that are too many.

    HarfBuzz calls it, and would pass over an exception; nothing may be raised here.
    """

    def __init__(self) -> None:
        self.segments: list[Segment] = []
        self.values: list[float] = []
        self.count = 0

    def add(self, letter: str, *points: float) -> None:
        self.count += 1
        if self.count > MAX_SEGMENTS:
            return
        turned = tuple(value if k % 2 == 0 else -value for k, value in enumerate(points))
        self.segments.append((letter, turned))
        self.values.extend(turned)


@cache
def _draw_functions() -> Any:
    """HarfBuzz' callbacks, made once."""
    import uharfbuzz as hb

    made = hb.DrawFuncs()
    made.set_move_to_func(lambda x, y, pen: pen.add("M", x, y))
    made.set_line_to_func(lambda x, y, pen: pen.add("L", x, y))
    made.set_quadratic_to_func(lambda a, b, x, y, pen: pen.add("Q", a, b, x, y))
    made.set_cubic_to_func(lambda a, b, c, d, x, y, pen: pen.add("C", a, b, c, d, x, y))
    made.set_close_path_func(lambda pen: pen.add("Z"))
    return made
