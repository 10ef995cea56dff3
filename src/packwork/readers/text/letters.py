"""Letters of a shaped line as separate regions."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

import shapely
from shapely import affinity

from packwork.geometry.bezier import FLATTENING
from packwork.geometry.overlay import union
from packwork.geometry.polygon import Region, region
from packwork.readers.fonts.curves import rings_of
from packwork.readers.fonts.face import Segment, Shaped, Typeface
from packwork.readers.fonts.guard import check_glyph
from packwork.readers.fonts.itemise import clusters, script_of, visual_order
from packwork.readers.fonts.lettering import Setting
from packwork.readers.fonts.pictures import picture_of
from packwork.readers.fonts.remembered import remembered_by_font
from packwork.readers.unfit import UnfitError, naming

STAND_ALONE = frozenset({
    "Armn", "Bopo", "Brai", "Cans", "Cher", "Copt", "Cyrl", "Ethi", "Geor", "Glag", "Goth", "Grek",
    "Hang", "Hani", "Hebr", "Hira", "Kana", "Latn", "Ogam", "Runr", "Tfng", "Yiii",
})  # fmt: skip
"""Scripts whose letters do not depend on their neighbours: each is shaped by itself, so that
neither ligatures nor kerning close the gaps between them. Words of all others are shaped whole."""

JOINED = 0.005
"""Distance in ems below which the letters of a word that is shaped whole are one. Larger joins
what merely lies close, smaller cuts joins that a font leaves open by a hair. Chosen."""

MOST_ADVANCE = 8.0
"""How far one character may move the next, in ems: more is damage. Chosen."""

_BLANKS = "\u2800\u3164"
"""Signs that are meant to draw nothing."""

MOST_KNOWN = 1024
"""Glyphs whose regions are remembered. Chosen."""


@dataclass(frozen=True, eq=False)
class Letter:
    """One letter, or several that join, as a font draws them, in ems, y down, base line at 0.

    Parameters
    ----------
    region
        What it covers, with holes and parts; empty for a space.
    advance
        How far it moves the origin of the next letter to the right.
    """

    region: Region
    advance: float


@dataclass(frozen=True, eq=False)
class _Drawn:
    """What one glyph covers in its word, in ems."""

    region: Region
    cluster: int


def letters_of(line: Sequence[Setting]) -> list[Letter]:
    """Letters of one line, from left to right.

    Raises
    ------
    ReadError
        If a glyph is damaged or empty; it names the font.

    Examples
    --------
    >>> from packwork.readers.fonts.face import bundled_typeface
    >>> from packwork.readers.fonts.itemise import Piece
    >>> found = letters_of([Setting(Piece("o x"), bundled_typeface())])
    >>> [letter.region.is_empty for letter in found]
    [False, True, False]
    """
    order = visual_order([setting.piece for setting in line])
    return [letter for k in order for letter in _letters(line[k])]


def _letters(setting: Setting) -> Iterator[Letter]:
    text, face, is_leftward = setting.piece.text, setting.face, setting.piece.is_leftward
    script = script_of(text)
    is_alone = not script or script in STAND_ALONE
    parts = clusters(text) if is_alone else re.findall(r"\s+|\S+", text)
    with naming(face.name):
        for part in reversed(parts) if is_leftward else parts:
            shaped = face.shaped(part, is_leftward=is_leftward)
            drawn = _drawn(shaped, face)
            if not drawn and any(map(_is_seen, part)):
                raise UnfitError(f"draws nothing for {part!r}; choose another font")
            advance = min(max(shaped.advance / face.units, 0.0), MOST_ADVANCE * len(part))
            *before, last = [_covered(drawn)] if is_alone else _joined(drawn) or [_covered([])]
            yield from (Letter(one, 0.0) for one in before)
            yield Letter(last, advance)


def _joined(drawn: Sequence[_Drawn]) -> list[Region]:
    """What glyphs cover, one after the other, those that join in one; marks join their letter."""
    groups: list[list[_Drawn]] = []
    for one in drawn:
        if groups and (one.cluster == groups[-1][-1].cluster or _is_near(one, groups[-1])):
            groups[-1].append(one)
        else:
            groups.append([one])
    return [_covered(group) for group in groups]


def _is_near(one: _Drawn, others: Sequence[_Drawn]) -> bool:
    return bool(shapely.dwithin(one.region, [each.region for each in others], JOINED).any())


def _covered(drawn: Sequence[_Drawn]) -> Region:
    return drawn[0].region if len(drawn) == 1 else union([one.region for one in drawn])


def _drawn(shaped: Shaped, face: Typeface) -> list[_Drawn]:
    """Glyphs that cover something, from left to right."""
    found = []
    for glyph in shaped.glyphs:
        drawn = _glyph_region(face, glyph.number)
        if not drawn.is_empty:
            x, y = glyph.x / face.units, glyph.y / face.units
            placed = affinity.translate(drawn, x, y) if x or y else drawn
            found.append(_Drawn(placed, glyph.cluster))
    return found


def _is_seen(character: str) -> bool:
    return unicodedata.category(character)[0] in "LNPS" and character not in _BLANKS


@remembered_by_font(MOST_KNOWN)
def _glyph_region(face: Typeface, number: int) -> Region:
    """What a glyph covers about its origin, in ems."""
    drawn = list(_unclosed(face.drawing(number)))
    rings = [ring / face.units for ring in rings_of(drawn, FLATTENING * face.units)]
    check_glyph(rings)
    found = region(rings, "nonzero")
    bitmap = face.bitmap(number) if not rings else None
    return found if bitmap is None else picture_of(bitmap, (0.0, 0.0), 1 / face.units).region


def _unclosed(segments: Sequence[Segment]) -> Iterator[Segment]:
    """Segments but for lines back to where a contour began: rings are closed without."""
    start: tuple[float, ...] = ()
    for segment, after in pairwise(segments):
        letter, points = segment
        start = points if letter == "M" else start
        if not (letter == "L" and points == start and after[0] == "Z"):
            yield segment
