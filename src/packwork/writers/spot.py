"""Pages made ready for print shops: boxes that say where they are trimmed, lines in a spot colour.

Print-and-cut programs look for a separation called CutContour, and Typst, which sets the page,
knows no spot colours.
"""

from __future__ import annotations

import io
from collections.abc import Sequence
from dataclasses import dataclass

from packwork.arrays import FloatArray
from packwork.scene.notation import number
from packwork.writers.cutting import HAIRLINE_PT, SPOT

_DIGITS = 4
"""Decimals of a coordinate, in points: 35 nm."""


@dataclass(frozen=True, kw_only=True)
class Press:
    """Demands of a print shop on a page, in points.

    Parameters
    ----------
    lines
        Closed lines to cut, y down from the top of the sheet that is left after trimming.
    width, height
        Of that sheet.
    bleed
        What is printed beyond it on each side.
    """

    lines: Sequence[FloatArray]
    width: float
    height: float
    bleed: float = 0.0


def prepared(data: bytes, press: Press) -> bytes:
    """PDF of one page with its boxes, and its cut lines on top in the spot colour."""
    import pikepdf
    from pikepdf import Array, Dictionary, Name

    with pikepdf.open(io.BytesIO(data)) as pdf:
        # False unless it is said; programs made with Poppler call it an error where it is.
        if "/Suspects" in (marked := pdf.Root.get("/MarkInfo", Dictionary())):
            del marked["/Suspects"]
        page = pdf.pages[0]
        if press.lines or press.bleed:
            low, wide, high = press.bleed, press.width, press.height
            page.TrimBox = [round(v, 6) for v in (low, low, low + wide, low + high)]
            page.BleedBox = [round(v, 6) for v in (0, 0, wide + 2 * low, high + 2 * low)]
        if press.lines:
            # Magenta where there is no such ink.
            tint = Dictionary(FunctionType=2, Domain=[0, 1], C0=[0] * 4, C1=[0, 1, 0, 0], N=1)
            ink = Array([Name.Separation, Name(f"/{SPOT}"), Name.DeviceCMYK, tint])
            page.add_resource(pdf.make_indirect(ink), Name.ColorSpace, Name(f"/{SPOT}"))
            over = Dictionary(Type=Name.ExtGState, OP=True, op=True, OPM=1)
            page.add_resource(pdf.make_indirect(over), Name.ExtGState, Name.Overprint)
            page.contents_add(b"q\n", prepend=True)
            page.contents_add(b"Q\n" + _drawn(press))
        written = io.BytesIO()
        pdf.save(written, deterministic_id=True)
        return written.getvalue()


def _drawn(press: Press) -> bytes:
    """Content that strokes the lines, over what is there and without knocking it out."""
    top = press.bleed + press.height
    lines = ["q", "/Overprint gs", f"/{SPOT} CS", "1 SCN", f"{HAIRLINE_PT:g} w", "4 M"]
    for ring in press.lines:
        points = [
            f"{number(press.bleed + x, _DIGITS)} {number(top - y, _DIGITS)}"
            for x, y in ring.tolist()
        ]
        lines.append(f"{points[0]} m " + " ".join(f"{point} l" for point in points[1:]) + " s")
    return "\n".join([*lines, "Q", ""]).encode()
