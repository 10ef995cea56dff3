"""PDFs for print shops: margin, marks, art in the bleed, read back by PDFium."""

from __future__ import annotations

from contextlib import closing
from dataclasses import replace

import numpy as np
import pypdfium2 as pdfium
import pytest

from packwork import fill
from packwork.errors import RecipeError, ShapeError
from packwork.readers.container import read_container
from packwork.scene.container import inside_margin
from packwork.scene.item import FlatArt
from packwork.scene.layout import Layout, sheet
from packwork.writers import encoded, write_options
from packwork.writers.prepress.rim import rim_of
from scenes import flat_item, poses, square

PT = 72 / 25.4


@pytest.fixture
def edged() -> Layout:
    """A sheet of 100 x 60 mm: a blue square at its left edge, a red one in the middle."""
    placed = poses([10.0, 50.0], [30.0, 30.0])
    items = tuple(
        replace(flat_item(name, square(10.0)), art=FlatArt(name)) for name in ("blue", "red")
    )
    return Layout(sheet("page", 100.0, 60.0, "mm"), items, placed, placed.scale)


def pixels(pdf: bytes, scale: float = 2.0) -> np.ndarray:
    with closing(pdfium.PdfDocument(pdf)) as document:
        return np.asarray(document[0].render(scale=scale).to_pil().convert("RGB")).astype(int)


def at(picture: np.ndarray, x_mm: float, y_mm: float, scale: float = 2.0) -> list[int]:
    """Colour at a place of the page."""
    found: list[int] = picture[round(y_mm * PT * scale), round(x_mm * PT * scale)].tolist()
    return found


@pytest.mark.parametrize("marks", ["crop", "all"])
def test_marks_lie_beyond_the_bleed(edged: Layout, marks: str) -> None:
    pdf = encoded(edged, "a.pdf", write_options(bleed="3mm", marks=marks, background="ivory"))
    with closing(pdfium.PdfDocument(pdf)) as document:
        page = document[0]
        left, low, right, high = page.get_trimbox()
        bleed = page.get_bleedbox()
        width, height = page.get_size()
    assert (right - left, high - low) == pytest.approx((100 * PT, 60 * PT), abs=1e-3)
    assert bleed == pytest.approx((left - 3 * PT, low - 3 * PT, right + 3 * PT, high + 3 * PT))
    picture = pixels(pdf, 4.0)
    dark = np.argwhere(picture.max(axis=2) < 100)
    x, y = dark[:, 1] / 4.0, height - dark[:, 0] / 4.0
    assert len(dark) > 100
    inside = (x > bleed[0]) & (x < bleed[2]) & (y > bleed[1]) & (y < bleed[3])
    assert not inside.any()
    # Registration marks alone stand in the middle of a side.
    assert (np.abs(x - width / 2) < 2 * PT).any() == (marks == "all")


def test_marks_are_in_all_inks(edged: Layout) -> None:
    assert b"/All" in encoded(edged, "a.pdf", write_options(marks="crop"))


def test_art_at_the_edge_is_mirrored_in_the_bleed(edged: Layout) -> None:
    picture = pixels(encoded(edged, "a.pdf", write_options(bleed="3mm", background="white")))
    assert at(picture, 1.0, 33.0) == at(picture, 8.0, 33.0) == [0, 0, 255]
    # Nothing of what ends before the edge.
    assert at(picture, 53.0, 1.0) == [255, 255, 255]
    seam = picture[round(33 * PT * 2), : round(20 * PT * 2)]
    assert np.ptp(seam, axis=0).tolist() == [0, 0, 0]


def test_only_what_touches_the_edge_is_mirrored(edged: Layout) -> None:
    rim = rim_of(edged)
    assert rim is not None
    assert [item.name for item in rim.items] == ["blue"]
    inner = replace(edged, poses=replace(edged.poses, x=edged.poses.x + 1.0))
    assert rim_of(inner) is None


@pytest.mark.parametrize("shape", ["heart", "circle", "page", "star"])
def test_a_container_leaves_the_margin(shape: str) -> None:
    container = read_container(shape, "A5")
    left, top, right, bottom = inside_margin(container, 12.0).outline.bounds
    assert min(left, top, container.width - right, container.height - bottom) >= 12 - 1e-9
    assert inside_margin(container, 12.0).canvas == container.canvas


def test_a_container_with_room_stays_as_it_is() -> None:
    container = read_container("heart", "A5")
    small = inside_margin(container, 20.0)
    assert inside_margin(small, 10.0).outline.bounds == pytest.approx(small.outline.bounds)


def test_a_margin_that_leaves_nothing_is_refused() -> None:
    with pytest.raises(ShapeError):
        inside_margin(read_container("page", "A6"), 60.0)


def test_nothing_is_placed_in_the_margin() -> None:
    layout = fill(
        "page", "star", count=4, canvas="A6", margin="8mm", levels="24", epochs=4, effort="draft"
    )
    bounds = np.array([outline.bounds for outline in layout.outlines])
    assert bounds[:, :2].min() >= 8
    assert (bounds[:, 2:] <= [105 - 8, 148 - 8]).all()
    assert (layout.container.width, layout.container.height) == (105, 148)


def test_a_margin_wider_than_the_sheet_is_refused() -> None:
    with pytest.raises(RecipeError, match="margin: 60mm leaves nothing of the sheet"):
        fill("page", "star", canvas="A6", margin="60mm")
