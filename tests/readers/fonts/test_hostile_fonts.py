"""Any bytes give letters or a ReadError, never anything else, and soon."""

from __future__ import annotations

import io
import itertools
import struct
import time
from collections.abc import Callable, Iterator
from contextlib import suppress

import pytest
from fontTools.fontBuilder import FontBuilder
from fontTools.misc.psCharStrings import T2CharString
from fontTools.pens.t2CharStringPen import T2CharStringPen
from fontTools.pens.ttGlyphPen import TTGlyphPen
from fontTools.ttLib import TTFont, newTable
from hypothesis import given, settings
from hypothesis import strategies as st

import packwork.readers.fonts.face as face_module
from made_fonts import doubled_font, nested_font, scribbled_font
from packwork.errors import ReadError
from packwork.readers import cache
from packwork.readers.fonts.face import MAX_FONT_BYTES, Typeface
from packwork.readers.fonts.fallback import Fonts
from packwork.readers.reading import UnfitError, reading_file
from packwork.readers.text import Letter, container_of_words, letters_of
from packwork.readers.words.shaping import word_item
from packwork.readers.words.word import Word
from packwork.scene.item import FontFile, LiveText, TextRun
from packwork.wordcloud import WordCloud
from packwork.writers.svg_live_text import embedded_fonts

SECONDS_AT_MOST = 20.0
"""A bomb takes hours or all memory; the bound is that generous for slow machines."""


def small_font(is_ttf: bool) -> bytes:
    builder = FontBuilder(1000, isTTF=is_ttf)
    names = [".notdef", "a", "b"]
    builder.setupGlyphOrder(names)
    builder.setupCharacterMap({ord("a"): "a", ord("b"): "b"})
    glyphs = {}
    for name in names:
        pen = TTGlyphPen(glyphs) if is_ttf else T2CharStringPen(600, None)
        if name == "b" and is_ttf:
            pen.addComponent("a", (1, 0, 0, 1, 50, 0))
        elif name != ".notdef":
            pen.moveTo((0, 0))
            pen.curveTo((0, 300), (200, 700), (400, 700)) if not is_ttf else pen.qCurveTo(
                (0, 700), (400, 700)
            )
            pen.lineTo((400, 0))
            pen.closePath()
        glyphs[name] = pen.glyph() if is_ttf else pen.getCharString()
    builder.setupGlyf(glyphs) if is_ttf else builder.setupCFF("Test", {}, glyphs, {})
    builder.setupHorizontalMetrics(dict.fromkeys(names, (600, 0)))
    builder.setupHorizontalHeader(ascent=800, descent=-200)
    builder.setupPost()
    return saved(builder.font)


def saved(font: TTFont) -> bytes:
    stream = io.BytesIO()
    font.save(stream)
    return stream.getvalue()


TRUETYPE, POSTSCRIPT = small_font(True), small_font(False)


def letters(data: bytes, text: str) -> list[Letter]:
    """Letters as a container sets them, by a font file's bytes."""
    with reading_file("a.ttf"):
        (line,) = Fonts([Typeface(data, "a.ttf")]).settings([text])
        return letters_of(line)


def letters_or_read_error(data: bytes) -> None:
    try:
        found = letters(data, "ab")
    except ReadError as error:
        message = str(error)
    else:
        assert all(letter.region.is_valid for letter in found)
        return
    assert message.startswith("a.ttf: ")
    assert len(message.splitlines()) == 1


@settings(deadline=None, max_examples=100)
@given(st.sampled_from([b"", b"\0\1\0\0", b"OTTO", b"ttcf", b"true"]), st.binary(max_size=300))
def test_any_bytes(start, data):
    letters_or_read_error(start + data)


@settings(deadline=None, max_examples=300)
@given(st.data(), st.sampled_from([TRUETYPE, POSTSCRIPT]))
def test_mutated_bytes(data, font):
    mutated = bytearray(font)
    for _ in range(data.draw(st.integers(1, 8))):
        place = data.draw(st.integers(0, len(mutated) - 1))
        mutated[place] = data.draw(st.sampled_from([0, 1, 0x7F, 0x80, 0xFF]) | st.integers(0, 255))
    letters_or_read_error(bytes(mutated))


@settings(deadline=None, max_examples=100)
@given(st.sampled_from([TRUETYPE, POSTSCRIPT]), st.floats(0, 1), st.integers(0, 30))
def test_spliced_bytes(font, share, length):
    place = int(share * len(font))
    letters_or_read_error(font[:place] + font[place + length :])


@pytest.fixture
def soon() -> Iterator[None]:
    began = time.process_time()
    yield
    assert time.process_time() - began < SECONDS_AT_MOST


def changed(data: bytes, change: Callable[[TTFont], None]) -> bytes:
    font = TTFont(io.BytesIO(data), recalcBBoxes=False)
    change(font)
    return saved(font)


@pytest.mark.usefixtures("soon")
@pytest.mark.parametrize("form", [12, 13])
def test_characters_claimed_by_the_billion(form):
    groups = struct.pack(">LLL", 0, 0xFFFFFFFF, 1) * 10_000
    table = struct.pack(">HHLLL", form, 0, 16 + len(groups), 0, 10_000) + groups
    cmap = struct.pack(">HHHHL", 0, 1, 3, 10, 12) + table

    def claim(font: TTFont) -> None:
        font["cmap"] = newTable("cmap")
        font["cmap"].compile = lambda _: cmap

    letters_or_read_error(changed(TRUETYPE, claim))


@pytest.mark.usefixtures("soon")
def test_a_glyph_made_of_a_thousand_copies_of_a_thousand_copies():
    glyphs = {".notdef": TTGlyphPen(None).glyph()}
    names = [".notdef", *(f"g{k}" for k in range(30)), "a"]
    for before, name in itertools.pairwise(names):
        pen = TTGlyphPen(dict.fromkeys(names))
        for _ in range(10):
            pen.addComponent(before, (1, 0, 0, 1, 0, 0))
        glyphs[name] = pen.glyph()
        glyphs[name].xMin = glyphs[name].yMin = glyphs[name].xMax = glyphs[name].yMax = 0

    def nest(font: TTFont) -> None:
        font.setGlyphOrder(names)
        font["glyf"] = newTable("glyf")
        font["glyf"].glyphs, font["glyf"].glyphOrder = glyphs, names
        font["hmtx"].metrics = dict.fromkeys(names, (600, 0))
        for table in font["cmap"].tables:
            table.cmap = {ord("a"): "a", ord("b"): "a"}

    with pytest.raises(ReadError, match=r"draws nothing for 'a'"):
        letters(changed(TRUETYPE, nest), "a")


def font_of(side: int) -> bytes:
    """A font whose letter a is a square of so many units, 1,000 in an em."""
    pen = TTGlyphPen(None)
    pen.moveTo((0, 0))
    for place in ((0, side), (side, side), (side, 0)):
        pen.lineTo(place)
    pen.closePath()

    def enlarge(font: TTFont) -> None:
        font["glyf"]["a"] = pen.glyph()
        font["glyf"]["a"].recalcBounds(font["glyf"])

    return changed(TRUETYPE, enlarge)


def far_font() -> bytes:
    """Lines that end sixty ems off, by steps that a font may take."""
    lines = [1_000, 0, "rlineto"] * 60 + [0, 1_000, "rlineto"] + [-1_000, 0, "rlineto"] * 60
    return nested_font(1, 1, lines)


RICH = {
    "far off": far_font,
    "scribble": lambda: scribbled_font(15_000),
    "small scribble": lambda: scribbled_font(1_000),
    "doubled": lambda: doubled_font(24),
    "nested": lambda: nested_font(10),
    "less nested": lambda: nested_font(4),
    "nested too deep": lambda: nested_font(12, 2),
    "far": lambda: font_of(32_100),
}
REASON = "cross too often|more than 20,000|reaches too far|cannot be drawn"


@pytest.mark.usefixtures("soon")
@pytest.mark.parametrize("kind", RICH)
def test_glyphs_that_would_take_all_memory_are_refused(kind):
    data = RICH[kind]()
    with pytest.raises(ReadError, match=REASON):
        letters(data, "a")
    # HarfBuzz calls us back: what is raised there it passes over, and goes on.
    with pytest.raises(UnfitError, match=REASON):
        word_item(Word("a", 1.0), Fonts([Typeface(data, "a.otf")]))


def test_a_glyph_that_is_too_rich_is_counted_and_not_kept():
    face = Typeface(nested_font(10), "a.otf")
    (glyph,) = face.shaped("a").glyphs
    for _ in range(2):
        with pytest.raises(UnfitError, match=r"a glyph of \d\d,\d\d\d pieces, more than 20,000"):
            face.drawing(glyph.number)


def test_a_glyph_of_a_few_copies_is_drawn():
    (found,) = (letter.region for letter in letters(doubled_font(3), "a"))
    item = word_item(Word("a", 1.0), Fonts([Typeface(doubled_font(3), "a.ttf")]))
    assert found.area == pytest.approx(0.304 * 0.504, rel=0.05)
    assert item.outline.area > 0


@pytest.mark.usefixtures("soon")
def test_a_word_that_a_font_draws_with_thousands_of_glyphs(monkeypatch):
    monkeypatch.setattr(face_module, "MOST_GLYPHS", 3)
    with pytest.raises(UnfitError, match="one word with more than 3 glyphs"):
        Typeface(TRUETYPE, "a.ttf").shaped("abab")


@pytest.mark.usefixtures("soon")
def test_a_font_whose_programs_do_not_end_is_not_embedded():
    font = FontFile(nested_font(10), "nested.otf")
    run = TextRun("a", font, 0.0, 0.0, 1.0, (0.0,), 0.6)
    found, refused = embedded_fonts([LiveText((run,), "")])
    assert found == {}
    assert "cannot be cut down" in refused["nested.otf"]


@pytest.mark.usefixtures("soon")
def test_a_glyph_made_of_itself():
    def loop(font: TTFont) -> None:
        font["glyf"]["b"].components[0].glyphName = "b"

    with pytest.raises(ReadError, match="cannot be drawn"):
        letters(changed(TRUETYPE, loop), "b")


@pytest.mark.usefixtures("soon")
def test_a_program_of_ten_calls_of_ten_calls():
    def nest(font: TTFont) -> None:
        top = font["CFF "].cff[0]
        # Calls k of a subroutine push its number less the bias of 107.
        programs = [[k - 1 - 107, "callgsubr"] * 10 if k else [0, 0, "rlineto"] for k in range(9)]
        for program in programs:
            top.GlobalSubrs.append(T2CharString(program=[*program, "return"]))
        call = [0, 0, "rmoveto", 8 - 107, "callgsubr", "endchar"]
        program = T2CharString(program=call, private=top.Private, globalSubrs=top.GlobalSubrs)
        top.CharStrings["a"] = program

    with pytest.raises(ReadError, match=r"more than 20,000|cannot be drawn"):
        letters(changed(POSTSCRIPT, nest), "a")


@pytest.mark.usefixtures("soon")
def test_a_letter_that_a_damaged_font_does_not_draw_is_not_left_out():
    def empty(font: TTFont) -> None:
        top = font["CFF "].cff[0]
        top.CharStrings["a"] = T2CharString(program=["endchar"], private=top.Private)

    with pytest.raises(ReadError, match="draws nothing for 'a'"):
        letters(changed(POSTSCRIPT, empty), "ba")


@pytest.mark.usefixtures("soon")
def test_places_of_glyphs_that_run_backwards():
    def reverse(font: TTFont) -> None:
        size = len(font.reader["glyf"])
        font["loca"] = newTable("loca")
        font["loca"].compile = lambda _: struct.pack(">4H", 0, size // 2, 0, size // 2)
        glyf = font.reader["glyf"]
        font["glyf"] = newTable("glyf")
        font["glyf"].compile = lambda _: glyf

    with pytest.raises(ReadError, match="its glyphs overlap in the file"):
        letters(changed(TRUETYPE, reverse), "a")


@pytest.mark.parametrize(
    ("table", "place", "number", "problem"),
    [
        (b"head", 18, 0, "an em of 0 units"),
        (b"head", 18, 60_000, "an em of 60000 units"),
    ],
)
def test_numbers_that_make_no_font(table, place, number, problem):
    with pytest.raises(ReadError, match=problem):
        letters(_with_number(table, place, number), "a")


def test_a_font_that_says_it_has_no_glyphs_is_refused_or_drawn_as_it_is():
    # Versions of HarfBuzz differ in whether they believe it.
    with suppress(ReadError):
        (letter,) = letters(_with_number(b"maxp", 4, 0), "a")
        assert letter.region.area > 0


def _with_number(table, place, number):
    (offset,) = struct.unpack_from(">L", TRUETYPE, TRUETYPE.index(table) + 8)
    at = offset + place
    return TRUETYPE[:at] + struct.pack(">H", number) + TRUETYPE[at + 2 :]


def test_a_letter_moves_the_next_by_no_more_than_some_ems():
    def widen(font: TTFont) -> None:
        font["hmtx"].metrics["a"] = (60_000, 0)

    first, second = (letter.advance for letter in letters(changed(TRUETYPE, widen), "ab"))
    # Older versions of HarfBuzz take so large a number for none.
    assert first in (0.0, 8.0)
    assert second == 0.6


@pytest.mark.parametrize(
    ("data", "without", "problem"),
    [(TRUETYPE, b"glyf", "without outlines"), (POSTSCRIPT, b"CFF ", "without outlines")],
)
def test_fonts_without_outlines(data, without, problem):
    with pytest.raises(ReadError, match=problem):
        letters(data.replace(without, b"zzzz", 1), "a")
    with pytest.raises(ReadError, match=r"draws nothing for 'a'|cannot be drawn"):
        letters(data.replace(without, b"CFF2", 1), "a")


def test_a_file_that_is_too_large(tmp_path):
    with (tmp_path / "large.ttf").open("wb") as file:
        file.truncate(MAX_FONT_BYTES + 1)
    with pytest.raises(ReadError, match="larger than 50 MB"):
        container_of_words("text:a", 100, tmp_path / "large.ttf")


def _curled_font() -> bytes:
    """A font whose letter a has 15,000 curves from side to side, and whose b is small."""
    pen = TTGlyphPen(None)
    pen.moveTo((0, 0))
    for k in range(1, 15_000):
        pen.qCurveTo((900 * (k % 2), 31 * k % 900), (17 * k % 900, 13 * k % 900))
    pen.closePath()

    def curl(font: TTFont) -> None:
        font["glyf"]["b"] = font["glyf"]["a"]
        font["glyf"]["a"] = pen.glyph()
        font["glyf"]["a"].recalcBounds(font["glyf"])

    return changed(TRUETYPE, curl)


@pytest.mark.usefixtures("soon")
def test_pictures_show_no_letter_that_files_refuse(tmp_path, caplog):
    (tmp_path / "curled.ttf").write_bytes(_curled_font())
    cloud = WordCloud(str(tmp_path / "curled.ttf"), 200, 100, random_state=1)
    cloud.generate_from_frequencies({"ba": 2, "b": 1})
    assert [word for (word, _), *_ in cloud.layout_] == ["b"]
    assert "not placed: ba: is a font with a glyph" in caplog.text
    assert "<svg" in cloud.to_svg()


def test_what_is_remembered_of_fonts_is_bound_by_points(monkeypatch):
    monkeypatch.setattr(cache, "MOST_POINTS_KEPT", 10)
    asked = []

    @cache.cached_by_identity(100, len)
    def many(_face: Typeface, count: int) -> str:
        asked.append(count)
        return count * "x"

    face = Typeface(TRUETYPE, "a.ttf")
    assert [len(many(face, count)) for count in (4, 5, 4, 6, 5, 11, 4)] == [4, 5, 4, 6, 5, 11, 4]
    # Six makes five give way, and what is too large by itself all.
    assert asked == [4, 5, 6, 5, 11, 4]
