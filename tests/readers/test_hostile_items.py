"""Any bytes give an item or a ReadError, never anything else."""

from __future__ import annotations

import re
import time

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from packwork.errors import ReadError
from packwork.readers import reading
from packwork.readers.pictures.mask import trace_mask
from packwork.readers.pictures.silhouette import item_of_picture
from packwork.readers.svg.item import item_of_svg, read_svg
from packwork.readers.svg_syntax import path_data
from packwork.scene.item import Item

SPACES = 'xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"'
VALID = (
    f'<svg {SPACES} width="4cm" viewBox="0 0 100 80"><style>.a{{fill:none;stroke:#123;'
    'stroke-width:4;stroke-linejoin:miter}</style><defs><g id="x"><rect width="20" '
    'height="10" rx="3"/></g><linearGradient id="g"><stop offset="0" stop-color="red"/>'
    '</linearGradient></defs><use xlink:href="#x" transform="rotate(20 5 5) scale(2,1)"/>'
    '<path class="a" d="M10 10C20 20 40-5 60 40S3 4 50 60a10 5 30 0 1 9-9T30 30Q1 2 9 70z"/>'
    '<g fill="url(#g)" fill-rule="evenodd"><polygon points="50,5 79,75 3,39 97,39 21,75"/>'
    '<ellipse cx="50%" cy="40" rx="9" ry="4mm"/></g></svg>'
).encode()

HANG_S = 40.0
"""Some times the processor time that any of these takes, far less than it would be unbounded."""

PARTS = 16
"""Parts into which budgets and that time are divided, so that the test takes less."""

TOKENS = st.sampled_from(
    [*"MmLlHvCcSqTAazZe01,", "-1", ".5", "1e3", "1e-9", "-1e7", "50", "99.9"]
) | (st.sampled_from(["1e300", "NaN", "inf", "00"]))


def item_or_read_error(data: bytes) -> None:
    try:
        item = item_of_svg(data, "a", "a.svg", is_compared=True)
    except ReadError as error:
        message = str(error)
    else:
        assert_usable(item)
        return
    assert message.startswith("a.svg: ")
    assert len(message.splitlines()) == 1


def assert_usable(item: Item) -> None:
    assert item.outline.region.is_valid
    assert item.ink.region.is_valid
    assert item.outline.area > 0
    assert np.hypot(*item.outline.centroid) < 1e-6 * item.outline.extent


@settings(deadline=None, max_examples=100)
@given(st.binary(max_size=200))
def test_any_bytes(data):
    item_or_read_error(data)


@settings(deadline=None, max_examples=100)
@given(st.text(max_size=200))
def test_any_body(text):
    item_or_read_error(f"<svg {SPACES}>{text}</svg>".encode("utf-8", "replace"))


@settings(deadline=None, max_examples=150)
@given(st.data())
def test_mutated_bytes(data):
    mutated = bytearray(VALID)
    for _ in range(data.draw(st.integers(1, 8))):
        place = data.draw(st.integers(0, len(mutated) - 1))
        mutated[place] = data.draw(st.integers(0, 255))
    item_or_read_error(bytes(mutated))


@settings(deadline=None, max_examples=100)
@given(st.integers(0, len(VALID)), st.integers(0, 30))
def test_spliced_bytes(place, length):
    item_or_read_error(VALID[:place] + VALID[place + length :])


@settings(deadline=None, max_examples=200)
@example(["M", "0", "0", "NaN"], "0", "miter")
@given(
    st.lists(TOKENS, max_size=25),
    st.sampled_from(["0", "3", "1e-9", "1e9", "50%", "-1", "NaN"]),
    st.sampled_from(["miter", "round", "bevel"]),
)
def test_any_path(tokens, width, join):
    body = (
        f'<path d="M5 5 {" ".join(tokens)}" stroke="red" stroke-width="{width}"'
        f' stroke-linejoin="{join}" stroke-linecap="round"/>'
    )
    item_or_read_error(f"<svg {SPACES}>{body}</svg>".encode())


@settings(deadline=None, max_examples=60)
@given(st.lists(st.floats(), min_size=6, max_size=6))
def test_any_transform(numbers):
    matrix = " ".join(map(repr, numbers))
    body = f'<g transform="matrix({matrix})"><circle r="9" stroke="red"/></g>'
    item_or_read_error(f"<svg {SPACES}>{body}</svg>".encode())


@settings(deadline=None, max_examples=40)
@given(st.data())
def test_mutated_drawings_that_are_traced(data):
    traced = bytearray(VALID.replace(b"</svg>", b'<text y="60" font-size="30">ab</text></svg>'))
    for _ in range(data.draw(st.integers(0, 4))):
        place = data.draw(st.integers(0, len(traced) - 1))
        traced[place] = data.draw(st.integers(32, 126))
    item_or_read_error(bytes(traced))


RICH = (
    f'<svg {SPACES} viewBox="0 0 100 100"><filter id="f"><feGaussianBlur stdDeviation="2"/>'
    '<feComposite in2="SourceAlpha" operator="in"/></filter><clipPath id="c"><circle cx="50"'
    ' cy="50" r="40"/></clipPath><mask id="m"><rect width="60" height="90" fill="#999"/></mask>'
    '<style>:root{--i:#05f}.a{fill:var(--i, red);clip-path:url(#c)}</style><g class="a">'
    '<rect width="90" height="30" rx="9" filter="url(#f)"/></g><path d="M9 9H90V80" fill="none"'
    ' stroke="#000" stroke-width="3" stroke-dasharray="5 2 0" stroke-dashoffset="3"/>'
    '<g mask="url(#m)"><path d="M20 20h50v50z"/></g><svg x="5" width="50%" viewBox="0 0 9 9">'
    '<text y="8" font-size="5">a<tspan fill="red" dx="1">b</tspan></text></svg></svg>'
).encode()
NUMBERS = st.sampled_from([b"0", b"-1", b"1e7", b"1e-7", b"NaN", b"99", b"0.5", b"1e5", b"#"])


@settings(deadline=None, max_examples=8)
@given(st.data())
def test_changed_numbers_of_rich_drawings(data):
    changed = RICH
    for _ in range(data.draw(st.integers(1, 4))):
        numbers = list(re.finditer(rb"\d+", changed))
        number = numbers[data.draw(st.integers(0, len(numbers) - 1))]
        changed = changed[: number.start()] + data.draw(NUMBERS) + changed[number.end() :]
    item_or_read_error(changed)


ZIGZAG = "".join(f"L{k * 0.01:.2f} {k % 2 * 90}" for k in range(3000))
TURNS = 2.4 * np.arange(180)
STAR = " ".join(f"{50 + 45 * np.cos(t):.2f} {50 + 45 * np.sin(t):.2f}" for t in TURNS)
CLIP = '<clipPath id="c">{}</clipPath>'


@pytest.mark.parametrize(
    "body",
    [
        f'<path d="M0 0{ZIGZAG}" fill="none" stroke="#000" stroke-width=".01"/>',
        CLIP.format(f'<path d="M{STAR}z"/>')
        + "".join(
            f'<g clip-path="url(#c)" transform="rotate({k})"><path d="M{STAR}z"/></g>'
            for k in range(100)
        ),
        CLIP.format('<circle r="90"/>') + '<g clip-path="url(#c)"><rect width="9"/></g>' * 900,
        '<mask id="m"><circle r="9000" fill="#fff"/></mask><circle r="9000" mask="url(#m)"/>' * 2,
        '<mask id="m"><circle r="90" fill="#fff"/></mask>' + '<circle r="9" mask="url(#m)"/>' * 250,
        '<path d="' + "".join(f"M0 0H{90 - k / 100}V{90 - k / 100}z" for k in range(4000)) + '"/>',
        '<rect width="90" height="90" opacity=".5"/>' * 2000,
        "".join(f'<text y="{k}">word {k}</text>' for k in range(15)),
        "".join(f'<path d="M{k} 0l90 90" stroke="#000"/>' for k in range(8200)),
        '<path d="M0 0' + "C9 50 -9 50 1 1" * 200 + '" stroke="none"/>',
        '<filter id="f" x="-1" y="-1" width="3" height="3"><feGaussianBlur stdDeviation="90"/>'
        '</filter>' + '<rect width="9000" height="9000" filter="url(#f)"/>' * 200,
    ],
    ids=[
        "zigzag", "stars in stars", "clips", "huge masks", "masks", "nested rings", "layers",
        "texts", "lines", "one on another", "filters",
    ],
)  # fmt: skip
def test_drawings_that_would_take_minutes(body, monkeypatch):
    """With a part of the budgets, in the same part of the time: so it holds for all of them."""
    monkeypatch.setattr(reading, "SHAPES_NS", reading.SHAPES_NS / PARTS)
    monkeypatch.setattr(reading, "PICTURES_NS", reading.PICTURES_NS / PARTS)
    begin = time.process_time()
    item_or_read_error(svg(body))
    assert time.process_time() - begin < HANG_S / PARTS


@settings(deadline=None, max_examples=60)
@given(st.binary(max_size=100))
def test_any_bytes_as_a_picture(data):
    for head in (b"", b"\x89PNG\r\n\x1a\n", b"GIF89a", b"BM", b"RIFF0000WEBPVP8 ", b"\xff\xd8\xff"):
        with pytest.raises(ReadError, match=r"^a\.png: is "):
            item_of_picture(head + data, "a", "a.png")


@settings(deadline=None, max_examples=60)
@given(st.binary(max_size=300))
def test_any_bytes_as_a_mask(tmp_path_factory, data):
    path = tmp_path_factory.mktemp("masks") / "mask.png"
    path.write_bytes(data)
    with pytest.raises(ReadError, match=r"mask\.png"):
        trace_mask(path)


def svg(body: str) -> bytes:
    return f'<svg {SPACES} viewBox="0 0 100 100">{body}</svg>'.encode()


@pytest.mark.parametrize(
    ("body", "problem"),
    [
        ("", "paints no area"),
        ('<path d="M0 0L50 50"/>', "paints no area"),
        ('<path d="M0 0h50h-50z"/>', "paints no area"),
        ('<path fill="none" d="M0 0h50v50z"/>', "paints no area"),
        ('<rect x="200" width="9" height="9"/>', "paints no area"),
        ('<path d="M0 0L NaN 5 5 5z"/>', "NaN"),
        ('<circle r="NaN"/>', "NaN"),
        ('<path d="M0 0L1e300 5 5 5z"/>', "1e\\+300"),
        ('<path d="M0 0L1e999 5 5 5z"/>', "inf"),
        ('<g transform="scale(1e7)"><rect transform="scale(1e7)" width="1" height="1"/></g>', "1e"),
        ('<rect width="1e-9" height="1e-9"/>', "too little"),
        ('<rect width="100" height="1e-9"/>', "too little|no area"),
        (
            '<path d="M0 0' + " ".join(f"L{k % 97} {k * k % 89}" for k in range(9000)) + 'z"/>',
            "cross",
        ),
        ("<rect width='1' height='1'/>" * 60_000, "grows to"),
    ],
)
def test_unusable_drawings(body, problem):
    with pytest.raises(ReadError, match=problem):
        item_of_svg(svg(body), "a", "a.svg")


def test_a_path_of_too_many_segments(monkeypatch):
    monkeypatch.setattr(path_data, "MAX_SEGMENTS", 5_000)
    with pytest.raises(ReadError, match="more than 5,000 segments"):
        item_of_svg(svg('<path d="M0 0' + "h1" * 5_001 + 'z"/>'), "a", "a.svg")


@pytest.mark.parametrize(
    ("page", "problem"),
    [
        ('viewBox="0 0 0 9"', "viewBox of 0 x 9"),
        ('viewBox="0 0 1e12 9"', "1e\\+12"),
        ('width="-5" height="9"', "page of -5 x 9"),
        ('width="NaN"', "NaN"),
    ],
)
def test_unusable_pages(page, problem):
    with pytest.raises(ReadError, match=problem):
        item_of_svg(f"<svg {page}><rect width='9' height='9'/></svg>".encode(), "a", "a.svg")


BIG_TILE = '<pattern id="p" {}><circle r="5"/></pattern><rect width="90" height="90" {}/>'


@pytest.mark.parametrize(
    ("pattern", "shape"),
    [
        ('width="40" height="40"', 'fill="url(#p)"'),
        ('width="9999" height="9" patternUnits="userSpaceOnUse"', 'fill="url(#p)"'),
        ('width="1" height="1" patternTransform="scale(999)"', 'fill="url(#p)"'),
        (
            'width="9" height="9" patternUnits="userSpaceOnUse"',
            'fill="url(#p)" transform="scale(99)"',
        ),
    ],
)
def test_tiles_that_no_renderer_could_hold(pattern, shape):
    with pytest.raises(ReadError, match="pattern tile"):
        item_of_svg(svg(BIG_TILE.format(pattern, shape)), "a", "a.svg")


def test_tiles_for_a_clipped_corner():
    body = (
        '<clipPath id="c"><rect width="1" height="1"/></clipPath>'
        '<pattern id="p" width="1" height="1"><rect width="99" height="99"/></pattern>'
        '<rect width="90" height="90" fill="url(#p)" clip-path="url(#c)"/>'
    )
    with pytest.raises(ReadError, match="pattern tile"):
        item_of_svg(svg(body), "a", "a.svg")


def test_missing_file():
    with pytest.raises(ReadError, match="no such file"):
        read_svg("nowhere/bear.svg")


def test_folder_for_a_file(tmp_path):
    with pytest.raises(ReadError, match="is a folder"):
        read_svg(tmp_path)
