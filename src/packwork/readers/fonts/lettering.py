"""Shaped words to regions and to paths; glyphs that are pictures are traced."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
import shapely
from shapely import affinity

from packwork.arrays import FloatArray
from packwork.geometry import affine
from packwork.geometry.bezier import FLATTENING
from packwork.geometry.polygon import Region, united
from packwork.readers.cache import GlyphInk, cached_by_identity
from packwork.readers.fonts.face import UNKNOWN_LANGUAGE, Bitmap, Glyph, Typeface
from packwork.readers.fonts.glyph_ink import (
    Box,
    ClearInk,
    GlyphPath,
    clear_ink,
    glyph_ink,
    glyph_path,
)
from packwork.readers.fonts.itemise import Piece, visual_order
from packwork.readers.pictures.decode import decode_picture, png_of_pixels
from packwork.readers.pictures.silhouette import outline_of_cut_out
from packwork.readers.reading import UnfitError
from packwork.scene.item import TextRun

MOST_PX = 1_024
"""Longer side of a glyph's picture; fonts have 136 and 160. Chosen."""


@dataclass(frozen=True, eq=False)
class GlyphPicture:
    """A glyph's picture in place; ``matrix`` maps (2 x 3) pixels to the word's units."""

    png: bytes
    width: int
    height: int
    matrix: FloatArray
    region: Region


def picture_of(bitmap: Bitmap, origin: tuple[float, float], scale: float) -> GlyphPicture:
    """Picture of a glyph whose origin stands there, its font's units that large.

    >>> png = png_of_pixels(np.full((2, 4, 4), 255, np.uint8))
    >>> picture = picture_of(Bitmap(png, 0, -100, 200, 0), (10.0, 0.0), 1.0)
    >>> [round(side) for side in picture.region.bounds]
    [10, -100, 210, 0]
    """
    pixels = decode_picture(bitmap.png, MOST_PX).pixels
    height, width = pixels.shape[:2]
    wide = scale * (bitmap.right - bitmap.left) / width
    high = scale * (bitmap.bottom - bitmap.top) / height
    left, top = origin[0] + scale * bitmap.left, origin[1] + scale * bitmap.top
    matrix = np.array([[wide, 0.0, left], [0.0, high, top]])
    outline = outline_of_cut_out(pixels)
    return GlyphPicture(
        png_of_pixels(pixels),
        width,
        height,
        matrix,
        shapely.transform(outline, lambda points: affine.apply(matrix, points)),
    )


LINE_STEP = 1.0
"""Distance of the base lines of a word of several lines, in ems. Chosen."""

MOST_WORDS = 1_024
"""Words whose curves and outlines are remembered, each up to fifty kilobytes. Chosen."""

_MARGIN = 0.5
"""Share of the allowed flattening that glyphs use up; the rest is rounding."""


@dataclass(frozen=True, eq=False)
class Lettering:
    """A word as fonts draw it, in ems, y down, the first base line at 0.

    Parameters
    ----------
    covered
        What its letters cover: rings where none comes near another, else a region.
    curves
        Of its letters, in units of its first font.
    units
        Such units in one em.
    runs
        The same as text, in those units.
    coarseness
        Tolerance to which curves were followed, over ``FLATTENING`` of its extent.
    """

    covered: ClearInk | Region
    curves: Curves
    units: float
    runs: tuple[TextRun, ...] = ()
    pictures: tuple[GlyphPicture, ...] = ()
    coarseness: float = 1.0

    @cached_property
    def region(self) -> Region:
        """Region of all letters, with holes and parts."""
        return self.covered.ink.region if isinstance(self.covered, ClearInk) else self.covered

    @property
    def path(self) -> str:
        """SVG path data of its curves; contours may overlap, non-zero."""
        return self.curves.path


@dataclass(frozen=True, eq=False)
class Curves:
    """Glyphs' curves, each with its place and its size; written out once they are asked for."""

    glyphs: tuple[tuple[GlyphPath, tuple[float, float], float], ...]

    @cached_property
    def path(self) -> str:
        """SVG path data of all."""
        return "".join(glyph.moved(*place, size) for glyph, place, size in self.glyphs)


@dataclass(frozen=True)
class TypeSetting:
    """A piece of a line and the font that draws it."""

    piece: Piece
    face: Typeface


MOST_COARSE = 4.0
"""Coarseness at most. Larger lets areas of letters be off by more than is certified of them (.04 %
at 4, .2 at 16), smaller takes memory. Tried."""


def lettering_of(
    lines: Sequence[Sequence[TypeSetting]],
    language: str = UNKNOWN_LANGUAGE,
    em: float = math.inf,
    most_coarse: float = MOST_COARSE,
) -> Lettering:
    """Word of one or several centred lines, each piece drawn by its own font.

    Curves are followed to ``FLATTENING`` of the word's extent, or of the side of a picture in which
    an em is ``em`` of that side; coarser than for its own extent ``most_coarse`` times at most.

    >>> from packwork.readers.fonts.face import bundled_typeface
    >>> face = bundled_typeface()
    >>> word = lettering_of([[TypeSetting(Piece("o"), face), TypeSetting(Piece("x"), face)]])
    >>> [run.text for run in word.runs], word.runs[0].x < word.runs[1].x
    (['o', 'x'], True)
    >>> len(word.region.geoms), word.path[:1]
    (2, 'M')
    """
    face, *others = dict.fromkeys(one.face for line in lines for one in line)
    if others:
        return _lettering(lines, language, em, most_coarse)
    pieces = tuple(tuple(one.piece for one in line) for line in lines)
    return _lettering_by(face, face.name, pieces, language, em, most_coarse)


@cached_by_identity(MOST_WORDS)
def _lettering_by(
    face: Typeface, _name: str, lines: tuple[tuple[Piece, ...], ...], *asked: Any
) -> Lettering:
    """Word in one font of that name: words recur as letters do."""
    return _lettering([[TypeSetting(piece, face) for piece in line] for line in lines], *asked)


def _lettering(
    lines: Sequence[Sequence[TypeSetting]], language: str, em: float, most_coarse: float
) -> Lettering:
    word = LetteredRuns.of(lines, language, em, most_coarse)
    covered = _covered(word.runs, word.pictures, word.tolerance, 1 / word.units)
    curves = Curves(tuple((*one, run.scale) for run in word.runs for one in run.curves()))
    texts = tuple(run.text for run in word.runs)
    return Lettering(covered, curves, word.units, texts, word.pictures, word.coarseness)


@dataclass(frozen=True, eq=False)
class LetteredRuns:
    """Runs of a word in place, in units of its first font, and how finely curves are followed."""

    runs: tuple[FontRun, ...]
    pictures: tuple[GlyphPicture, ...]
    units: float
    coarseness: float
    tolerance: float

    @classmethod
    def of(
        cls, lines: Sequence[Sequence[TypeSetting]], language: str, em: float, most_coarse: float
    ) -> LetteredRuns:
        """Runs of one or several lines, as ``lettering_of`` says."""
        units = lines[0][0].face.units
        shaped = [line_of_runs(line, k, units, language) for k, line in enumerate(lines)]
        runs = tuple(run for line in shaped for run in line)
        pictures = tuple(picture for run in runs for picture in run.pictures())
        boxes = [box for run in runs for box in run.boxes()]
        if not boxes and not pictures:
            raise UnfitError("has no outlines to draw it with")
        coarseness = _coarseness(boxes, em / units, most_coarse)
        return cls(runs, pictures, units, coarseness, coarseness * tolerance_of(boxes))


def _covered(
    runs: Sequence[FontRun], pictures: Sequence[GlyphPicture], tolerance: float, size: float
) -> ClearInk | Region:
    """Region of glyphs and pictures ``size`` times as large; curves followed to ``tolerance``."""
    glyphs = [glyph for run in runs for glyph in run.inks(tolerance)]
    places = np.array([place for run in runs for place in run.places()]).reshape(-1, 2)
    sizes = np.repeat([run.scale for run in runs], [len(run.glyphs) for run in runs])
    clear = None if pictures else clear_ink(glyphs, places * size, sizes * size)
    if clear is not None:
        return clear
    regions = [
        affinity.affine_transform(glyph.region, (own, 0, 0, own, *place))
        for glyph, own, place in zip(glyphs, sizes, places, strict=True)
    ]
    whole = united([*regions, *(picture.region for picture in pictures)])
    return affinity.scale(whole, size, size, origin=(0, 0))


@dataclass(frozen=True)
class FontRun:
    """Glyphs of one font at their place, in the word's units, with the text that they are."""

    face: Typeface
    glyphs: tuple[Glyph, ...]
    x: float
    y: float
    scale: float
    piece: Piece
    advance: float

    def boxes(self) -> list[Box]:
        """Left, top, right and bottom of the curves of each glyph that has some."""
        found = []
        for path, (x, y) in zip(self.paths, self.places(), strict=True):
            if path.box is not None:
                left, top, right, bottom = (self.scale * end for end in path.box)
                found.append((x + left, y + top, x + right, y + bottom))
        return found

    @cached_property
    def paths(self) -> list[GlyphPath]:
        """Curves of each glyph about its origin, in units of its own font."""
        return [glyph_path(self.face, glyph.number) for glyph in self.glyphs]

    def curves(self) -> list[tuple[GlyphPath, tuple[float, float]]]:
        """Curves of each glyph, and its origin."""
        return list(zip(self.paths, self.places(), strict=True))

    def inks(self, tolerance: float) -> list[GlyphInk]:
        """Regions of the glyphs about their origins, curves followed to ``tolerance``."""
        return [glyph_ink(self.face, glyph.number, tolerance / self.scale) for glyph in self.glyphs]

    def places(self) -> list[tuple[float, float]]:
        """Origins of the glyphs."""
        return [self._place(glyph) for glyph in self.glyphs]

    def pictures(self) -> list[GlyphPicture]:
        """Those of its glyphs that are pictures."""
        face = self.face
        found = []
        for glyph in self.glyphs if face.has_pictures else ():
            bitmap = None if face.drawing(glyph.number) else face.bitmap(glyph.number)
            if bitmap is not None:
                found.append(picture_of(bitmap, self._place(glyph), self.scale))
        return found

    def ends(self) -> list[float]:
        """Leftmost and rightmost of what is drawn."""
        across = [end for box in self.boxes() for end in box[::2]]
        across += [end for picture in self.pictures() for end in picture.region.bounds[::2]]
        return [min(across), max(across)] if across else []

    def _place(self, glyph: Glyph) -> tuple[float, float]:
        return self.x + glyph.x * self.scale, self.y + glyph.y * self.scale

    @property
    def text(self) -> TextRun:
        """The run as text, upright."""
        units = self.face.units
        return TextRun(
            self.piece.text,
            self.face.file,
            self.x,
            self.y,
            units * self.scale,
            tuple(glyph.x / units for glyph in self.glyphs),
            self.advance / units,
            self.piece.is_leftward,
        )


def line_of_runs(
    line: Sequence[TypeSetting], number: int, units: float, language: str
) -> list[FontRun]:
    """Runs of one line beside each other, centred about 0 by what they draw."""
    runs: dict[int, FontRun] = {}
    x = 0.0
    for k in visual_order([setting.piece for setting in line]):
        piece, face = line[k].piece, line[k].face
        shaped = face.shaped(piece.text, is_leftward=piece.is_leftward, language=language)
        y, scale = number * LINE_STEP * units, units / face.units
        runs[k] = FontRun(face, shaped.glyphs, x, y, scale, piece, shaped.advance)
        x += shaped.advance * runs[k].scale
    ends = [end for run in runs.values() for end in run.ends()]
    middle = float(round((min(ends) + max(ends)) / 2)) if ends else 0.0
    return [replace(runs[k], x=runs[k].x - middle) for k in range(len(line))]


def box_of(boxes: Sequence[Box]) -> Box:
    """Box about all of some.

    >>> box_of([(0.0, 1.0, 2.0, 3.0), (-1.0, 2.0, 0.0, 4.0)])
    (-1.0, 1.0, 2.0, 4.0)
    """
    left, top, right, bottom = zip(*boxes, strict=True)
    return min(left), min(top), max(right), max(bottom)


def _extent(boxes: Sequence[Box]) -> float:
    """Longer side of a box about all."""
    left, top, right, bottom = box_of(boxes)
    return max(right - left, bottom - top)


def _coarseness(boxes: Sequence[Box], shown: float, most: float) -> float:
    """Side of a picture over a word's extent in it, a power of two; ``shown``: of it, of a unit."""
    extent = _extent(boxes) if boxes else 1.0
    return 2.0 ** math.floor(math.log2(min(max(1.0 / (extent * shown), 1.0), most)))


def tolerance_of(boxes: Sequence[Box]) -> float:
    """Largest distance of chords from curves, in the word's units."""
    if not boxes:
        return 1.0
    extent = _extent(boxes)
    # Words of about one length share their glyphs.
    return _MARGIN * FLATTENING * 2.0 ** math.floor(math.log2(max(extent, 1e-9)))
