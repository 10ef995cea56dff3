"""Drawings as people have them, made up: every feature by itself, then several at once."""

from __future__ import annotations

import base64
from collections.abc import Iterator
from io import BytesIO

import numpy as np
from PIL import Image

SPACES = 'xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"'

PAGES = (
    'viewBox="0 0 100 100"',
    'viewBox="0 0 100 100" width="48" height="48"',
    'viewBox="0 0 100 100" width="25.4mm" height="50.8mm" preserveAspectRatio="xMinYMax"',
    'viewBox="-10 -10 120 120" width="3in"',
    'viewBox="10 20 80 60" width="200" height="90" preserveAspectRatio="xMidYMid slice"',
    'width="100" height="100"',
    'width="100%" height="100%" viewBox="0 0 100 100" style="enable-background:new 0 0 1 1"',
)


def _picture() -> str:
    file = BytesIO()
    Image.new("RGB", (3, 2), "tomato").save(file, "PNG")
    return "data:image/png;base64," + base64.b64encode(file.getvalue()).decode()


FEATURES = {
    "path": '<path d="M10 10 C 90 0 90 60 50 90 S 5 60 10 10z" fill="#c33"/>',
    "arcs": '<path d="M20 50a30 20 30 1150 10a10 12 0 00-10 20A25 25 0 01 20 50" fill="#36c"/>',
    "rounded": '<rect x="10" y="20" width="70" height="50" rx="20" ry="9" fill="teal"/>',
    "even-odd": '<path fill-rule="evenodd" d="M50 5L79 95 3 39H97L21 95Z"/>',
    "self-crossing": '<path d="M10 10h50v50h-50z M30 30h60v60h-60z M40 40v10h10v-10z"/>',
    "strokes": (
        '<g fill="none" stroke="#222" stroke-width="8"><path d="M15 80 30 20 50 75 55 20 85 80"/>'
        '<path d="M10 10q20 20 80 0" stroke-linecap="round" stroke-linejoin="round"/></g>'
    ),
    "dashes": (
        '<circle cx="50" cy="50" r="40" fill="none" stroke="#070" stroke-width="5"'
        ' stroke-dasharray="9 4 2" stroke-dashoffset="3"/><path d="M10 50h80" stroke="red"'
        ' stroke-width="6" stroke-dasharray="0 10" stroke-linecap="round"/>'
    ),
    "arc of a ring": (
        '<circle cx="50" cy="50" r="30" fill="none" stroke="#707" stroke-width="20"'
        ' stroke-dasharray="60 1000" transform="rotate(-90 50 50)"/>'
    ),
    "stretched": (
        '<g transform="translate(5 5) scale(3 1) skewX(9)"><circle cx="14" cy="45" r="9"'
        ' fill="none" stroke="#000" stroke-width="4"/></g>'
    ),
    "use": (
        '<defs><g id="a"><path d="M0 0h20v20z"/></g></defs><use xlink:href="#a" x="10" y="10"/>'
        '<use href="#a" fill="red" transform="translate(50 50) rotate(20) scale(2)"/>'
    ),
    "symbol": (
        '<symbol id="s" viewBox="0 0 10 10"><circle cx="5" cy="5" r="6"/></symbol>'
        '<use href="#s" x="10" y="10" width="40" height="60"/>'
    ),
    "nested": (
        '<svg x="20" y="10" width="50" height="80" viewBox="0 0 10 10"'
        ' preserveAspectRatio="xMinYMax slice"><circle cx="5" cy="5" r="4" fill="#c90"/></svg>'
    ),
    "classes": (
        "<style>.cls-1{fill:none;stroke:#000;stroke-width:9} g > .cls-2,#k{fill:#a33}</style>"
        '<path class="cls-1 x" d="M20 20h60v60"/><g><path class="cls-2" d="M0 50h50v50z"/></g>'
    ),
    "variables": (
        "<style>:root{--ink:#05f}</style><circle cx='40' cy='40' r='20' fill='var(--ink)'/>"
        '<circle cx="70" cy="70" r="20" fill="var(--none, currentColor)"/>'
    ),
    "current colour": '<g color="#090" fill="currentColor"><circle cx="40" cy="40" r="20"/></g>',
    "gradients": (
        '<linearGradient id="g"><stop stop-color="red"/><stop offset="1" stop-color="#00f"'
        ' stop-opacity=".2"/></linearGradient><radialGradient id="h" xlink:href="#g" r=".7"/>'
        '<path fill="url(#g)" d="M10 10h80v30z"/><circle cx="50" cy="70" r="20" fill="url(#h)"/>'
    ),
    "clear gradient": (
        '<linearGradient id="n"><stop stop-opacity="0"/></linearGradient>'
        '<rect width="99" height="99" fill="url(#n)"/><circle cx="50" cy="50" r="20"/>'
    ),
    "clip": (
        '<clipPath id="c"><circle cx="50" cy="50" r="30"/><path d="M0 0h30v30z"/></clipPath>'
        '<g clip-path="url(#c)"><rect width="60" height="100" fill="#693"/></g>'
    ),
    "clipped clip": (
        '<clipPath id="d"><rect width="50" height="99"/></clipPath>'
        '<clipPath id="c" clip-path="url(#d)"><use href="#u"/></clipPath>'
        '<defs><circle id="u" cx="50" cy="50" r="40"/></defs>'
        '<rect width="99" height="70" clip-path="url(#c)" transform="rotate(10 50 50)"/>'
    ),
    "clip in shares": (
        '<clipPath id="c" clipPathUnits="objectBoundingBox"><circle cx=".5" cy=".5" r=".4"/>'
        '</clipPath><rect x="10" y="10" width="60" height="80" clip-path="url(#c)"/>'
    ),
    "mask": (
        '<mask id="m"><rect width="100" height="60" fill="#fff"/><circle cx="50" cy="40" r="9"/>'
        '</mask><circle cx="50" cy="50" r="40" fill="#36a" mask="url(#m)"/>'
    ),
    "pattern": (
        '<pattern id="p" width="20" height="20" patternUnits="userSpaceOnUse"><rect width="15"'
        ' height="15" fill="#b50"/></pattern><rect width="90" height="90" fill="url(#p)"/>'
    ),
    "marker": (
        '<marker id="m" markerWidth="9" markerHeight="9" refX="3" refY="3" orient="auto">'
        '<path d="M0 0l6 3-6 3z"/></marker><path d="M20 50h50" stroke="#000" stroke-width="5"'
        ' marker-end="url(#m)"/>'
    ),
    "picture": f'<image x="10" y="20" width="60" height="40" xlink:href="{_picture()}"/>',
    "shade": (
        '<filter id="f"><feGaussianBlur stdDeviation="3" result="b"/><feComposite in="b"'
        ' in2="SourceAlpha" operator="in"/></filter><circle cx="50" cy="50" r="30" fill="#e55"/>'
        '<circle cx="50" cy="50" r="30" fill="#922" filter="url(#f)"/>'
    ),
    "shadow": (
        '<filter id="f" width="2" height="2"><feDropShadow dx="12" dy="12"/></filter>'
        '<rect x="10" y="10" width="50" height="50" fill="gold" filter="url(#f)"/>'
    ),
    "text": '<text x="5" y="60" font-size="40" fill="#333">Ab<tspan fill="red">c</tspan></text>',
    "text on a path": (
        '<path id="t" d="M10 60C20 10 80 10 90 60" fill="none"/><text font-size="14"'
        ' font-family="No Such Font, sans-serif"><textPath xlink:href="#t">along it</textPath>'
        "</text>"
    ),
    "faint": '<g opacity=".2"><circle cx="50" cy="50" r="30"/></g>',
    "blended": (
        '<g style="isolation:isolate"><rect width="60" height="60" fill="#f00"/><rect x="30"'
        ' y="30" width="60" height="60" fill="#0f0" style="mix-blend-mode:multiply"/></g>'
    ),
    "unseen": (
        '<rect width="99" height="99" display="none"/><rect width="99" height="99" fill="none"/>'
        '<g visibility="hidden"><rect x="30" y="30" width="9" height="9" visibility="visible"/></g>'
    ),
    "shares": '<ellipse cx="50%" cy="50%" rx="40%" ry="9%"/><line x2="100%" stroke="red"/>',
    "language": '<switch><path systemLanguage="de"/><a href="x"><circle r="40"/></a></switch>',
    "broken tail": '<path d="M10 10 h50 v50 z L oops 30 30"/>',
}
"""Each in a page of about 100 x 100 units."""


def wild_files(count: int, seed: int) -> Iterator[tuple[str, str]]:
    """Names and texts: each feature by itself, then ``count`` mixtures of several."""
    rng = np.random.default_rng(seed)
    for name, body in FEATURES.items():
        yield name, document(body, PAGES[0])
    names = list(FEATURES)
    for k in range(count):
        chosen = [names[n] for n in rng.choice(len(names), rng.integers(2, 5), replace=False)]
        parts = [_placed(FEATURES[name], number, rng) for number, name in enumerate(chosen)]
        yield f"mixture {k}: {', '.join(chosen)}", document("".join(parts), str(rng.choice(PAGES)))


def document(body: str, page: str) -> str:
    return f"<svg {SPACES} {page}>{body}</svg>"


def _placed(body: str, number: int, rng: np.random.Generator) -> str:
    """Body somewhere else, its ids its own."""
    for mark in ('id="', "url(#", 'href="#'):
        body = body.replace(mark, f"{mark}k{number}")
    x, y, turn = rng.uniform((-20, -20, -40), (40, 40, 40))
    scale = rng.uniform(0.3, 1.2)
    place = f"translate({x:.2f} {y:.2f}) rotate({turn:.1f}) scale({scale:.3f})"
    return f'<g transform="{place}">{body}</g>'
