"""Words of a PDF as unseen text over the curves that show them, to be selected and found.

Text render mode 3 (ISO 32000-1, 9.3.6) paints nothing, so that its font needs widths but no
shapes, as in the PDFs of OCR programs (Smith, "An Overview of the Tesseract OCR Engine", 2007):
no licence is asked for, and all scripts are written alike. Words are added to the structure
tree that Typst writes, in their order.

A bent word is one straight run, from its first letter to its last through their middle. Programs
that read text join letters by nearness: those of a run apiece, each turned on the curve, come
apart in Firefox, and PDFium reads some words twice. Poppler takes tilted runs apart too, and what
leaves the page, unless ``ActualText`` says the word; leftward words have none, as it and PDFium
read that from the left.
"""

from __future__ import annotations

import math
import struct
from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise
from typing import TypeAlias, final

import numpy as np
import pikepdf
from pikepdf import Array, Dictionary, Name

from packwork.arrays import FloatArray
from packwork.geometry import affine
from packwork.scene.item import TextRun, VectorArt
from packwork.scene.layout import Layout
from packwork.scene.notation import number
from packwork.units import convert
from packwork.writers.prepress.sheet import PrintSheet

_NAME = "Unseen"

_EM = 1_000

_STEP = 20
"""Steps of the font's widths, in thousandths of an em; the text says what is left. Smaller makes
more codes. Chosen."""

_WIDEST = 100
"""Steps of the widest character."""

_SPACE = 12
"""Steps of the space that parts a word from the next."""

_LEVEL = 1e-3
"""Slope up to which a run is level. Chosen."""

_DIGITS = 5
"""Decimals of a matrix, whose numbers are points or points to the em."""

_MOST_CODES = 0xFFFF

_Code: TypeAlias = tuple[str, int]
"""A character, and its width in steps."""


def put_unseen_text(pdf: pikepdf.Pdf, layout: Layout, sheet: PrintSheet) -> None:
    """Add the words of a layout to the page of a PDF that Typst set."""
    scale = convert(1.0, layout.container.unit, "pt")
    to_page = np.array([[scale, 0.0, sheet.around], [0.0, -scale, sheet.around + sheet.height]])
    writer = _TextWriter(pdf)
    for placed, runs, language in _words(layout):
        writer.add(affine.compose(to_page, placed), runs, language)
    writer.finish()


def _words(layout: Layout) -> Iterator[tuple[FloatArray, list[TextRun], str]]:
    """Words between spaces, the map from their units to the canvas, and their language."""
    for k, item in enumerate(layout.items):
        if item.text is None or not isinstance(item.art, VectorArt):
            continue
        placed = affine.compose(layout.poses.matrix(k), item.art.matrix)
        for runs in _spans(item.text.runs):
            yield placed, runs, item.text.language


def _spans(runs: Sequence[TextRun]) -> Iterator[list[TextRun]]:
    """Runs up to one that ends in a space or a line; those of a straight line from the left."""
    span = list(runs[:1])
    for before, run in pairwise(runs):
        is_straight = not before.angle and not run.angle
        if before.text[-1:].isspace() or (is_straight and before.y != run.y):
            yield span
            span = []
        span.append(run)
    if span:
        yield span if any(run.angle for run in span) else sorted(span, key=lambda run: run.x)


def _character_ends(run: TextRun) -> FloatArray:
    """``(n, 2, 2)`` left and right end of each character's base line, from the left.

    They are its glyphs' where each is one character, else all as wide.
    """
    ends = np.linspace(0.0, run.advance, len(run.text) + 1)
    if len(run.steps) == len(run.text):
        ends = np.maximum.accumulate([*run.steps, run.advance])
    along = run.size * np.column_stack([ends, np.zeros_like(ends)])
    points = affine.apply(affine.similarity(run.x, run.y, run.angle, 1.0), along)
    return np.stack([points[:-1], points[1:]], axis=1)


def straight_run(runs: Sequence[TextRun]) -> tuple[FloatArray, str, FloatArray]:
    """One run of all characters of a word, the last a space.

    That is the map from ems (y up) to the word's units, the characters from left to right, and
    ``(n, 2)`` where each begins and ends, in ems.

    Examples
    --------
    >>> from packwork.scene.item import FontFile
    >>> font, right = FontFile(b"", "sans"), np.pi / 2
    >>> up = TextRun("o", font, 0.0, 10.0, 10.0, (0.0,), 1.0, angle=-right)
    >>> along = TextRun("x", font, 0.0, 0.0, 10.0, (0.0,), 1.0)
    >>> place, text, ends = straight_run([up, along])
    >>> np.degrees(np.arctan2(-place[1, 0], place[0, 0])).round().item(), text
    (45.0, 'ox ')
    >>> ends.round(2).tolist()
    [[0.0, 0.71], [0.71, 1.41], [1.41, 1.65]]
    """
    size = max(run.size for run in runs)
    text = "".join(run.text[::-1] if run.is_leftward else run.text for run in runs)
    points = np.concatenate([_character_ends(run) for run in runs])
    shown = len(text.rstrip())
    points = points[:shown] if shown else points
    start = points[0, 0]
    angle = math.atan2(*(points[-1, 1] - start)[::-1])
    across = np.array([-math.sin(angle), math.cos(angle)])
    x, y = start + across * np.mean((points - start) @ across)
    ends = (points - start) @ np.array([math.cos(angle), math.sin(angle)]) / size
    last = ends[-1, 1]
    place = affine.similarity(float(x), float(y), angle, size) * [1.0, -1.0, 1.0]
    return place, f"{text[: len(points)]} ", np.vstack([ends, [last, last + _SPACE * _STEP / _EM]])


@final
class _TextWriter:
    """Content that writes words, and the codes of their characters."""

    def __init__(self, pdf: pikepdf.Pdf) -> None:
        self._pdf, self._page = pdf, pdf.pages[0]
        self._codes: dict[_Code, int] = {}
        self._content: list[str] = []
        tree = pdf.Root.StructTreeRoot
        self._document, self._marked = tree.K[0], tree.ParentTree.Nums[1]

    def add(self, to_page: FloatArray, runs: Sequence[TextRun], language: str) -> None:
        """Add a word, a span of the document; ``to_page`` maps its units to points."""
        if not any(run.text.strip() for run in runs):
            return
        place, text, ends = straight_run(runs)
        matrix = affine.compose(to_page, place)
        if not text.strip() or abs(float(np.linalg.det(matrix[:, :2]))) < 10.0 ** (-2 * _DIGITS):
            return
        if (shown := self._shown(text, ends)) is None:
            return
        mark = len(self._marked)
        element = self._pdf.make_indirect(
            Dictionary(
                Type=Name.StructElem, S=Name.Span, P=self._document, Pg=self._page.obj, K=mark,
            )
        )  # fmt: skip
        if language:
            element.Lang = pikepdf.String(language)
        self._marked.append(element)
        self._document.K.append(element)
        numbers = " ".join(number(float(v), _DIGITS) for v in matrix.T.ravel())
        shown = f"{numbers} Tm [{shown}] TJ"
        is_plain = not self._takes_apart(matrix, ends) or any(run.is_leftward for run in runs)
        said = "" if is_plain else f" /ActualText <{_hex(text)}>"
        self._content += [f"/Span <</MCID {mark}{said}>> BDC", f"BT {shown} ET", "EMC"]

    def _takes_apart(self, matrix: FloatArray, ends: FloatArray) -> bool:
        """Whether a run is parallel to no side of the page, or leaves the page as tiles' may."""
        along = np.abs(matrix[:, 0])
        sides = affine.apply(matrix, np.array([[ends[0, 0], 0.0], [ends[-1, 1], 0.0]]))
        low, high = np.reshape([float(v) for v in self._page.mediabox], (2, 2))
        is_inside = bool(((sides > low) & (sides < high)).all())
        return not is_inside or bool(along.min() > _LEVEL * along.max())

    def _shown(self, text: str, ends: FloatArray) -> str | None:
        """Codes of characters, and by how much each is wider than up to the next.

        None where the font has no room for them: words that would be read wrong are left out.
        """
        steps = np.clip(np.rint((ends[:, 1] - ends[:, 0]) * _EM / _STEP), 1, _WIDEST).astype(int)
        wanted = list(zip(text, steps.tolist(), strict=True))
        if len(self._codes) + len({*wanted} - self._codes.keys()) > _MOST_CODES:
            return None
        codes = [self._codes.setdefault(one, len(self._codes) + 1) for one in wanted]
        over = steps[:-1] * _STEP - np.diff(ends[:, 0]) * _EM
        parts = [f"<{code:04X}>{number(v, 0)}" for code, v in zip(codes, over, strict=False)]
        return " ".join([*parts, f"<{codes[-1]:04X}>"])

    def finish(self) -> None:
        """Put the words on the page, on top of all."""
        if not self._content:
            return
        self._page.add_resource(self._font(), Name.Font, Name(f"/{_NAME}"))
        self._page.contents_add(b"q\n", prepend=True)
        content = "\n".join(["Q", "q", f"/{_NAME} 1 Tf 3 Tr", *self._content, "Q", ""])
        self._page.contents_add(content.encode())

    def _font(self) -> pikepdf.Object:
        """Font whose characters show nothing."""
        pdf, name = self._pdf, Name(f"/{_NAME}")
        steps = [steps for _, steps in self._codes]
        descriptor = Dictionary(
            Type=Name.FontDescriptor, FontName=name, Flags=4, FontBBox=[0, _LOW, _EM, _HIGH],
            ItalicAngle=0, Ascent=_HIGH, Descent=_LOW, CapHeight=_HIGH, StemV=80,
            FontFile2=pdf.make_stream(_font_file(max(steps))),
        )  # fmt: skip
        system = Dictionary(
            Registry=pikepdf.String("Adobe"), Ordering=pikepdf.String("Identity"), Supplement=0
        )
        drawn = Dictionary(
            Type=Name.Font, Subtype=Name.CIDFontType2, BaseFont=name,
            CIDSystemInfo=system,
            FontDescriptor=pdf.make_indirect(descriptor), W=[1, [_STEP * k for k in steps]],
            CIDToGIDMap=pdf.make_stream(struct.pack(f">{len(steps) + 1}H", 0, *steps)),
        )  # fmt: skip
        font = Dictionary(
            Type=Name.Font, Subtype=Name.Type0, BaseFont=name, Encoding=Name("/Identity-H"),
            DescendantFonts=Array([pdf.make_indirect(drawn)]),
            ToUnicode=pdf.make_stream(_unicode_map(self._codes).encode()),
        )  # fmt: skip
        return pdf.make_indirect(font)


def _hex(text: str) -> str:
    return f"FEFF{text.encode('utf-16-be').hex()}"


def _unicode_map(codes: Mapping[_Code, int]) -> str:
    """CMap from codes to characters (ISO 32000-1, 9.10.3), at most 100 in a block."""
    rows = [
        f"<{code:04X}> <{character.encode('utf-16-be').hex()}>"
        for (character, _), code in codes.items()
    ]
    blocks = []
    for first in range(0, len(rows), 100):
        block = rows[first : first + 100]
        blocks += [f"{len(block)} beginbfchar", *block, "endbfchar"]
    return "\n".join(
        [
            "/CIDInit /ProcSet findresource begin", "12 dict begin", "begincmap",
            "/CIDSystemInfo <</Registry (Adobe) /Ordering (UCS) /Supplement 0>> def",
            f"/CMapName /{_NAME} def", "/CMapType 2 def",
            "1 begincodespacerange", "<0000> <FFFF>", "endcodespacerange", *blocks,
            "endcmap", "CMapName currentdict /CMap defineresource pop", "end", "end",
        ]
    )  # fmt: skip


_LOW, _HIGH = -250, 750


def _font_file(widest: int) -> bytes:
    """TrueType font with the tables that a PDF asks for (9.9), its glyphs 0, 1, ... steps wide.

    Each is a line across its em and back: it has no area but a box, without which PDFium takes
    a character for none.
    """
    widths = [_STEP * k for k in range(widest + 1)]
    lines = [
        struct.pack(">5hHHBB4h", 1, 0, _LOW, w, _HIGH, 1, 0, 1, 1, 0, w, _LOW, _HIGH - _LOW)
        for w in widths
    ]
    places, count = range(0, 12 * len(lines) + 1, 12), len(lines)
    tables = {
        b"glyf": b"".join(lines),
        b"head": struct.pack(
            ">IIIIHHqqhhhhHHhhh", 0x10000, 0x10000, 0, 0x5F0F3CF5, 0, _EM, 0, 0,
            0, _LOW, widths[-1], _HIGH, 0, 8, 2, 0, 0,
        ),
        b"hhea": struct.pack(
            ">IhhhH11hH", 0x10000, _HIGH, _LOW, 0, widths[-1], 0, 0, widths[-1], 1, *[0] * 7, count
        ),
        b"hmtx": b"".join(struct.pack(">Hh", w, 0) for w in widths),
        b"loca": struct.pack(f">{count + 1}H", *places),
        b"maxp": struct.pack(">I14H", 0x10000, count, 2, 1, 0, 0, 2, *[0] * 8),
    }  # fmt: skip
    start, records, content = 12 + 16 * len(tables), b"", b""
    for tag, table in tables.items():
        padded = table + bytes(-len(table) % 4)
        total = sum(struct.unpack(f">{len(padded) // 4}I", padded)) & 0xFFFFFFFF
        records += struct.pack(">4sIII", tag, total, start + len(content), len(table))
        content += padded
    head = struct.pack(">IHHHH", 0x10000, len(tables), 64, 2, 32)
    return head + records + content
