"""What an item paints lies within its outline, in every format that shows its art."""

from __future__ import annotations

import logging

import pytest

from packwork.readers.budget.rendering import Work
from packwork.readers.builtin import builtin_item, icon_names
from packwork.readers.svg.art import paints_beyond, within_outline
from packwork.readers.svg.item import item_of_svg
from packwork.scene.item import VectorArt

PAGE = (
    '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" '
    'viewBox="0 0 10 10"{}>{}</svg>'
)
DISC = '<circle cx="5" cy="5" r="4" fill="red"/>'
SQUARE = '<rect width="9" height="9" fill="red"/>'
FAR = '<rect x="{}" y="2" width="6" height="6" fill="blue"/>'
SYMBOL = '<symbol id="s" {}><rect width="10" height="10"/></symbol><use xlink:href="#s" {}/>'
DRAWINGS = {
    "beside the page": ("", DISC + FAR.format(14)),
    "far from the page": ("", DISC + FAR.format(-90)),
    "faint, beside the page": ("", DISC + f'<g opacity=".2">{FAR.format(14)}</g>'),
    "by use": ("", f'<defs><g id="g">{FAR.format(14)}</g></defs>{DISC}<use xlink:href="#g"/>'),
    "text beside the page": ("", f'{DISC}<text x="20" y="5" font-size="5">ab</text>'),
    "the root lies elsewhere": (
        ' x="6" y="3" width="10" height="10"',
        '<circle cx="9" cy="5" r="4"/>',
    ),
    "the root is turned": (
        ' transform="rotate(30 5 5)" width="20" height="20"',
        DISC + FAR.format(8),
    ),
    "a clip of a use of a use": (
        "",
        '<defs><circle id="a" cx="5" cy="5" r="4"/><use id="b" xlink:href="#a"/></defs><clipPath '
        f'id="c"><use xlink:href="#b"/></clipPath>{DISC}'
        '<path clip-path="url(#c)" d="M0 0h10v10z"/>',
    ),
    "a clip of a group": (
        "",
        '<clipPath id="c"><g><path d="M0 0h5v9z"/></g></clipPath>'
        f'{DISC}<rect width="10" height="10" clip-path="url(#c)"/>',
    ),
    "a viewport without area": ("", f'{DISC}<svg width="0" height="9">{FAR.format(2)}</svg>'),
    "a symbol with a size": (
        "",
        DISC + SYMBOL.format('width="3" height="3" viewBox="0 0 10 10"', ""),
    ),
    "a symbol with a place": (
        "",
        DISC
        + SYMBOL.format('x="4" y="1" transform="scale(.5)" viewBox="0 0 9 9"', 'width="5" x="1"'),
    ),
    "a use without area": ("", DISC + SYMBOL.format('viewBox="0 0 1 1"', 'width="0" height="5"')),
    "deferring": (
        "",
        f'{DISC}<svg width="9" height="4" viewBox="0 0 10 10" preserveAspectRatio="defer xMinYMin '
        'slice"><rect width="10" height="10"/></svg>',
    ),
    "a shadow": (
        "",
        '<filter id="f" width="3" height="3"><feGaussianBlur stdDeviation=".1"/><feOffset dx="5"/>'
        f'</filter>{DISC}<circle cx="3" cy="3" r="2" filter="url(#f)"/>',
    ),
    "a marker": (
        "",
        '<marker id="m" viewBox="0 0 2 2" markerWidth="9" markerHeight="9" overflow="visible">'
        '<path d="M0 0h9v9z"/></marker><path d="M1 1h7" stroke="#000" marker-end="url(#m)"/>',
    ),
    "a pattern": (
        "",
        '<pattern id="p" width=".2" height=".2" overflow="visible"><rect width="1" height="4"/>'
        f'</pattern><circle cx="5" cy="5" r="4" fill="url(#p)"/>{FAR.format(11)}',
    ),
}  # fmt: skip


def drawing(name: str) -> bytes:
    attributes, body = DRAWINGS[name]
    return PAGE.format(attributes, body).encode()


@pytest.mark.parametrize("name", DRAWINGS)
def test_no_drawing_is_painted_beyond_its_outline(name: str) -> None:
    item = item_of_svg(drawing(name), "drawing", "drawing.svg", is_compared=True)
    assert isinstance(item.art, VectorArt)
    left, top, right, bottom = item.outline.bounds
    long = max(right - left, bottom - top)
    around = (left - 30 * long, top - 30 * long, right + 30 * long, bottom + 30 * long)
    assert not paints_beyond(item.art, item.outline, around, Work(1, 0))


def test_what_is_beside_the_outline_is_cut_off_and_said(caplog: pytest.LogCaptureFixture) -> None:
    item = item_of_svg(PAGE.format("", DISC).encode(), "disc", "disc.svg", is_compared=True)
    beside = VectorArt(item.art.markup + '<path d="M9.5 3h1v4h-1z"/>', item.art.matrix)
    with caplog.at_level(logging.WARNING, "packwork"):
        cut = within_outline([beside, beside], item.outline, None, Work(1, 0))
    assert not paints_beyond(cut, item.outline, None, Work(1, 0))
    assert [record.getMessage() for record in caplog.records] == [
        "drawing: what it paints beyond its outline is cut off"
    ]


def test_what_is_too_rich_to_be_painted_is_cut_off() -> None:
    item = item_of_svg(PAGE.format("", DISC).encode(), "disc", "disc.svg", is_compared=True)
    cut = within_outline([item.art], item.outline, None, Work(1e9, 1e9))
    assert "<clipPath" in cut.markup


def test_drawings_that_are_as_they_show_stay_as_they_are() -> None:
    item = item_of_svg(PAGE.format("", SQUARE).encode(), "disc", "disc.svg", is_compared=True)
    assert item.art.markup == SQUARE


def test_no_bundled_icon_is_painted_beyond_its_outline() -> None:
    items = {name: builtin_item(name) for name in icon_names()}
    assert len(items) > 20
    assert [n for n, i in items.items() if paints_beyond(i.art, i.outline, None, Work(1, 0))] == []
