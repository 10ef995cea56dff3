"""Words bent along curves: each letter is put by a rigid motion at its arc length."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from shapely import affinity

from packwork.arrays import FloatArray
from packwork.geometry import affine
from packwork.geometry.curves import Curve
from packwork.geometry.polygon import Region, united
from packwork.readers.fonts.face import UNKNOWN_LANGUAGE, Glyph
from packwork.readers.fonts.glyph_ink import GlyphPath, glyph_ink, glyph_path
from packwork.readers.fonts.lettering import (
    Curves,
    GlyphRun,
    Lettering,
    TypeSetting,
    line_of_runs,
    tolerance_of,
)
from packwork.readers.reading import UnfitError


def bent_lettering(
    line: Sequence[TypeSetting],
    curve: Curve,
    start: float,
    end: float,
    language: str = UNKNOWN_LANGUAGE,
) -> Lettering:
    """A line the middle of whose ink runs along a curve, in ems, from one arc length to another.

    Letters stand apart as the font has them, and farther where the stretch is longer. It is no
    text: no document could set it so.

    >>> from packwork.readers.fonts.face import bundled_typeface
    >>> from packwork.readers.fonts.itemise import Piece
    >>> down = Curve(np.array([[0.0, 0.0], [0.0, 9.0]]))
    >>> word = bent_lettering([TypeSetting(Piece("ox"), bundled_typeface())], down, 1.0, 3.0)
    >>> [round(end, 1) for end in word.region.bounds[1::2]]
    [1.2, 2.8]
    """
    units = line[0].face.units
    runs = line_of_runs(line, 0, units, language)
    if any(run.pictures() for run in runs):
        raise UnfitError("has pictures for letters, which cannot be bent")
    letters = [letter for run in runs for letter in _letters(run) if letter.boxes()]
    if not letters:
        raise UnfitError("has no outlines to draw it with")
    low, high = _box(letters)
    tolerance = tolerance_of([box for letter in letters for box in letter.boxes()])
    stretch = (end - start) / (high[0] - low[0])
    paths, regions = list[GlyphPath](), list[Region]()
    for letter in letters:
        left, right = (corner[0] for corner in _box([letter]))
        middle = np.array([(left + right) / 2, (low[1] + high[1]) / 2])
        along = start + (middle[0] - low[0]) * stretch
        angle = float(curve.angle(along, (high[1] - low[1]) / units / 2))
        x, y = (curve.at(along) * units).tolist()
        put = affine.compose(
            affine.similarity(x, y, angle, 1.0),
            affine.similarity(-float(middle[0]), -float(middle[1]), 0.0, 1.0),
        )
        for glyph, place in zip(letter.glyphs, letter.places(), strict=True):
            own = affine.compose(put, affine.similarity(*place, 0.0, letter.scale))
            path = glyph_path(letter.face, glyph.number)
            paths.append(GlyphPath(path.template, affine.apply(own, path.points)))
            ink = glyph_ink(letter.face, glyph.number, tolerance / letter.scale).region
            regions.append(affinity.affine_transform(ink, [*own[:, :2].ravel(), *own[:, 2]]))
    whole = affinity.scale(united(regions), 1 / units, 1 / units, origin=(0, 0))
    return Lettering(whole, Curves(tuple((path, (0.0, 0.0), 1.0) for path in paths)), units)


def _letters(run: GlyphRun) -> list[GlyphRun]:
    """Letters of a run, each with its marks."""
    found: dict[int, list[Glyph]] = {}
    for glyph in run.glyphs:
        found.setdefault(glyph.cluster, []).append(glyph)
    return [replace(run, glyphs=tuple(several)) for several in found.values()]


def _box(letters: Sequence[GlyphRun]) -> FloatArray:
    """``(2, 2)`` least and largest x, y of the curves of letters."""
    boxes = np.array([box for letter in letters for box in letter.boxes()])
    return np.array([boxes[:, 0].min(axis=0), boxes[:, 1].max(axis=0)])
