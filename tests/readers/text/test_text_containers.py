"""Words to containers: letters against fontTools' own, and how lines are set."""

from __future__ import annotations

import io
from itertools import combinations
from pathlib import Path

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
from PIL import Image
from shapely import Polygon

from made_fonts import EMOJI, STRIKE_PX, emoji_font, variable_font
from packwork.errors import ReadError
from packwork.fonts import FOLDERS, bundled_file
from packwork.geometry.polygon import polygon_parts
from packwork.readers.container import read_container
from packwork.readers.fonts.face import Typeface
from packwork.readers.fonts.fallback import Fonts
from packwork.readers.reading import reading_file
from packwork.readers.text import (
    LETTER_GAP,
    LINE_GAP,
    MOST_CHARACTERS,
    Letter,
    container_of_words,
    letters_of,
    set_lines,
)

BUNDLED = Path(bundled_file()).read_bytes()
SCRIPTS = Path(__file__).parent.parent / "fonts"
EM = 1000


def letters(data: bytes, text: str) -> list[Letter]:
    """Letters of one line, by a font file's bytes."""
    with reading_file("own.ttf"):
        (line,) = Fonts([Typeface(data, "own.ttf")]).settings([text])
        return letters_of(line)


def squares(count: int):
    """Glyphs by name, the k-th a square of k tenths of an em."""
    glyphs = {".notdef": TTGlyphPen(None).glyph()}
    for k in range(1, count + 1):
        pen = TTGlyphPen(None)
        pen.moveTo((0, 0))
        for place in ((0, 100 * k), (100 * k, 100 * k), (100 * k, 0)):
            pen.lineTo(place)
        pen.closePath()
        glyphs[f"g{k}"] = pen.glyph()
    return glyphs


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


def built(glyphs, cmap, metrics=None, is_ttf=True, is_cff2=False) -> bytes:
    builder = FontBuilder(EM, isTTF=is_ttf)
    builder.setupGlyphOrder(list(glyphs))
    builder.setupCharacterMap(cmap)
    if is_ttf:
        builder.setupGlyf(glyphs)
    elif is_cff2:
        builder.setupCFF2(glyphs)
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
    for character, letter in zip(text, letters(BUNDLED, text), strict=True):
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


@pytest.mark.parametrize("form", [0, 4, 6, 12, 13])
def test_all_forms_of_character_tables(form):
    codes = [65, 66, 67, 90] if form == 0 else [65, 66, 67, 300, 0x4E2D]
    codes += [0x1F600, 0x1F601] if form >= 12 else []
    font = TTFont(io.BytesIO(built(squares(len(codes)), {})))
    names = font.getGlyphOrder()
    table = CmapSubtable.newSubtable(form)
    table.platformID, table.platEncID, table.language = 3, 10 if form >= 12 else 1, 0
    table.cmap = {code: names[k + 1] for k, code in enumerate(codes)}
    font["cmap"].tables = [table]
    stream = io.BytesIO()
    font.save(stream)
    widths = [row.region.bounds[2] for row in letters(stream.getvalue(), "".join(map(chr, codes)))]
    assert widths == pytest.approx([0.1 * (k + 1) for k in range(len(codes))])
    with pytest.raises(
        ReadError, match=r"given has '!' \(U\+0021\), '.*' \(U\+10FFFE\); choose another"
    ):
        letters(stream.getvalue(), "A!\U0010fffe")


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
    assert letters(stream.getvalue(), "B")[0].region.area == pytest.approx(0.18)


def test_truetype_outlines_composites_and_holes(truetype):
    found = dict(zip("BDX ", letters(truetype, "BDX "), strict=True))
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
    for one, other in zip(before, after, strict=True):
        shift = np.subtract(other.region.bounds, one.region.bounds)
        assert shift == pytest.approx((0.05, 0, 0.05, 0), abs=1e-9)


def test_postscript_outlines(postscript):
    (found,) = letters(postscript, "B")
    assert found.region.area == pytest.approx(0.18)
    assert len(polygon_parts(found.region)[0].interiors) == 1


def test_outlines_as_variable_postscript_fonts_have_them():
    pens = {name: T2CharStringPen(None, {}, CFF2=True) for name in (".notdef", "block")}
    draw_block(pens["block"])
    glyphs = {name: pen.getCharString() for name, pen in pens.items()}
    (found,) = letters(built(glyphs, {66: "block"}, is_ttf=False, is_cff2=True), "B")
    assert found.region.area == pytest.approx(0.18)


def test_a_variable_font_stands_at_its_default(tmp_path):
    (tmp_path / "own.ttf").write_bytes(variable_font())
    left, top, right, bottom = read_container("text:a", 500, tmp_path / "own.ttf").outline.bounds
    assert (right - left) / (bottom - top) == pytest.approx(100 / 500)


def test_first_font_of_a_collection(truetype, postscript):
    collection = TTCollection()
    collection.fonts = [TTFont(io.BytesIO(truetype)), TTFont(io.BytesIO(postscript))]
    stream = io.BytesIO()
    collection.save(stream)
    assert len(letters(stream.getvalue(), "X")) == 1


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
    """The font says where: below an x, with the x's own distances to its neighbours."""
    plain, marked = (container_of_words(f"text:{text}", 600) for text in ("oxo", "ox\u0331o"))
    assert len(polygon_parts(marked.outline.region)) == 4
    assert marked.width / marked.height < plain.width / plain.height


def test_letters_are_moved_apart_and_lines_are_centred():
    letter = Letter(shapely.box(0, -1, 1, 0), 0.5)
    left, top, right, bottom = set_lines([[letter] * 3, [letter]]).bounds
    assert (left, right) == pytest.approx((-1.5 - LETTER_GAP, 1.5 + LETTER_GAP), rel=1e-4)
    assert (top, bottom) == pytest.approx((0, 2 + LINE_GAP))


def test_letters_of_many_points_are_set_as_others_are(monkeypatch):
    whole = container_of_words("text:LTAVfj/|AV", 600)
    monkeypatch.setattr("packwork.readers.text.FEW_POINTS", 0)
    facing = container_of_words("text:LTAVfj/|AV", 600)
    assert np.allclose(facing.outline.points, whole.outline.points, atol=1e-9)


def parts_of(text: str, font: str) -> list[Polygon]:
    """Parts of a container of words, from left to right."""
    region = container_of_words(f"text:{text}", 1000, SCRIPTS / font).outline.region
    return sorted(polygon_parts(region), key=lambda part: part.bounds[0])


def test_arabic_letters_join_and_run_to_the_left():
    font = "NotoNaskhArabic.ttf"
    ba, ta = "\u0628", "\u0629"
    # A ba's dot is below, the two of a final ta above: it stands on the left.
    joined, apart = parts_of(ba + ta, font), parts_of(f"{ba}\u200c{ta}", font)
    letter = max(joined, key=lambda part: part.area)
    assert len(apart) == len(joined) + 1
    below = [part for part in joined if part.bounds[1] > letter.centroid.y]
    above = [part for part in joined if part.bounds[3] < letter.centroid.y]
    assert min(part.bounds[0] for part in below) > max(part.bounds[2] for part in above)


def test_hindi_words_hang_on_one_line():
    word, two = (parts_of(text, "NotoSansDevanagari.ttf") for text in ("हिन्दी", "हिन्दी हिन्दी"))
    assert len(word) < 3
    assert len(two) == 2 * len(word)


def test_thai_marks_stack_and_letters_stand_apart():
    parts = parts_of("น้ำ", "NotoSansThai.ttf")
    assert len(parts) == 4
    assert min(a.distance(b) for a, b in combinations(parts, 2)) > 0


def test_chinese_and_hebrew_words_are_containers():
    han = container_of_words("text:汉语|世界", 600, SCRIPTS / "NotoSansSC.otf")
    assert 0.8 < han.width / han.height < 1.2
    assert len(parts_of("שלום", "NotoSansHebrew.ttf")) == 4


def test_scripts_take_the_fonts_that_a_machine_has(machine):
    if machine == "many fonts":
        assert len(read_container("text:ภาษา", 300).outline.rings) == 4
        assert len(read_container("text:A ภาษา", 300).outline.rings) == 4 + 2
    else:
        with pytest.raises(ReadError, match=r"no font installed has 'ภ' \(U\+0E20\)"):
            read_container("text:A ภาษา")


def test_a_font_without_a_space_is_told_so():
    with pytest.raises(ReadError, match=r"no font given has ' ' \(U\+0020\)"):
        letters(built(truetype_glyphs(), {66: "block"}), "B B")


def test_an_installed_family_is_a_font_too(font_folders, monkeypatch):
    monkeypatch.setenv(FOLDERS, font_folders["many fonts"])
    container = read_container("text:ภาษา", 300, "Noto Sans Thai")
    assert len(container.outline.rings) == 4
    with pytest.raises(ReadError, match="no installed family; similar are noto sans thai"):
        read_container("text:A", 300, "Noto Sans Thay")


def test_emoji_are_their_silhouettes(tmp_path):
    file = io.BytesIO()
    Image.new("RGBA", (STRIKE_PX, STRIKE_PX), "teal").save(file, format="png")
    (tmp_path / "faces.ttf").write_bytes(emoji_font(file.getvalue()))
    container = read_container(f"text:{EMOJI}", 300, tmp_path / "faces.ttf")
    assert container.outline.area == pytest.approx((300 / 1.04) ** 2, rel=0.01)


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
        ("text:A中", "no font installed has '中' \\(U\\+4E2D\\); install one, or give its file"),
        ("text:" + "A" * (MOST_CHARACTERS + 1), "longer than 500 characters"),
    ],
)
def test_words_that_cannot_be_set(source, problem, font_folders, monkeypatch):
    monkeypatch.setenv(FOLDERS, font_folders["no fonts"])
    with pytest.raises(ReadError, match=problem):
        read_container(source)


@pytest.mark.parametrize(
    ("data", "problem"),
    [
        (b"", "own.ttf: is not a font; give a TTF"),
        (b"plain text", "is not a font"),
        (b"wOF2" + bytes(99), "packed for the web"),
        (b"\0\1\0\0", "without its table 'head'"),
        (b"ttcf" + bytes(99), "without its table 'head'"),
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


def test_signs_that_are_meant_to_be_blank(truetype, tmp_path):
    (tmp_path / "own.ttf").write_bytes(built(truetype_glyphs(), {66: "block", 0x2800: "empty"}))
    spaced = read_container("text:B\u2800B", 100, tmp_path / "own.ttf")
    assert len(spaced.outline.rings) == 4
    with pytest.raises(ReadError, match="holds a line that draws nothing"):
        read_container("text:B|\u2800", 100, tmp_path / "own.ttf")


def test_all_characters_that_a_font_lacks_are_named(truetype, tmp_path):
    (tmp_path / "own.ttf").write_bytes(truetype)
    with pytest.raises(ReadError, match=r"has '上' \(U\+4E0A\), .* and 2 more; choose another"):
        read_container("text:上中下国人口手足", 100, tmp_path / "own.ttf")
