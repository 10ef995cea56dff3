"""PDFs, read back by PDFium: sizes, places, areas, looks."""

from __future__ import annotations

import io
import re
from collections.abc import Callable
from dataclasses import fields, replace

import numpy as np
import pytest
import shapely
import typst
from PIL import Image

from packwork.errors import WriteError
from packwork.geometry.polygon import silhouette
from packwork.readers.builtin import builtin_item
from packwork.readers.svg.item import item_of_svg
from packwork.scene.container import brought_over, on_canvas
from packwork.scene.item import Item, PictureArt, VectorArt
from packwork.scene.layout import Layout
from packwork.scene.pose import Poses
from packwork.units import canvas_size
from packwork.writers.bitmaps import png_bytes
from packwork.writers.cutting import CutOptions
from packwork.writers.pdf import pdf_bytes, without_text
from packwork.writers.pictures import MAX_PICTURE_PX
from packwork.writers.svg import SvgOptions
from printed import pdf_pixels, read_pdf

INKED = 250
"""Channels below this are ink on white."""

TEXT = b'<svg viewBox="0 0 90 40"><text y="30" font-size="30" fill="teal">Abc</text></svg>'
DASHES = (
    b'<svg viewBox="0 0 90 90"><path d="M20 60 L45 20 L70 60" fill="none" stroke="#123"'
    b' stroke-width="12" stroke-linecap="round" stroke-linejoin="round"/></svg>'
)


def lettered_item() -> Item:
    """Item whose drawing still holds text, as one with very many texts does."""
    markup = '<text x="-20" y="10" font-size="30" fill="teal">Abc</text>'
    return replace(item_of_svg(TEXT, "text", "text.svg"), art=VectorArt(markup, np.eye(2, 3)))


@pytest.fixture
def sheet(make_layout: Callable[..., Layout]) -> Callable[..., Layout]:
    """Layouts on a sheet of 200 x 150 mm, the items in two rows."""

    def make(*items: Item, size: str = "200x150mm") -> Layout:
        turns = np.linspace(0.0, 5.0, len(items))
        x, y = 8.0 + 64.0 * np.linspace(0, 1, len(items)), np.resize([20.0, 40.0], len(items))
        layout = make_layout(items, x=x, y=y, angle=turns, scale=np.full(len(items), 0.2))
        container = on_canvas(layout.container, canvas_size(size))
        poses = brought_over(layout.poses, layout.container, container)
        return replace(layout, container=container, poses=poses)

    return make


def alone(layout: Layout, k: int) -> Layout:
    """The same layout with one item only."""
    poses = Poses(*(getattr(layout.poses, field.name)[[k]] for field in fields(Poses)))
    return replace(layout, items=layout.items[k : k + 1], poses=poses, weights=layout.weights[[k]])


def ink_of(picture: np.ndarray) -> np.ndarray:
    return np.asarray(picture[..., :3].min(axis=2) < INKED)


def shared(one: np.ndarray, other: np.ndarray) -> float:
    """Intersection over union of the inked pixels."""
    return float((one & other).sum() / (one | other).sum())


@pytest.mark.parametrize("cut", [None, CutOptions(line="outlines")])
def test_no_suspects_are_written(sheet: Callable[..., Layout], cut: CutOptions | None) -> None:
    # Poppler: "Suspects object is wrong type (boolean)", of the boolean that the format asks for.
    data = pdf_bytes(sheet(builtin_item("star")), SvgOptions(cut=cut))
    assert data.count(b"/MarkInfo") == 1
    assert re.search(rb"/MarkInfo << /Marked true >>", data)
    assert b"/Suspects" not in data
    table = int(data[data.rindex(b"startxref") :].split()[1])
    assert data[table : table + 4] == b"xref"


@pytest.mark.parametrize(
    ("size", "width", "height"),
    [("200x150mm", 200, 150), ("8in", 203.2, 152.4), ("A4", 210, 297), ("96x48", 25.4, 12.7)],
)
def test_the_page_is_as_large_as_the_canvas(
    sheet: Callable[..., Layout], size: str, width: float, height: float
) -> None:
    page = read_pdf(pdf_bytes(sheet(size=size)))
    assert (page.width, page.height) == pytest.approx((width, height), abs=1e-3)


@pytest.mark.parametrize("name", ["bicycle", "octopus", "heart", "moon", "butterfly", "ring"])
def test_areas_and_places_come_back(name: str, sheet: Callable[..., Layout]) -> None:
    layout = sheet(*[builtin_item(name)] * 3)
    for k, outline in enumerate(layout.outlines):
        page = read_pdf(pdf_bytes(alone(layout, k)))
        seen = silhouette(shapely.union_all(page.regions))
        assert seen.area == pytest.approx(outline.area, rel=1e-4)
        assert shapely.distance(seen.centroid, outline.region.centroid) < 0.01


def test_a_path_is_within_the_precision_of_its_measured_outline(
    sheet: Callable[..., Layout], ring_item: Item
) -> None:
    layout = sheet(*[ring_item] * 5)
    page = read_pdf(pdf_bytes(layout))
    for seen, ink in zip(page.regions, layout.inks, strict=True):
        assert shapely.hausdorff_distance(seen, ink.region) < 1e-6 * layout.container.side


def test_strokes_are_ink(sheet: Callable[..., Layout]) -> None:
    layout = sheet(item_of_svg(DASHES, "roof", "roof.svg"))
    (seen,) = read_pdf(pdf_bytes(layout)).regions
    assert seen.area == pytest.approx(layout.inks[0].area, rel=1e-4)


@pytest.mark.parametrize("options", [SvgOptions(), SvgOptions(show_container=True)])
def test_it_looks_like_the_png(
    options: SvgOptions,
    sheet: Callable[..., Layout],
    ring_item: Item,
    star_item: Item,
) -> None:
    icons = [builtin_item(name) for name in ("bicycle", "donut", "umbrella")]
    layout = sheet(ring_item, star_item, *icons, item_of_svg(TEXT, "text", "text.svg"))
    seen = ink_of(pdf_pixels(pdf_bytes(layout, options), 1600))
    assert shared(seen, seen) == 1 > shared(seen, np.roll(seen, 3, axis=1))
    with Image.open(
        io.BytesIO(
            png_bytes(
                layout,
                1600,
                replace(options, background="#ffffff"),
            )
        )
    ) as picture:
        expected = ink_of(np.asarray(picture))
    assert shared(seen, expected) >= 0.99


def test_colours_gradients_and_backgrounds_are_kept(
    sheet: Callable[..., Layout], star_item: Item
) -> None:
    layout = sheet(star_item, star_item)
    got = pdf_pixels(pdf_bytes(layout, SvgOptions(background="ivory")), 800)
    with Image.open(io.BytesIO(png_bytes(layout, 800))) as picture:
        expected = np.asarray(picture)[..., :3].astype(float)
    assert got[0, 0].tolist() == [255, 255, 240]
    inside = ink_of(expected)
    assert np.abs(got - expected)[inside].mean() < 3


def test_only_text_becomes_pictures(
    sheet: Callable[..., Layout], star_item: Item, photo_item: Item
) -> None:
    text = lettered_item()
    layout = without_text(sheet(star_item, text, photo_item, text))
    kinds = [type(item.art) for item in layout.items]
    assert kinds == [VectorArt, PictureArt, PictureArt, PictureArt]
    assert layout.items[1].art is layout.items[3].art
    assert layout.items[0] is star_item
    plain = sheet(star_item)
    assert without_text(plain) is plain


@pytest.mark.parametrize("size", ["200x150mm", "A0", "1x1mm", "1000000"])
def test_pictures_of_text_have_a_bearable_size(size: str, sheet: Callable[..., Layout]) -> None:
    art = without_text(sheet(lettered_item(), size=size)).items[0].art
    assert isinstance(art, PictureArt)
    assert 1 < max(art.width, art.height) <= MAX_PICTURE_PX


def test_same_layout_same_bytes(three: Layout) -> None:
    assert pdf_bytes(three) == pdf_bytes(three)


@pytest.mark.parametrize(
    "name", ['a"b', "R&D", "nul\0bell\x07", "\ud800", "🦊 fox", "#set(", "n" * 999]
)
def test_hostile_names(three: Layout, name: str) -> None:
    items = tuple(replace(item, name=name) for item in three.items)
    layout = replace(three, items=items, container=replace(three.container, name=name))
    assert pdf_bytes(layout).startswith(b"%PDF")


def test_broken_art_is_one_clear_line(make_layout: Callable[..., Layout], star_item: Item) -> None:
    for markup in ("<g>", "<text>"):
        broken = replace(star_item, art=VectorArt(markup, np.eye(2, 3)))
        with pytest.raises(WriteError, match="cannot be rendered") as caught:
            pdf_bytes(make_layout([broken]))
        assert "\n" not in str(caught.value)


def test_a_refusal_of_the_setter_is_one_clear_line(
    three: Layout, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse(*_: object, **__: object) -> bytes:
        raise typst.TypstError("no\npage")

    monkeypatch.setattr(typst, "compile", refuse)
    with pytest.raises(WriteError, match=r"cannot be rendered \(no page\)"):
        pdf_bytes(three)
