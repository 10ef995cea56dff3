"""Small fonts made for tests, and folders of them as machines have them.

One font's weight varies, one's glyph is a picture, others are the bundled one by another name.
"""

from __future__ import annotations

import io
import os
from pathlib import Path

from fontTools.fontBuilder import FontBuilder
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
