"""Glyphs come back from where they are kept as they were drawn."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import shapely

from packwork.folders import Store
from packwork.geometry.outline import Outline
from packwork.readers import cache
from packwork.readers.cache import GlyphInk, kept_glyph, packed_glyph, unpacked_glyph
from packwork.readers.fonts.face import bundled_typeface
from packwork.readers.fonts.glyph_ink import glyph_ink


@pytest.fixture
def store(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Store:
    monkeypatch.setenv("PACKWORK_CACHE_DIR", str(tmp_path))
    store = Store("glyphs", 10_000_000)
    monkeypatch.setattr(cache, "GLYPHS", store)
    return store


def letter(text: str) -> GlyphInk:
    face = bundled_typeface()
    [glyph] = face.shaped(text).glyphs
    return glyph_ink.__wrapped__(face, glyph.number, 1.0)


def same(one: Outline | None, other: Outline | None) -> bool:
    if one is None or other is None:
        return one is other
    return np.array_equal(one.points, other.points) and np.array_equal(one.starts, other.starts)


@pytest.mark.parametrize("text", ["o", "i", "B", "%", " "])
def test_a_glyph_comes_back_bit_for_bit(
    text: str, store: Store, monkeypatch: pytest.MonkeyPatch
) -> None:
    drawn = letter(text)

    def never(*_: object) -> GlyphInk:
        raise AssertionError("drawn anew")

    monkeypatch.setattr("packwork.readers.fonts.glyph_ink._drawn", never)
    back = letter(text)
    assert back.clearance == drawn.clearance
    assert shapely.to_wkb(back.region) == shapely.to_wkb(drawn.region)
    assert same(back.ink, drawn.ink)
    assert same(back.silhouette, drawn.silhouette)


def test_other_tolerances_and_other_code_draw_anew(
    store: Store, monkeypatch: pytest.MonkeyPatch
) -> None:
    glyph, asked = letter("o"), list[str]()

    def draw(name: str) -> GlyphInk:
        asked.append(name)
        return glyph

    kept_glyph(("font", 7, 1.0), lambda: draw("first"))
    kept_glyph(("font", 7, 1.0), lambda: draw("again"))
    kept_glyph(("font", 7, 0.5), lambda: draw("finer"))
    monkeypatch.setattr(cache, "reader_version", lambda: "another")
    kept_glyph(("font", 7, 1.0), lambda: draw("other code"))
    assert asked == ["first", "finer", "other code"]


def test_what_is_damaged_is_no_glyph() -> None:
    whole = packed_glyph(letter("B"))
    for length in range(0, len(whole), 7):
        assert unpacked_glyph(whole[:length]) is None
    assert unpacked_glyph(whole + b"12345678") is None
