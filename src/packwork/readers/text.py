"""Words to containers, ``text:HELLO|WORLD``: letters as regions, set apart in lines."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

import shapely
from shapely import affinity

from packwork.geometry.bezier import FLATTENING
from packwork.geometry.overlay import union
from packwork.geometry.polygon import Region, region
from packwork.readers.cache import cached_by_identity
from packwork.readers.fonts.face import Segment, Shaped, Typeface, check_glyph
from packwork.readers.fonts.fallback import Fonts, is_font_file, open_fonts, typeface_of_file
from packwork.readers.fonts.glyph_ink import rings_of
from packwork.readers.fonts.itemise import clusters, script_of, visual_order
from packwork.readers.fonts.lettering import MOST_WORDS, TypeSetting, picture_of
from packwork.readers.options import TEXT_PREFIX
from packwork.readers.reading import UnfitError, reading_file
from packwork.readers.regions import clean_union
from packwork.scene.container import Container, placed_container

STAND_ALONE = frozenset({
    "Armn", "Bopo", "Brai", "Cans", "Cher", "Copt", "Cyrl", "Ethi", "Geor", "Glag", "Goth", "Grek",
    "Hang", "Hani", "Hebr", "Hira", "Kana", "Latn", "Ogam", "Runr", "Tfng", "Yiii",
})  # fmt: skip
"""Scripts whose letters do not depend on their neighbours: each is shaped by itself, so that
neither ligatures nor kerning close the gaps between them. Words of all others are shaped whole."""

LETTER_GAP = 0.04
"""Least distance between neighbouring letters, in ems. Larger wastes the canvas, smaller
lets items of one letter crowd those of the next. Chosen."""

LINE_GAP = 3 * LETTER_GAP
"""Distance between the boxes of two lines, in ems."""

JOINED = LETTER_GAP / 8
"""Distance in ems below which the letters of a word that is shaped whole are one. Larger joins
what merely lies close, smaller cuts joins that a font leaves open by a hair."""

MOST_ADVANCE = 8.0
"""How far one character may move the next, in ems: more is damage. Chosen."""

_BLANKS = "\u2800\u3164"
"""Signs that are meant to draw nothing."""


@dataclass(frozen=True, eq=False)
class Letter:
    """One letter, or several that join, as a font draws them, in ems, y down, base line at 0.

    ``region`` is empty for a space; ``advance`` is how far right the next letter's origin lies.
    """

    region: Region
    advance: float


@dataclass(frozen=True, eq=False)
class _DrawnGlyph:
    """Region of one glyph in its word, in ems."""

    region: Region
    cluster: int


def letters_of(line: Sequence[TypeSetting]) -> list[Letter]:
    """Letters of one line, from left to right.

    Examples
    --------
    >>> from packwork.readers.fonts.face import bundled_typeface
    >>> from packwork.readers.fonts.itemise import Piece
    >>> found = letters_of([TypeSetting(Piece("o x"), bundled_typeface())])
    >>> [letter.region.is_empty for letter in found]
    [False, True, False]
    """
    order = visual_order([setting.piece for setting in line])
    return [letter for k in order for letter in _letters(line[k])]


def _letters(setting: TypeSetting) -> Iterator[Letter]:
    text, face, is_leftward = setting.piece.text, setting.face, setting.piece.is_leftward
    script = script_of(text)
    is_alone = not script or script in STAND_ALONE
    parts = clusters(text) if is_alone else re.findall(r"\s+|\S+", text)
    with reading_file(face.name):
        for part in reversed(parts) if is_leftward else parts:
            shaped = face.shaped(part, is_leftward=is_leftward)
            drawn = _drawn(shaped, face)
            if not drawn and any(map(_is_seen, part)):
                raise UnfitError(f"draws nothing for {part!r}; choose another font")
            advance = min(max(shaped.advance / face.units, 0.0), MOST_ADVANCE * len(part))
            *before, last = [_covered(drawn)] if is_alone else _joined(drawn) or [_covered([])]
            yield from (Letter(one, 0.0) for one in before)
            yield Letter(last, advance)


def _joined(drawn: Sequence[_DrawnGlyph]) -> list[Region]:
    """Regions of glyphs, one after the other, those that join in one; marks join their letter."""
    groups: list[list[_DrawnGlyph]] = []
    for one in drawn:
        if groups and (one.cluster == groups[-1][-1].cluster or _is_near(one, groups[-1])):
            groups[-1].append(one)
        else:
            groups.append([one])
    return [_covered(group) for group in groups]


def _is_near(one: _DrawnGlyph, others: Sequence[_DrawnGlyph]) -> bool:
    return bool(shapely.dwithin(one.region, [each.region for each in others], JOINED).any())


def _covered(drawn: Sequence[_DrawnGlyph]) -> Region:
    return drawn[0].region if len(drawn) == 1 else union([one.region for one in drawn])


def _drawn(shaped: Shaped, face: Typeface) -> list[_DrawnGlyph]:
    """Glyphs that cover something, from left to right."""
    found = []
    for glyph in shaped.glyphs:
        drawn = _glyph_region(face, glyph.number)
        if not drawn.is_empty:
            x, y = glyph.x / face.units, glyph.y / face.units
            placed = affinity.translate(drawn, x, y) if x or y else drawn
            found.append(_DrawnGlyph(placed, glyph.cluster))
    return found


def _is_seen(character: str) -> bool:
    return unicodedata.category(character)[0] in "LNPS" and character not in _BLANKS


@cached_by_identity(MOST_WORDS)
def _glyph_region(face: Typeface, number: int) -> Region:
    """Region of a glyph about its origin, in ems."""
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


WEIGHT = 900
"""Of installed families: the thickest letters hold the most. Chosen."""

MARGIN = 0.02
"""Free edge of the canvas, as a share of the words' longer side. Chosen."""


def container_of_words(
    source: str, side: float = 600.0, font: str | Path | None = None
) -> Container:
    """Container of ``text:`` and words, ``|`` between lines, on a canvas about them, ``side`` long.

    Words of any script, shaped as its readers expect, in a font file or an installed family.
    Letters stand apart, but those that join in writing, as in Arabic and Hindi. Counters of
    letters are holes.

    Examples
    --------
    >>> container = container_of_words("text:OX", 300.0)
    >>> container.name, container.width, len(container.outline.rings)
    ('OX', 300.0, 3)
    """
    with reading_file(source):
        lines = lines_of(source.removeprefix(TEXT_PREFIX))
        fonts = _fonts(None if font is None else str(font))
        words = clean_union(set_lines([letters_of(line) for line in fonts.settings(lines)]))
    left, top, right, bottom = words.bounds
    edge = MARGIN * max(right - left, bottom - top)
    canvas = (left - edge, top - edge, right - left + 2 * edge, bottom - top + 2 * edge)
    return placed_container(" ".join(lines), source, words, canvas, side)


def _fonts(font: str | None) -> Fonts:
    if font is None:
        return open_fonts([], WEIGHT)
    return Fonts([typeface_of_file(font)]) if is_font_file(font) else open_fonts([font], WEIGHT)


MOST_CHARACTERS = 500
"""Characters in one container; more could not be filled on any canvas. Chosen."""

FEW_POINTS = 20_000
"""Points of two neighbours up to which distances are taken from the whole of them: a phrase of
letters that all join has 100,000, and costs a minute. Single letters have hundreds. Chosen."""

_JOINERS = "\u200c\u200d"
"""Where letters are to join, and where not."""

_NOTHING = _JOINERS + " \ufe0e\ufe0f"


def lines_of(text: str) -> list[str]:
    """Lines of a text, ``|`` between them, in composed characters, single spaces.

    Examples
    --------
    >>> lines_of(" HELLO   big|WORLD| ")
    ['HELLO big', 'WORLD']
    """
    composed = "".join(c for c in unicodedata.normalize("NFC", text) if not _is_unseen(c))
    lines = [" ".join(line.split()) for line in composed.split("|")]
    kept = [line for line in lines if line.strip(_NOTHING)]
    if not kept:
        raise UnfitError("holds no word; give one, as in text:HELLO")
    if sum(map(len, kept)) > MOST_CHARACTERS:
        raise UnfitError(f"is longer than {MOST_CHARACTERS} characters; give fewer words")
    return kept


def set_lines(lines: Sequence[Sequence[Letter]]) -> Region:
    """Region of centred lines, one under the other, in ems, letters from left to right.

    Letters stand by their advance, moved apart where they would come nearer than
    ``LETTER_GAP``; lines stand ``LINE_GAP`` under each other's ink.

    Examples
    --------
    >>> block = Letter(shapely.box(0, -1, 1, 0), 1.0)
    >>> set_lines([[block, block], [block]]).bounds
    (-1.02, 0.0, 1.02, 2.12)
    """
    placed, top = [], 0.0
    for line in lines:
        ink = _set_line(line)
        left, low, right, high = ink.bounds
        placed.append(affinity.translate(ink, -(left + right) / 2, top - low))
        top += high - low + LINE_GAP
    return union(placed)


def _set_line(line: Sequence[Letter]) -> Region:
    pieces: list[Region] = []
    x = 0.0
    for letter in line:
        moved = affinity.translate(letter.region, x)
        push = _push(pieces[-1], moved) if pieces and not moved.is_empty else 0.0
        if not moved.is_empty:
            pieces.append(affinity.translate(moved, push))
        x += push + letter.advance
    if not pieces:
        raise UnfitError("holds a line that draws nothing; choose other signs")
    return union(pieces)


def _push(before: Region, after: Region) -> float:
    """Distance by which ``after`` must go right to be clear of ``before``."""
    push, widest = 0.0, before.bounds[2] - after.bounds[0] + LETTER_GAP
    shapely.prepare(before)
    if not shapely.dwithin(before, after, LETTER_GAP):
        return push
    if len(shapely.get_coordinates([before, after])) > FEW_POINTS:
        before, after = _facing(before, after)
    lack = LETTER_GAP - float(shapely.distance(before, after))
    # A step right widens the gap by no more than itself, so no step goes too far.
    while lack > 1e-3 * LETTER_GAP and push < widest:
        push += lack
        lack = LETTER_GAP - float(shapely.distance(before, affinity.translate(after, push)))
    return push


def _facing(before: Region, after: Region) -> tuple[Region, Region]:
    """Parts of two regions beside each other that can be nearer than ``LETTER_GAP``."""
    left, right = after.bounds[0] - LETTER_GAP, before.bounds[2] + LETTER_GAP
    low, high = min(before.bounds[1], after.bounds[1]), max(before.bounds[3], after.bounds[3])
    parts = shapely.clip_by_rect([before, after], left, low - 1, right, high + 1)
    return parts[0], parts[1]


def _is_unseen(character: str) -> bool:
    """Whether a character only steers the text, as marks of direction do; joiners stay."""
    return unicodedata.category(character) == "Cf" and character not in _JOINERS
