"""Sheets as one PDF: a page for each as large as it is, then a list of the parts that are cut."""

from __future__ import annotations

import io
import json
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from packwork.errors import WriteError
from packwork.geometry.outline import Outline
from packwork.phrasing import number_of
from packwork.scene.container import Container
from packwork.scene.item import Item
from packwork.scene.layout import Layout
from packwork.scene.notation import sound_text
from packwork.scene.pose import Poses
from packwork.writers.pdf import drawing_text
from packwork.writers.placements import line_lengths, placements_bytes, turned_over
from packwork.writers.svg import NAME_LENGTH, SvgOptions

_PAGE = """\
#let list = json(bytes(sys.inputs.list))
#set document(title: list.title, date: none)
#set page(paper: "a4", margin: 18mm)
#set text(font: "Libertinus Serif", size: 10pt, number-type: "lining", number-width: "tabular")
#text(size: 17pt, weight: "bold", list.title)

#text(fill: luma(90), list.about)
#v(4mm)
#table(
  columns: (22mm, 1fr, auto, auto, auto),
  align: (center + horizon, left + horizon, right + horizon, right + horizon, left + horizon),
  stroke: (x, y) => (bottom: 0.4pt + luma(if y == 0 { 60 } else { 200 })),
  inset: (x: 2mm, y: 1.6mm),
  table.header([], [*part*], [*count*], [*size*], [*on sheet*]),
  ..list.parts.map(part => (
    image(bytes(part.drawing), format: "svg", width: 18mm, height: 13mm, fit: "contain"),
    part.name, part.count, part.size, part.sheets,
  )).flatten()
)
"""


@dataclass(eq=False)
class _Entry:
    """A kind of part: an item as it is drawn, its scale, and how often it is on each sheet."""

    item: Item
    scale: float
    sheets: Counter[int] = field(default_factory=Counter)
    over: int = 0


ENDINGS = (".csv", ".pdf")
"""Endings of files of which there is one for all sheets."""


def is_for_all(path: str | Path) -> bool:
    """Whether a file of that name holds all sheets of a nest.

    Examples
    --------
    >>> is_for_all("parts.csv"), is_for_all("sheet.dxf")
    (True, False)
    """
    return Path(path).suffix.lower() in ENDINGS


def all_sheets_bytes(path: str | Path, sheets: Sequence[Layout], pages: Sequence[bytes]) -> bytes:
    """Content of such a file; ``pages`` are the sheets as PDFs, which only a PDF needs."""
    if Path(path).suffix.lower() == ".csv":
        return placements_bytes(sheets)
    return sheets_pdf(pages, sheets)


def sheets_pdf(pages: Sequence[bytes], sheets: Sequence[Layout]) -> bytes:
    """One PDF of the sheets' pages, each as it was written, and pages of a list of all parts.

    The list names each part, how many there are on which sheets, and its size at its own angle.
    """
    import pikepdf

    with pikepdf.open(io.BytesIO(pages[0])) as whole:
        for page in (*pages[1:], _list(sheets)):
            with pikepdf.open(io.BytesIO(page)) as one:
                whole.pages.extend(one.pages)
        written = io.BytesIO()
        whole.save(written, deterministic_id=True)
        return written.getvalue()


def _list(sheets: Sequence[Layout]) -> bytes:
    import typst

    entries = _entries(sheets)
    count = sum(sum(one.sheets.values()) for one in entries)
    container = sheets[0].container
    about = f"{number_of(count, 'part')} on {number_of(len(sheets), 'sheet')}"
    if len({(one.container.width, one.container.height) for one in sheets}) == 1:
        about += f" of {container.width:.6g} x {container.height:.6g} {container.unit}"
    lengths = [sum(ones) for ones in zip(*map(line_lengths, sheets), strict=True)]
    for doing, length in zip(("cut", "engrave"), lengths, strict=True):
        about += f"; to {doing}: {length:,.1f} {container.unit}" if length else ""
    told = {
        "title": "Parts",
        "about": about,
        "parts": [_told(entry, container.unit, len(sheets)) for entry in entries],
    }
    try:
        pages = typst.compile(
            _PAGE.encode(), sys_inputs={"list": json.dumps(told)}, ignore_system_fonts=True
        )
    except RuntimeError as error:
        reason = " ".join(str(error).split())
        raise WriteError("PDF", f"the list of parts cannot be set ({reason})") from error
    return pages


def _entries(sheets: Sequence[Layout]) -> list[_Entry]:
    """Kinds of parts, in the order in which they are met; those turned over are of their kind."""
    found: dict[tuple[str, str, float], _Entry] = {}
    for number, layout in enumerate(sheets, start=1):
        over = turned_over(layout)
        scales = layout.poses.axis_scales.max(axis=1).tolist()
        for k, (item, scale) in enumerate(zip(layout.items, scales, strict=True)):
            key = (item.label.name or item.name, item.source, scale)
            entry = found.setdefault(key, _Entry(item, scale))
            if entry.over and k + 1 not in over:
                entry.item = item
            entry.sheets[number] += 1
            entry.over += int(k + 1 in over)
    return list(found.values())


def _told(entry: _Entry, unit: str, count: int) -> Mapping[str, Any]:
    left, top, right, bottom = (entry.scale * v for v in entry.item.outline.bounds)
    name = " ".join(sound_text(entry.item.label.name or entry.item.name).split())[:NAME_LENGTH]
    where = ", ".join(f"{many} on {number}" for number, many in sorted(entry.sheets.items()))
    return {
        "name": name + (f" ({entry.over} turned over)" if entry.over else ""),
        "count": str(sum(entry.sheets.values())),
        "size": f"{right - left:.5g} x {bottom - top:.5g} {unit}",
        "sheets": where if count > 1 else "1",
        "drawing": _drawing(entry.item),
    }


def _drawing(item: Item) -> str:
    """SVG of one part, in its own units."""
    left, top, right, bottom = item.outline.bounds
    size = right - left, bottom - top
    one = np.ones(1)
    box = Container("part", "part", Outline.box(0.0, 0.0, *size), *size)
    return drawing_text(
        Layout(box, (item,), Poses(-left * one, -top * one, 0.0 * one, one), one), SvgOptions()
    )
