"""Drawings that were read before: bit for bit the same, and never of other code or bytes."""

from __future__ import annotations

import json
import logging
from dataclasses import fields
from pathlib import Path

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from packwork.folders import Store
from packwork.readers import cache
from packwork.readers.options import ReadOptions
from packwork.readers.pages import Read
from packwork.readers.svg import item as svg_item
from packwork.readers.svg.item import read_svg
from packwork.scene.item import Item, VectorArt

RING = (
    '<svg viewBox="0 0 100 100"><defs><linearGradient id="g"><stop stop-color="red"/>'
    '</linearGradient></defs><circle cx="50" cy="50" r="30" fill="none" stroke="url(#g)" '
    'stroke-width="9"/><path d="M0 0 L9 0 L3 7.3 Z" fill="#00f"/></svg>'
)
PAGE = (
    '<svg viewBox="0 0 100 100"><rect width="100" height="100" fill="#fff"/>'
    '<circle cx="50" cy="50" r="30" fill="#123"/></svg>'
)


@pytest.fixture
def readings(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Names of the drawings that were read and not remembered; a cache of its own."""
    monkeypatch.setenv("PACKWORK_CACHE_DIR", str(tmp_path / "cache"))
    monkeypatch.setattr(cache, "DRAWINGS", Store("drawings", 10_000_000))
    anew, names = svg_item._read_anew, list[str]()

    def noting(data: bytes, name: str, *rest: object, **how: object) -> Read:
        names.append(name)
        return anew(data, name, *rest, **how)  # type: ignore[arg-type]

    monkeypatch.setattr(svg_item, "_read_anew", noting)
    return names


def same(one: Item, other: Item) -> bool:
    arts = one.art, other.art
    assert isinstance(arts[0], VectorArt)
    assert isinstance(arts[1], VectorArt)
    return (
        arts[0].markup == arts[1].markup
        and arts[0].is_traced == arts[1].is_traced
        and arts[0].matrix.tobytes() == arts[1].matrix.tobytes()
        and all(
            a.points.tobytes() == b.points.tobytes() and a.starts.tolist() == b.starts.tolist()
            for a, b in ((one.outline, other.outline), (one.ink, other.ink))
        )
    )


@pytest.mark.parametrize("drawing", [RING, PAGE])
def test_what_was_read_comes_back_bit_for_bit(
    drawing: str, tmp_path: Path, readings: list[str]
) -> None:
    for name in ("one", "other"):
        (tmp_path / f"{name}.svg").write_text(drawing, encoding="utf-8")
    one, other = (read_svg(tmp_path / f"{name}.svg") for name in ("one", "other"))
    assert readings == ["one"]
    assert same(one.item, other.item)
    assert one.page == other.page
    assert (other.item.name, other.item.source) == ("other", str(tmp_path / "other.svg"))
    assert other.item.outline.points.flags.writeable == one.item.outline.points.flags.writeable


def test_other_bytes_and_other_ways_to_read_are_read(tmp_path: Path, readings: list[str]) -> None:
    file = tmp_path / "a.svg"
    file.write_text(PAGE, encoding="utf-8")
    read_svg(file)
    read_svg(file, "keep")
    kept_page = read_svg(file, "fill", ReadOptions(keep_page=True))
    assert kept_page.item.outline.area == pytest.approx(10_000)
    file.write_text(PAGE.replace("r=", "r ="), encoding="utf-8")
    read_svg(file)
    assert len(readings) == 4


def test_other_code_reads_anew(
    tmp_path: Path, readings: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "a.svg").write_text(RING, encoding="utf-8")
    read_svg(tmp_path / "a.svg")
    monkeypatch.setattr(cache, "reader_version", lambda: "another")
    read_svg(tmp_path / "a.svg")
    assert len(readings) == 2


def test_letters_are_drawn_by_the_fonts_of_the_day(tmp_path: Path, readings: list[str]) -> None:
    text = '<svg viewBox="0 0 90 90"><text x="9" y="60" font-size="50">A</text></svg>'
    (tmp_path / "a.svg").write_text(text, encoding="utf-8")
    for _ in range(2):
        read_svg(tmp_path / "a.svg")
    assert len(readings) == 2


def test_what_is_said_of_a_drawing_is_said_each_time(
    tmp_path: Path, readings: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    noting = svg_item._read_anew

    def saying(*asked: object, **how: object) -> Read:
        logging.getLogger("packwork").warning("odd")
        return noting(*asked, **how)  # type: ignore[arg-type]

    monkeypatch.setattr(svg_item, "_read_anew", saying)
    (tmp_path / "a.svg").write_text(RING, encoding="utf-8")
    for _ in range(2):
        read_svg(tmp_path / "a.svg")
    assert len(readings) == 2


@pytest.mark.parametrize(
    "spoil",
    [
        lambda data: b"",
        lambda data: b"{}\n",
        lambda data: data[:-8],
        lambda data: data + bytes(8),
        lambda data: data.replace(b"NONE", b"NIL"),
        lambda data: data.replace(b"arrays", b"array"),
        lambda data: data[: data.index(b"\n") + 1] + np.full(99, np.nan).tobytes(),
        lambda data: b"\x80\x04" + data,
    ],
)
def test_what_is_no_reading_is_passed_over(
    spoil: object, tmp_path: Path, readings: list[str]
) -> None:
    (tmp_path / "a.svg").write_text(RING, encoding="utf-8")
    whole = cache.packed_read(read_svg(tmp_path / "a.svg"))
    # The way to read a page again is not of the file.
    assert whole is None
    whole = cache.packed_read(Read(read_svg(tmp_path / "a.svg").item, "a.svg"))
    assert whole is not None
    assert callable(spoil)
    assert cache.unpacked_read(whole, "a", "a.svg") is not None
    assert cache.unpacked_read(spoil(whole), "a", "a.svg") is None


def test_all_that_a_reading_holds_is_known_here() -> None:
    """Who adds a field has to keep it too, or leave it at its default."""
    assert {field.name for field in fields(Read)} == {"item", "file", "page", "again"}
    assert {field.name for field in fields(VectorArt)} == {"markup", "matrix", "is_traced"}


@pytest.mark.parametrize(
    "header",
    [b'{"arrays": [["<f8", [1%s]]]}' % (b"0" * 30), b"[" * 200_000, b'{"arrays": [["<f8", [-1]]]}'],
    ids=["larger than any array", "deeper than the stack", "less than nothing"],
)
def test_damaged_headers_are_passed_over(header: bytes) -> None:
    assert cache.unpacked_read(header + b"\n", "a", "a.svg") is None
    assert cache.unpacked_glyph(header + b"\n") is None


FORMS = st.tuples(
    st.sampled_from(["<f8", "<i8", "|u1", "|O", "(2,0)f8", "f"]),
    st.lists(st.integers() | st.floats() | st.none() | st.text(max_size=3), max_size=3),
)
HEADERS = st.fixed_dictionaries(
    {"arrays": st.lists(FORMS, max_size=5) | st.integers()},
    optional={
        "markup": st.text(max_size=5),
        "traced": st.booleans(),
        "fate": st.sampled_from(["NONE", "LEFT_OUT", ""]),
        "clearance": st.floats() | st.text(max_size=5) | st.integers(),
    },
)


@given(
    st.binary()
    | st.builds(
        lambda head, rest: json.dumps(head).encode() + b"\n" + rest, HEADERS, st.binary(max_size=64)
    )
)
@example(b"")
def test_any_bytes_are_a_reading_or_none(data: bytes) -> None:
    assert isinstance(cache.unpacked_read(data, "a", "a.svg"), Read | None)
    assert isinstance(cache.unpacked_glyph(data), cache.GlyphInk | None)
