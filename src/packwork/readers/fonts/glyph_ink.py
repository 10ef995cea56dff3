"""Curves of glyphs as rings, and words put together from glyphs that stand clear of each other.

Letters recur: what one covers is found once for each font. Where no two come near each other, a
word's rings are those of its letters, moved to their places.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TypeAlias

import numpy as np
import shapely

from packwork.arrays import FloatArray
from packwork.geometry.affine import similarity
from packwork.geometry.bezier import flatten_cubics
from packwork.geometry.distance import clearance, distance
from packwork.geometry.outline import Outline, joined
from packwork.geometry.polygon import region, silhouette
from packwork.readers.cache import GlyphInk, cached_by_identity, kept_glyph
from packwork.readers.fonts.face import Segment, Typeface, check_glyph
from packwork.readers.fonts.itemise import MOST_KNOWN


def rings_of(segments: Sequence[Segment], tolerance: float) -> list[FloatArray]:
    """Contours as rings whose chords lie within ``tolerance`` of the curves.

    >>> rings_of([("M", (0.0, 0.0)), ("L", (2.0, 0.0)), ("L", (2.0, 1.0)), ("Z", ())], 0.1)
    [array([[0., 0.],
           [2., 0.],
           [2., 1.]])]
    """
    begins, controls = list[int](), list[tuple[float, ...]]()
    x = y = 0.0
    for letter, numbers in segments:
        if letter == "M":
            begins.append(len(controls))
        if letter in {"M", "L"}:
            x, y = numbers
            controls.append((x, y) * 4)
        elif letter == "Q":
            a, b, end_x, end_y = numbers
            handles = (x + 2 * a) / 3, (y + 2 * b) / 3, (end_x + 2 * a) / 3, (end_y + 2 * b) / 3
            controls.append((x, y, *handles, end_x, end_y))
            x, y = end_x, end_y
        elif letter == "C":
            controls.append((x, y, *numbers))
            x, y = numbers[4:]
    if not controls:
        return []
    points, counts = flatten_cubics(np.array(controls).reshape(-1, 4, 2), tolerance)
    return np.split(points, (np.cumsum(counts) - counts)[begins[1:]])


CLEAR = 1e-3
"""Clearance, as a share of a glyph's extent, that is enough: more is not looked for. Chosen: fifty
times what readers follow curves to."""


@dataclass(frozen=True, eq=False)
class ClearInk:
    """Regions of glyphs that stand clear of each other.

    ``places`` ``(n, 2)`` are their origins, ``sizes`` ``(n, 1)`` factors on their own units;
    ``clearance`` is the smallest distance of two, or clearance of one, as a share of the extent.
    """

    glyphs: Sequence[GlyphInk]
    places: FloatArray
    sizes: FloatArray
    clearance: float

    @property
    def ink(self) -> Outline:
        """Rings, with holes; made anew each time, since words are remembered by the thousand."""
        return self._moved([glyph.ink for glyph in self.glyphs if glyph.ink is not None])

    @property
    def silhouette(self) -> Outline:
        """Rings, without holes; as above."""
        return self._moved(
            [glyph.silhouette for glyph in self.glyphs if glyph.silhouette is not None]
        )

    def _moved(self, outlines: Sequence[Outline]) -> Outline:
        """Outlines of the glyphs at their places, as one."""
        points, starts = joined(outlines)
        counts = [len(outline.points) for outline in outlines]
        sizes = np.repeat(self.sizes, counts, axis=0)
        return Outline(points * sizes + np.repeat(self.places, counts, axis=0), starts)


Box: TypeAlias = tuple[float, float, float, float]
"""Left, top, right and bottom."""


@dataclass(frozen=True, eq=False)
class GlyphPath:
    """A glyph's curves about its origin, in its font's units.

    ``template`` is SVG path data with a place for each number of ``points`` ``(n, 2)``.
    """

    template: str
    points: FloatArray

    @cached_property
    def box(self) -> Box | None:
        """Left, top, right and bottom; None of a space."""
        if len(self.points) == 0:
            return None
        (left, top), (right, bottom) = self.points.min(axis=0), self.points.max(axis=0)
        return float(left), float(top), float(right), float(bottom)

    def moved(self, x: float, y: float, size: float) -> str:
        """SVG path data with the origin at a place, as exact as the numbers are.

        >>> GlyphPath("M{:.10g} {:.10g}Z", np.array([[1.0, -2.5]])).moved(1.0, 1.0, 2.0)
        'M3-4Z'
        """
        moved = self.points * size + (x, y)
        return self.template.format(*moved.ravel().tolist()).replace(" -", "-")


@cached_by_identity(MOST_KNOWN, lambda path: len(path.points))
def glyph_path(face: Typeface, number: int) -> GlyphPath:
    """Curves of a glyph."""
    segments = face.drawing(number)
    values = [value for _, numbers in segments for value in numbers]
    pieces = [letter + " ".join(["{:.10g}"] * len(numbers)) for letter, numbers in segments]
    return GlyphPath("".join(pieces), np.array(values, dtype=np.float64).reshape(-1, 2))


@cached_by_identity(MOST_KNOWN, lambda glyph: 3 * shapely.get_num_coordinates(glyph.region))
def glyph_ink(face: Typeface, number: int, tolerance: float) -> GlyphInk:
    """Region of a glyph, its curves followed to ``tolerance``.

    >>> from packwork.readers.fonts.face import bundled_typeface
    >>> face = bundled_typeface()
    >>> [glyph] = face.shaped("o").glyphs
    >>> found = glyph_ink(face, glyph.number, 1.0)
    >>> len(found.ink.rings), len(found.silhouette.rings)
    (2, 1)
    """
    return kept_glyph((face.identity, number, tolerance), lambda: _drawn(face, number, tolerance))


def _drawn(face: Typeface, number: int, tolerance: float) -> GlyphInk:
    rings = rings_of(face.drawing(number), tolerance)
    check_glyph(rings)
    covered = region(rings, "nonzero")
    if not covered.area > 0:
        return GlyphInk(covered, None, None, np.inf)
    filled = Outline.from_region(silhouette(covered))
    ink = Outline.from_region(covered)
    return GlyphInk(covered, ink, filled, clearance(covered, CLEAR * ink.extent))


def clear_ink(glyphs: Sequence[GlyphInk], places: FloatArray, sizes: FloatArray) -> ClearInk | None:
    """Glyphs with origins ``(n, 2)`` and factors ``(n,)`` as one; None if they meet."""
    drawn = [k for k, glyph in enumerate(glyphs) if glyph.ink is not None]
    if not drawn:
        return None
    # Sizes and places as one column for each corner of a box, one row for each glyph.
    size, place = sizes[drawn, None], places[drawn]
    inks = [glyph.ink for glyph in glyphs if glyph.ink is not None]
    boxes = np.array([ink.bounds for ink in inks]) * size + np.tile(place, 2)
    extent = float(np.max(boxes[:, 2:].max(axis=0) - boxes[:, :2].min(axis=0)))
    least = float(np.min([glyphs[k].clearance for k in drawn] * sizes[drawn]))
    low = np.maximum(boxes[:, None, :2], boxes[None, :, :2])
    high = np.minimum(boxes[:, None, 2:], boxes[None, :, 2:])
    # Boxes that are farther apart than that tell no more.
    near = (low - high < least).all(axis=2)
    for k, other in np.argwhere(np.triu(near, 1)):
        if _is_within(boxes[k], boxes[other]) or _is_within(boxes[other], boxes[k]):
            return None
        one, two = (
            inks[m].mapped(similarity(place[m, 0], place[m, 1], 0.0, size[m, 0])).region
            for m in (k, other)
        )
        least = min(least, distance(one, two))
        # In scripts that join letters the first two meet already.
        if not least > 0:
            return None
    if not least > 0:
        return None
    return ClearInk([glyphs[k] for k in drawn], place, size, least / extent)


def _is_within(inner: FloatArray, outer: FloatArray) -> bool:
    """Whether a box lies in another: a glyph might lie in another's hole."""
    return bool((inner[:2] >= outer[:2]).all() and (inner[2:] <= outer[2:]).all())
