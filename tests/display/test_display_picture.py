"""What a notebook is given: SVGs that bear company, PNGs where those are too long."""

from __future__ import annotations

import re
from dataclasses import replace
from io import BytesIO
from xml.etree import ElementTree as ET

import numpy as np
import pytest
from PIL import Image

from packwork.display import picture
from packwork.display.picture import notebook_png, notebook_svg
from packwork.geometry import affine
from packwork.scene.item import Item, PictureArt, VectorArt
from packwork.scene.layout import Layout
from packwork.writers.svg import svg_text
from scenes import disc, flat_item, poses, round_container, square, star


def layout_of(*items: Item) -> Layout:
    """Items in a row on a disc of 100 units."""
    count = len(items)
    row = poses(np.linspace(30, 70, count), np.full(count, 50.0), 0.0, 5.0)
    return Layout(round_container(), items, row, np.ones(count))


def picture_item() -> Item:
    """Item that is a picture of 4 x 4 pixels."""
    file = BytesIO()
    Image.new("RGBA", (4, 4), "teal").save(file, "PNG")
    tile = square(2.0)
    place = affine.similarity(-2.0, -2.0, 0.0, 1.0)
    return Item("photo", "photo.png", tile, tile, PictureArt(file.getvalue(), 4, 4, place))


def used_ids(document: str) -> set[str]:
    return set(re.findall(r'xlink:href="#([^"]+)"', document))


def test_each_use_finds_its_shape_and_no_other_layouts() -> None:
    stars, discs = (layout_of(flat_item("a", shape)) for shape in (star(), disc()))
    assert used_ids(svg_text(stars)) == used_ids(svg_text(discs)), "nothing to tell apart"
    seen = [notebook_svg(layout) or "" for layout in (stars, discs)]
    for document in seen:
        root = ET.fromstring(document)  # noqa: S314
        ids = [element.get("id") for element in root.iter() if element.get("id")]
        assert used_ids(document) <= set(ids)
        assert len(ids) == len(set(ids))
    assert not used_ids(seen[0]) & used_ids(seen[1])


def test_the_same_layout_gives_the_same_text() -> None:
    assert notebook_svg(layout_of(flat_item("a", star()))) == notebook_svg(
        layout_of(flat_item("a", star()))
    )


def test_names_that_look_like_references_stay_as_they_are() -> None:
    document = notebook_svg(layout_of(flat_item('x id="shape-1"', star()))) or ""
    names = [e.get("data-name") for e in ET.fromstring(document).iter()]  # noqa: S314
    assert 'x id="shape-1"' in names


@pytest.mark.parametrize(
    ("width", "height", "shown"), [(100, 50, (600, 300)), (30, 120, (150, 600))]
)
def test_any_canvas_fits_a_column(width: float, height: float, shown: tuple[int, int]) -> None:
    layout = layout_of(flat_item("a", star()))
    sheet = replace(layout.container, width=width, height=height, unit="mm")
    root = ET.fromstring(notebook_svg(replace(layout, container=sheet)) or "")  # noqa: S314
    assert (float(root.get("width", "")), float(root.get("height", ""))) == shown


def test_what_would_be_a_long_svg_is_a_png(monkeypatch: pytest.MonkeyPatch) -> None:
    markup = "<path d='M0 0h1v1z'/>"
    shape = square(1.0)
    vector = Item("v", "v", shape, shape, VectorArt(markup, affine.identity()))
    layouts = [layout_of(item) for item in (flat_item("a", star()), vector, picture_item())]
    for layout in layouts:
        assert notebook_png(layout) is None
        assert notebook_svg(layout) is not None
    monkeypatch.setattr(picture, "LONGEST_SVG", 10)
    for layout in layouts:
        assert notebook_svg(layout) is None
        found = notebook_png(layout)
        assert found is not None
        png, shown = found
        assert Image.open(BytesIO(png)).size == (1200, 1200)
        assert shown == {"width": 600, "height": 600}


@pytest.mark.parametrize("copies", [1, 50])
def test_the_length_is_foreseen_within_a_factor_of_two(copies: int) -> None:
    items = [flat_item("a", disc(1.0, 3_000)), picture_item()]
    layout = layout_of(*(items * copies))
    foreseen = sum(picture._length(item) for item in items) + picture._PER_COPY * 2 * copies
    assert 0.5 < foreseen / len(notebook_svg(layout) or "") < 2
