"""Drawings whose paint may lie elsewhere than their shapes, each filled, measured and painted."""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator

from benchmarks.robustness.hostile.running import Line
from benchmarks.robustness.wild import FEATURES, PAGES, SPACES

PLACES = (
    ' x="6" y="3"', ' transform="rotate(20)"', ' opacity=".4"', ' overflow="visible"',
    ' preserveAspectRatio="defer xMaxYMin slice"', "", "", "",
)  # fmt: skip
OPTIONS = (
    (), ("--stretch", "3", "--sizes", "free"), ("--canvas", "120mm"), ("--cut", "outlines"),
    ("--rotate", "none", "--padding", "0.4"), ("--show-container",), ("--flatten",),
)  # fmt: skip


CUT, PATTERNED, FILTERED = ' clip-path="url(#c)"', ' fill="url(#p)"', ' filter="url(#f)"'


def lines(count: int, seed: int) -> Iterator[Line]:
    """So many runs of ``fill``, each with a drawing or two made up by chance."""
    for number in range(count):
        dice = random.Random(f"drawings {seed} {number}")  # noqa: S311 - nothing secret
        files = {f"{name}.svg": drawing(dice).encode() for name in "ab"[: dice.choice((1, 1, 2))]}
        words = (
            "fill", dice.choice(("square", "circle", "heart")), *files, "star", "-n", "9",
            "--effort", "draft", "--levels", "16,32", "--epochs", "6", "--threads", "1",
            *dice.choice(OPTIONS), "-o", "out.svg", "--report", "report.out",
        )  # fmt: skip
        yield Line(number, "wild drawings", words, files, is_painted=True)


def drawing(dice: random.Random) -> str:
    """A page with one to four parts, moved, turned, cut and used anywhere."""
    parts = [_part(dice, k) for k in range(dice.choice((1, 1, 2, 2, 3, 4)))]
    if dice.random() < 0.6:
        parts.insert(0, '<circle cx="50" cy="50" r="40" fill="#c63"/>')
    return f"<svg {SPACES} {dice.choice(PAGES)}{dice.choice(PLACES)}>{''.join(parts)}</svg>"


def _part(dice: random.Random, k: int) -> str:
    body = dice.choice(list(FEATURES.values()))
    body = body if dice.random() < 0.4 else dice.choice(_MAKERS)(dice, k)
    # Ids of parts are their own.
    for mark in ('id="', 'href="#', "url(#"):
        body = body.replace(mark, f"{mark}{k}")
    turn = dice.choice(("", "", "", f' transform="{_move(dice)}"'))
    return f"<g{turn}>{body}</g>" if turn else body


def _move(dice: random.Random) -> str:
    return dice.choice((
        f"translate({_far(dice)} {_far(dice)})", f"rotate({dice.randint(0, 359)} 50 50)",
        "scale(-1 1)", f"scale({dice.choice((0.02, 0.5, 3))})", "skewX(40)",
        f"matrix(1 .3 -.2 1 {_far(dice)} 0)",
    ))  # fmt: skip


def _far(dice: random.Random) -> int:
    return dice.choice((-300, -90, -20, 0, 15, 60, 110, 400))


def _shape(dice: random.Random, more: str = "") -> str:
    x, y, size = _far(dice), _far(dice), dice.choice((4, 20, 60, 150))
    return dice.choice((
        f'<rect x="{x}" y="{y}" width="{size}" height="{size}"{more}/>',
        f'<circle cx="{x}" cy="{y}" r="{size / 2}"{more}/>',
        f'<path d="M{x} {y}c{size} 0 0 {size} {size} {size}l-{size / 3} 9z"{more}/>',
        f'<path d="M{x} {y}l{size} {size}" stroke="#06c" stroke-width="{size / 5}"{more}/>',
    ))  # fmt: skip


def _off_page(dice: random.Random, _: int) -> str:
    faint = f' opacity="{dice.choice((0.1, 0.3, 0.7))}"' if dice.random() < 0.3 else ""
    return _shape(dice, faint) + _shape(dice)


def _clipped(dice: random.Random, _: int) -> str:
    inside = dice.choice((
        _shape(dice), f"<g>{_shape(dice)}</g>", '<use xlink:href="#u"/>',
        '<text font-size="60" y="60">A</text>', _shape(dice, ' clip-path="url(#d)"'),
    ))  # fmt: skip
    units = dice.choice(("", ' clipPathUnits="objectBoundingBox" transform="scale(.01)"'))
    return (
        f'<defs><circle id="v" cx="40" cy="40" r="30"/><use id="u" xlink:href="#v"/></defs>'
        '<clipPath id="d"><rect width="50" height="90"/></clipPath>'
        f'<clipPath id="c"{units}>{inside}</clipPath>{_shape(dice, CUT)}'
    )


def _nested(dice: random.Random, _: int) -> str:
    size = dice.choice(("", ' width="40" height="30"', ' width="0" height="9"', ' width="50%"'))
    view = dice.choice(("", ' viewBox="0 0 10 10"', ' viewBox="-50 0 90 40"'))
    more = dice.choice(("", ' overflow="visible"', ' preserveAspectRatio="none"'))
    return f'<svg x="{_far(dice)}" y="10"{size}{view}{more}>{_shape(dice)}{_shape(dice)}</svg>'


def _symbol(dice: random.Random, _: int) -> str:
    own = dice.choice(("", ' width="9" height="30"', ' x="20"', ' transform="rotate(9)"'))
    more = dice.choice(("", ' overflow="visible"', ' refX="5"'))
    size = dice.choice(("", ' width="60" height="20"', ' width="0"'))
    return (
        f'<symbol id="s" viewBox="0 0 50 50"{own}{more}>{_shape(dice)}</symbol>'
        f'<use xlink:href="#s" x="{_far(dice)}"{size}/><use xlink:href="#s" y="40" width="30"/>'
    )


def _pattern(dice: random.Random, _: int) -> str:
    more = dice.choice(("", ' overflow="visible"', ' patternTransform="rotate(30)"'))
    return (
        f'<pattern id="p" width=".3" height=".3"{more}>{_shape(dice)}</pattern>'
        f"{_shape(dice, PATTERNED)}"
    )


def _filtered(dice: random.Random, _: int) -> str:
    step = dice.choice((
        f'<feOffset dx="{_far(dice)}" dy="5"/>', '<feGaussianBlur stdDeviation="8"/>',
        '<feFlood flood-color="red"/>', '<feDropShadow dx="30" dy="30" stdDeviation="2"/>',
    ))  # fmt: skip
    return (
        f'<filter id="f" x="-1" y="-1" width="4" height="4">{step}</filter>{_shape(dice, FILTERED)}'
    )


def _marked(dice: random.Random, _: int) -> str:
    more = dice.choice(("", ' overflow="visible"', ' markerUnits="userSpaceOnUse"'))
    return (
        f'<marker id="m" viewBox="0 0 9 9" markerWidth="{dice.choice((3, 40))}"{more}>'
        f'{_shape(dice)}</marker><path d="M20 20h40v30" fill="none" stroke="#222" '
        'marker-end="url(#m)" marker-mid="url(#m)"/>'
    )


def _text(dice: random.Random, _: int) -> str:
    return f'<text x="{_far(dice)}" y="{_far(dice)}" font-size="{dice.choice((9, 60))}">Ag</text>'


def _stroked(dice: random.Random, _: int) -> str:
    join = dice.choice(
        ('stroke-miterlimit="40"', 'stroke-linecap="square"', 'stroke-dasharray="9"')
    )
    return (
        f'<path d="M{_far(dice)} 10l60 4l-60 4" fill="none" stroke="#080" stroke-width="6" {join}/>'
    )


_MAKERS: tuple[Callable[[random.Random, int], str], ...] = (
    _off_page, _off_page, _clipped, _nested, _symbol, _pattern, _filtered, _marked, _text, _stroked,
)  # fmt: skip
