"""Scripts as their readers expect them: our outlines against another renderer's pictures.

The fonts beside this file are cut down to these words.
"""

from __future__ import annotations

from importlib import resources
from pathlib import Path

import numpy as np
import pytest
from PIL import Image, ImageDraw, ImageFont, features

from packwork.geometry.outline import Outline
from packwork.raster.coverage import coverage
from packwork.readers.fonts.face import Typeface
from packwork.readers.fonts.fallback import Fonts

FONTS = Path(__file__).parent
INTER = Path(str(resources.files("packwork.bundled").joinpath("fonts/InterDisplay-Black.otf")))
EM_PX = 200
LEAST_LIKENESS = 0.95
"""The other renderer rounds advances to whole pixels; a wrong form gives less than 0.8."""

needs_raqm = pytest.mark.skipif(not features.check("raqm"), reason="Pillow without raqm")

WORDS = [
    pytest.param(INTER, "office", id="latin"),
    pytest.param(INTER, "Ångström", id="accents"),
    pytest.param(INTER, "e\u0301te\u0301", id="combining"),
    pytest.param(INTER, "Вкус", id="cyrillic"),
    pytest.param(INTER, "μέλι", id="greek"),
    pytest.param(FONTS / "NotoNaskhArabic.ttf", "العربية", id="arabic"),
    pytest.param(FONTS / "NotoNaskhArabic.ttf", "محبة", id="arabic-joined"),
    pytest.param(FONTS / "NotoSansHebrew.ttf", "שלום", id="hebrew"),
    pytest.param(FONTS / "NotoSansDevanagari.ttf", "हिन्दी", id="devanagari"),
    pytest.param(FONTS / "NotoSansDevanagari.ttf", "क्षत्रिय", id="conjuncts"),
    pytest.param(FONTS / "NotoSansThai.ttf", "น้ำ", id="thai"),
    pytest.param(FONTS / "NotoSansSC.otf", "汉语世界", id="chinese"),
    pytest.param(FONTS / "NotoSansSC.otf", "日本語", id="japanese"),
]


def ours(font: Path, word: str) -> np.ndarray:
    drawn = Fonts([Typeface(font.read_bytes(), font.name)]).lettering([word])
    outline = Outline.from_region(drawn.region)
    points = (outline.points - outline.points.min(axis=0)) * EM_PX + 2
    width, height = np.ceil(points.max(axis=0)).astype(int) + 2
    return coverage(points, outline.starts, (int(height), int(width))).astype(float)


def theirs(font: Path, word: str) -> np.ndarray:
    face = ImageFont.truetype(str(font), EM_PX, layout_engine=ImageFont.Layout.RAQM)
    image = Image.new("L", (8 * EM_PX, 4 * EM_PX))
    ImageDraw.Draw(image).text((EM_PX, EM_PX), word, font=face, fill=255)
    return np.asarray(image.crop(image.getbbox())) / 255.0


def likeness(first: np.ndarray, second: np.ndarray) -> float:
    """Intersection over union at the best shift of a few pixels."""
    shape = np.maximum(first.shape, second.shape) + 8
    base = np.zeros(shape)
    base[4 : 4 + first.shape[0], 4 : 4 + first.shape[1]] = first
    best = 0.0
    for down in range(9):
        for right in range(9):
            other = np.zeros(shape)
            rows, columns = second.shape
            if down + rows > shape[0] or right + columns > shape[1]:
                continue
            other[down : down + rows, right : right + columns] = second
            best = max(best, float(np.minimum(base, other).sum() / np.maximum(base, other).sum()))
    return best


@needs_raqm
@pytest.mark.parametrize(("font", "word"), WORDS)
def test_words_look_as_another_renderer_shows_them(font: Path, word: str) -> None:
    assert likeness(ours(font, word), theirs(font, word)) > LEAST_LIKENESS


@needs_raqm
def test_the_comparison_tells_joined_letters_from_isolated_ones() -> None:
    font = FONTS / "NotoNaskhArabic.ttf"
    assert likeness(ours(font, "محبة"), theirs(font, "محبة"[::-1])) < LEAST_LIKENESS - 0.15
