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
from packwork.readers.words.shaping import shaped_word
from packwork.readers.words.word import Word
from packwork.wordcloud import WordCloud
from packwork.wordcloud.engine import COARSEST, DrawnWord

Corners = list[tuple[float, float]]
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


def ring_of(x: float, y: float, side: float, turn: int) -> Corners:
    return [(x, y), (x + side, y), (x + side, y + side), (x, y + side)][::turn]


ARCH = [(0.0, 0.0), (700.0, 0.0), (700.0, 100.0), (100.0, 100.0), (100.0, 600.0), (700.0, 600.0),
        (700.0, 700.0), (0.0, 700.0)]  # fmt: skip
STROKES = {
    "beside": [ring_of(0, 0, 200, 1), ring_of(300, 0, 100, -1)],
    "in a bay": [ARCH, ring_of(300, 250, 200, -1)],
    "on the rim": [ring_of(0, 0, 700, 1), ring_of(600, 300, 200, -1)],
    "in a hole": [ring_of(0, 0, 700, 1), ring_of(100, 100, 500, -1), ring_of(200, 200, 300, -1)],
    "holes that meet": [ring_of(0, 0, 700, 1), ring_of(100, 0, 300, -1), ring_of(300, 0, 300, -1)],
    "one that crosses itself": [[(0.0, 0.0), (700.0, 600.0), (700.0, 0.0), (0.0, 700.0)]],
    "a plain hole": [ring_of(0, 0, 700, 1), ring_of(100, 100, 500, -1)],
    "rings in holes": [ring_of(0, 0, 700, 1), ring_of(100, 100, 500, -1), ring_of(200, 200, 300, 1),
                       ring_of(300, 300, 100, -1)],
}  # fmt: skip


class _Crossed(Typeface):
    """A face whose letters are all of these strokes."""

    def __init__(self, kind: str) -> None:
        self.__dict__ = {**bundled_typeface().__dict__, "_known": {}}
        self.kind = kind

    @property
    def identity(self) -> str:  # type: ignore[override]
        return f"crossed {self.kind}"

    def drawing(self, number: int):  # type: ignore[no-untyped-def]
        return tuple(
            segment
            for first, *others in STROKES[self.kind]
            for segment in (("M", first), *(("L", corner) for corner in others), ("Z", ()))
        )


@pytest.mark.parametrize("kind", STROKES)
def test_strokes_either_way_round_are_ink_alike(kind: str) -> None:
    found = glyph_rings(_Crossed(kind), 1, 1.0)
    assert found is not None
    rings = [np.array(ring) for ring in STROKES[kind]]
    # On pixels a ring takes away what it goes round the other way.
    assert found.area == pytest.approx(region(rings, "nonzero").area)
    assert covered(found).equals(region(rings, "nonzero"))
