"""Round shapes in pieces: the same drawing, alike in every program."""

from __future__ import annotations

import xml.etree.ElementTree as ET

import numpy as np
import pytest

from packwork.geometry.polygon import region
from packwork.readers.svg.item import item_of_svg, with_short_arcs
from packwork.readers.svg_syntax.path_data import parse_path
from packwork.readers.svg_syntax.shapes import flattened, shape_pieces
from packwork.scene.layout import Layout
from packwork.writers.pdf import pdf_bytes
from printed import read_pdf
from scenes import poses, square_container

ROUND = {
    "circle": '<circle cx="50" cy="40" r="30"/>',
    "ellipse": '<ellipse cx="50" cy="40" rx="30" ry="9"/>',
    "ellipse of one radius": '<ellipse cx="50" cy="40" rx="30"/>',
    "in mm": '<circle cx="1cm" cy="10mm" r="5mm"/>',
    "small": '<circle cx="500" cy="400" r="0.003"/>',
    "rounded": '<rect x="10" y="20" width="60" height="30" rx="9" ry="4"/>',
    "arcs": '<path d="M10 50a40 25 30 0 1 80 0 10 10 0 0 0-80 0z"/>',
    "arcs and more": '<path d="M10 50A40 40 0 0 1 90 50s9 9-20 20q5 5-20 9L10 60 H5z m9 9h4v4"/>',
    "radii too short": '<path d="M0 0A1 2 20 1 1 60 30Z"/>',
}
PLAIN = {
    "rect": '<rect width="9" height="4"/>',
    "path": '<path d="M0 0h9v4z"/>',
    "share of the page": '<circle cx="50%" cy="5" r="3"/>',
    "no radius": '<circle cx="5" cy="5" r="0"/>',
    "marked": '<g><marker id="m"/><path d="M0 0a9 9 0 0 1 9 9" marker-mid="url(#m)"/></g>',
}


def shape(markup: str) -> ET.Element:
    return ET.fromstring(f"<svg>{markup}</svg>")  # noqa: S314


@pytest.mark.parametrize("name", ROUND)
def test_the_region_stays_what_it_was(name: str) -> None:
    before = shape(ROUND[name])
    after = with_short_arcs(before)
    assert [element.tag for element in after] == ["path"]
    size = np.ptp(np.concatenate([p.segments for p in shape_pieces(before[0], (0, 0))]), axis=0)
    tolerance = 1e-8 * float(size.max())
    old, new = (
        region([flattened(piece, tolerance) for piece in pieces])
        for pieces in (shape_pieces(before[0], (0, 0)), parse_path(after[0].get("d", "")))
    )
    assert old.symmetric_difference(new).area < 3e-6 * old.area


@pytest.mark.parametrize("name", PLAIN)
def test_other_shapes_keep_their_form(name: str) -> None:
    before = shape(PLAIN[name])
    assert ET.tostring(with_short_arcs(before)) == ET.tostring(before)


def test_what_a_shape_looks_like_stays() -> None:
    before = shape('<g fill="red"><circle r="3" id="a" stroke="blue" transform="scale(2)"/></g>')
    text = ET.tostring(before)
    (after,) = with_short_arcs(before)[0]
    assert {k: v for k, v in after.attrib.items() if k != "d"} == {
        "id": "a", "stroke": "blue", "transform": "scale(2)",
    }  # fmt: skip
    assert ET.tostring(before) == text, "the drawing itself is left alone"


@pytest.mark.parametrize("name", ["circle", "ellipse", "rounded", "arcs", "radii too short"])
def test_another_program_draws_what_was_measured(name: str) -> None:
    """Quarters of circles as single cubics would be off by 2.8e-4 of the area."""
    item = item_of_svg(f'<svg viewBox="-99 -99 300 300">{ROUND[name]}</svg>'.encode(), "a", "a")
    layout = Layout(square_container(), (item,), poses([50.0], [50.0], 0.3, 0.5), np.ones(1))
    (seen,) = read_pdf(pdf_bytes(layout)).regions
    assert seen.area * (96 / 25.4) ** 2 == pytest.approx(layout.inks[0].area, rel=1e-4)
