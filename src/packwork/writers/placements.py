"""Places of parts as a table: where each lies on its sheet, for spreadsheets and machines."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Iterator, Sequence

import numpy as np
import shapely

from packwork.geometry import affine
from packwork.scene.item import Item
from packwork.scene.layout import Layout
from packwork.scene.line_art import LineArt
from packwork.scene.notation import decimals, number, sound_text
from packwork.writers.svg import NAME_LENGTH, PRECISION

FORMULA = ("=", "+", "-", "@", "\t", "\r")
"""First letters by which spreadsheets take a text for a formula."""


def plain_cell(text: str) -> str:
    """A cell that no spreadsheet takes for a formula.

    Examples
    --------
    >>> plain_cell("=1+1"), plain_cell("bracket")
    ("'=1+1", 'bracket')
    """
    return f"'{text}" if text.startswith(FORMULA) else text


def placements_bytes(sheets: Sequence[Layout]) -> bytes:
    r"""CSV of all parts on all sheets, a row for each, sheets and parts counted from 1.

    Lengths are in the sheets' unit, from the top left corner of each, y down: ``x`` and ``y`` of
    the part's centre of area, then its box. Angles are in degrees, clockwise; what is mirrored was
    turned over, left to right, before that.

    Examples
    --------
    >>> from packwork.scene.layout import blank
    >>> placements_bytes([blank(unit="mm")]).decode("utf-8-sig")
    'sheet,number,part,x_mm,y_mm,angle_deg,mirrored,left_mm,top_mm,width_mm,height_mm\n'
    """
    unit = sheets[0].container.unit if sheets else "px"
    lengths = [f"{name}_{unit}" for name in ("x", "y", "left", "top", "width", "height")]
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(
        ["sheet", "number", "part", *lengths[:2], "angle_deg", "mirrored", *lengths[2:]]
    )
    for k, layout in enumerate(sheets, start=1):
        writer.writerows([str(k), *row] for row in _rows(layout))
    # Spreadsheets take letters beyond ASCII for what they are only after such a mark.
    return stream.getvalue().encode("utf-8-sig")


def turned_over(layout: Layout) -> frozenset[int]:
    """Numbers, from 1, of the parts of a nest that are turned over, as its manifest says."""
    said = layout.manifest.get("nest")
    found = said.get("mirrored", ()) if isinstance(said, dict) else ()
    return frozenset(one for one in found if isinstance(one, int)) if (
        isinstance(found, list | tuple)
    ) else frozenset()  # fmt: skip


def line_lengths(layout: Layout) -> tuple[float, float]:
    """Lengths of what a machine cuts of the parts of a nest and of what it engraves, canvas units.

    Examples
    --------
    >>> from packwork.scene.layout import blank
    >>> line_lengths(blank())
    (0.0, 0.0)
    """
    of_item = {item: _own_lengths(item) for item in layout.items}
    lengths = np.array([of_item[item] for item in layout.items]).reshape(-1, 2)
    cut, engraved = layout.poses.axis_scales.max(axis=1) @ lengths
    return float(cut), float(engraved)


def _own_lengths(item: Item) -> tuple[float, float]:
    if isinstance(item.art, LineArt) and item.art.cut:
        scale = math.sqrt(abs(float(np.linalg.det(item.art.matrix[:, :2]))))
        cut, engraved = (
            scale * sum(one.length for one in lines) for lines in (item.art.cut, item.art.engraved)
        )
        return cut, engraved
    return float(shapely.length(item.ink.region)), 0.0


def _rows(layout: Layout) -> Iterator[list[str]]:
    digits = decimals(layout.container.side * PRECISION)
    over = turned_over(layout)
    for k, (item, outline) in enumerate(zip(layout.items, layout.outlines, strict=True)):
        name = " ".join(sound_text(item.label.name or item.name).split())[:NAME_LENGTH]
        left, top, right, bottom = outline.bounds
        centre = affine.apply(layout.poses.matrix(k), item.outline.centroid[None])[0]
        angle = math.degrees(float(layout.poses.angle[k])) % 360.0
        lengths = [
            number(float(v), digits) for v in (*centre, left, top, right - left, bottom - top)
        ]
        yield [
            str(k + 1), plain_cell(name), *lengths[:2], number(round(angle, 6) % 360.0, 6),
            "yes" if k + 1 in over else "no", *lengths[2:],
        ]  # fmt: skip
