"""Drawings to items: units, holes, parts, ids, pages, shadows, sheets."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from packwork.errors import ReadError
from packwork.readers.svg.item import item_of_svg
from packwork.scene.item import VectorArt

PAGE = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100">{}</svg>'


def item_of(body: str, holes: str = "fill"):
    return item_of_svg(PAGE.format(body).encode(), "a", "a.svg", holes)


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


@pytest.mark.parametrize(
    "step",
    [
        "",
        '<feFlood flood-opacity="0"/>',
        '<feOffset dx="500"/>',
        '<feComponentTransfer><feFuncA type="linear" slope="0"/></feComponentTransfer>',
    ],
)
def test_a_drawing_whose_filter_leaves_nothing_is_refused_by_name(step: str) -> None:
    hidden = f'<filter id="f">{step}</filter><rect width="30" height="20" filter="url(#f)"/>'
    with pytest.raises(ReadError, match=r"a\.svg: paints nothing, for its filters hide"):
        item_of(hidden)


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
