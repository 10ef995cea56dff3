"""Glyphs as HarfBuzz draws them against those of fontTools."""

from __future__ import annotations

import numpy as np
import pytest
from fontTools.pens.recordingPen import DecomposingRecordingPen
from fontTools.ttLib import TTFont

from packwork.fonts import bundled_file
from packwork.readers.fonts.face import bundled_typeface
from packwork.readers.fonts.glyph_ink import rings_of

TEXT = "SIGaqgfjß&8%ÄçΩЖ@ế"
TOLERANCE = 1e-6
"""Of an em."""


def test_curves_are_those_that_fonttools_draws() -> None:
    font, face = TTFont(bundled_file()), bundled_typeface()
    glyphs, names = font.getGlyphSet(), font.getBestCmap()
    for character in TEXT:
        pen = DecomposingRecordingPen(glyphs)
        glyphs[names[ord(character)]].draw(pen)
        theirs = np.array([point for _, points in pen.value for point in points])
        drawn = face.drawing(font.getGlyphID(names[ord(character)]))
        ours = np.concatenate([np.reshape(numbers, (-1, 2)) for _, numbers in drawn]) * (1.0, -1.0)
        apart = np.abs(ours[:, None] - theirs[None]).max(axis=2)
        assert apart.min(axis=0).max() <= TOLERANCE * face.units
        assert apart.min(axis=1).max() <= TOLERANCE * face.units


@pytest.mark.parametrize("letter", ["Q", "C"])
def test_rings_follow_curves_to_the_tolerance(letter: str) -> None:
    handles = (0.0, 60.0) if letter == "Q" else (0.0, 40.0, 60.0, 100.0)
    curve = [("M", (0.0, 0.0)), (letter, (*handles, 100.0, 100.0)), ("Z", ())]
    fine, coarse = (rings_of(curve, tolerance)[0] for tolerance in (0.01, 1.0))
    assert len(coarse) < len(fine)
    heights = np.interp(coarse[:, 0], fine[:, 0], fine[:, 1])
    assert np.abs(heights - coarse[:, 1]).max() < 1.0
