"""Strangers' files are held against their rendering, and traced where that is nearer."""

from __future__ import annotations

import defusedxml.ElementTree as DefusedET
import numpy as np
import pytest
import shapely

from packwork.errors import ReadError
from packwork.readers.budget.rendering import LEAST_PX, Work, work_of
from packwork.readers.gate.door import parse_untrusted
from packwork.readers.reading import TooRichError
from packwork.readers.svg import drawing as drawing_module
from packwork.readers.svg.drawing import read_drawing
from packwork.readers.svg.ink import PaintedInk, TracedInk
from packwork.readers.svg.item import item_of_svg, read_svg
from packwork.readers.svg.resvg import Comparison, excess, side_by_side, solid_twin
from packwork.readers.svg_syntax.coordinates import read_page

SPACES = 'xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"'
CLEAR = '<linearGradient id="g"><stop stop-opacity="0"/></linearGradient>'
DOT = '<circle cx="50" cy="50" r="20"/>'
TURNS = 2.4 * np.arange(400)
STAR = "L".join(f"{50 + 45 * np.cos(t):.2f} {50 + 45 * np.sin(t):.2f}" for t in TURNS)


def svg(body: str, page: str = 'viewBox="0 0 100 100"') -> bytes:
    return f"<svg {SPACES} {page}>{body}</svg>".encode()


def compared(body: str, page: str = 'viewBox="0 0 100 100"'):
    return read_drawing(svg(body, page), is_compared=True)


def test_what_shows_nothing_is_not_taken_for_ink(tmp_path, caplog):
    file = tmp_path / "veil.svg"
    file.write_bytes(svg(f'{CLEAR}<rect width="99" height="99" fill="url(#g)"/>{DOT}'))
    item = read_svg(file).item
    assert item.ink.area == pytest.approx(np.pi * 400, rel=1e-3)
    assert "veil.svg: is traced from its picture, with which its shapes" in caplog.text
    assert "agree to 12.8% only" in caplog.text


def test_agreeing_drawings_stay_as_computed(caplog):
    read = compared(DOT + '<path d="M1 1h9v9z" stroke="red" opacity=".1"/>')
    assert isinstance(read.ink, PaintedInk)
    assert caplog.text == ""


@pytest.mark.parametrize("page", ['viewBox="0 0 100 100"', 'width="1e3" height="1e3"', ""])
def test_thin_details_agree_at_a_closer_look(page, caplog):
    hairs = "".join(f'<path d="M{k} 5v90" stroke="#000" stroke-width=".02"/>' for k in range(40))
    assert isinstance(compared(hairs, page).ink, PaintedInk)
    assert caplog.text == ""


def test_scribbles_are_traced(caplog):
    scribble = f'<path d="M{STAR}z"/>'
    with pytest.raises(ReadError, match="crosses itself"):
        item_of_svg(svg(scribble), "a", "a.svg")
    item = item_of_svg(svg(scribble), "a", "a.svg", is_compared=True)
    assert item.outline.area == pytest.approx(np.pi * 45**2, rel=0.05)
    assert "is traced from its picture, for it crosses itself about" in caplog.text


def test_crowds_are_traced(monkeypatch, caplog):
    monkeypatch.setattr(drawing_module, "MAX_SHAPES", 3)
    read = compared("".join(f'<rect x="{20 * k}" width="9" height="9"/>' for k in range(4)))
    assert isinstance(read.ink, TracedInk)
    assert read.ink.whole.area == pytest.approx(4 * 81, rel=1e-3)
    assert "for it has 4 shapes" in caplog.text


def test_traced_without_a_page(caplog):
    drawn = f'{CLEAR}<rect x="-50" width="99" height="99" fill="url(#g)"/>{DOT}'
    item = item_of_svg(svg(drawn, ""), "a", "a.svg", is_compared=True)
    assert item.ink.area == pytest.approx(np.pi * 400, rel=1e-3)
    assert "agree to" in caplog.text


def test_invisible_drawings_are_refused(tmp_path):
    file = tmp_path / "veil.svg"
    file.write_bytes(svg(f'{CLEAR}<rect width="99" height="99" fill="url(#g)"/>'))
    with pytest.raises(ReadError, match=r"veil\.svg: paints no area"):
        read_svg(file)


def test_masks_that_let_little_through_are_shapes():
    masked = (
        f'<mask id="m"><rect width="50" height="99" fill="#555"/></mask><g mask="url(#m)">{DOT}</g>'
    )
    item = item_of_svg(svg(masked), "a", "a.svg", is_compared=True)
    assert item.ink.area == pytest.approx(np.pi * 200, rel=1e-2)


@pytest.mark.parametrize("share", [0.25, 0.5, 0.9])
def test_agreement_is_the_share_of_areas(share):
    root = parse_untrusted(svg('<rect width="80" height="60"/>'))
    page, whole = read_page(root), shapely.box(0, 0, 80, 60)
    comparison = Comparison(root, page, whole, work_of(root, [], page))
    assert comparison.agreement(shapely.box(0, 0, 80 * share, 60)) == pytest.approx(share, abs=0.01)
    assert comparison.agreement(whole) == pytest.approx(1.0, abs=0.01)


def test_excess_counts_what_lies_beyond():
    root = parse_untrusted(svg('<rect width="60" height="60"/>'))
    page = read_page(root)
    whole, part = shapely.box(0, 0, 60, 60), shapely.box(0, 0, 40, 60)
    assert excess(*side_by_side(whole, root, page, 64)) == 0
    assert excess(*side_by_side(part, root, page, 64)) == pytest.approx(0.5, abs=0.1)


def test_solid_twin_keeps_what_is_seen_only():
    text = (
        "<svg><linearGradient id='a'><stop stop-color='#0000'/></linearGradient>"
        "<linearGradient id='b'/><linearGradient id='c'><stop/></linearGradient>"
        "<g fill='url(#a)' stroke='url(#b)' opacity='.3' filter='url(#f)'/><g fill='inherit'"
        " stroke='rgba(1,2,3,0)' opacity='0' stroke-dasharray='3'/><mask><g opacity='.5'/></mask>"
        "</svg>"
    )
    root = DefusedET.fromstring(text)
    root[1].set("xlink:href", "#c")
    twin = solid_twin(root, with_dashes=False)
    assert twin[3].attrib == {"fill": "none", "stroke": "black"}
    assert twin[4].attrib == {"fill": "inherit", "stroke": "none", "opacity": "0"}
    assert twin[5][0].attrib == {"opacity": ".5"}
    assert root[3].get("opacity") == ".3"


def test_pictures_shrink_as_the_work_grows():
    sides = [Work(100, layers).side(1000, 1.0) for layers in (0, 1, 10, 100, 1000)]
    assert sides == sorted(sides, reverse=True)
    assert sides[0] == 1000
    assert sides[-1] >= LEAST_PX
    with pytest.raises(TooRichError, match="one over another"):
        Work(100, 100_000).side(1000, 1.0)


def test_looking_closer_costs_as_much_as_the_page():
    work = Work(elements=1e4, layers=3, depth=2.0, spill=1.0, page=100.0)
    assert work.nanoseconds(200, 10.0) > work.nanoseconds(200, 100.0)
    assert work.side(1000, 1.0) < work.side(1000, 100.0)
