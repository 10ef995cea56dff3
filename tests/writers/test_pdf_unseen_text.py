"""Words of a PDF as unseen text: read once and in order, in an embedded font, nothing painted."""

from __future__ import annotations

import io
import re
import shutil
import subprocess
from collections.abc import Callable
from contextlib import closing
from dataclasses import replace
from pathlib import Path

import numpy as np
import pikepdf
import pypdfium2 as pdfium
import pytest
from fontTools.ttLib import TTFont

import packwork as pw
from made_profiles import press_profile
from packwork.geometry.curves import Curve
from packwork.readers.fonts.face import Typeface
from packwork.readers.fonts.fallback import Fonts, open_fonts
from packwork.readers.words.shaping import bent_word, word_item
from packwork.readers.words.word import Word
from packwork.scene.item import Item
from packwork.scene.layout import Layout
from packwork.scene.pose import Poses
from packwork.verify.preflight import preflight_of
from packwork.verify.text import faults_in_file
from packwork.writers import encoded, pdf_unseen_text, write_options
from packwork.writers.pdf import pdf_bytes
from packwork.writers.svg import SvgOptions
from printed import pdf_pixels

FONTS = Path(__file__).parents[1] / "readers" / "fonts"
LIVE = SvgOptions(text="live")
MakeLayout = Callable[..., Layout]


def word(text: str, *names: str) -> Item:
    """A word in the bundled font, then in those of files."""
    own = [Typeface((FONTS / name).read_bytes(), name) for name in names]
    return word_item(Word(text, 1.0), Fonts([*open_fonts([]).faces, *own]))


def round_word(text: str, radius: float = 4.0, turn: float = 1.2) -> Item:
    """A word at the top of a circle, its radius in ems, to so many radians on each side."""
    turns = np.linspace(-turn, turn, 200)
    arc = Curve(radius * np.column_stack([np.sin(turns), -np.cos(turns)]))
    return bent_word(Word(text, 1.0), open_fonts([]), arc, 0.1, arc.length - 0.1).item


@pytest.fixture
def placed(make_layout: MakeLayout) -> MakeLayout:
    """Up to four words, each in a quarter of the sheet."""

    def make(*items: Item, angle: float = 0.0) -> Layout:
        count = len(items)
        x, y = [20.0, 60.0, 20.0, 60.0][:count], [15.0, 15.0, 45.0, 45.0][:count]
        scale = np.full(count, 0.02)
        return make_layout(items, x=x, y=y, angle=np.full(count, angle), scale=scale)

    return make


def by_pdfium(pdf: bytes) -> list[str]:
    """Words of a PDF as Chromium finds them."""
    with (
        closing(pdfium.PdfDocument(pdf)) as document,
        closing(document[0]) as page,
        closing(page.get_textpage()) as text,
    ):
        return str(text.get_text_range()).split()


def by_poppler(pdf: bytes) -> list[str]:
    """Words of a PDF as Evince and Okular find them; marks of direction left out."""
    if shutil.which("pdftotext") is None:
        pytest.skip("pdftotext is not installed")
    command = ["pdftotext", "-raw", "-enc", "UTF-8", "-", "-"]
    told = subprocess.run(command, input=pdf, capture_output=True, check=True, timeout=60)
    return re.sub("[\u202a-\u202e]", "", told.stdout.decode()).split()


READ = [by_pdfium, by_poppler]


@pytest.mark.parametrize("read", READ, ids=["pdfium", "poppler"])
@pytest.mark.parametrize("angle", [0.0, 0.3, np.pi / 4, -np.pi / 2, 2.5])
def test_words_are_read_once_and_in_order(
    placed: MakeLayout, read: Callable[[bytes], list[str]], angle: float
) -> None:
    items = word("office"), word("Ångström"), word("bear|cub"), word("New York")
    found = read(pdf_bytes(placed(*items, angle=angle), LIVE))
    assert found == ["office", "Ångström", "bear", "cub", "New", "York"]


@pytest.mark.parametrize("read", READ, ids=["pdfium", "poppler"])
@pytest.mark.parametrize("turn", [0.5, 1.2, 2.4])
def test_words_of_a_ring_are_read_whole(
    placed: MakeLayout, read: Callable[[bytes], list[str]], turn: float
) -> None:
    layout = placed(round_word("OLD ORCHARD CIDER", 2.0 + 4.0 / turn, turn))
    assert read(pdf_bytes(layout, LIVE)) == ["OLD", "ORCHARD", "CIDER"]


@pytest.mark.parametrize("read", READ, ids=["pdfium", "poppler"])
@pytest.mark.parametrize(
    ("font", "said"),
    [
        ("NotoNaskhArabic.ttf", "العربية"),
        ("NotoSansHebrew.ttf", "שלום"),
        ("NotoSansThai.ttf", "น้ำ"),
        ("NotoSansDevanagari.ttf", "क्षत्रिय"),
    ],
)
def test_scripts_are_read_as_they_were_written(
    placed: MakeLayout, read: Callable[[bytes], list[str]], font: str, said: str
) -> None:
    assert read(pdf_bytes(placed(word(said, font)), LIVE)) == [said]


@pytest.mark.parametrize("read", READ, ids=["pdfium", "poppler"])
@pytest.mark.parametrize("x", [1.0, 79.0])
def test_a_word_that_leaves_the_page_is_read_whole(
    placed: MakeLayout, read: Callable[[bytes], list[str]], x: float
) -> None:
    layout = placed(word("office"), word("bear"))
    beyond = Poses(np.array([x, 60.0]), layout.poses.y, 0.0, 0.02)
    assert sorted(read(pdf_bytes(replace(layout, poses=beyond), LIVE))) == ["bear", "office"]


def test_nothing_of_it_is_seen(placed: MakeLayout) -> None:
    layout = placed(word("office"), round_word("OLD ORCHARD"), angle=0.3)
    live, curves = (pdf_pixels(pdf_bytes(layout, options), 900) for options in (LIVE, SvgOptions()))
    assert live.min() < 250
    assert np.array_equal(live, curves)


def test_boxes_of_characters_lie_on_their_letters(placed: MakeLayout) -> None:
    pdf = pdf_bytes(placed(word("ill")), LIVE)
    with (
        closing(pdfium.PdfDocument(pdf)) as document,
        closing(document[0]) as page,
        closing(page.get_textpage()) as text,
    ):
        height = page.get_height()
        drawn = np.array([one.get_bounds() for one in page.get_objects([2])])
        boxes = np.array([text.get_charbox(k, loose=True) for k in range(3)])
    left, low, right, high = [*drawn[:, :2].min(axis=0), *drawn[:, 2:].max(axis=0)]
    assert height > high
    em = float(np.ptp(boxes[0, 1::2]))
    assert boxes[0, 0] == pytest.approx(left, abs=0.1 * em)
    assert boxes[2, 2] == pytest.approx(right, abs=0.1 * em)
    assert np.allclose(boxes[1:, 0], boxes[:-1, 2], atol=0.03 * em)
    assert boxes[0, 1] < low + 0.1 * em
    assert boxes[0, 3] > high - 0.1 * em


def test_layouts_without_words_are_what_they_were(make_layout: MakeLayout, star_item: Item) -> None:
    layout = make_layout((star_item,), x=[30.0], y=[30.0], scale=[0.2])
    assert pdf_bytes(layout, LIVE) == pdf_bytes(layout)


def test_words_are_spans_of_the_structure_tree(placed: MakeLayout) -> None:
    layout = placed(word("one"), round_word("TWO THREE"))
    with pikepdf.open(io.BytesIO(pdf_bytes(layout, LIVE))) as pdf:
        page = pdf.pages[0]
        tree = pdf.Root.StructTreeRoot
        marked = tree.ParentTree.Nums[1]
        spans = [one for one in tree.K[0].K if one.S == "/Span"][-3:]
        assert [marked[int(one.K)] == one for one in spans] == [True] * 3
        assert page.StructParents == tree.ParentTree.Nums[0]
        operators = pikepdf.parse_content_stream(page)
        marks = [int(one.operands[1].MCID) for one in operators if str(one.operator) == "BDC"]
        assert sorted(marks) == list(range(len(marked)))


def test_a_file_for_a_press_embeds_the_font(placed: MakeLayout, tmp_path: Path) -> None:
    (tmp_path / "press.icc").write_bytes(press_profile())
    options = write_options(icc=tmp_path / "press.icc", bleed="3mm", marks="all", text="live")
    pdf = encoded(placed(word("office"), round_word("OLD ORCHARD")), "a.pdf", options)
    assert by_pdfium(pdf) == ["office", "OLD", "ORCHARD"]
    with pikepdf.open(io.BytesIO(pdf)) as read:
        (font,) = read.pages[0].Resources.Font.values()
        (drawn,) = font.DescendantFonts
        embedded = TTFont(io.BytesIO(drawn.FontDescriptor.FontFile2.read_bytes()))
        glyphs = np.frombuffer(drawn.CIDToGIDMap.read_bytes(), ">u2")[1:]
        # Widths in the PDF are those of the font, ISO 15930-7 by way of ISO 32000-1, 9.7.4.3.
        advances = [embedded["hmtx"][embedded.getGlyphName(int(glyph))][0] for glyph in glyphs]
        assert advances == [int(width) for width in drawn.W[1]]
        assert not read.check_pdf_syntax()


def test_unseen_letters_are_no_matter_of_a_press(placed: MakeLayout) -> None:
    layout = placed(word("office"))
    checks = [preflight_of(pdf_bytes(layout, how), "a.pdf") for how in (LIVE, SvgOptions())]
    assert checks[0] == checks[1]


def test_what_is_written_is_held_against_the_layout() -> None:
    layout = pw.words("circle", {"honey": 3, "bear": 2}, ring=("TOP",), effort="draft")
    options = write_options(text="live")
    pdf = encoded(layout, "a.pdf", options)
    assert by_pdfium(pdf)[-1] == "TOP"
    assert faults_in_file(pdf, "a.pdf", layout, options) == ()
    with pikepdf.open(io.BytesIO(pdf)) as changed:
        changed.pages[0].contents_coalesce()
        content = changed.pages[0].Contents
        content.write(content.read_bytes().replace(b" 3 Tr", b" 0 Tr"))
        written = io.BytesIO()
        changed.save(written)
    (fault,) = faults_in_file(written.getvalue(), "a.pdf", layout, options)
    assert "paints by TJ" in fault


def test_a_word_without_extent_is_left_out(placed: MakeLayout) -> None:
    layout = placed(word("office"), word("bear"))
    tiny = Poses(layout.poses.x, layout.poses.y, 0.0, np.array([0.05, 1e-12]))
    assert by_pdfium(pdf_bytes(replace(layout, poses=tiny), LIVE)) == ["office"]


def test_words_without_characters_and_those_beyond_all_codes_are_left_out(
    placed: MakeLayout, monkeypatch: pytest.MonkeyPatch
) -> None:
    blank = word("blank")
    assert blank.text is not None
    runs = tuple(replace(run, text="", steps=()) for run in blank.text.runs)
    layout = placed(replace(blank, text=replace(blank.text, runs=runs)), word("office"), word("x"))
    assert by_pdfium(pdf_bytes(layout, LIVE)) == ["office", "x"]
    monkeypatch.setattr(pdf_unseen_text, "_MOST_CODES", 6)
    assert by_pdfium(pdf_bytes(placed(word("off"), word("bear"), word("off")), LIVE)) == ["off"] * 2
