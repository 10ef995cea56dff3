"""Small fonts that ask for much: programs that call programs, glyphs of glyphs, huge outlines.

Each is made by formula, and sets words or a container of letters.
"""

from __future__ import annotations

import io
import random
from collections.abc import Callable, Iterator, Mapping
from itertools import pairwise
from typing import Any

from fontTools.fontBuilder import FontBuilder
from fontTools.misc.psCharStrings import T2CharString
from fontTools.pens.ttGlyphPen import TTGlyphPen

from benchmarks.robustness.hostile.running import Line

BIAS = 107
"""Programs are called by their number less this, where there are fewer than 1,240."""


def lines(count: int, seed: int) -> Iterator[Line]:
    """So many runs, each with a font of its own."""
    for number in range(count):
        dice = random.Random(f"fonts {seed} {number}")  # noqa: S311 - nothing secret
        sort = sorted(_FONTS)[number % len(_FONTS)]
        name = "f.otf" if sort in POSTSCRIPT else "f.ttf"
        words = (*dice.choice(_USES), "--font", name, "--effort", "draft", "--levels", "16,32",
                 "-o", "a.svg", "--report", "report.out")  # fmt: skip
        yield Line(number, "fonts", words, {name: _FONTS[sort](dice)})


_USES = (
    ("words", "circle", "aaa aa a", "-n", "3"),
    ("words", "circle", "aaa aa a", "-n", "3", "--text", "live"),
    ("words", "circle", "aa bb", "-n", "12", "--weight-is", "ink"),
    ("fill", "text:aa", "star", "-n", "3"),
    ("fill", "text:aa|bb", "star", "circle", "-n", "4"),
)


def nested(dice: random.Random) -> bytes:
    """A PostScript program that calls another many times, which calls another ..."""
    levels, calls = dice.choice((2, 5, 9, 10, 12)), dice.choice((1, 2, 10, 40))
    lines_drawn = [700, 300, -650, 310, 620, -640, -660, 50, "rlineto"]
    programs: list[list[Any]] = [[*lines_drawn, "return"]]
    programs += [[*([k - 1 - BIAS, "callgsubr"] * calls), "return"] for k in range(1, levels)]
    return _postscript(programs, [0, 0, "rmoveto", levels - 1 - BIAS, "callgsubr", "endchar"])


def calling_itself(dice: random.Random) -> bytes:
    """A program that calls itself, or one that is not there."""
    target = dice.choice((0, 0, 5, 1_000))
    program = [5, 5, "rlineto", target - BIAS, "callgsubr", "return"]
    return _postscript([program], [0, 0, "rmoveto", -BIAS, "callgsubr", "endchar"])


def far_off(dice: random.Random) -> bytes:
    """Curves that add up to places far outside of all that fonts know."""
    steps = dice.choice((10, 500, 5_000))
    size = dice.choice((30_000, 32_767))
    drawn = [size, size, -size, size, size, -size, "rrcurveto"] * steps
    return _postscript([["return"]], [0, 0, "rmoveto", *drawn, "endchar"])


def doubled(dice: random.Random) -> bytes:
    """A glyph that is two of another, which is two of another ..."""
    levels, times = dice.choice((3, 8, 12, 16, 40)), dice.choice((1, 2, 5))
    glyphs = {"g0": _contour(((0, 0), (0, 500), (300, 500), (300, 0)))}
    names = [f"g{k}" for k in range(levels)] + ["a"]
    for before, name in pairwise(names):
        glyphs[name] = _composite(names, [before] * times)
    return _truetype(glyphs)


def containing_itself(dice: random.Random) -> bytes:
    """A glyph that is part of itself, at once or by way of another."""
    names = ["a", "g1", "g2"]
    way = dice.choice((("a",), ("g1",), ("g2", "g1")))
    return _truetype({
        "a": _composite(names, list(way)),
        "g1": _composite(names, ["a"]),
        "g2": _composite(names, ["a", "a"]),
    })  # fmt: skip


def scribbled(dice: random.Random) -> bytes:
    """One contour of many points, each edge across many others."""
    points = dice.choice((40, 400, 4_000, 15_000, 60_000))
    reach = dice.choice((30, 1_000, 32_000))
    return _truetype({
        "a": _contour([(k * 7_919 % reach, k * 104_729 % (reach - 3)) for k in range(points)])
    })  # fmt: skip


def crowded(dice: random.Random) -> bytes:
    """A glyph of many contours, apart or on top of each other."""
    pen = TTGlyphPen(None)
    apart = dice.choice((0, 1, 37))
    for k in range(dice.choice((10, 1_000, 9_000))):
        x, y = k * apart % 1_000, k * apart // 1_000 * 40
        _draw(pen, ((x, y), (x, y + 30), (x + 30, y + 30)))
    return _truetype({"a": pen.glyph()})


def of_odd_size(dice: random.Random) -> bytes:
    """Glyphs that are huge or nothing beside the size that their font has."""
    corner = dice.choice((1, 16, 32_767))
    glyph = _contour(((0, 0), (0, corner), (corner, corner)))
    return _truetype(
        {"a": glyph}, em=dice.choice((16, 1_000, 16_384)), width=dice.choice((0, 1, 65_535))
    )


def of_nothing(dice: random.Random) -> bytes:
    """Letters without ink, or with a line of no width."""
    nothing = TTGlyphPen(None).glyph()
    line = _contour(((0, 0), (500, 500), (0, 0)))
    return _truetype({"a": dice.choice((nothing, line))}, width=dice.choice((0, 600)))


POSTSCRIPT = frozenset({"nested", "calling_itself", "far_off"})
_FONTS: Mapping[str, Callable[[random.Random], bytes]] = {
    make.__name__: make
    for make in (nested, calling_itself, far_off, doubled, containing_itself, scribbled, crowded,
                 of_odd_size, of_nothing)
}  # fmt: skip


def _draw(pen: TTGlyphPen, points: Any) -> None:
    pen.moveTo(points[0])
    for point in points[1:]:
        pen.lineTo(point)
    pen.closePath()


def _contour(points: Any) -> Any:
    pen = TTGlyphPen(None)
    _draw(pen, points)
    return pen.glyph()


def _composite(names: list[str], parts: list[str]) -> Any:
    pen = TTGlyphPen(dict.fromkeys(names))
    for shift, part in enumerate(parts):
        pen.addComponent(part, (1, 0, 0, 1, shift, shift))
    return pen.glyph()


def _begun(names: list[str], em: int, width: int, *, is_truetype: bool) -> FontBuilder:
    builder = FontBuilder(em, isTTF=is_truetype)
    builder.font.recalcBBoxes = False
    builder.setupGlyphOrder(names)
    builder.setupCharacterMap({ord("a"): "a", ord("b"): "a"})
    builder.setupHorizontalMetrics(dict.fromkeys(names, (width, 0)))
    builder.setupHorizontalHeader(ascent=800, descent=-200)
    builder.setupNameTable({"familyName": "Odd", "styleName": "Regular"})
    builder.setupOS2()
    builder.setupPost()
    return builder


def _saved(builder: FontBuilder) -> bytes:
    file = io.BytesIO()
    builder.save(file)
    return file.getvalue()


def _truetype(glyphs: Mapping[str, Any], em: int = 1_000, width: int = 600) -> bytes:
    names = [".notdef", *glyphs]
    builder = _begun(names, em, width, is_truetype=True)
    every = {".notdef": TTGlyphPen(None).glyph(), **glyphs}
    builder.setupGlyf(every, calcGlyphBounds=False)
    for glyph in every.values():
        glyph.xMin, glyph.yMin, glyph.xMax, glyph.yMax = 0, 0, 600, 500
    return _saved(builder)


def _postscript(programs: list[list[Any]], main: list[Any]) -> bytes:
    names = [".notdef", "a"]
    builder = _begun(names, 1_000, 600, is_truetype=False)
    builder.setupCFF("Odd", {}, {name: T2CharString(program=["endchar"]) for name in names}, {})
    top = builder.font["CFF "].cff[0]
    for program in programs:
        top.GlobalSubrs.append(T2CharString(program=program))
    top.CharStrings["a"] = T2CharString(
        program=main, private=top.Private, globalSubrs=top.GlobalSubrs
    )
    return _saved(builder)
