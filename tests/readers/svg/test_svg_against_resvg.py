"""Computed ink and exported art against a renderer that shares no code with them."""

from __future__ import annotations

import pytest

from packwork.readers.svg.item import item_of_svg

STAR = "M50 5 L79 95 L3 39 L97 39 L21 95 Z"
ZIGZAG = 'd="M15 80 L30 20 L50 75 L55 20 L85 80" fill="none" stroke="#000" stroke-width="12"'
LINK = 'xmlns:xlink="http://www.w3.org/1999/xlink"'

DRAWINGS = {
    "path": '<path d="M10 10 C 90 0 90 60 50 90 S 5 60 10 10z"/>',
    "quadratics": '<path d="M10 50 Q 30 0 50 50 T 90 50 L 90 90 H 10 z"/>',
    "arcs": '<path d="M20 50 A 30 20 30 1 1 70 60 A 10 12 0 0 0 60 80 a25 25 0 01-40-30z"/>',
    "packed arc flags": '<path d="M10 50a20 20 0 0120-20l50 5a20 30 15 10-20 40z"/>',
    "arc radii too small": '<path d="M20 50 A 5 3 20 0 1 80 60 z"/>',
    "relative after close": '<path d="M10 10h20v20h-20z m40 40h30v30h-30zl-10 -10 v20z"/>',
    "rect": '<rect x="10" y="20" width="70" height="50"/>',
    "round rect": '<rect x="10" y="20" width="70" height="50" rx="20" ry="90"/>',
    "circle": '<circle cx="50" cy="50" r="40%"/>',
    "ellipse": '<ellipse cx="50%" cy="50" rx="40" ry="20"/>',
    "polygon": '<polygon points="50,5 79,95 3,39 97,39 21,95"/>',
    "polyline": '<polyline points="10,10 90,20 50,90"/>',
    "evenodd star": f'<path fill-rule="evenodd" d="{STAR}"/>',
    "nonzero star": f'<path d="{STAR}"/>',
    "nonzero overlap": '<path d="M10 10h50v50h-50z M30 30h60v60h-60z"/>',
    "nonzero hole": '<path d="M10 10h80v80h-80z M30 30v40h40v-40z"/>',
    "two parts": '<circle cx="25" cy="25" r="20"/><circle cx="75" cy="75" r="20"/>',
    "butt": '<path d="M20 20 L80 70" stroke="#000" stroke-width="20"/>',
    "round cap": '<path d="M20 20 L80 70" stroke="#000" stroke-width="20" stroke-linecap="round"/>',
    "square cap": (
        '<path d="M20 20 L80 70" stroke="#000" stroke-width="20" stroke-linecap="square"/>'
    ),
    "miter": f"<path {ZIGZAG}/>",
    "miter limit 1": f'<path {ZIGZAG} stroke-miterlimit="1"/>',
    "miter limit 20": f'<path {ZIGZAG} stroke-miterlimit="20"/>',
    "round join": f'<path {ZIGZAG} stroke-linejoin="round"/>',
    "bevel join": f'<path {ZIGZAG} stroke-linejoin="bevel"/>',
    "closed stroke": ('<path d="M20 20 H80 L50 80z" fill="none" stroke="#000" stroke-width="10"/>'),
    "curved stroke": (
        '<path d="M20 80 C 20 0 80 0 80 80" fill="none" stroke="#000" stroke-width="12"/>'
    ),
    "single points": (
        '<g stroke="#000" stroke-width="30"><path stroke-linecap="round" d="M30 30h0"/>'
        '<path stroke-linecap="square" d="M70 70z"/></g>'
    ),
    "fill and stroke": '<circle cx="50" cy="50" r="30" stroke="#00f" stroke-width="8"/>',
    "line": '<line x1="10" y1="50%" x2="90%" y2="20" stroke="red" stroke-width="5%"/>',
    "stretched stroke": (
        '<g transform="scale(3 1) skewX(10)"><circle cx="12" cy="50" r="8" fill="none"'
        ' stroke="#000" stroke-width="4"/></g>'
    ),
    "nested transforms": (
        '<g transform="translate(50 50) rotate(30)"><g transform="scale(2,.5) skewY(12)">'
        '<rect x="-15" y="-20" width="30" height="60" transform="rotate(10 5 5)"/></g></g>'
    ),
    "mirrored": (
        '<g transform="matrix(-1 0 0 1 100 0)"><path d="M10 10h60l-30 60z" stroke="#000"'
        ' stroke-width="6"/></g>'
    ),
    "use": (
        f'<defs><path id="a" d="M0 0h20v20z"/></defs><use {LINK} xlink:href="#a" x="10" y="10"/>'
        f'<use href="#a" transform="translate(50 50) scale(2)"/>'
    ),
    "use inherits": (
        '<defs><circle id="a" r="15" cx="30" cy="30"/></defs>'
        '<use href="#a" fill="none" stroke="#000" stroke-width="6"/><use href="#a" x="40"/>'
    ),
    "symbol": (
        '<symbol id="s" viewBox="0 0 10 10"><circle cx="5" cy="5" r="6"/></symbol>'
        '<use href="#s" x="10" y="10" width="40" height="60"/>'
    ),
    "nested svg": (
        '<svg x="20" y="10" width="50" height="80" viewBox="0 0 10 10"'
        ' preserveAspectRatio="xMinYMax slice"><circle cx="5" cy="5" r="4"/></svg>'
    ),
    "class": (
        "<style>/* c */ .a{fill:none;stroke:#000;stroke-width:9} g > .b, #c {fill:none}</style>"
        '<path class="a x" d="M20 20h60v60"/><g><path class="b" d="M0 0h50v50z"/></g>'
        '<path id="c" d="M0 50h50v50z"/>'
    ),
    "cascade": (
        "<style>path{fill:none} .on{fill:red} .off{fill:none!important}</style>"
        '<path class="on" d="M0 0h40v40z"/><path class="off" style="fill:red" d="M50 0h40v40z"/>'
        '<path style="fill:blue" d="M0 50h40v40z"/><path fill="blue" d="M50 50h40v40z"/>'
    ),
    "media rules": (
        "<style>@media print{path{fill:none}}@import 'x.css';path{stroke:red;stroke-width:4}"
        '</style><path d="M20 20h60v60z"/>'
    ),
    "gradient": (
        '<linearGradient id="g"><stop offset="0" stop-color="red"/><stop offset="1"'
        ' stop-color="#00f"/></linearGradient><path fill="url(#g)" d="M10 10h80v60z"/>'
    ),
    "missing gradient": (
        '<path fill="url(#no)" d="M10 10h80v60z"/><path fill="url(#no) red" d="M10 80h9v9z"/>'
    ),
    "unseen": (
        '<g display="none"><rect width="99" height="99"/></g><rect width="99" height="99"'
        ' visibility="hidden"/><rect width="99" height="99" opacity="0"/><rect width="99"'
        ' height="99" fill="transparent"/><rect width="99" height="99" fill-opacity="0"/>'
        '<g visibility="hidden"><rect x="30" y="30" width="9" height="9" visibility="visible"/></g>'
    ),
    "current colour": '<g color="red" fill="currentColor"><circle cx="40" cy="40" r="20"/></g>',
    "cut by the page": '<circle cx="0" cy="0" r="70" stroke="#000" stroke-width="20"/>',
    "broken tail": '<path d="M10 10 h50 v50 z L oops 30 30"/>',
    "clip": (
        '<clipPath id="c"><circle cx="50" cy="50" r="30"/></clipPath>'
        '<rect width="60" height="100" clip-path="url(#c)"/>'
    ),
    "clip of several shapes": (
        '<clipPath id="c"><circle cx="30" cy="50" r="20"/><rect x="40" y="10" width="50"'
        ' height="50" transform="rotate(9)"/></clipPath><g clip-path="url(#c)" transform='
        '"translate(5)"><rect width="60" height="100"/><path d="M60 0h30v90z"/></g>'
    ),
    "clip with a hole": (
        '<g clip-rule="evenodd"><clipPath id="c"><path d="M10 10h80v80h-80zM30 30h40v40h-40z"/>'
        '</clipPath></g><rect width="100" height="100" clip-path="url(#c)"/>'
    ),
    "clip by use": (
        '<defs><circle id="u" cx="30" cy="30" r="25" fill="none"/></defs><clipPath id="c"'
        ' transform="translate(20 10)"><use href="#u"/></clipPath>'
        '<rect width="100" height="60" clip-path="url(#c)"/>'
    ),
    "clipped clip": (
        '<clipPath id="d"><rect width="50" height="90"/></clipPath><clipPath id="c"'
        ' clip-path="url(#d)"><circle cx="50" cy="50" r="40"/></clipPath>'
        '<rect width="100" height="70" clip-path="url(#c)" transform="rotate(10 50 50)"/>'
    ),
    "clipped use": (
        '<clipPath id="c"><rect width="30" height="30"/></clipPath><defs><g id="u"><circle'
        ' cx="20" cy="20" r="20"/></g></defs>'
        '<use href="#u" x="30" y="40" clip-path="url(#c)" transform="scale(1.5 1)"/>'
    ),
    "clip with a hidden part": (
        '<clipPath id="c"><rect width="50" height="50"/><rect x="50" width="50" height="50"'
        ' visibility="hidden"/><rect y="50" width="9" height="50" display="none"/></clipPath>'
        '<rect width="100" height="100" clip-path="url(#c)"/>'
    ),
    "clip in shares": (
        '<clipPath id="c" clipPathUnits="objectBoundingBox"><circle cx=".5" cy=".5" r=".4"/>'
        '</clipPath><rect x="10" y="10" width="60" height="80" clip-path="url(#c)"/>'
    ),
    "dashes": (
        '<path d="M10 10h80v80h-80z" fill="none" stroke="#000" stroke-width="8"'
        ' stroke-dasharray="15 7 3" stroke-dashoffset="4"/>'
    ),
    "dots": (
        '<path d="M10 20H90" stroke="#000" stroke-width="8" stroke-dasharray="0 12"'
        ' stroke-linecap="round"/><path d="M80 30V90" stroke="#000" stroke-width="8"'
        ' stroke-dasharray="0 14" stroke-linecap="square"/>'
    ),
    "part of a ring": (
        '<circle cx="50" cy="50" r="30" fill="none" stroke="#000" stroke-width="20"'
        ' stroke-dasharray="70 999" transform="rotate(-90 50 50)"/>'
    ),
    "dash over the start of a ring": (
        '<rect x="20" y="20" width="60" height="60" fill="none" stroke="#000" stroke-width="14"'
        ' stroke-dasharray="50 40" stroke-dashoffset="20"/>'
    ),
    "hidden by a sheet": (
        '<rect width="90" height="90"/><circle cx="40" cy="40" r="20"/><path d="M80 80h19v19z"/>'
    ),
    "mask": (
        '<mask id="m"><rect width="100" height="50" fill="#fff"/></mask>'
        '<circle cx="50" cy="50" r="40" mask="url(#m)" opacity=".3"/>'
    ),
    "pattern": (
        '<pattern id="p" width="40" height="40" patternUnits="userSpaceOnUse">'
        '<rect width="30" height="30"/></pattern><rect width="90" height="90" fill="url(#p)"/>'
    ),
    "marker": (
        '<marker id="m" markerWidth="9" markerHeight="9" refX="3" refY="3"><circle cx="3" cy="3"'
        ' r="3"/></marker><path d="M20 50h60" stroke="#000" stroke-width="5"'
        ' marker-end="url(#m)"/>'
    ),
}

PAGES = {
    "viewBox": 'viewBox="0 0 100 100"',
    "millimetres": 'viewBox="0 0 100 100" width="50.8mm" height="25.4mm"',
    "points": 'viewBox="0 0 100 100" width="60pt" height="10pc"',
    "no viewBox": 'width="100" height="100"',
    "shifted": 'viewBox="10 20 80 60" width="2in" height="3in" preserveAspectRatio="none"',
    "sliced": 'viewBox="0 0 100 100" width="300" height="150" preserveAspectRatio="xMaxYMin slice"',
    "root style": 'viewBox="0 0 100 100" fill="none" stroke="#000" style="stroke-width:3"',
}


def document(body: str, page: str = PAGES["viewBox"]) -> str:
    return f'<svg xmlns="http://www.w3.org/2000/svg" {page}>{body}</svg>'


FAINT = {"mask"}
"""Drawings that resvg shows below half opacity: a shape all the same."""


@pytest.mark.parametrize("name", sorted(DRAWINGS.keys() - FAINT))
def test_ink_is_what_resvg_shows(name, iou_with_resvg):
    assert iou_with_resvg(document(DRAWINGS[name])) >= 0.98


@pytest.mark.parametrize("page", PAGES)
@pytest.mark.parametrize("name", ["path", "nested svg", "line"])
def test_pages_are_laid_out_as_resvg_does(name, page, iou_with_resvg):
    assert iou_with_resvg(document(DRAWINGS[name], PAGES[page])) >= 0.98


@pytest.mark.parametrize("name", sorted(DRAWINGS.keys() - FAINT))
def test_art_covers_the_ink(name, art_iou):
    item = item_of_svg(document(DRAWINGS[name]).encode(), name, name)
    assert art_iou(item) >= 0.98


@pytest.mark.parametrize("page", PAGES)
def test_art_covers_the_ink_on_any_page(page, art_iou):
    item = item_of_svg(document(DRAWINGS["ellipse"], PAGES[page]).encode(), page, page)
    assert art_iou(item) >= 0.98


def test_faint_shapes_are_shapes():
    item = item_of_svg(document(DRAWINGS["mask"]).encode(), "mask", "mask.svg")
    assert item.outline.area == pytest.approx(3.14159 * 40**2 / 2, rel=3e-3)


@pytest.mark.xfail(strict=True, reason="proves that the comparison can fail")
def test_comparison_can_fail(iou_with_resvg):
    half_clear = '<rect width="90" height="90" opacity=".3"/><rect width="9" height="9"/>'
    assert iou_with_resvg(document(half_clear)) >= 0.98
