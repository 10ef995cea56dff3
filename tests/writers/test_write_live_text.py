"""Words as text: at the outlines' place, in fonts that the file carries, or as outlines."""

from __future__ import annotations

import base64
import io
import logging
import re
from importlib import resources
from pathlib import Path

import numpy as np
import pytest
from defusedxml import ElementTree
from fontTools.ttLib import TTFont, newTable
from fontTools.ttLib.tables._k_e_r_n import KernTable_format_0
from shapely import affinity

import packwork as pw
from made_fonts import variable_font
from packwork.geometry.curves import Curve
from packwork.geometry.polygon import united
from packwork.readers.fonts.face import Typeface
from packwork.readers.fonts.fallback import Fonts
from packwork.readers.fonts.glyph_ink import glyph_ink
from packwork.readers.layouts.read import read_written
from packwork.readers.words.shaping import bent_word, word_item
from packwork.readers.words.word import Word
from packwork.scene.layout import Layout
from packwork.scene.recolour import recoloured
from packwork.writers.svg import SvgOptions, svg_text
from packwork.writers.svg_live_text import may_be_embedded

INTER = resources.files("packwork.bundled").joinpath("fonts/InterDisplay-Black.otf").read_bytes()
FONTS = Path(__file__).parents[1] / "readers" / "fonts"
SVG = "{http://www.w3.org/2000/svg}"
LIVE = SvgOptions(text="live")


def layout(*words: str, fonts: Fonts | None = None) -> Layout:
    """Words in a row on a canvas."""
    set_in = fonts or Fonts([Typeface(INTER, "Inter")])
    items = tuple(word_item(Word(word, 1.0), set_in) for word in words)
    k = np.arange(len(items))
    one = np.ones(len(items))
    poses = pw.fill("circle", "star", count=1, effort="draft", levels="50").poses
    placed = type(poses)(150.0 + 150 * k, 300.0 * one, 0.2 * k, 0.4 * one)
    return Layout(pw.read_container("circle"), items, placed, one)


def bent(word: str, radius: float = 4.0, fonts: Fonts | None = None) -> Layout:
    """A word round a circle, radius in ems."""
    turn = np.linspace(-2.6, 2.6, 200)
    arc = Curve(radius * np.column_stack([1 + np.sin(turn), 1 - np.cos(turn)]))
    placed = layout("ox")
    item = bent_word(Word(word, 1.0), fonts or Fonts([Typeface(INTER, "I")]), arc, 1.0, 12.0).item
    return Layout(placed.container, (item,), placed.poses, placed.weights)


def embedded(text: str) -> list[TTFont]:
    found = re.findall(r"data:font/woff;base64,([^)]*)", text)
    return [TTFont(io.BytesIO(base64.b64decode(data))) for data in found]


def changed(**fields: int) -> bytes:
    """The bundled font with other values in its table OS/2."""
    font = TTFont(io.BytesIO(INTER))
    for name, value in fields.items():
        setattr(font["OS/2"], name, value)
    made = io.BytesIO()
    font.save(made)
    return made.getvalue()


def test_a_word_is_text_with_an_id_and_a_tooltip_in_a_font_of_its_letters_alone() -> None:
    text = svg_text(layout("office", "Ångström"), LIVE)
    root = ElementTree.fromstring(text)
    word = next(element for element in root.iter() if element.get("id") == "office")
    (shown,) = word.iter(f"{SVG}text")
    assert shown.text == "office"
    assert "<title>office: 1</title>" in text
    assert "<use" not in text
    (font,) = embedded(text)
    assert {ord(c) for c in "officeÅngström"} <= set(font.getBestCmap())
    assert len(font.getBestCmap()) < 20
    assert "packwork" not in shown.get("font-family")


def test_what_is_measured_of_it_is_what_is_measured_of_outlines(tmp_path: Path) -> None:
    placed = layout("ox", "bear")
    for name, options in (("live.svg", LIVE), ("curves.svg", SvgOptions())):
        (tmp_path / name).write_text(svg_text(placed, options), encoding="utf-8")
    live, curves = (read_written(tmp_path / name) for name in ("live.svg", "curves.svg"))
    for one, other in zip(live.outlines, curves.outlines, strict=True):
        assert one.area == pytest.approx(other.area, rel=1e-6)
        assert one.bounds == pytest.approx(other.bounds, abs=1e-3)


def test_text_has_the_words_colour_and_opacity() -> None:
    placed = layout("ox")
    item = recoloured(placed.items[0], "#12345680")
    text = svg_text(Layout(placed.container, (item,), placed.poses, placed.weights), LIVE)
    assert 'fill="#123456" fill-opacity="0.502"' in text


def test_leftward_text_begins_at_its_right_end() -> None:
    fonts = Fonts([Typeface((FONTS / "NotoNaskhArabic.ttf").read_bytes(), "naskh")])
    placed = layout("العربية", fonts=fonts)
    (run,) = placed.items[0].text.runs
    text = svg_text(placed, LIVE)
    assert 'direction="rtl" unicode-bidi="bidi-override">العربية</text>' in text
    assert f'x="{run.x + run.advance * run.size:.10g}"' in text


@pytest.mark.parametrize(
    ("font", "word"),
    [
        ("NotoSansThai.ttf", "น้ำ"),
        ("NotoSansDevanagari.ttf", "क्षत्रिय"),
        ("NotoSansHebrew.ttf", "שלום"),
        ("NotoSansSC.otf", "日本語"),
    ],
)
def test_scripts_are_set_alike_by_the_part_that_is_embedded(font: str, word: str) -> None:
    fonts = Fonts([Typeface((FONTS / font).read_bytes(), font)])
    assert f">{word}</text>" in svg_text(layout(word, fonts=fonts), LIVE)


def test_a_word_of_two_fonts_is_one_text() -> None:
    chinese = Typeface((FONTS / "NotoSansSC.otf").read_bytes(), "sc")
    text = svg_text(layout("go汉语", fonts=Fonts([Typeface(INTER, "Inter"), chinese])), LIVE)
    (shown,) = ElementTree.fromstring(text).iter(f"{SVG}text")
    assert [span.text for span in shown] == ["go", "汉语"]
    assert len(embedded(text)) == 2


@pytest.mark.parametrize("bits", [0x0002, 0x0100, 0x0200])
def test_fonts_whose_licence_forbids_it_are_not_embedded(
    bits: int, caplog: pytest.LogCaptureFixture
) -> None:
    fonts = Fonts([Typeface(changed(fsType=bits), "Closed")])
    with caplog.at_level(logging.WARNING):
        text = svg_text(layout("ox", fonts=fonts), LIVE)
    assert "Closed: its words are outlines, not text: its licence" in caplog.text
    assert "@font-face" not in text
    assert "<text" not in text
    assert "<use" in text


def test_the_most_permissive_bit_of_a_licence_holds() -> None:
    assert [bits for bits in (0, 2, 4, 8, 0x0C, 0x0A) if may_be_embedded(bits)] == [0, 4, 8, 12, 10]


def test_a_font_that_cannot_be_cut_down_leaves_outlines(caplog: pytest.LogCaptureFixture) -> None:
    placed = layout("ox")
    run = placed.items[0].text.runs[0]
    # As if the whole font had set it otherwise than its part does.
    object.__setattr__(run, "steps", tuple(step + 0.1 for step in run.steps))
    with caplog.at_level(logging.WARNING):
        assert "<text" not in svg_text(placed, LIVE)
    assert "would set the words otherwise" in caplog.text


def test_a_variable_font_is_embedded_at_the_weight_of_the_word() -> None:
    fonts = Fonts([Typeface(variable_font(), "squares", weight=500)])
    (font,) = embedded(svg_text(layout("a", fonts=fonts), LIVE))
    assert "fvar" not in font
    assert font["glyf"]["a"].xMax == 200


def test_a_font_keeps_the_pairs_of_an_old_kern_table() -> None:
    font = TTFont(io.BytesIO(INTER))
    names = font.getBestCmap()
    pair = KernTable_format_0()
    pair.coverage, pair.version, pair.apple = 1, 0, False
    pair.kernTable = {(names[ord("o")], names[ord("x")]): -300}
    font["kern"] = newTable("kern")
    font["kern"].version, font["kern"].kernTables = 0, [pair]
    del font["GPOS"]
    made = io.BytesIO()
    font.save(made)
    (part,) = embedded(
        svg_text(layout("ox", fonts=Fonts([Typeface(made.getvalue(), "old")])), LIVE)
    )
    assert part["kern"].kernTables[0].kernTable
    assert len(part.getBestCmap()) == 2


def test_files_are_the_same_every_time() -> None:
    placed = layout("ox", "bear")
    assert svg_text(placed, LIVE) == svg_text(placed, LIVE)


def test_pictures_keep_to_outlines() -> None:
    from packwork.writers.bitmaps import png_bytes

    placed = layout("ox")
    assert png_bytes(placed, 100)[:4] == b"\x89PNG"


def test_icons_are_drawn_as_ever() -> None:
    star = pw.fill("circle", "star", count=2, effort="draft", levels="50")
    assert svg_text(star, LIVE) == svg_text(star)


@pytest.mark.parametrize("radius", [3.0, 4.0, 6.0])
def test_letters_along_a_curve_are_one_text_and_stand_where_their_outlines_do(
    radius: float,
) -> None:
    """Each letter of the text, turned about its origin, covers its part of the outline."""
    placed = bent("THE OFFICE Å", radius)
    (item,) = placed.items
    (shown,) = ElementTree.fromstring(svg_text(placed, LIVE)).iter(f"{SVG}text")
    assert "".join(span.text for span in shown) == "THE OFFICE Å"
    face = Typeface(INTER, "Inter")
    regions = []
    for span in shown:
        alone = face.shaped(span.text.strip()).glyphs
        ink = united([glyph_ink(face, glyph.number, 0.5).region for glyph in alone])
        turned = affinity.rotate(ink, float(span.get("rotate")), origin=(0, 0))
        regions.append(affinity.translate(turned, float(span.get("x")), float(span.get("y"))))
    matrix = item.art.matrix
    drawn = affinity.affine_transform(united(regions), [*matrix[:, :2].ravel(), *matrix[:, 2]])
    missed = drawn.symmetric_difference(item.ink.region).area
    assert missed < 1e-3 * item.ink.region.area


@pytest.mark.parametrize(
    ("font", "word"), [("NotoNaskhArabic.ttf", "العربية"), ("NotoSansHebrew.ttf", "שלום")]
)
def test_bent_letters_that_no_document_sets_alike_are_outlines(font: str, word: str) -> None:
    fonts = Fonts([Typeface((FONTS / font).read_bytes(), font)])
    assert bent(word, fonts=fonts).items[0].text is None


def test_what_is_measured_of_bent_text_is_what_is_measured_of_outlines(tmp_path: Path) -> None:
    placed = bent("ROUND & ROUND")
    for name, options in (("live.svg", LIVE), ("curves.svg", SvgOptions())):
        (tmp_path / name).write_text(svg_text(placed, options), encoding="utf-8")
    live, curves = (read_written(tmp_path / name) for name in ("live.svg", "curves.svg"))
    assert live.outlines[0].area == pytest.approx(curves.outlines[0].area, rel=1e-6)
    assert live.outlines[0].bounds == pytest.approx(curves.outlines[0].bounds, abs=1e-3)
