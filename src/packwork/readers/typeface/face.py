"""Font files as HarfBuzz sees them: words to glyphs in place, glyphs to curves.

HarfBuzz checks what it is given, is tried against damaged fonts all the time, and draws
variable fonts at any weight; it does all of the reading here.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any, TypeAlias

import numpy as np

from packwork.arrays import FloatArray
from packwork.readers.text.sfnt import MAX_FONT_BYTES as MAX_FONT_BYTES
from packwork.readers.unfit import UnfitError
from packwork.scene.live_text import FontFile

UNKNOWN_LANGUAGE = "und"
"""What HarfBuzz is told where no language is given: it would ask the machine."""

Segment: TypeAlias = tuple[str, tuple[float, ...]]
"""A letter of SVG's paths (M, L, Q, C or Z) and its absolute coordinates, y down."""

MAX_SEGMENTS = 20_000
"""Lines and curves in one glyph. Ornaments have thousands. Chosen."""

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
    """

    number: int
    x: float
    y: float


@dataclass(frozen=True)
class Shaped:
    """Glyphs of a run, and where the next run would begin.

    Parameters
    ----------
    glyphs
        From left to right.
    advance
        In the font's units.
    """

    glyphs: tuple[Glyph, ...]
    advance: float


@dataclass(frozen=True)
class Bitmap:
    """A glyph that is a picture.

    Parameters
    ----------
    png
        The file, as the font holds it.
    left, top, right, bottom
        Its box about the glyph's origin, in the font's units, y down.
    """

    png: bytes
    left: float
    top: float
    right: float
    bottom: float


class Typeface:
    """One face of a font, at one weight.

    Parameters
    ----------
    data
        The file.
    name
        What people call it.
    index
        Which face of a collection.
    weight
        For variable fonts: the weight axis.

    Raises
    ------
    UnfitError
        If it is no font that can be read.

    Examples
    --------
    >>> Typeface(b"nonsense", "x.ttf")
    Traceback (most recent call last):
    packwork.readers.unfit.UnfitError: is not a font; give a TTF, an OTF or a TTC
    """

    def __init__(self, data: bytes, name: str, index: int = 0, weight: int | None = None) -> None:
        import uharfbuzz as hb

        if data[:4] in (b"wOFF", b"wOF2"):
            raise UnfitError("is a font packed for the web (WOFF); unpack it to a TTF or an OTF")
        face = hb.Face(data, index)
        if face.glyph_count == 0:
            raise UnfitError("is not a font; give a TTF, an OTF or a TTC")
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
        self.file = FontFile(data, name, index, held)

    @cached_property
    def weight(self) -> float:
        """As the font states it: 400 is regular, 700 bold."""
        return float(self._font.get_style_value(self._hb.StyleTag.WEIGHT))

    @cached_property
    def oddity(self) -> tuple[float, float]:
        """How far it is from upright, and from the common width."""
        tags = self._hb.StyleTag
        lean = float(self._font.get_style_value(tags.ITALIC) != 0)
        lean += abs(float(self._font.get_style_value(tags.SLANT_ANGLE)))
        return lean, abs(float(self._font.get_style_value(tags.WIDTH)) - UPRIGHT_WIDTH)

    def has(self, characters: str) -> bool:
        """Whether there is a glyph for each character by itself."""
        return all(self._font.get_nominal_glyph(ord(character)) for character in characters)

    def shaped(
        self, run: str, *, is_leftward: bool = False, language: str = UNKNOWN_LANGUAGE
    ) -> Shaped:
        """Glyphs of one script and direction: ligatures, joined letters, stacked marks.

        Examples
        --------
        >>> face = bundled_typeface()
        >>> found = [face.shaped(text).glyphs for text in ("office", "中")]
        >>> len(found[0]), [glyph.number for glyph in found[1]]
        (6, [0])

        Raises
        ------
        UnfitError
            If they are more than ``MOST_GLYPHS``.
        """
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
            found.append(Glyph(info.codepoint, x + place.x_offset, y - place.y_offset))
            x += place.x_advance
            y -= place.y_advance
        return Shaped(tuple(found), x)

    def bitmap(self, number: int) -> Bitmap | None:
        """Picture of a glyph of a colour font; None if it has none."""
        if not self._font.face.has_color_png:
            return None
        blob, box = self._font.get_glyph_color_png(number), self._font.get_glyph_extents(number)
        if blob is None or len(blob) == 0 or box is None:
            return None
        left, top = float(box.x_bearing), -float(box.y_bearing)
        return Bitmap(bytes(blob.data), left, top, left + box.width, top - box.height)

    def drawing(self, number: int) -> tuple[Segment, ...]:
        """Curves of a glyph about its origin, in the font's units, y down.

        Raises
        ------
        UnfitError
            If it has more than ``MAX_SEGMENTS``.
        """
        if number not in self._known:
            pen = _Pen()
            self._font.draw_glyph(number, _draw_functions(), pen)
            if pen.count > MAX_SEGMENTS:
                raise UnfitError(
                    f"is a font with a glyph of {pen.count:,} pieces, more than {MAX_SEGMENTS:,}; "
                    "give a plainer one"
                )
            self._known[number] = tuple(pen.segments)
        return self._known[number]


def bundled_typeface() -> Typeface:
    """The bundled black sans: Latin, Greek and Cyrillic letters.

    Examples
    --------
    >>> bundled_typeface().has("aяω")
    True
    """
    from importlib import resources

    from packwork.readers.text.container import FONT

    place = resources.files("packwork.bundled").joinpath("fonts", FONT)
    return Typeface(place.read_bytes(), "Inter Display")


class _Pen:
    """Collects a glyph's segments, y turned down, and counts those that are too many.

    HarfBuzz calls it, and would pass over an exception; nothing may be raised here.
    """

    def __init__(self) -> None:
        self.segments: list[Segment] = []
        self.count = 0

    def add(self, letter: str, *points: float) -> None:
        self.count += 1
        if self.count > MAX_SEGMENTS:
            return
        turned = tuple(value if k % 2 == 0 else -value for k, value in enumerate(points))
        self.segments.append((letter, turned))


_functions: list[Any] = []


def _draw_functions() -> Any:
    """HarfBuzz' callbacks, made once."""
    if not _functions:
        import uharfbuzz as hb

        made = hb.DrawFuncs()
        made.set_move_to_func(lambda x, y, pen: pen.add("M", x, y))
        made.set_line_to_func(lambda x, y, pen: pen.add("L", x, y))
        made.set_quadratic_to_func(lambda a, b, x, y, pen: pen.add("Q", a, b, x, y))
        made.set_cubic_to_func(lambda a, b, c, d, x, y, pen: pen.add("C", a, b, c, d, x, y))
        made.set_close_path_func(lambda pen: pen.add("Z"))
        _functions.append(made)
    return _functions[0]


def points_of(segment: Segment) -> FloatArray:
    """``(k, 2)`` points of a segment.

    Examples
    --------
    >>> points_of(("L", (1.0, 2.0))).tolist()
    [[1.0, 2.0]]
    """
    return np.array(segment[1], dtype=np.float64).reshape(-1, 2)
