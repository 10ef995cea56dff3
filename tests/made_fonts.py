"""Small fonts made for tests, and folders of them as machines have them.

One font's weight varies, one's glyph is a picture, others are the bundled one by another name.
"""

from __future__ import annotations

import io
import os
from collections.abc import Sequence
from itertools import pairwise
from pathlib import Path

from fontTools.fontBuilder import FontBuilder
from fontTools.misc.psCharStrings import T2CharString
from fontTools.pens.ttGlyphPen import TTGlyphPen
from fontTools.ttLib import TTFont, newTable
from fontTools.ttLib.tables.sbixGlyph import Glyph
from fontTools.ttLib.tables.sbixStrike import Strike
from fontTools.ttLib.tables.TupleVariation import TupleVariation

from packwork.fonts import bundled_file

SCRIPTS = Path(__file__).parent / "readers" / "fonts"
DEJAVU = ("DejaVu Sans", "DejaVu Sans Mono", "DejaVu Serif")
OTHERS = ("Arial", "Times New Roman", "Courier New", "Liberation Sans", "Noto Sans")
EMOJI = "\U0001f600"
STRIKE_PX = 64


def variable_font() -> bytes:
    """A font of one square, 100 units wide at weight 100 and 300 at 900."""
    builder = FontBuilder(1000, isTTF=True)
    builder.setupGlyphOrder([".notdef", "a"])
    builder.setupCharacterMap({ord("a"): "a"})
    pen = TTGlyphPen(None)
    pen.moveTo((0, 0))
    for point in ((0, 500), (100, 500), (100, 0)):
        pen.lineTo(point)
    pen.closePath()
    builder.setupGlyf({".notdef": TTGlyphPen(None).glyph(), "a": pen.glyph()})
    builder.setupHorizontalMetrics({".notdef": (400, 0), "a": (400, 0)})
    builder.setupHorizontalHeader(ascent=800, descent=-200)
    builder.setupNameTable({"familyName": "Squares", "styleName": "Regular"})
    builder.setupFvar([("wght", 100, 100, 900, "Weight")], [])
    deltas = [(0, 0), (0, 0), (200, 0), (200, 0), (0, 0), (0, 0), (0, 0), (0, 0)]
    builder.setupGvar({"a": [TupleVariation({"wght": (0.0, 1.0, 1.0)}, deltas)], ".notdef": []})
    builder.setupOS2()
    builder.setupPost()
    file = io.BytesIO()
    builder.save(file)
    return file.getvalue()


def emoji_font(picture: bytes) -> bytes:
    """A font of one emoji: a picture as wide as an em, without an outline."""
    builder = FontBuilder(1_000, isTTF=True)
    builder.setupGlyphOrder([".notdef", "face"])
    builder.setupCharacterMap({ord(EMOJI): "face"})
    builder.setupGlyf({name: TTGlyphPen(None).glyph() for name in (".notdef", "face")})
    builder.setupHorizontalMetrics({".notdef": (500, 0), "face": (1_000, 0)})
    builder.setupHorizontalHeader(ascent=900, descent=-100)
    builder.setupNameTable({"familyName": "Faces", "styleName": "Regular"})
    builder.setupOS2()
    builder.setupPost()
    strike = Strike(ppem=STRIKE_PX, resolution=72)
    strike.glyphs = {
        ".notdef": Glyph(glyphName=".notdef"),
        "face": Glyph(
            glyphName="face",
            graphicType="png ",
            imageData=picture,
            originOffsetX=0,
            originOffsetY=0,
        ),
    }
    table = newTable("sbix")
    table.version, table.flags, table.numStrikes = 1, 1, 1
    table.strikes = {STRIKE_PX: strike}
    builder.font["sbix"] = table
    file = io.BytesIO()
    builder.save(file)
    return file.getvalue()


def scribbled_font(points: int) -> bytes:
    """A font whose letter a is one contour of so many points, each edge across all others."""
    pen = TTGlyphPen(None)
    places = [(k * 7_919 % 1_000, k * 104_729 % 997) for k in range(points)]
    pen.moveTo(places[0])
    for place in places[1:]:
        pen.lineTo(place)
    pen.closePath()
    return _font_of_a({"a": pen.glyph()})


def doubled_font(levels: int) -> bytes:
    """A font whose letter a is two of a glyph, which is two of another, and so on."""
    pen = TTGlyphPen(None)
    pen.moveTo((0, 0))
    for place in ((0, 500), (300, 500), (300, 0)):
        pen.lineTo(place)
    pen.closePath()
    glyphs = {"g0": pen.glyph()}
    names = [f"g{k}" for k in range(levels)] + ["a"]
    for before, name in pairwise(names):
        pen = TTGlyphPen(dict.fromkeys(names))
        for shift in (0, 1):
            pen.addComponent(before, (1, 0, 0, 1, shift, shift))
        glyphs[name] = pen.glyph()
    return _font_of_a(glyphs, are_boxed=False)


LINES = (700, 300, -650, 310, 620, -640, -660, 50, "rlineto")


def nested_font(levels: int, calls: int = 10, lines: Sequence[int | str] = LINES) -> bytes:
    """A PostScript font whose letter a calls a program that calls ten that call ten ..."""
    builder = FontBuilder(1_000, isTTF=False)
    builder.font.recalcBBoxes = False
    names = [".notdef", "a"]
    builder.setupGlyphOrder(names)
    builder.setupCharacterMap({ord("a"): "a"})
    builder.setupHorizontalMetrics(dict.fromkeys(names, (600, 0)))
    builder.setupHorizontalHeader(ascent=800, descent=-200)
    builder.setupNameTable({"familyName": "Nested", "styleName": "Regular"})
    builder.setupOS2()
    builder.setupPost()
    empty = {name: T2CharString(program=["endchar"]) for name in names}
    builder.setupCFF("Nested", {}, empty, {})
    top = builder.font["CFF "].cff[0]
    for k in range(levels):
        # A call pushes the number of the program less the bias of 107.
        program = [k - 1 - 107, "callgsubr"] * calls if k else [*lines]
        top.GlobalSubrs.append(T2CharString(program=[*program, "return"]))
    program = [0, 0, "rmoveto", levels - 1 - 107, "callgsubr", "endchar"]
    top.CharStrings["a"] = T2CharString(
        program=program, private=top.Private, globalSubrs=top.GlobalSubrs
    )
    file = io.BytesIO()
    builder.save(file)
    return file.getvalue()


def _font_of_a(glyphs: dict[str, object], *, are_boxed: bool = True) -> bytes:
    names = [".notdef", *glyphs]
    builder = FontBuilder(1_000, isTTF=True)
    builder.setupGlyphOrder(names)
    builder.setupCharacterMap({ord("a"): "a"})
    every = {".notdef": TTGlyphPen(None).glyph(), **glyphs}
    builder.setupGlyf(every, calcGlyphBounds=are_boxed)
    if not are_boxed:
        builder.font.recalcBBoxes = False
        for glyph in every.values():
            glyph.xMin, glyph.yMin, glyph.xMax, glyph.yMax = 0, 0, 600, 500
    builder.setupHorizontalMetrics(dict.fromkeys(names, (600, 0)))
    builder.setupHorizontalHeader(ascent=800, descent=-200)
    builder.setupNameTable({"familyName": "Rich", "styleName": "Regular"})
    builder.setupOS2()
    builder.setupPost()
    file = io.BytesIO()
    builder.save(file)
    return file.getvalue()


def renamed_font(family: str) -> bytes:
    """The bundled font under the name of another family."""
    font = TTFont(bundled_file())
    for record in list(font["name"].names):
        if record.nameID in (1, 16):
            font["name"].setName(
                family, record.nameID, record.platformID, record.platEncID, record.langID
            )
    file = io.BytesIO()
    font.save(file)
    return file.getvalue()


def make_font_folders(folder: Path) -> dict[str, str]:
    """Machines by name, each with the folders that ``PACKWORK_FONTS`` is to name."""
    machines = {"no fonts": (), "DejaVu only": DEJAVU, "many fonts": (*DEJAVU, *OTHERS)}
    for machine, families in machines.items():
        (folder / machine).mkdir()
        for family in families:
            (folder / machine / f"{family}.otf").write_bytes(renamed_font(family))
    (folder / "many fonts" / "broken.ttf").write_bytes(b"\0\1\0\0nonsense")
    found = {machine: str(folder / machine) for machine in machines}
    found["many fonts"] += os.pathsep + str(SCRIPTS)
    return found
