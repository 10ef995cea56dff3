"""Words with weights to items: proportions, fonts, and what cannot be set."""

from __future__ import annotations

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from made_fonts import variable_font
from packwork.errors import ReadError, RecipeError
from packwork.readers.fonts.face import Typeface, bundled_typeface
from packwork.readers.fonts.fallback import open_fonts
from packwork.readers.reading import UnfitError
from packwork.readers.words.items import read_word_items
from packwork.readers.words.options import WordOptions
from packwork.readers.words.shaping import EM_PX, shaped_word, word_item
from packwork.readers.words.word import Word
from packwork.scene.item import bulge_between


def read(source: dict[str, float], **options):
    return read_word_items(WordOptions(source=source, **options))


def heights(weight_is: str) -> np.ndarray:
    """Scales that give the areas asked for, the smallest's as one."""
    found = read({"bear": 4.0, "ox": 1.0}, weight_is=weight_is)
    own = np.array([item.outline.area for item in found.items])
    scales = np.sqrt(found.areas / own)
    return scales / scales[-1]


def test_weights_are_heights_areas_or_ink() -> None:
    assert heights("height")[0] == pytest.approx(4.0)
    assert heights("area")[0] == pytest.approx(2.0)
    areas = read({"bear": 4.0, "ox": 1.0}, weight_is="ink").areas
    assert areas[0] / areas[1] == pytest.approx(4.0)


def test_heights_too_far_apart_are_refused() -> None:
    with pytest.raises(RecipeError, match="1e\\+04 times as high as the smallest"):
        read({"bear": 1e4, "ox": 1.0})
    with pytest.raises(RecipeError, match=r"1\.8e\+308 times as high as the smallest"):
        read({"bear": 1e300, "ox": 1e-300})
    assert len(read({"bear": 1e4, "ox": 1.0}, weight_is="area").items) == 2


def test_the_art_draws_the_ink() -> None:
    item = word_item(Word("ÅQ&8", 1.0), open_fonts([]))
    assert item.art.markup.count("M") == len(item.ink.rings)
    assert item.label.name == "ÅQ&8"


def test_words_of_several_lines_stand_centred_below_each_other() -> None:
    one, two = (word_item(Word(text, 1.0), open_fonts([])) for text in ("oxo", "oxo|oxo"))
    assert two.ink.area == pytest.approx(2 * one.ink.area, rel=1e-6)
    left, top, right, bottom = two.ink.bounds
    assert right - left == pytest.approx(one.ink.bounds[2] - one.ink.bounds[0], rel=1e-6)
    assert bottom - top > EM_PX


@pytest.mark.parametrize(
    ("word", "reason"),
    [
        ("a" * 10_000, "has 10,000 characters"),
        ("\U0001e000\U0001e001", "no font"),
        ("\u200b\u200d", "no outlines"),
    ],
)
def test_words_that_cannot_be_set_are_told_with_the_reason(word: str, reason: str) -> None:
    found = read({"bear": 1.0, word: 1.0})
    assert [item.name for item in found.items] == ["bear"]
    assert reason in next(iter(found.undrawn.values()))


def test_no_word_at_all_is_an_error() -> None:
    with pytest.raises(ReadError, match="cannot be set, nor any other word"):
        read({"中": 1.0}, fonts=["Inter Display"])


def test_a_family_that_is_not_installed_says_which_are_similar() -> None:
    with pytest.raises(ReadError, match=r"similar are .*inter display"):
        open_fonts(["Inter Dsplay"])


def test_a_missing_font_file_is_named() -> None:
    with pytest.raises(ReadError, match=r"missing\.ttf: there is no such file"):
        open_fonts(["missing.ttf"])


@pytest.mark.parametrize("data", [b"", b"nonsense", b"wOF2" + bytes(40), b"ttcf" + bytes(8)])
def test_bytes_that_are_no_font_are_refused(data: bytes) -> None:
    with pytest.raises(UnfitError, match=r"is (not )?a font"):
        Typeface(data, "x")


@settings(deadline=None, max_examples=40)
@given(st.data())
def test_a_damaged_font_gives_glyphs_or_a_refusal(data: st.DataObject) -> None:
    from importlib import resources

    whole = resources.files("packwork.bundled").joinpath("fonts/InterDisplay-Black.otf")
    font = bytearray(whole.read_bytes())
    for place in data.draw(st.lists(st.integers(0, len(font) - 1), max_size=30)):
        font[place] ^= 0x5A
    try:
        face = Typeface(bytes(font), "x")
        for glyph in face.shaped("bear").glyphs:
            face.drawing(glyph.number)
    except UnfitError:
        pass


def test_curves_are_exact_in_the_fonts_units() -> None:
    face = bundled_typeface()
    drawn = face.drawing(face.shaped("o").glyphs[0].number)
    assert {letter for letter, _ in drawn} <= set("MLQCZ")
    values = [value for _, numbers in drawn for value in numbers]
    assert all(value == round(value) for value in values)


def test_a_variable_font_is_drawn_at_the_weight_asked_for() -> None:
    data = variable_font()
    widths = []
    for weight in (100, 500, 900, 2_000):
        face = Typeface(data, "x", weight=weight)
        points = [
            v
            for _, numbers in face.drawing(face.shaped("a").glyphs[0].number)
            for v in numbers[::2]
        ]
        widths.append(max(points))
    assert widths == [100, 200, 300, 300]


def test_long_words_that_begin_alike_are_each_told() -> None:
    begun = "x" * 120
    read = read_word_items(WordOptions(source={"ox": 1, begun + "a": 1, begun + "b": 1}), "fill")
    assert len(read.items) == 1
    assert len(read.undrawn) == 2


def test_small_words_have_coarser_outlines_and_say_how_far_from_their_curves() -> None:
    fonts = open_fonts([])
    fine, coarse = (shaped_word(Word("bogus", 1.0), fonts, "keep", em) for em in (1.0, 0.01))
    assert fine.item.coarseness == 1 < coarse.item.coarseness
    assert len(coarse.outline.points) < len(fine.outline.points) / 1.5
    one = bulge_between([coarse.item], np.ones(1)) / 2
    assert shapely.hausdorff_distance(fine.outline.region, coarse.outline.region) < one
