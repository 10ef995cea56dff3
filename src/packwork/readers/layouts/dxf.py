"""Layouts read back from DXF files: the very lines that a machine would follow."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from packwork.arrays import FloatArray
from packwork.geometry.polygon import Region, region
from packwork.readers.layouts.assembly import (
    FoundItem,
    FoundSheet,
    assembled,
    sound_gap,
    sound_weight,
)
from packwork.readers.layouts.dxf_tags import DxfLine, header_of, lines_of, tags_of
from packwork.readers.unfit import UnfitError
from packwork.scene.layout import Layout
from packwork.units import Unit

LINES_ALONE = "holds lines alone: its items are plain shapes of one colour, their angles unknown"
"""Sentence for edits of such a file."""

_UNITS: dict[int, Unit] = {1: "in", 4: "mm", 5: "cm"}
_NOT_OURS = "as packwork writes it; give a DXF that no other program saved again, or a .geojson"


def layout_of_dxf(text: str, name: str) -> Layout:
    r"""Layout of a DXF's text, its outlines the lines on the layer ``items``, else ``cut``.

    Raises
    ------
    UnfitError
        If it is not a DXF of ours.

    Examples
    --------
    >>> layout_of_dxf("0\nEOF\n", "empty.dxf")
    Traceback (most recent call last):
    packwork.readers.unfit.UnfitError: states no size and unit, as packwork writes it; ...
    """
    tags = tags_of(text)
    width, height, unit = _canvas(header_of(tags))
    lines = lines_of(tags)
    # A container that has openings shows its walls; what is measured has a layer of its own.
    seen = [line for line in lines if line.layer == "container"]
    room = [line for line in lines if line.layer == "room"]
    walls = room or [line for line in seen if line.is_closed]
    if not walls:
        raise UnfitError(f"has no line on the layer container, {_NOT_OURS}")
    gap, shares = _promise(walls[0])
    items = _items(_outlines(lines), height)
    sheet = FoundSheet(
        width=width,
        height=height,
        unit=unit,
        container=_region(walls, height),
        gap=gap,
        areas_in_shares=shares,
        items=items,
        walls=tuple(_down(line.points, height) for line in seen) if room else None,
        said={"not_kept": [LINES_ALONE], "changed": _lost(walls[0], items)},
    )
    return assembled(sheet, name)


def _outlines(lines: Sequence[DxfLine]) -> list[DxfLine]:
    """Lines of items: on a layer of their own where others are cut."""
    layers = {line.layer for line in lines}
    return [line for line in lines if line.layer == ("items" if "items" in layers else "cut")]


def _canvas(header: dict[str, list[float]]) -> tuple[float, float, Unit]:
    codes, sizes = header.get("$INSUNITS", []), header.get("$LIMMAX", [])
    unit = _UNITS.get(round(codes[0])) if codes else None
    if unit is None or len(sizes) != 2 or not min(sizes) > 0:
        raise UnfitError(f"states no size and unit, {_NOT_OURS}")
    return sizes[0], sizes[1], unit


def _promise(wall: DxfLine) -> tuple[float | None, bool]:
    """Gap and whether areas are in shares, as the container's first line says them."""
    if not wall.said:
        return None, False
    return sound_gap(wall.said[0]), wall.said[1:2] == ("1",)


def _lost(wall: DxfLine, items: Sequence[FoundItem]) -> list[str]:
    """That not as many items are in the file as it says, if it does."""
    stated = wall.said[2] if len(wall.said) > 2 else ""
    if stated in {"", str(len(items))}:
        return []
    return [f"{len(items)} of {stated[:9]} items are in the file"]


def _items(lines: Sequence[DxfLine], height: float) -> list[FoundItem]:
    """Items in the order of their numbers; each may have several lines."""
    together: dict[str, list[DxfLine]] = {}
    for line in lines:
        if len(line.said) != 3:
            raise UnfitError(f"has lines on the layer cut that name no item, {_NOT_OURS}")
        together.setdefault(line.said[0], []).append(line)
    return [
        FoundItem(own[0].said[1], _region(own, height), sound_weight(own[0].said[2]))
        for own in together.values()
    ]


def _region(lines: Sequence[DxfLine], height: float) -> Region:
    return region([_down(line.points, height) for line in lines], "evenodd")


def _down(points: FloatArray, height: float) -> FloatArray:
    """The same points, y down from the sheet's top."""
    return np.column_stack([points[:, 0], height - points[:, 1]])
