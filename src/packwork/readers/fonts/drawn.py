"""Words as rings that may lie over each other: what is only drawn on pixels needs no union."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
import shapely

from packwork.arrays import FloatArray
from packwork.geometry.affine import similarity
from packwork.geometry.outline import Outline, centre_of_area, joined
from packwork.readers.cache import cached_by_identity
from packwork.readers.fonts.face import Typeface, check_glyph, check_points
from packwork.readers.fonts.fallback import Fonts
from packwork.readers.fonts.glyph_ink import glyph_ink, rings_of
from packwork.readers.fonts.itemise import MOST_KNOWN, Piece
from packwork.readers.fonts.lettering import MOST_WORDS, LetteredRuns, TypeSetting


def drawn_outline(
    fonts: Fonts, lines: Sequence[str], em: float, most_coarse: float, size: float
) -> tuple[Outline, FloatArray] | None:
    """Rings of all glyphs about their common centre, and the 2 x 3 map that brought them there.

    An em is ``size`` large. Curves are followed as ``lettering_of`` says. None for what has
    pictures among its glyphs, or no area.

    >>> from packwork.readers.fonts.fallback import open_fonts
    >>> found = drawn_outline(open_fonts([]), ["ox"], 1.0, 1.0, 100.0)
    >>> len(found[0].rings), found[1].shape
    (3, (2, 3))
    """
    settings, asked = fonts.settings(lines), (fonts.asked_language, em, most_coarse, size)
    face, *others = dict.fromkeys(one.face for line in settings for one in line)
    if others:
        return _drawn(settings, *asked)
    return _drawn_by(
        face, face.name, tuple(tuple(one.piece for one in s) for s in settings), *asked
    )


@cached_by_identity(MOST_WORDS, lambda found: 0 if found is None else len(found[0].points))
def _drawn_by(
    face: Typeface, _name: str, lines: tuple[tuple[Piece, ...], ...], *asked: Any
) -> tuple[Outline, FloatArray] | None:
    """Word in one font of that name: programs draw the same words again."""
    return _drawn([[TypeSetting(piece, face) for piece in line] for line in lines], *asked)


def _drawn(
    lines: Sequence[Sequence[TypeSetting]],
    language: str,
    em: float,
    most_coarse: float,
    size: float,
) -> tuple[Outline, FloatArray] | None:
    word = LetteredRuns.of(lines, language, em, most_coarse)
    if word.pictures:
        return None
    outlines, places, sizes = list[Outline](), list[tuple[float, float]](), list[float]()
    for run in word.runs:
        for glyph, place in zip(run.glyphs, run.places(), strict=True):
            rings = glyph_rings(run.face, glyph.number, word.tolerance / run.scale)
            if rings is not None:
                outlines.append(rings)
                places.append(place)
                sizes.append(run.scale)
    if not outlines:
        return None
    counts = [len(outline.points) for outline in outlines]
    check_points(sum(counts), "word")
    points, starts = joined(outlines)
    moved = points * np.repeat(sizes, counts)[:, None] + np.repeat(places, counts, axis=0)
    whole = Outline(moved * (size / word.units), starts)
    x, y = centre_of_area(whole)
    if not (math.isfinite(x) and math.isfinite(y)):
        return None
    return Outline(whole.points - (x, y), starts), similarity(-x, -y, 0.0, 1.0)


@cached_by_identity(MOST_KNOWN, lambda found: 0 if found is None else len(found.points))
def glyph_rings(face: Typeface, number: int, tolerance: float) -> Outline | None:
    """Contours of a glyph about its origin, its curves followed to ``tolerance``; None of a space.

    They may lie over each other; what they go round clockwise is filled once or more often.

    >>> from packwork.readers.fonts.face import bundled_typeface
    >>> face = bundled_typeface()
    >>> [glyph] = face.shaped("o").glyphs
    >>> found = glyph_rings(face, glyph.number, 1.0)
    >>> [float(area) > 0 for area in found.ring_areas]
    [True, False]
    """
    found = _as_drawn(face, number, tolerance)
    if found is None or _is_ink(face, number):
        return found
    # Contours that run either way round are one ink all the same.
    return glyph_ink(face, number, tolerance).ink


def _as_drawn(face: Typeface, number: int, tolerance: float) -> Outline | None:
    """Contours of a glyph, on the whole clockwise."""
    rings = [ring for ring in rings_of(face.drawing(number), tolerance) if len(ring) >= 3]
    if not rings:
        return None
    check_points(sum(map(len, rings)), "glyph")
    found = Outline.from_rings(rings)
    return found if found.area >= 0 else Outline.from_rings([ring[::-1] for ring in rings])


JUDGED = 1e-3
"""Tolerance, as a share of an em, at which it is found out how contours lie. Chosen."""


@cached_by_identity(MOST_KNOWN)
def _is_ink(face: Typeface, number: int) -> bool:
    """Whether contours of a glyph are its ink as they are; asked once for all tolerances."""
    found = _as_drawn(face, number, JUDGED * face.units)
    if found is None:
        return True
    check_glyph(found.rings)
    return _has_holes_only_in_rings(found)


def _has_holes_only_in_rings(outline: Outline) -> bool:
    """Whether nothing is taken away but once of what is filled.

    Of holes that meet, the smallest must lie in as many filled rings as there are holes.
    """
    which = np.repeat(np.arange(len(outline.starts) - 1), np.diff(outline.starts))
    drawn = shapely.polygons(shapely.linearrings(outline.points, indices=which))
    # Of one that crosses itself a part may run the other way.
    if not shapely.is_valid(drawn).all():
        return False
    filled = outline.ring_areas > 0
    if filled.all():
        return True
    holes, sizes = drawn[~filled], -outline.ring_areas[~filled]
    within, _ = shapely.STRtree(drawn[filled]).query(holes, predicate="within")
    one, other = shapely.STRtree(holes).query(holes, predicate="intersects")
    met = one[sizes[other] >= sizes[one]]
    count = len(holes)
    return bool((np.bincount(within, minlength=count) >= np.bincount(met, minlength=count)).all())
