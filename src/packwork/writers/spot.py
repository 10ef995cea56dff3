"""Cut lines in a PDF, in a spot colour: an update appended to a file that Typst made.

Print-and-cut programs look for a separation called CutContour. Typst knows no spot colours, so
the page is described anew, as PDF lets files be changed (ISO 32000-1, 7.5.6): what stands in
the file stays, new objects and a new cross-reference table come after it.
"""

from __future__ import annotations

import re
import zlib
from collections.abc import Sequence
from dataclasses import dataclass

from packwork.arrays import FloatArray
from packwork.errors import WriteError
from packwork.scene.notation import number
from packwork.writers.cutting import HAIRLINE_PT, SPOT

_DIGITS = 4
"""Decimals of a coordinate, in points: 35 nm."""

_PAGE = re.compile(rb"(\d+) 0 obj\n(<</Type/Page/(?:(?!endobj).)*?>>)\nendobj", re.DOTALL)
_RESOURCES = re.compile(rb"/Resources (\d+) 0 R")
_CONTENTS = re.compile(rb"/Contents (\d+) 0 R")
_TRAILER = re.compile(rb"trailer\n<<(/Size (\d+).*?)>>\nstartxref\n(\d+)\n", re.DOTALL)


@dataclass(frozen=True, kw_only=True)
class Press:
    """What a print shop asks of a page, in points.

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


def prepared(pdf: bytes, press: Press) -> bytes:
    """PDF of one page with its boxes, and its cut lines on top in the spot colour.

    Raises
    ------
    WriteError
        If it is not laid out as Typst lays it out.
    """
    pages = _PAGE.findall(pdf)
    trailer = _TRAILER.search(pdf, pdf.rfind(b"trailer"))
    if len(pages) != 1 or trailer is None:
        raise WriteError("PDF", "the page could not be prepared for cutting; write SVG or DXF")
    (number_, page), size = pages[0], int(trailer[2])
    resources, contents = _RESOURCES.search(page), _CONTENTS.search(page)
    if resources is None or contents is None:
        raise WriteError("PDF", "the page could not be prepared for cutting; write SVG or DXF")
    update = _Update(pdf, size)
    if press.lines:
        update.add(int(resources[1]), _with_spot(_body(pdf, int(resources[1])), size, size + 1))
        update.add(size, _separation())
        update.add(size + 1, b"<</Type/ExtGState/OP true/op true/OPM 1>>")
        before, after = update.stream(b"q\n"), update.stream(_drawn(press))
        shown = b"[%d 0 R %s 0 R %d 0 R]" % (before, contents[1], after)
        page = page.replace(contents[0], b"/Contents " + shown)
    page = page.removesuffix(b">>") + _boxes(press) + b">>"
    update.add(int(number_), page)
    return update.written(trailer[1], int(trailer[3]))


class _Update:
    """Objects that come after a file, which stays as it is."""

    def __init__(self, pdf: bytes, size: int) -> None:
        self._pdf = pdf if pdf.endswith(b"\n") else pdf + b"\n"
        self._next = size + 2
        self._objects: dict[int, bytes] = {}

    def add(self, key: int, body: bytes) -> None:
        """Add an object, or replace one."""
        self._objects[key] = body

    def stream(self, data: bytes) -> int:
        """Add a stream; its number."""
        packed = zlib.compress(data, 9)
        key, self._next = self._next, self._next + 1
        head = b"<</Length %d/Filter/FlateDecode>>" % len(packed)
        self.add(key, head + b"\nstream\n" + packed + b"\nendstream")
        return key

    def written(self, trailer: bytes, before: int) -> bytes:
        """The whole file, its last table first to be read and leading on to the older one."""
        parts, places, end = [self._pdf], {}, len(self._pdf)
        for key, body in sorted(self._objects.items()):
            places[key] = end
            parts.append(b"%d 0 obj\n" % key + body + b"\nendobj\n")
            end += len(parts[-1])
        rows = b"".join(b"%d 1\n%010d 00000 n\r\n" % place for place in places.items())
        size = max(self._next, *self._objects) if self._objects else self._next
        said = re.sub(rb"/Size \d+", b"/Size %d/Prev %d" % (size, before), trailer)
        parts.append(b"xref\n" + rows + b"trailer\n<<" + said + b">>\n")
        parts.append(b"startxref\n%d\n%%%%EOF\n" % end)
        return b"".join(parts)


def _body(pdf: bytes, key: int) -> bytes:
    found = re.search(rb"(?:^|\n)%d 0 obj\n(.*?)\nendobj" % key, pdf, re.DOTALL)
    if found is None or not found[1].startswith(b"<<"):
        raise WriteError("PDF", "the page could not be prepared for cutting; write SVG or DXF")
    return found[1]


def _with_spot(resources: bytes, colour: int, state: int) -> bytes:
    """Resources of a page, the spot colour and printing over among them."""
    for key, entry in (
        (b"/ColorSpace", b"/%s %d 0 R" % (SPOT.encode(), colour)),
        (b"/ExtGState", b"/%s %d 0 R" % (SPOT.encode(), state)),
    ):
        if key + b"<<" in resources:
            resources = resources.replace(key + b"<<", key + b"<<" + entry, 1)
        else:
            resources = resources.removesuffix(b">>") + key + b"<<" + entry + b">>>>"
    return resources


def _separation() -> bytes:
    """The spot colour: magenta where there is no such ink."""
    tint = b"<</FunctionType 2/Domain[0 1]/C0[0 0 0 0]/C1[0 1 0 0]/N 1>>"
    return b"[/Separation/" + SPOT.encode() + b"/DeviceCMYK " + tint + b"]"


def _drawn(press: Press) -> bytes:
    """Content that strokes the lines, over what is there and without knocking it out."""
    top = press.bleed + press.height
    lines = [
        "Q", "q", f"/{SPOT} gs", f"/{SPOT} CS", "1 SCN", f"{HAIRLINE_PT:g} w", "1 j",
    ]  # fmt: skip
    for ring in press.lines:
        points = [
            f"{number(press.bleed + x, _DIGITS)} {number(top - y, _DIGITS)}"
            for x, y in ring.tolist()
        ]
        lines.append(f"{points[0]} m " + " ".join(f"{point} l" for point in points[1:]) + " s")
    return "\n".join([*lines, "Q", ""]).encode()


def _boxes(press: Press) -> bytes:
    """What is trimmed, and what is printed beyond it."""
    low, wide, high = press.bleed, press.width, press.height
    trim = " ".join(f"{v:.9g}" for v in (low, low, low + wide, low + high))
    whole = " ".join(f"{v:.9g}" for v in (0, 0, wide + 2 * low, high + 2 * low))
    return f"/TrimBox[{trim}]/BleedBox[{whole}]".encode()
