"""Words put together from glyphs that stand clear of each other, without any set operation.

Letters recur: what one covers is found once for each font. Where no two come near each other, a
word's rings are those of its letters, moved to their places.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely

from packwork.arrays import FloatArray
from packwork.geometry.affine import similarity
from packwork.geometry.distance import distance
from packwork.geometry.outline import Outline, joined
from packwork.geometry.polygon import Region, region, silhouette
from packwork.readers.fonts.curves import rings_of
from packwork.readers.fonts.face import Typeface
from packwork.readers.fonts.guard import check_glyph
from packwork.readers.fonts.remembered import remembered_by_font

MOST_KNOWN = 4096
"""Glyphs that are remembered: those of a long Chinese text. Chosen."""


@dataclass(frozen=True, eq=False)
class GlyphInk:
    """What a glyph covers about its origin, in its font's units.

    Parameters
    ----------
    region
        The same as a region; empty for a space.
    ink, silhouette
        Its rings, and those of its silhouette, without holes; None for a space.
    clearance
        By how much a vertex may move before rings meet.
    """

    region: Region
    ink: Outline | None
    silhouette: Outline | None
    clearance: float


@dataclass(frozen=True, eq=False)
class ClearInk:
    """What glyphs cover that stand clear of each other.

    Parameters
    ----------
    ink, silhouette
        Rings, with holes and without.
    clearance
        Smallest distance of two glyphs, or clearance of one, as a share of the extent; at least.
    """

    ink: Outline
    silhouette: Outline
    clearance: float


@remembered_by_font(MOST_KNOWN)
def glyph_ends(face: Typeface, number: int) -> tuple[float, ...]:
    """Leftmost and rightmost of a glyph's curves and handles; none of a space."""
    across = [x for _, values in face.drawing(number) for x in values[::2]]
    return (min(across), max(across)) if across else ()


@remembered_by_font(MOST_KNOWN)
def glyph_ink(face: Typeface, number: int, tolerance: float) -> GlyphInk:
    """What a glyph covers, its curves followed to ``tolerance``.

    Raises
    ------
    UnfitError
        If the glyph is damaged.

    Examples
    --------
    >>> from packwork.readers.fonts.face import bundled_typeface
    >>> face = bundled_typeface()
    >>> [glyph] = face.shaped("o").glyphs
    >>> found = glyph_ink(face, glyph.number, 1.0)
    >>> len(found.ink.rings), len(found.silhouette.rings)
    (2, 1)
    """
    rings = rings_of(face.drawing(number), tolerance)
    check_glyph(rings)
    covered = region(rings, "nonzero")
    if not covered.area > 0:
        return GlyphInk(covered, None, None, np.inf)
    filled = Outline.from_region(silhouette(covered))
    clearance = float(shapely.minimum_clearance(covered))
    return GlyphInk(covered, Outline.from_region(covered), filled, clearance)


def clear_ink(glyphs: Sequence[GlyphInk], places: FloatArray, sizes: FloatArray) -> ClearInk | None:
    """Glyphs at their places as one; None where some are not simple, or meet.

    Parameters
    ----------
    places
        ``(n, 2)`` of their origins.
    sizes
        ``(n,)`` factors on their own units.
    """
    maps = [
        similarity(place[0], place[1], 0.0, size) for place, size in zip(places, sizes, strict=True)
    ]
    drawn = list(zip(glyphs, maps, strict=True))
    inks = [glyph.ink.mapped(one) for glyph, one in drawn if glyph.ink is not None]
    filled = [glyph.silhouette.mapped(one) for glyph, one in drawn if glyph.silhouette is not None]
    if not inks:
        return None
    least = min(float(glyph.clearance * size) for glyph, size in zip(glyphs, sizes, strict=True))
    boxes = np.array([ink.bounds for ink in inks])
    extent = float(np.max(boxes[:, 2:].max(axis=0) - boxes[:, :2].min(axis=0)))
    for k, ink in enumerate(inks):
        low = np.maximum(boxes[k + 1 :, :2], boxes[k, :2])
        high = np.minimum(boxes[k + 1 :, 2:], boxes[k, 2:])
        # Boxes that are farther apart than that tell no more.
        for other in np.flatnonzero((low - high < least).all(axis=1)) + k + 1:
            if _is_within(boxes[k], boxes[other]) or _is_within(boxes[other], boxes[k]):
                return None
            least = min(least, distance(ink.region, inks[other].region))
    if not least > 0:
        return None
    return ClearInk(Outline(*joined(inks)), Outline(*joined(filled)), least / extent)


def _is_within(inner: FloatArray, outer: FloatArray) -> bool:
    """Whether a box lies in another: a glyph might lie in another's hole."""
    return bool((inner[:2] >= outer[:2]).all() and (inner[2:] <= outer[2:]).all())
