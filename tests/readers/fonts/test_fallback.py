"""Words of several fonts, scripts and directions; glyphs that are pictures."""

from __future__ import annotations

import io
from importlib import resources
from pathlib import Path

import numpy as np
import pytest
from PIL import Image, ImageDraw

from made_fonts import EMOJI, STRIKE_PX, emoji_font
from packwork.readers.fonts.face import Typeface
from packwork.readers.fonts.fallback import Fonts, open_fonts
from packwork.readers.fonts.itemise import clusters, itemised, visual_order
from packwork.readers.reading import UnfitError
from packwork.readers.words.shaping import word_item
from packwork.readers.words.word import Word
from packwork.scene.item import VectorArt
from packwork.scene.recolour import has_one_colour

FONTS = Path(__file__).parent
INTER = str(resources.files("packwork.bundled").joinpath("fonts/InterDisplay-Black.otf"))


def disc() -> bytes:
    picture = Image.new("RGBA", (STRIKE_PX, STRIKE_PX))
    ImageDraw.Draw(picture).ellipse((0, 0, STRIKE_PX - 1, STRIKE_PX - 1), fill="gold")
    file = io.BytesIO()
    picture.save(file, format="png")
    return file.getvalue()


def test_each_part_of_a_word_is_drawn_by_the_first_font_that_has_it() -> None:
    fonts = open_fonts([INTER, str(FONTS / "NotoSansSC.otf")])
    runs = fonts.lettering(["go汉语go"]).runs
    assert [run.text for run in runs] == ["go", "汉语", "go"]
    assert [Path(run.font.name).stem for run in runs] == [
        "InterDisplay-Black", "NotoSansSC", "InterDisplay-Black",
    ]  # fmt: skip
    ends = [run.x + run.advance * run.size for run in runs]
    assert [run.x for run in runs[1:]] == pytest.approx(ends[:2])


def test_a_font_that_has_all_of_a_word_draws_all_of_it() -> None:
    fonts = open_fonts([str(FONTS / "NotoSansSC.otf"), INTER])
    assert len({run.font for run in fonts.lettering(["office"]).runs}) == 1


def test_words_are_set_by_the_fonts_that_a_machine_has(machine: str) -> None:
    fonts = open_fonts([])
    assert not fonts.lettering(["honey"]).region.is_empty
    if machine == "many fonts":
        assert not fonts.lettering(["ภาษา"]).region.is_empty
    else:
        with pytest.raises(UnfitError, match=r"no font installed has '[ภาษา]'"):
            fonts.lettering(["ภาษา"])


def test_a_character_that_no_font_has_is_named() -> None:
    with pytest.raises(UnfitError, match=r"has '中' \(U\+4E2D\); choose another with --font"):
        open_fonts([INTER]).lettering(["go中"])


@pytest.mark.parametrize(
    ("line", "pieces", "order"),
    [
        ("office", ["office"], [0]),
        ("don't-stop", ["don't-stop"], [0]),
        ("日本のカメラ", ["日本のカメラ"], [0]),
        ("हिन्दी-भाषा", ["हिन्दी-भाषा"], [0]),
        ("Tшx", ["T", "ш", "x"], [0, 1, 2]),
        ("כן 12 לא", ["כן ", "12", " לא"], [2, 1, 0]),
        ("no כן", ["no ", "כן"], [0, 1]),
    ],
)
def test_lines_are_cut_by_script_and_direction(
    line: str, pieces: list[str], order: list[int]
) -> None:
    found = itemised(line)
    assert [piece.text for piece in found] == pieces
    assert visual_order(found) == order


def test_digits_in_a_word_that_runs_leftward_keep_their_order() -> None:
    """By themselves they look as they do beside letters."""
    fonts = open_fonts([INTER, str(FONTS / "NotoSansHebrew.ttf")])
    alone, among = fonts.lettering(["12"]), fonts.lettering(["של12"])
    assert [run.text for run in among.runs] == ["של", "12"]
    assert among.runs[1].x < among.runs[0].x
    assert among.runs[1].steps == alone.runs[0].steps


def test_joined_emoji_and_flags_are_not_cut() -> None:
    family = "\U0001f468\u200d\U0001f469\u200d\U0001f467"
    assert clusters("a\ufe0f" + family + "\U0001f44d\U0001f3fd") == [
        "a\ufe0f", family, "\U0001f44d\U0001f3fd",
    ]  # fmt: skip


def test_a_picture_glyph_is_an_image_whose_silhouette_is_traced() -> None:
    fonts = Fonts([Typeface(emoji_font(disc()), "faces")])
    item = word_item(Word(EMOJI, 1.0), fonts)
    assert item.outline.area == pytest.approx(np.pi * 50**2, rel=0.02)
    assert isinstance(item.art, VectorArt)
    assert item.art.markup.startswith("<image ")
    assert not has_one_colour(item.art)
    assert item.text is None


def test_letters_and_pictures_stand_beside_each_other() -> None:
    fonts = Fonts([open_fonts([INTER]).faces[0], Typeface(emoji_font(disc()), "faces")])
    item = word_item(Word(f"hi{EMOJI}", 1.0), fonts)
    assert isinstance(item.art, VectorArt)
    assert [part in item.art.markup for part in ("<path", "<image")] == [True, True]
    alone = word_item(Word("hi", 1.0), fonts)
    assert item.ink.area == pytest.approx(alone.ink.area + np.pi * 50**2, rel=0.02)


def test_a_broken_picture_in_a_font_is_refused() -> None:
    fonts = Fonts([Typeface(emoji_font(b"\x89PNG\r\n\x1a\n" + bytes(60)), "faces")])
    with pytest.raises(UnfitError):
        word_item(Word(EMOJI, 1.0), fonts)
