"""Words to containers: letters against fontTools' own, and how lines are set."""

from __future__ import annotations

import io
from importlib import resources
from itertools import combinations

import numpy as np
import pytest
import shapely
from fontTools.fontBuilder import FontBuilder
from fontTools.pens.areaPen import AreaPen
from fontTools.pens.boundsPen import BoundsPen
from fontTools.pens.t2CharStringPen import T2CharStringPen
from fontTools.pens.ttGlyphPen import TTGlyphPen
from fontTools.ttLib import TTCollection, TTFont
from fontTools.ttLib.tables._c_m_a_p import CmapSubtable

from packwork.errors import ReadError
from packwork.geometry.polygon import polygon_parts
from packwork.readers.container import read_container
from packwork.readers.text.characters import glyph_numbers
from packwork.readers.text.container import FONT, container_of_words
from packwork.readers.text.face import Letter, letters
from packwork.readers.text.setting import LETTER_GAP, LINE_GAP, MOST_CHARACTERS, set_lines

BUNDLED = resources.files("packwork.bundled").joinpath("fonts", FONT).read_bytes()
EM = 1000


def draw_block(pen, left=100):
    """A block with a hole, 400 wide and 700 high."""
    for x, y, side, high in ((left, 0, 400, 700), (left + 100, 600, 200, -500)):
        pen.moveTo((x, y))
        pen.lineTo((x, y + high))
        pen.lineTo((x + side, y + high))
        pen.lineTo((x + side, y))
        pen.closePath()


def draw_drop(pen):
    """Quadratics whose joints are implied."""
    pen.moveTo((0, 0))
    pen.qCurveTo((0, 600), (600, 600), (600, 0))
    pen.closePath()


def built(glyphs, cmap, metrics=None, is_ttf=True) -> bytes:
    builder = FontBuilder(EM, isTTF=is_ttf)
    builder.setupGlyphOrder(list(glyphs))
    builder.setupCharacterMap(cmap)
    if is_ttf:
        builder.setupGlyf(glyphs)
    else:
        builder.setupCFF("Test", {}, glyphs, {})
    default = {name: (600, getattr(glyph, "xMin", 0)) for name, glyph in glyphs.items()}
    builder.setupHorizontalMetrics(metrics or default)
    builder.setupHorizontalHeader(ascent=800, descent=-200)
    builder.setupPost()
    stream = io.BytesIO()
    builder.save(stream)
    return stream.getvalue()


def truetype_glyphs():
    pens = {name: TTGlyphPen(None) for name in (".notdef", "block", "drop", "empty")}
    draw_block(pens["block"])
    draw_drop(pens["drop"])
    glyphs = {name: pen.glyph() for name, pen in pens.items()}
    composite = TTGlyphPen(glyphs)
    composite.addComponent("block", (0.5, 0, 0, 0.5, 30, 20))
    composite.addComponent("drop", (1, 0, 0, 1, 400, 0))
    return {**glyphs, "both": composite.glyph()}


CMAP = {ord("B"): "block", ord("D"): "drop", ord(" "): "empty", ord("X"): "both"}


@pytest.fixture(scope="module")
def truetype() -> bytes:
    return built(truetype_glyphs(), CMAP)


@pytest.fixture(scope="module")
def postscript() -> bytes:
    pens = {name: T2CharStringPen(600, None) for name in (".notdef", "block", "empty")}
    draw_block(pens["block"])
    glyphs = {name: pen.getCharString() for name, pen in pens.items()}
    return built(glyphs, {ord("B"): "block", ord(" "): "empty"}, is_ttf=False)


def test_letters_are_those_that_fonttools_draws():
    text = "SIGaqgfjß&8%ÄçΩЖ@ế"
    font = TTFont(io.BytesIO(BUNDLED))
    glyphs, names = font.getGlyphSet(), font.getBestCmap()
    em = font["head"].unitsPerEm
    for character, letter in letters(BUNDLED, text).items():
        glyph = glyphs[names[ord(character)]]
        area, bounds = AreaPen(glyphs), BoundsPen(glyphs)
        glyph.draw(area)
        glyph.draw(bounds)
        left, low, right, high = bounds.bounds
        assert letter.region.area == pytest.approx(abs(area.value) / em**2, rel=2e-3)
        assert letter.region.bounds == pytest.approx(
            [v / em for v in (left, -high, right, -low)], abs=1e-3
        )
        assert letter.advance == glyph.width / em


def test_every_character_of_the_bundled_font_finds_its_glyph():
    font = TTFont(io.BytesIO(BUNDLED))
    expected = {chr(code): font.getGlyphID(name) for code, name in font.getBestCmap().items()}
    assert glyph_numbers(font.reader["cmap"], expected) == expected


@pytest.mark.parametrize("form", [0, 4, 6, 12, 13])
def test_all_forms_of_character_tables(form):
    codes = [65, 66, 67, 90, 200] if form == 0 else [65, 66, 67, 300, 0x4E2D]
    codes += [0x1F600, 0x1F601] if form >= 12 else []
    table = CmapSubtable.newSubtable(form)
    table.platformID, table.platEncID, table.language = 3, 10 if form >= 12 else 1, 0
    names = [f"g{k}" for k in range(len(codes) + 1)]
    table.cmap = {code: names[k + 1] for k, code in enumerate(codes)}
    font = TTFont()
    font.setGlyphOrder(names)
    header = b"\0\0\0\1" + bytes([0, 3, 0, table.platEncID, 0, 0, 0, 12])
    found = glyph_numbers(header + table.compile(font), [*map(chr, codes), "!", "\U0010fffe"])
    assert list(found.values()) == [*range(1, len(codes) + 1), 0, 0]


def test_symbols_are_found_where_symbol_fonts_keep_them():
    pen = TTGlyphPen(None)
    draw_block(pen)
    glyphs = {".notdef": TTGlyphPen(None).glyph(), "block": pen.glyph()}
    font = TTFont(io.BytesIO(built(glyphs, {0xF042: "block"})))
    (kept,) = [t for t in font["cmap"].tables if t.platformID == 3][:1]
    kept.platEncID = 0
    font["cmap"].tables = [kept]
    stream = io.BytesIO()
    font.save(stream)
    assert letters(stream.getvalue(), "B")["B"].region.area == pytest.approx(0.18)


def test_truetype_outlines_composites_and_holes(truetype):
    found = letters(truetype, "BDX ")
    assert found["B"].region.area == pytest.approx(0.4 * 0.7 - 0.2 * 0.5)
    assert found["B"].region.bounds == pytest.approx((0.1, -0.7, 0.5, 0))
    assert found["D"].region.bounds == pytest.approx((0, -0.6, 0.6, 0))
    assert found["D"].region.area == pytest.approx(0.3, rel=1e-4)
    assert found["X"].region.bounds[::2] == pytest.approx((0.08, 1.0), abs=2e-3)
    assert found[" "].region.is_empty


def test_side_bearings_move_truetype_letters():
    glyphs = truetype_glyphs()
    before = letters(built(glyphs, CMAP), "BX")
    moved = {name: (600, getattr(glyph, "xMin", 0) + 50) for name, glyph in glyphs.items()}
    after = letters(built(glyphs, CMAP, moved), "BX")
    for name in "BX":
        shift = np.subtract(after[name].region.bounds, before[name].region.bounds)
        assert shift == pytest.approx((0.05, 0, 0.05, 0), abs=1e-9)


def test_postscript_outlines(postscript):
    found = letters(postscript, "B")
    assert found["B"].region.area == pytest.approx(0.18)
    assert len(polygon_parts(found["B"].region)[0].interiors) == 1


def test_first_font_of_a_collection(truetype, postscript):
    collection = TTCollection()
    collection.fonts = [TTFont(io.BytesIO(truetype)), TTFont(io.BytesIO(postscript))]
    stream = io.BytesIO()
    collection.save(stream)
    assert letters(stream.getvalue(), "X").keys() == {"X"}


def test_words_lie_inside_their_canvas_with_counters_open():
    container = container_of_words("text:BOA", 300)
    left, top, right, bottom = container.outline.bounds
    assert container.side == pytest.approx(300)
    assert left == pytest.approx(300 - right)
    assert top == pytest.approx(container.height - bottom)
    assert top == pytest.approx(left)
    assert left > 0
    assert len(container.outline.rings) == 3 + 4


def test_lines_stand_one_under_the_other():
    one, two = (container_of_words(f"text:{words}") for words in ("HELLO WORLD", "HELLO|WORLD"))
    assert one.name == two.name == "HELLO WORLD"
    assert one.width / one.height > 5 > 3 > two.width / two.height
    assert len(polygon_parts(two.outline.region)) == 10


def test_no_two_letters_touch():
    for text in ("text:AVATAR fjord", "text:LTLT/\\jfj", "text:Жизнь Ωραία"):
        container = container_of_words(text, 1000)
        parts = polygon_parts(container.outline.region)
        assert min(a.distance(b) for a, b in combinations(parts, 2)) > 0.01 * container.height


def test_marks_stay_on_their_letters():
    block, mark = shapely.box(0, -0.7, 0.5, 0), shapely.box(-0.4, -0.9, -0.1, -0.7)
    table = {"x": Letter(block, 0.6), "\u0331": Letter(mark, 0.0)}
    left, top, right, _ = set_lines(["x\u0331"], table).bounds
    assert (right - left, top) == (0.5, 0.0)


def test_letters_are_moved_apart_and_lines_are_centred():
    table = {"a": Letter(shapely.box(0, -1, 1, 0), 0.5)}
    left, top, right, bottom = set_lines(["aaa", "a"], table).bounds
    assert (left, right) == pytest.approx((-1.5 - LETTER_GAP, 1.5 + LETTER_GAP), rel=1e-4)
    assert (top, bottom) == pytest.approx((0, 2 + LINE_GAP))


def test_a_font_of_ones_own(truetype, tmp_path):
    (tmp_path / "own.ttf").write_bytes(truetype)
    container = read_container("text:BD", 100, tmp_path / "own.ttf")
    assert len(container.outline.rings) == 3


def test_composed_and_decomposed_words_are_the_same():
    one, other = (
        container_of_words(f"text:{word}") for word in ("\u00e9a", "e\u0301a\u200d\ufe0f")
    )
    assert np.array_equal(one.outline.points, other.outline.points)


@pytest.mark.parametrize(
    ("source", "problem"),
    [
        ("text:", "text:: holds no word; give one, as in text:HELLO"),
        ("text: | \u200d", "holds no word"),
        ("text:A中", "has no glyph for '中' \\(U\\+4E2D\\); choose another font"),
        ("text:上中下国人口手足", "and 2 more"),
        ("text:שלום", "written from right to left"),
        ("text:" + "A" * (MOST_CHARACTERS + 1), "longer than 500 characters"),
    ],
)
def test_words_that_cannot_be_set(source, problem):
    with pytest.raises(ReadError, match=problem):
        read_container(source)


@pytest.mark.parametrize(
    ("data", "problem"),
    [
        (b"", "own.ttf: is not a font; give a TTF"),
        (b"plain text", "is not a font"),
        (b"wOF2" + bytes(99), "packed for the web"),
        (b"\0\1\0\0", "damaged font"),
        (b"ttcf" + bytes(99), "damaged font"),
        (b"OTTO" + bytes(99), "without its table 'head'"),
    ],
)
def test_files_that_are_no_fonts(data, problem, tmp_path):
    (tmp_path / "own.ttf").write_bytes(data)
    with pytest.raises(ReadError, match=problem):
        read_container("text:A", 100, tmp_path / "own.ttf")


def test_a_font_that_draws_nothing(truetype, tmp_path):
    (tmp_path / "own.ttf").write_bytes(
        built({n: TTGlyphPen(None).glyph() for n in (".notdef", "block")}, {66: "block"})
    )
    with pytest.raises(ReadError, match="draws nothing for 'B'"):
        read_container("text:B", 100, tmp_path / "own.ttf")
    with pytest.raises(ReadError, match="there is no such file"):
        read_container("text:B", 100, tmp_path / "missing.ttf")
