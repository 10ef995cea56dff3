"""Words put together from glyphs cover what the union of their glyphs covers."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor

import pytest

from packwork.geometry.outline import Outline, centre_of_area
from packwork.readers.fonts import lettering
from packwork.readers.fonts.face import bundled_typeface
from packwork.readers.fonts.fallback import open_fonts
from packwork.readers.fonts.glyph_ink import ClearInk
from packwork.readers.words.shaping import word_item
from packwork.readers.words.word import Word
from packwork.scene.item import Item


def item_of(text: str) -> Item:
    return word_item(Word(text, 1.0), open_fonts([]))


def differing_share(one: Outline, other: Outline) -> float:
    return float(one.region.symmetric_difference(other.region).area) / one.area


@pytest.mark.parametrize(
    "text", ["honey", "AVATAR", "W.A.Y.", "ÅÄÖ", "®", "(a) i", '"÷"', "Ельцин"]
)
def test_a_word_of_clear_glyphs_is_their_union(text: str, monkeypatch: pytest.MonkeyPatch) -> None:
    quick = item_of(text)
    monkeypatch.setattr(lettering, "clear_ink", lambda *_: None)
    monkeypatch.setattr(lettering, "_lettering_by", lettering._lettering_by.__wrapped__)
    slow = item_of(text)
    assert differing_share(quick.outline, slow.outline) < 1e-12
    assert differing_share(quick.ink, slow.ink) < 1e-12
    assert len(quick.outline.rings) == len(slow.outline.rings)


def test_glyphs_that_stand_apart_need_no_union() -> None:
    fonts = open_fonts([])
    assert isinstance(fonts.lettering(["honey"]).covered, ClearInk)


def test_marks_that_touch_a_letter_do() -> None:
    drawn = open_fonts([]).lettering(["Ç̦ a"])
    assert not isinstance(drawn.covered, ClearInk) or drawn.covered.clearance > 0
    assert drawn.region.is_valid


def test_the_centre_is_that_of_the_region() -> None:
    outline = item_of("Tolkien").outline
    assert centre_of_area(outline) == pytest.approx(outline.centroid, abs=1e-9 * outline.extent)


def test_words_are_remembered_by_what_the_font_holds() -> None:
    first, again = (open_fonts([]).lettering(["honey"]) for _ in range(2))
    assert again.covered is first.covered
    other = open_fonts([]).lettering(["honeys"])
    assert other.covered is not first.covered


def test_threads_that_share_a_face_get_their_own_words() -> None:
    face = bundled_typeface()
    texts = [letter * n for n, letter in enumerate("abcdefgh", start=1)]
    expected = {text: face.shaped(text) for text in texts}
    with ThreadPoolExecutor(8) as pool:
        found = list(pool.map(lambda text: (text, face.shaped(text)), texts * 200))
    assert all(shaped == expected[text] for text, shaped in found)
