"""Drawings of legal size that would take minutes: counted, coarsened or refused."""

from __future__ import annotations

from unittest.mock import Mock

import numpy as np
import pytest
import shapely

from packwork.errors import ReadError
from packwork.geometry import affine
from packwork.readers import reading
from packwork.readers.gate.door import parse_untrusted
from packwork.readers.reading import TooRichError
from packwork.readers.svg.drawing import read_drawing
from packwork.readers.svg.item import item_of_svg
from packwork.readers.svg.trace import MAX_POINTS, MAX_RINGS, touched
from packwork.readers.svg.walk import painted_shapes

PAGE = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 1000 1000">{}</svg>'
HAIRS = "".join(f"M{k / 3:.2f} 0V1000h.05V0z" for k in range(2600))
TURNS = np.linspace(0.0, 400.0, 24_000)
SPIRAL = " ".join(f"{500 + t * np.cos(t):.2f} {500 + t * np.sin(t):.2f}" for t in TURNS)


def data(body: str) -> bytes:
    return PAGE.format(body).encode()


@pytest.mark.parametrize(
    "body",
    [
        f'<path d="{HAIRS}"/>',
        f'<path d="M{SPIRAL}" fill="none" stroke="#000" stroke-linejoin="round"/>',
    ],
    ids=["hairs", "spiral"],
)
def test_rich_outlines_are_made_coarser_and_cover_what_is_drawn(body, caplog, monkeypatch):
    monkeypatch.setattr(reading, "SHAPES_NS", 5e8)
    item = item_of_svg(data(body), "a", "a.svg", is_compared=True)
    assert "is traced from its picture" in caplog.text
    assert sum(map(len, item.outline.rings)) <= MAX_POINTS
    assert len(item.outline.rings) <= MAX_RINGS
    assert item.art.is_traced


def test_hairs_too_thin_for_a_picture_are_covered():
    region = read_drawing(data(f'<path d="{HAIRS}"/>'), is_compared=True).ink.whole
    places = np.array([(k / 3 + 0.025, y) for k in range(0, 2600, 7) for y in (3.0, 497.0, 997.0)])
    assert shapely.contains_xy(region, *places.T).mean() > 0.999


@pytest.mark.parametrize(
    "body",
    [
        "<style>" + "g:nth-child(2n) path:not(.a){fill:red}" * 1500 + "</style>"
        + "<g><path d='M0 0h9v9z'/></g>" * 500,
        "<g/>" * 100_000,
        '<path d="M0 0' + "h1v1" * 90_000 + '"/>',
        '<g style="transform-box:fill-box;transform-origin:center">' * 60
        + '<path d="M0 0h9v9z"/>' * 900 + "</g>" * 60,
    ],
    ids=["rules", "elements", "segments", "boxes"],
)  # fmt: skip
def test_what_cannot_be_read_in_the_budget_is_refused_in_one_line(body):
    with pytest.raises(ReadError, match="simplify it") as refusal:
        item_of_svg(data(body), "a", "a.svg", is_compared=True)
    assert "\n" not in str(refusal.value)


@pytest.mark.parametrize(
    "filters",
    [
        '<feGaussianBlur stdDeviation="3"/>' * 80,
        '<feGaussianBlur stdDeviation="700"/>',
    ],
)
def test_filters_beyond_what_drawings_need_are_left_out(filters, caplog):
    body = f'<filter id="f">{filters}</filter><rect width="500" height="500" filter="url(#f)"/>'
    root = parse_untrusted(data(body))
    assert all("filter" not in element.attrib for element in root.iter())
    assert "filters were left out" in caplog.text


def test_one_budget_is_shared_and_counted():
    with reading.one_budget() as outer, reading.one_budget() as inner:
        assert inner is outer
        reading.spend(reading.SHAPES_NS / 2, "x")
        assert reading.left("shapes") == pytest.approx(reading.SHAPES_NS / 2)
        assert reading.left("pictures") == reading.PICTURES_NS
        with pytest.raises(TooRichError, match="has too much of it"):
            reading.spend(reading.SHAPES_NS, "has too much of it")


def test_plain_drawings_spend_little_of_their_budget():
    body = '<circle cx="50" cy="50" r="40" stroke="#000"/><text y="90" font-size="30">abc</text>'
    with reading.one_budget() as spent:
        item_of_svg(data(body), "a", "a.svg", is_compared=True)
    assert spent.left("shapes") > 0.5 * reading.SHAPES_NS
    assert spent.left("pictures") > 0.8 * reading.PICTURES_NS


def test_every_pixel_that_a_line_crosses_is_touched_and_no_other():
    path = '<path d="M5 5H95V45M20 60h0M30 70l40 20M60 95z" fill="none" stroke="#000"/>'
    root = parse_untrusted(f'<svg viewBox="0 0 100 100">{path}</svg>'.encode())
    found = touched(painted_shapes(root, None), (0.0, 0.0, 100.0, 100.0), (100, 100))
    expected = np.zeros((100, 100), dtype=bool)
    expected[5, 5:96] = expected[5:46, 95] = expected[60, 20] = True
    along = np.linspace(0.0, 1.0, 2_000)
    expected[(70 + 20 * along).astype(int), (30 + 40 * along).astype(int)] = True
    expected[95, 60] = True
    assert (found & ~expected).sum() == 0
    assert (expected & ~found).sum() <= 2


def test_thousands_of_dots_are_looked_up_together(monkeypatch):
    """Per line of a path nothing is done but lists: one lookup for all of them."""
    dots = "".join(f"M{k % 200} {k // 200}h0" for k in range(3_000))
    path = f'<path d="{dots}" stroke-linecap="round" stroke="#000"/>'
    root = parse_untrusted(f'<svg viewBox="0 0 200 200">{path}</svg>'.encode())
    placed = Mock(wraps=affine.apply)
    shapes = painted_shapes(root, None)
    monkeypatch.setattr(affine, "apply", placed)
    assert touched(shapes, (0.0, 0.0, 200.0, 200.0), (200, 200)).sum() == 3_000
    assert placed.call_count <= 2
