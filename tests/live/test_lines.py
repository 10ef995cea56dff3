"""Words on lines: set again where words, lines or the container change, in their colours."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import packwork as pw
from packwork.errors import RecipeError
from packwork.live.commands.command import named_container
from packwork.live.document import Document
from packwork.live.face.lines import put_anew, words_in
from packwork.live.kinds import LineKind
from packwork.live.relayout import poured_again
from packwork.readers.fonts.face import bundled_typeface
from packwork.scene.container import tiled
from packwork.scene.recolour import one_colour

TABLE = {"apple": 9, "cider": 7, "press": 5, "barrel": 4, "bloom": 3, "pear": 3, "oak": 2, "bee": 2}


@pytest.fixture(scope="module")
def badge() -> pw.Layout:
    return pw.words("circle", TABLE, ring=("OLD ORCHARD", "HEREFORD"), effort="draft")


def put(session: pw.Session, **asked: object) -> None:
    made = put_anew(session.document, 0, lambda _: None, **asked)
    session.do_together(made(session.library))


def names(document: Document) -> set[str]:
    return {item.name for item in document.items}


def test_a_badge_is_set_anew_with_other_words_in_their_colours_and_undone(
    badge: pw.Layout,
) -> None:
    session = badge.edit()
    before = session.document
    assert before.kind == LineKind(ring=("OLD ORCHARD", "HEREFORD"))
    assert words_in(before) == TABLE
    session.do("recolour", items=session.find("cider"), colour="#123456")
    words = {**TABLE, "bee": 12}
    del words["oak"]
    put(session, words=words)
    assert session.settle().certified
    now = session.document
    assert words_in(now) == words
    assert names(now) == {*words, "OLD ORCHARD", "HEREFORD"}
    assert now.left_out == {"oak": 2}
    drawn = next(item for item in now.items if item.name == "cider").art
    assert (one_colour(drawn) or ())[:3] == (0x12, 0x34, 0x56)
    areas = dict(zip((item.name for item in now.items), now.areas.tolist(), strict=True))
    assert areas["bee"] > 0.5 * areas["apple"]
    assert session.undo()
    assert np.array_equal(session.document.poses.x, before.poses.x)
    assert session.document.kind == before.kind


def test_words_come_from_where_there_is_room_onto_lines_and_back(badge: pw.Layout) -> None:
    session = badge.edit()
    put(session, along="edge", ring=())
    assert session.document.kind == LineKind(along="edge")
    assert session.settle().certified
    assert any(run.angle for item in session.document.items for run in item.text.runs)
    put(session, along=None, ring=())
    assert session.document.kind.name == "collage"
    assert session.settle().certified
    assert names(session.document) == set(TABLE)
    assert not any(run.angle for item in session.document.items for run in item.text.runs)


def test_what_lines_have_not_is_said(badge: pw.Layout) -> None:
    with pytest.raises(RecipeError, match="pour: words on lines have one layout"):
        poured_again(badge.edit().document, 1)
    session = pw.fill("circle", "star", count=3, effort="draft").edit()
    with pytest.raises(RecipeError, match="along: is for words, and there are none"):
        put_anew(session.document, 0, lambda _: None, along="edge")


def test_a_cloud_that_keeps_shares_is_certified_on_lines_and_back() -> None:
    session = pw.words("circle", TABLE, effort="draft").edit()
    assert session.layout.manifest["promised"]["areas_in_shares"]
    for along, ring in (("edge", ()), (None, ("OLD ORCHARD",))):
        put(session, along=along, ring=ring)
        assert session.settle().certified
        assert not session.layout.manifest["promised"]["areas_in_shares"]
    put(session, along=None, ring=())
    assert session.settle().certified
    assert session.layout.manifest["promised"]["areas_in_shares"]


def test_what_would_be_lost_on_lines_is_named(badge: pw.Layout) -> None:
    session = pw.words("circle", TABLE, effort="draft").edit()
    session.hold("apple")
    with pytest.raises(RecipeError, match=r"along: sets all words anew; release first .*: apple"):
        put_anew(session.document, 0, lambda _: None, along="edge")
    session.release("apple")
    session.add("star")
    with pytest.raises(RecipeError, match=r"along: is for words alone; .* none: star"):
        put_anew(session.document, 0, lambda _: None, along="edge")
    with pytest.raises(RecipeError, match="ring: has no room for 'WWWW"):
        put_anew(badge.edit().document, 0, lambda _: None, ring=("W" * 190,))


def test_a_word_spelled_like_a_text_round_it_is_a_word(badge: pw.Layout) -> None:
    session = badge.edit()
    put(session, ring=("cider", "HEREFORD"))
    assert words_in(session.document) == TABLE
    put(session, ring=())
    assert words_in(session.document) == TABLE
    assert names(session.document) == set(TABLE)


@pytest.mark.parametrize(
    ("kind", "values"),
    [
        ("remove", {"items": (0,)}),
        ("hold", {"items": (0,)}),
        ("move", {"item": 0, "x": 1.0, "y": 1.0}),
        ("grab", {"items": (0,)}),
        ("duplicate", {"item": 0}),
    ],
)
def test_no_hand_pushes_words_off_their_lines(
    badge: pw.Layout, kind: str, values: dict[str, object]
) -> None:
    session = badge.edit()
    before = session.document
    with pytest.raises(RecipeError, match=f"{kind}: words on lines lie where these have room"):
        session.do(kind, **values)
    assert session.document is before


def test_lines_need_an_edge(badge: pw.Layout) -> None:
    session = badge.edit()
    sheet = pw.fill("page", "star", count=1, effort="draft").container
    asset = named_container(session.library, tiled(sheet, "square"))
    with pytest.raises(RecipeError, match="tile: has no edge, which words on lines would need"):
        session.do("set_container", asset=asset)
    for given in ({"along": "edge"}, {"ring": "CIDER"}):
        with pytest.raises(RecipeError, match=f"{next(iter(given))}: needs a container's edge"):
            pw.words("page", TABLE, tile="square", **given)


HEBREW = Path(__file__).parents[1] / "readers" / "fonts" / "NotoSansHebrew.ttf"


def test_fonts_of_words_are_kept_or_it_is_said(badge: pw.Layout, tmp_path: Path) -> None:
    own = tmp_path / "own.otf"
    own.write_bytes(bundled_typeface().file.data)
    words, fonts = {**TABLE, "שלום": 8}, [str(own), str(HEBREW)]
    session = pw.words("circle", words, fonts=fonts, effort="draft").edit()
    put(session, along="edge", ring=("TOP",))
    assert words_in(session.document) == words
    found = {
        item.name: {run.font.name for run in item.text.runs} for item in session.document.items
    }
    assert {Path(name).name for name in found.pop("שלום")} == {HEBREW.name}
    assert {Path(name).name for one in found.values() for name in one} == {own.name}
    session = badge.edit()
    [apple] = pw.words("circle", {"apple": 1}, fonts=[str(own)], effort="draft").items
    document = session.document
    items = tuple(apple if one.name == "apple" else one for one in document.items)
    with pytest.raises(RecipeError, match=r"font: is one for all words on lines, not .*own\.otf"):
        put_anew(replace(document, items=items), 0, lambda _: None, along="edge", ring=())
