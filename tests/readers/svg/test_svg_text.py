"""Texts in drawings become outlines, whoever has which fonts."""

from __future__ import annotations

import os
import struct

import pytest
import shapely

from made_fonts import renamed_font
from packwork import fonts
from packwork.readers.fonts.face import bundled_typeface
from packwork.readers.svg import lettering
from packwork.readers.svg.item import item_of_svg
from packwork.scene.item import VectorArt

SPACES = 'xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"'
BUNDLED = 'font-family="Inter Display"'


pytestmark = pytest.mark.usefixtures("machine")


def item_of(body: str, page: str = 'viewBox="0 0 100 100"'):
    data = f"<svg {SPACES} {page}>{body}</svg>".encode()
    return item_of_svg(data, "sign", "sign.svg", is_compared=True)


def markup(item) -> str:
    assert isinstance(item.art, VectorArt)
    return item.art.markup


def test_text_is_paths_of_its_own_colour(art_iou, caplog):
    item = item_of(f'<text x="5" y="60" font-size="40" fill="teal" {BUNDLED}>HO</text>')
    assert "<text" not in markup(item)
    assert 'fill="teal"' in markup(item)
    assert len(item.ink.rings) == 3
    assert art_iou(item) > 0.98
    assert caplog.text == ""


def test_text_is_where_the_renderer_puts_it():
    plain = item_of(f'<text x="5" y="60" font-size="40" {BUNDLED}>H</text>')
    moved = item_of(
        f'<g transform="translate(50 20) scale(.5)" font-size="80"><text x="50%"'
        f' text-anchor="middle" dy=".3em" {BUNDLED}>H</text></g>'
    )
    assert moved.ink.area == pytest.approx(plain.ink.area, rel=0.01)


def test_letters_keep_the_curves_of_their_font():
    face = bundled_typeface()
    curves = face.drawing(face.shaped("O").glyphs[0].number)
    data = "".join(letter + " ".join(map(str, numbers)) for letter, numbers in curves)
    drawn = item_of(f'<path transform="translate(0 90) scale({80 / face.units})" d="{data}"/>')
    text = item_of(f'<text y="90" font-size="80" {BUNDLED}>O</text>')
    distance = shapely.hausdorff_distance(text.ink.region, drawn.ink.region, densify=0.05)
    assert distance < 0.001 * drawn.ink.extent


def test_letters_of_several_paints_are_several_paths(art_iou):
    item = item_of(
        f'<text y="60" font-size="30" fill="red" {BUNDLED}>H<tspan fill="none" stroke="#00f">I'
        '</tspan>L<tspan visibility="hidden">X</tspan></text>'
    )
    assert markup(item).count("<path") == 3
    assert 'stroke="#00f"' in markup(item)
    assert art_iou(item) > 0.98


def test_a_missing_font_is_named_once(caplog):
    body = '<text y="{}" font-size="30" font-family="\'Gill Nowhere\', Nor This">Abc</text>'
    item = item_of(body.format(40) + body.format(80))
    assert item.ink.area > 100
    assert caplog.text.count("sign.svg: the font 'Gill Nowhere' is not installed") == 1
    assert f"set in {fonts.fonts_for([], '').serif!r}" in caplog.text


def test_text_on_a_path(art_iou):
    item = item_of(
        '<defs><path id="p" d="M10 60C20 10 80 10 90 60"/></defs>'
        f'<text font-size="14" {BUNDLED}><textPath xlink:href="#p">along it</textPath></text>'
    )
    left, top, right, bottom = item.ink.bounds
    assert bottom - top > 0.3 * (right - left)
    assert art_iou(item) > 0.98


def test_text_without_a_page(art_iou):
    item = item_of(f'<text x="-300" y="60" font-size="40" {BUNDLED}>HO</text>', "")
    assert len(item.ink.rings) == 3
    assert art_iou(item) > 0.98


@pytest.mark.parametrize("hide", ["opacity='0'", "display='none'", "visibility='hidden'"])
def test_hidden_text_is_nothing(hide, caplog):
    item = item_of(f'<g {hide}><text y="50">A</text></g><rect width="9" height="9"/>')
    assert item.ink.area == pytest.approx(81)
    assert "<text" not in markup(item)
    assert caplog.text == ""


@pytest.mark.parametrize("place", ["scale(0 1)", "translate(1e6)"])
def test_text_that_cannot_show_is_dropped(place):
    item = item_of(f'<text transform="{place}" y="50">A</text><rect width="9" height="9"/>')
    assert item.ink.area == pytest.approx(81)


def test_text_that_is_used_again_stays_text(caplog):
    item = item_of(
        f'<defs><text id="t" y="30" font-size="25" {BUNDLED}>H</text></defs><use href="#t"/>'
    )
    assert "<text" in markup(item)
    assert "sign.svg: some of its text stays text" in caplog.text


def test_many_texts_stay_text(monkeypatch, caplog):
    monkeypatch.setattr(lettering, "MAX_TEXTS", 1)
    item = item_of(f'<text y="30" font-size="25" {BUNDLED}>H</text><text y="70">I</text>')
    assert markup(item).count("<text") == 2
    assert "some of its text stays text" in caplog.text


def test_text_that_stays_text_is_drawn_and_measured(art_iou):
    item = item_of('<defs><text id="t" y="60" font-size="40">HO</text></defs><use href="#t"/>')
    assert "<text" in markup(item)
    assert item.ink.area > 400
    assert art_iou(item) > 0.97


def test_text_in_masks_and_patterns_is_drawn():
    cut = item_of(
        '<mask id="m"><text y="60" font-size="40" fill="white">HO</text></mask>'
        '<rect width="100" height="100" mask="url(#m)"/>'
    )
    assert 400 < cut.ink.area < 2_000


def test_families_in_order_of_the_wish(machine):
    assert fonts.family_names(" 'A  B' ,, \"C\",serif") == ["A B", "C", "serif"]
    assert fonts.replaced_families(["inter display, Arial", "serif"]) == {}
    serif = {
        "no fonts": fonts.BUNDLED_FAMILY,
        "DejaVu only": "DejaVu Serif",
        "many fonts": "Times New Roman",
    }[machine]
    assert fonts.fonts_for([], "a").serif == serif
    assert fonts.replaced_families(["Gill Nowhere"]) == {"Gill Nowhere": serif}


def test_letters_that_few_fonts_have_get_them_all():
    plain, rare = (fonts.fonts_for([], text).files for text in "a漢")
    everything = {file for files in fonts.installed_families().values() for file in files}
    assert set(rare) == everything
    assert set(plain) <= everything


def test_only_the_letters_of_texts_count():
    svg = '<svg><title>漢</title><text font-family="&quot;Inter Display&quot;">{}</text></svg>'
    wishes = ['"Inter Display"']
    assert fonts.fonts_of(svg.format("a")) == fonts.fonts_for(wishes, "a")
    assert fonts.fonts_of(svg.format("<tspan>&#28450;</tspan>")) == fonts.fonts_for(wishes, "漢")
    assert fonts.fonts_of("<svg><title>text</title></svg>") is None


def test_fonts_are_found_in_folders(tmp_path, monkeypatch):
    (tmp_path / "inner").mkdir()
    (tmp_path / "inner" / "a.OTF").write_bytes(renamed_font("Inter Dingbat"))
    (tmp_path / "notes.txt").write_text("none", encoding="utf-8")
    monkeypatch.setenv(fonts.FOLDERS, os.pathsep.join([str(tmp_path), str(tmp_path / "nowhere")]))
    assert set(fonts.installed_families()) == {"inter dingbat", "inter display"}
    monkeypatch.delenv(fonts.FOLDERS)
    assert "inter dingbat" not in fonts.installed_families()


def test_a_font_that_goes_away_has_no_scripts(monkeypatch, tmp_path):
    gone = {"gone": (str(tmp_path / "gone.otf"),)}
    monkeypatch.setattr(fonts, "installed_families", lambda: gone)
    assert fonts.scripts_of("gone") == []


@pytest.mark.parametrize(
    "data",
    [
        b"",
        b"OTTO",
        b"nonsense" * 9,
        struct.pack(">4s4sI", b"ttcf", b"\0\1\0\0", 2**32 - 1),
        struct.pack(">4s4sI", b"ttcf", b"\0\1\0\0", 1) + struct.pack(">I", 2**31),
        struct.pack(">4sH6x", b"OTTO", 65_535) + b"name" * 9,
        struct.pack(">4sH6x", b"OTTO", 1) + struct.pack(">4s4xII", b"name", 28, 9),
        struct.pack(">4sH6x4s4xII", b"OTTO", 1, b"name", 28, 99)
        + struct.pack(">3H6H", 0, 1, 18, 3, 1, 9, 1, 3, 0)
        + b"\xd8\x00\xd8",
    ],
)
def test_broken_fonts_are_passed_over(tmp_path, data):
    file = tmp_path / "a.ttf"
    file.write_bytes(data)
    assert fonts.family_of(str(file)) == set()


@pytest.mark.parametrize(
    ("wished", "generic"),
    [
        ("helvetica", "sans_serif"),
        ("Arial Black", "sans_serif"),
        ("'No Such Sans'", "sans_serif"),
        ("Gill Nowhere, Courier", "monospace"),
        ("'Helvetica Neue', serif", "serif"),
        ("Gill Nowhere", "serif"),
    ],
)
def test_a_font_of_the_same_kind_stands_in(monkeypatch, wished: str, generic: str) -> None:
    known = dict.fromkeys(("dejavu sans", "dejavu serif", "dejavu sans mono"), ("f",))
    monkeypatch.setattr(fonts, "installed_families", lambda: known)
    there = getattr(fonts.fonts_for([], "a"), generic)
    assert set(fonts.replaced_families([wished]).values()) == {there}
    drawn = fonts.with_stand_ins(f'<svg><text font-family="{wished}">a</text></svg>')
    assert there in drawn or generic in drawn
