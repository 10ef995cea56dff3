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
from packwork.readers.fonts.glyph_ink import Box, GlyphPath, glyph_ink, glyph_path
from packwork.readers.fonts.lettering import (
    Curves,
    FontRun,
    Lettering,
    TypeSetting,
    box_of,
    line_of_runs,
    tolerance_of,
)
from packwork.readers.reading import UnfitError
from packwork.scene.item import TextRun


def bent_lettering(
    line: Sequence[TypeSetting],
    curve: Curve,
    start: float,
    end: float,
    language: str = UNKNOWN_LANGUAGE,
) -> Lettering:
    """A line the middle of whose ink runs along a curve, in ems, from one arc length to another.

    Letters stand apart as the font has them, and farther where the stretch is longer. Each is a run
    of text; it is no text where a letter by itself is another one than in its word.

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
    letters = [letter for run in runs for letter in _letters(run)]
    if not letters:
        raise UnfitError("has no outlines to draw it with")
    low, high = np.array(_box(letters)).reshape(2, 2)
    tolerance = tolerance_of([box for letter in letters for box in letter.boxes()])
    stretch = (end - start) / (high[0] - low[0])
    paths, regions, texts = list[GlyphPath](), list[Region](), list[TextRun | None]()
    for letter in letters:
        left, _, right, _ = _box([letter])
        middle = np.array([(left + right) / 2, (low[1] + high[1]) / 2])
        along = start + (middle[0] - low[0]) * stretch
        angle = float(curve.angle(along, (high[1] - low[1]) / units / 2))
        x, y = (curve.at(along) * units).tolist()
        put = affine.compose(
            affine.similarity(x, y, angle, 1.0),
            affine.similarity(-float(middle[0]), -float(middle[1]), 0.0, 1.0),
        )
        texts.append(_text(letter, put, angle, language))
        for glyph, place in zip(letter.glyphs, letter.places(), strict=True):
            own = affine.compose(put, affine.similarity(*place, 0.0, letter.scale))
            path = glyph_path(letter.face, glyph.number)
            paths.append(GlyphPath(path.template, affine.apply(own, path.points)))
            ink = glyph_ink(letter.face, glyph.number, tolerance / letter.scale).region
            regions.append(affinity.affine_transform(ink, [*own[:, :2].ravel(), *own[:, 2]]))
    whole = affinity.scale(united(regions), 1 / units, 1 / units, origin=(0, 0))
    curves = Curves(tuple((path, (0.0, 0.0), 1.0) for path in paths))
    read = tuple(text for text in texts if text is not None)
    return Lettering(whole, curves, units, read if len(read) == len(texts) else ())


def _letters(run: FontRun) -> list[FontRun]:
    """Letters of a run as they are read, each with its marks and the spaces after it."""
    found: dict[int, list[Glyph]] = {}
    for glyph in run.glyphs:
        found.setdefault(glyph.cluster, []).append(glyph)
    all_letters = (replace(run, glyphs=tuple(found[cluster])) for cluster in sorted(found))
    drawn = [letter for letter in all_letters if letter.boxes()]
    ends = [*(letter.glyphs[0].cluster for letter in drawn[1:]), len(run.piece.text)]
    return [
        replace(
            letter,
            piece=replace(run.piece, text=run.piece.text[letter.glyphs[0].cluster : end]),
        )
        for letter, end in zip(drawn, ends, strict=True)
    ]


def _text(letter: FontRun, put: FloatArray, angle: float, language: str) -> TextRun | None:
    """A letter as text that a document sets by itself; None where that is drawn otherwise.

    So are joined letters, and in browsers turned ones of scripts that run leftward.
    """
    alone = letter.face.shaped(letter.piece.text, language=language)
    drawn = [glyph for glyph in alone.glyphs if len(glyph_path(letter.face, glyph.number).points)]
    is_same = [one.number for one in letter.glyphs] == [one.number for one in drawn]
    if letter.piece.is_leftward or not is_same:
        return None
    off = np.array([[a.x - b.x, a.y - b.y] for a, b in zip(letter.glyphs, drawn, strict=True)])
    if np.ptp(off, axis=0).any():
        return None
    own = replace(letter, glyphs=alone.glyphs, advance=alone.advance).text
    [(x, y)] = affine.apply(put, off[:1] * letter.scale + [letter.x, letter.y]).tolist()
    return replace(own, x=x, y=y, angle=angle)


def _box(letters: Sequence[FontRun]) -> Box:
    """Box about the curves of letters."""
    return box_of([box for letter in letters for box in letter.boxes()])
