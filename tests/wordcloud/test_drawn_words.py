"""Words that are only drawn on pixels cover what their unions cover, and lie where these do."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import shapely

from packwork.geometry.outline import Outline
from packwork.geometry.polygon import region
from packwork.readers.fonts.drawn import glyph_rings
from packwork.readers.fonts.face import Typeface, bundled_typeface
from packwork.readers.fonts.fallback import open_fonts
from packwork.readers.words.items import shaped_word
from packwork.readers.words.options import Word
from packwork.wordcloud import WordCloud
from packwork.wordcloud.engine import COARSEST, DrawnWord

FONTS = Path(__file__).parents[1] / "readers" / "fonts"
WORDS = [
    ("", "W.A.Y."), ("", "(a) i®"), ("NotoNaskhArabic.ttf", "العربية"),
    ("NotoSansSC.otf", "世界日本"), ("NotoSansDevanagari.ttf", "हिन्दी"),
]  # fmt: skip


def covered(outline: Outline) -> shapely.Geometry:
    return region(outline.rings, "nonzero")


@pytest.mark.parametrize(("font", "text"), WORDS)
def test_rings_cover_what_the_union_covers(font: str, text: str) -> None:
    fonts, word = open_fonts([str(FONTS / font)] if font else []), Word(text, 1.0)
    drawn, shaped = DrawnWord.of(word, fonts, 1.0), shaped_word(word, fonts, "keep", 1.0, COARSEST)
    off = drawn.place[:, 2] - shaped.place[:, 2]
    whole = Outline(drawn.outline.points - off, drawn.outline.starts)
    difference = covered(whole).symmetric_difference(shaped.ink.region).area
    assert difference < 1e-6 * shaped.ink.area
    # Twice covered at most, never taken away: what is less than the union would be a hole.
    assert whole.area > shaped.ink.area * (1 - 1e-6)


def test_files_have_words_where_the_picture_has_them() -> None:
    cloud = WordCloud(str(FONTS / "NotoNaskhArabic.ttf"), 200, 100, random_state=1)
    cloud.generate_from_frequencies({"العربية": 3, "وثمانين": 2, "قريش": 1})
    poses = cloud.layout.poses
    for k, item in enumerate(cloud.layout.items):
        there = covered(cloud._placed.outlines[k])
        off = there.symmetric_difference(item.ink.mapped(poses.matrix(k)).region)
        assert off.area < 0.01 * there.area


class _Crossed(Typeface):
    """A face whose letters have a stroke that runs the other way beside the main one."""

    def __init__(self) -> None:
        self.__dict__ = {**bundled_typeface().__dict__, "_known": {}}

    @property
    def identity(self) -> str:  # type: ignore[override]
        return "crossed"

    def drawing(self, number: int):  # type: ignore[no-untyped-def]
        def box(x: float, side: float):  # type: ignore[no-untyped-def]
            ring = [(x, 0.0), (x + side, 0.0), (x + side, side), (x, side)]
            return [("M", ring[0]), *(("L", corner) for corner in ring[1:]), ("Z", ())]

        first, second = box(0.0, 200.0), box(300.0, 100.0)
        corners = second[:4][::-1]
        return (*first, ("M", corners[0][1]), *(("L", one[1]) for one in corners[1:]), ("Z", ()))


def test_strokes_either_way_round_are_ink_alike() -> None:
    found = glyph_rings(_Crossed(), 1, 1.0)
    assert found is not None
    assert found.area == pytest.approx(200.0**2 + 100.0**2)
    assert np.all(found.ring_areas > 0)
