"""Shaped words to regions and to paths."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from shapely import affinity

from packwork.arrays import FloatArray
from packwork.geometry.bezier import flatten_cubic
from packwork.geometry.polygon import Region, region, united
from packwork.readers.svg.follow import FLATTENING
from packwork.readers.typeface.face import Glyph, Segment, Typeface, points_of
from packwork.readers.unfit import UnfitError

LINE_STEP = 1.0
"""Distance of the base lines of a word of several lines, in ems. Chosen."""

MOST_KNOWN = 4096
"""Glyphs whose regions are remembered: those of a long Chinese text. Chosen."""

_MARGIN = 0.5
"""Share of the allowed flattening that glyphs use up; the rest is rounding."""


@dataclass(frozen=True, eq=False)
class Lettering:
    """A word as a font draws it, in ems, y down, the first base line at 0.

    Parameters
    ----------
    region
        What it covers, with holes and parts.
    path
        SVG path data of its curves, in the font's units; contours may overlap, non-zero.
    units
        The font's units in one em.
    """

    region: Region
    path: str
    units: float


def lettering(lines: Sequence[str], face: Typeface) -> Lettering | None:
    """Word of one or several centred lines; None if the font lacks one of its characters.

    Curves are followed to ``FLATTENING`` of the word's extent.

    Raises
    ------
    UnfitError
        If it draws nothing, or one of its glyphs is damaged.

    Examples
    --------
    >>> from packwork.readers.typeface.face import bundled_typeface
    >>> word = lettering(["ox"], bundled_typeface())
    >>> len(word.region.geoms), word.path[:1]
    (2, 'M')
    """
    shaped = [face.shaped(line) for line in lines]
    if any(glyph.number == 0 for line in shaped for glyph in line):
        return None
    placed = [glyph for k, line in enumerate(shaped) for glyph in _line(line, k, face)]
    contours = [_moved(face.drawing(glyph.number), glyph) for glyph in placed]
    points = [points_of(s) for contour in contours for s in contour if s[0] != "Z"]
    if not points:
        raise UnfitError("has no outlines to draw it with")
    extent = float(np.ptp(np.concatenate(points), axis=0).max())
    # Words of about one length share their glyphs.
    tolerance = _MARGIN * FLATTENING * 2.0 ** math.floor(math.log2(extent))
    covered = [
        affinity.translate(_glyph_region(face, glyph.number, tolerance), glyph.x, glyph.y)
        for glyph in placed
    ]
    whole = united(covered)
    em = 1 / face.units
    return Lettering(
        affinity.scale(whole, em, em, origin=(0, 0)),
        "".join(path_data(contour) for contour in contours),
        face.units,
    )


def path_data(segments: Sequence[Segment]) -> str:
    """SVG path data of segments, as exact as they are.

    Examples
    --------
    >>> path_data([("M", (0.0, -1.5)), ("L", (2.0, 1.0)), ("Z", ())])
    'M0-1.5L2 1Z'
    """
    pieces = []
    for letter, values in segments:
        numbers = " ".join(f"{value:.10g}" for value in values)
        pieces.append(letter + numbers.replace(" -", "-"))
    return "".join(pieces)


def _line(glyphs: Sequence[Glyph], number: int, face: Typeface) -> list[Glyph]:
    """Glyphs of one line, centred about 0 if there are several lines."""
    points = [points_of(s)[:, 0] + g.x for g in glyphs for s in face.drawing(g.number) if s[1]]
    middle = 0.0
    if points:
        across = np.concatenate(points)
        middle = float(np.round((across.min() + across.max()) / 2))
    down = number * LINE_STEP * face.units
    return [Glyph(g.number, g.x - middle, g.y + down) for g in glyphs]


def _moved(segments: Sequence[Segment], glyph: Glyph) -> list[Segment]:
    steps = (glyph.x, glyph.y)
    return [
        (letter, tuple(value + steps[k % 2] for k, value in enumerate(values)))
        for letter, values in segments
    ]


@lru_cache(maxsize=MOST_KNOWN)
def _glyph_region(face: Typeface, number: int, tolerance: float) -> Region:
    """What a glyph covers about its origin, its curves followed to ``tolerance``."""
    return region(_rings(face.drawing(number), tolerance), "nonzero")


def _rings(segments: Sequence[Segment], tolerance: float) -> list[FloatArray]:
    """Contours as flattened rings."""
    rings: list[list[FloatArray]] = []
    for segment in segments:
        letter, points = segment[0], points_of(segment)
        if letter == "M":
            rings.append([points])
        elif letter == "L":
            rings[-1].append(points)
        elif letter in {"Q", "C"}:
            start = rings[-1][-1][-1]
            rings[-1].append(flatten_cubic(start, *_cubic(start, points), tolerance))
    return [np.concatenate(ring) for ring in rings]


def _cubic(start: FloatArray, points: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Handles and end of a curve as a cubic's."""
    if len(points) == 3:
        return points[0], points[1], points[2]
    handle, end = points
    return (start + 2 * handle) / 3, (end + 2 * handle) / 3, end
