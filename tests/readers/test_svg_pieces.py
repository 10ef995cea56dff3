"""The parts of the SVG reader one by one."""

from __future__ import annotations

import math
from xml.etree import ElementTree as ET

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from packwork.readers.svg.item import item_of_svg
from packwork.readers.svg.region.strokes import stroke_region
from packwork.readers.svg_syntax.arcs import arc_cubics
from packwork.readers.svg_syntax.painting import Pen
from packwork.readers.svg_syntax.path_data import parse_path
from packwork.readers.svg_syntax.shapes import flattened, shape_pieces
from packwork.scene.item import VectorArt

PAGE = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100">{}</svg>'


def item_of(body: str, holes: str = "fill"):
    return item_of_svg(PAGE.format(body).encode(), "a", "a.svg", holes)


def ends(data: str) -> list[tuple[float, float]]:
    return [tuple(cubic[3].tolist()) for piece in parse_path(data) for cubic in piece.segments]


@pytest.mark.parametrize(
    ("data", "expected"),
    [
        ("M1 2L3 4", [(3, 4)]),
        ("M1,2,3,4,5,6", [(3, 4), (5, 6)]),
        ("m1 2 1 1", [(2, 3)]),
        ("M1-2L.5.5", [(0.5, 0.5)]),
        ("M0 0h1v2H-1V-2", [(1, 0), (1, 2), (-1, 2), (-1, -2)]),
        ("M0 0 1e1 1E+1", [(10, 10)]),
        ("M0 0h5zl1 1", [(5, 0), (1, 1)]),
        ("M0 0L1 1 2", [(1, 1)]),
        ("M0 0L1 1 oops L2 2", [(1, 1)]),
        ("oops M0 0L1 1", []),
        ("L1 1", []),
        ("", []),
        ("M0 0a1 1 0 0 0 0 0", []),
        ("M0 0A0 5 0 0 0 4 4", [(4, 4)]),
    ],
)
def test_path_data(data, expected):
    assert ends(data) == expected


def test_smooth_commands_mirror_only_their_own_kind():
    cubics = parse_path("M0 0C0 1 1 1 2 0S4 1 4 0")[0].segments
    assert cubics[1, 1].tolist() == [3.0, -1.0]
    plain = parse_path("M0 0L2 0S4 1 4 0")[0].segments
    assert plain[1, 1].tolist() == [2.0, 0.0]


@pytest.mark.parametrize("radius", [5e-324, 1e-320, 1e-12])
def test_arcs_too_small_for_their_place_are_lines(radius):
    end = (24.0, radius)
    assert arc_cubics((24.0, 0.0), end, (radius, radius, 0), 0, 1) == [((24.0, 0.0), end, end)]
    tile = ET.Element("rect", {"width": "24", "height": "150", "rx": repr(radius)})
    (rounded,) = shape_pieces(tile, (24.0, 150.0))
    assert np.isfinite(rounded.segments).all()


@settings(deadline=None)
@given(st.floats(0.1, 50), st.floats(0.1, 50), st.floats(-180, 180), st.booleans(), st.booleans())
def test_arcs_lie_on_an_ellipse(rx, ry, turn, large, sweep):
    start, end = (3.0, -4.0), (17.0, 9.0)
    cubics = np.array(arc_cubics(start, end, (rx, ry, turn), large, sweep))
    points = np.vstack([[start], cubics[:, 2]])
    angle = math.radians(turn)
    back = np.array([[math.cos(angle), math.sin(angle)], [-math.sin(angle), math.cos(angle)]])
    flat = points @ back.T / (rx, ry)
    assert cubics[-1, 2].tolist() == list(end)
    if len(flat) >= 4:
        # A circle through three points holds the others.
        a, b, c = flat[0], flat[len(flat) // 2], flat[-1]
        rows = 2 * np.array([b - a, c - a])
        centre = np.linalg.solve(rows, [b @ b - a @ a, c @ c - a @ a])
        radii = np.hypot(*(flat - centre).T)
        assert np.ptp(radii) < 1e-6 * radii.mean()


def test_flattening_keeps_its_tolerance():
    circle = parse_path("M-50 0a50 50 0 0 1 100 0a50 50 0 0 1-100 0z")[0]
    ring = flattened(circle, 2e-3)
    middles = (ring + np.roll(ring, -1, axis=0)) / 2
    assert np.abs(np.hypot(*ring.T) - 50).max() < 1e-5
    assert np.abs(np.hypot(*middles.T) - 50).max() < 2.1e-3
    assert len(ring) < 400


@pytest.mark.parametrize(
    ("pen", "area"),
    [
        (Pen(2), 40),
        (Pen(2, "square"), 44),
        (Pen(2, "round"), 40 + math.pi),
        (Pen(2, join="bevel"), 39.5),
        (Pen(2, join="round"), 39 + math.pi / 4),
        (Pen(2, miter_limit=1.4), 39.5),
        (Pen(2, miter_limit=1.42), 40),
    ],
)
def test_right_angle(pen, area):
    corner = np.array([[0.0, 0.0], [10.0, 0.0], [10.0, 10.0]])
    assert stroke_region(corner, False, pen, 1e-5).area == pytest.approx(area, abs=1e-3)


def test_closed_lines_have_no_caps():
    square = np.array([[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0]])
    assert stroke_region(square, True, Pen(2, "square"), 0.01).area == pytest.approx(80)


def test_units_of_items_are_css_pixels():
    text = '<svg viewBox="0 0 10 10" width="1in"><rect width="10" height="5"/></svg>'
    left, top, right, bottom = item_of_svg(text.encode(), "a", "a.svg").outline.bounds
    assert (left, top, right, bottom) == pytest.approx((-48, -24, 48, 24))


def test_holes():
    body = '<path d="M0 0h90v90h-90z M30 30v30h30v-30z"/>'
    filled, kept = item_of(body), item_of(body, "keep")
    assert (filled.outline.area, filled.ink.area) == pytest.approx((8100, 7200))
    assert kept.outline.area == kept.ink.area == pytest.approx(7200)


def test_parts_stay_apart_and_specks_go():
    body = '<path d="M0 0h40v90h-40z M50 0h40v90h-40z M99 99h.01v.01h-.01z"/>'
    assert len(item_of(body).outline.rings) == 2


def test_ids_of_two_drawings_never_meet():
    gradient = '<linearGradient id="g"><stop stop-color="{}"/></linearGradient>'
    shape = '<path fill="url(#g)" d="M0 0h9v9z"/>'
    arts = [item_of(gradient.format(colour) + shape).art for colour in ("red", "blue")]
    ids = [{part.split('"')[0] for part in art.markup.split('id="')[1:]} for art in arts]
    assert ids[0]
    assert not ids[0] & ids[1]
    assert all(f"url(#{name})" in art.markup for art, (name,) in zip(arts, ids, strict=True))


def test_simple_drawings_give_simple_art():
    art = item_of('<g><title>t</title><path id="x" d="M0 0h9v9z"/></g>').art
    assert isinstance(art, VectorArt)
    assert art.markup == '<g><path d="M0 0h9v9z"/></g>'


def test_percentages_keep_their_page(art_iou):
    item = item_of('<rect x="10%" width="50%" height="20%"/><circle r="10" cx="90" cy="50%"/>')
    assert art_iou(item) > 0.98


def test_what_is_clipped_away_is_no_ink():
    body = '<rect width="9" height="9"/><clipPath id="c"><path d="M0 0h5v5z"/></clipPath>'
    clipped = item_of(body + '<rect x="50" y="50" width="9" height="9" clip-path="url(#c)"/>')
    assert shapely.area(clipped.ink.region) == pytest.approx(81, rel=1e-3)


def test_shadows_beyond_the_shapes_are_taken_off(caplog):
    shadow = '<filter id="f" width="3"><feDropShadow dx="20" flood-color="red"/></filter>'
    item = item_of(shadow + '<rect width="30" height="20" filter="url(#f)"/>')
    assert item.ink.area == pytest.approx(600)
    assert isinstance(item.art, VectorArt)
    assert item.art.markup == '<rect width="30" height="20"/>'
    assert "a.svg: its filters were left out" in caplog.text


def test_shading_within_the_shapes_stays(caplog):
    shade = (
        '<filter id="f"><feGaussianBlur stdDeviation="3"/><feComposite in2="SourceAlpha"'
        ' operator="in"/></filter>'
    )
    art = item_of(shade + '<rect x="20" y="20" width="30" height="20" filter="url(#f)"/>').art
    assert isinstance(art, VectorArt)
    assert "feComposite" in art.markup
    assert caplog.text == ""


PAPER = '<rect width="100" height="100" fill="#fff"/>'
DISC = '<circle cx="50" cy="50" r="20" fill="teal"/>'


@pytest.mark.parametrize(
    "body",
    [
        PAPER + DISC,
        '<rect width="100%" height="100%" style="fill:rgb(252,250,245)"/>' + DISC,
        f'<g id="layer">{PAPER}{DISC}</g>',
        '<g fill="white"><path d="M-5-5H105V105H-5z"/></g>' + DISC,
    ],
    ids=["rectangle", "ivory", "layer", "path"],
)
def test_a_white_page_behind_the_drawing_is_left_out(body, caplog, art_iou):
    item = item_of(body)
    assert item.ink.area == pytest.approx(np.pi * 20**2, rel=1e-3)
    assert "its white page was left out" in caplog.text
    assert art_iou(item) > 0.98


@pytest.mark.parametrize(
    "body",
    [
        PAPER,
        PAPER.replace("#fff", "#fd7") + DISC,
        PAPER.replace("<rect", '<rect stroke="red"') + DISC,
        PAPER.replace("<rect", '<rect rx="20"') + DISC,
        PAPER.replace("<rect", '<rect opacity=".5"') + DISC,
        f'<g opacity=".5">{PAPER}{DISC}</g>',
        DISC + PAPER,
        f'{PAPER.replace("<rect", """<rect id="a" """)}{DISC}<use href="#a" x="90" fill="red"/>',
    ],
    ids=["alone", "coloured", "lined", "round", "faint", "in a faint group", "in front", "used"],
)
def test_tiles_stay(body, caplog):
    assert item_of(body).ink.area > 9000
    assert "white page" not in caplog.text
