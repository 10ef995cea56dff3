"""Layouts read back from the tags of DXF files: the very lines that a machine would follow.

Only what our own files hold is understood, with the standard library: a measure should
not lean on the program that wrote what is measured.
"""

from __future__ import annotations

import contextlib
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TypeAlias

import numpy as np

from packwork.arrays import FloatArray
from packwork.geometry import affine
from packwork.geometry.arcs import ArcLine, circle
from packwork.geometry.polygon import Region, region
from packwork.geometry.rectangles import is_near
from packwork.readers.dxf.item import line_art
from packwork.readers.layouts.assembly import (
    FoundItem,
    FoundSheet,
    assembled,
    sound_gap,
    sound_outline,
    sound_weight,
)
from packwork.readers.layouts.line_room import LineRoom
from packwork.readers.layouts.marks import left_out
from packwork.readers.reading import UnfitError
from packwork.readers.svg_syntax.coordinates import MAX_COORDINATE
from packwork.scene.item import Item
from packwork.scene.layout import Layout
from packwork.scene.line_art import CUT, EngravedLine
from packwork.units import Unit, convert

APPLICATION = "PACKWORK"
"""Name under which our files say what a line belongs to."""

CLOSED_LAYERS = frozenset({CUT, "items", "room"})
"""Where lines are closed. On ``container`` are walls, too, which may have openings, and on all
others what goes with the item before it and is not cut."""

MEASURED_FLATTENING = 2.5e-7
"""Largest distance of arcs from the chords that are measured, as a share of the sheet's longer
side: a quarter of the least gap that is certified."""

MOST_BENT = 1e6
"""Bulge of an arc at most; of a full circle it is infinite. Chosen."""

MOST_LINES = 6_000_000
"""Of a file, two for each tag: one takes about 100 bytes. Larger: a gigabyte. Chosen."""

Tag: TypeAlias = tuple[int, str]

_CLOSED = 1
_FIRST_EXTENDED = 1_000


@dataclass(frozen=True, eq=False)
class DxfLine:
    """A polyline or a circle in drawing units, y up, and what our files say of it."""

    layer: str
    line: ArcLine
    said: tuple[str, ...]
    colour: str = ""

    @property
    def is_engraved(self) -> bool:
        """Whether it is neither a sheet's nor an item's edge."""
        return self.layer not in CLOSED_LAYERS | {"container"}


def tags_of(text: str) -> list[Tag]:
    r"""Pairs of a file in turn.

    Examples
    --------
    >>> tags_of("0\nEOF\n")
    [(0, 'EOF')]
    """
    if text.count("\n") > MOST_LINES:
        raise UnfitError(f"has more than {MOST_LINES:,} lines; simplify it")
    lines = text.rstrip().split("\n")
    try:
        numbers = [int(number) for number in lines[0::2]]
    except ValueError:
        raise UnfitError("is not DXF in text form; save it as ASCII DXF") from None
    return list(zip(numbers, (value.strip() for value in lines[1::2]), strict=False))


def header_of(tags: Sequence[Tag]) -> dict[str, list[float]]:
    """Numbers of each variable of the header that has some.

    Examples
    --------
    >>> header_of([(9, "$INSUNITS"), (70, "4"), (9, "$LIMMAX"), (10, "20"), (20, "15")])
    {'$INSUNITS': [4.0], '$LIMMAX': [20.0, 15.0]}
    """
    found: dict[str, list[float]] = {}
    name = ""
    for code, value in tags:
        if code == 0 and value == "ENDSEC":
            break
        if code == 9:
            name = value
        elif name:
            number = _number(value)
            if math.isfinite(number):
                found.setdefault(name, []).append(number)
    return found


def lines_of(tags: Sequence[Tag]) -> list[DxfLine]:
    """Polylines and circles of the drawing, in their order.

    Examples
    --------
    >>> corners = [(10, "0"), (20, "0"), (10, "2"), (20, "0"), (10, "2"), (20, "1")]
    >>> tags = [(2, "ENTITIES"), (0, "LWPOLYLINE"), (8, "cut"), (70, "1"), *corners, (0, "EOF")]
    >>> line, = lines_of(tags)
    >>> line.layer, line.line.points[2].tolist()
    ('cut', [2.0, 1.0])
    """
    return [_READ[kind](own) for kind, own in _entities(tags) if kind in _READ]


def _entities(tags: Sequence[Tag]) -> Iterator[tuple[str, list[Tag]]]:
    start = next((k for k, tag in enumerate(tags) if tag == (2, "ENTITIES")), len(tags))
    kind, own = "", list[Tag]()
    for code, value in tags[start + 1 :]:
        if code != 0:
            own.append((code, value))
            continue
        if kind:
            yield kind, own
        if value in {"ENDSEC", "EOF"}:
            return
        kind, own = value, []


def _line(tags: Sequence[Tag]) -> DxfLine:
    plain = [tag for tag in tags if tag[0] < _FIRST_EXTENDED]
    layer = next((value for code, value in plain if code == 8), "")
    flags = next((_number(value) for code, value in plain if code == 70), 0.0)
    is_closed = flags == flags and bool(int(flags) & _CLOSED)
    if not is_closed and layer in CLOSED_LAYERS:
        raise UnfitError(f"holds a line on layer {layer[:20]!r} that is open")
    x, y = ([_number(value) for code, value in plain if code == axis] for axis in (10, 20))
    bulges = _bulges(plain)
    is_bent = any(bulges)
    is_sane = all(abs(number) <= MAX_COORDINATE for number in (*x, *y))
    is_sane = is_sane and all(abs(bulge) <= MOST_BENT for bulge in bulges)
    least = 3 if is_closed and not is_bent else 2
    if not len(x) == len(y) == len(bulges) or len(x) < least or not is_sane:
        raise UnfitError(f"holds a line on layer {layer[:20]!r} whose points are none")
    line = ArcLine(np.column_stack([x, y]), np.array(bulges), is_closed)
    return DxfLine(layer, line, tuple(_said(tags)), _colour(dict(plain)))


def _circle(tags: Sequence[Tag]) -> DxfLine:
    found = dict(tag for tag in tags if tag[0] < _FIRST_EXTENDED)
    x, y, radius = (_number(found.get(code, "")) for code in (10, 20, 40))
    layer = found.get(8, "")
    if not (max(abs(x), abs(y), radius) <= MAX_COORDINATE and radius > 0.0):
        raise UnfitError(f"holds a circle on layer {layer[:20]!r} that is none")
    return DxfLine(layer, circle((x, y), radius), tuple(_said(tags)), _colour(found))


def _colour(tags: Mapping[int, str]) -> str:
    """Colour of an entity, ``#rrggbb``; empty if it is its layer's."""
    true, number = tags.get(420, ""), tags.get(62, "")
    if true.isdecimal():
        return f"#{int(true[:9]) & 0xFFFFFF:06x}"
    if not (number.isdecimal() and 0 < int(number[:9]) < 256):
        return ""
    # Measuring, which needs no colours, goes without that package.
    with contextlib.suppress(ImportError):
        from ezdxf.colors import aci2rgb

        return aci2rgb(int(number)).to_hex()
    return ""


_READ: dict[str, Callable[[Sequence[Tag]], DxfLine]] = {"LWPOLYLINE": _line, "CIRCLE": _circle}


def _bulges(tags: Sequence[Tag]) -> list[float]:
    """Bulge of the side that begins at each point, 0 unless it is stated."""
    found: list[float] = []
    for code, value in tags:
        if code == 10:
            found.append(0.0)
        elif code == 42 and found:
            found[-1] = _number(value)
    return found


def _said(tags: Sequence[Tag]) -> Iterator[str]:
    is_ours = False
    for code, value in tags:
        if code == _FIRST_EXTENDED + 1:
            is_ours = value == APPLICATION
        elif code >= _FIRST_EXTENDED and is_ours:
            yield value


def _number(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        return math.nan


LINES_ALONE = "holds lines alone: its items are plain shapes of one colour, their angles unknown"
"""Sentence for edits of such a file."""

_UNITS: dict[int, Unit] = {1: "in", 4: "mm", 5: "cm"}
_NOT_OURS = "as packwork writes it; give a DXF that no other program saved again, or a .geojson"


def layout_of_dxf(text: str, name: str, *, outlines_only: bool = False) -> Layout:
    r"""Layout of a DXF's text, its outlines the lines on the layer ``items``, else ``cut``.

    Items that have arcs or engraved lines keep them, unless ``outlines_only``.

    Examples
    --------
    >>> layout_of_dxf("0\nEOF\n", "empty.dxf")
    Traceback (most recent call last):
    packwork.readers.reading.UnfitError: states no size and unit, as packwork writes it; ...
    """
    tags = tags_of(text)
    width, height, unit = _canvas(header_of(tags))
    lines = lines_of(tags)
    # A container that has openings shows its walls; what is measured has a layer of its own.
    seen = [line for line in lines if line.layer == "container"]
    room = [line for line in lines if line.layer == "room"]
    walls = room or [wall for wall in seen if wall.line.is_closed]
    if not walls:
        raise UnfitError(f"has no line on the layer container, {_NOT_OURS}")
    gap, shares = _promise(walls[0])
    # Lines of items have a layer of their own where others are cut.
    layer = "items" if any(line.layer == "items" for line in lines) else "cut"
    is_straight = not any(wall.line.bulges.any() for wall in walls)
    paper = _Paper(
        height, MEASURED_FLATTENING * max(width, height), convert(1.0, "px", unit), is_straight
    )
    kept = [
        line for line in lines
        if line.layer == layer or (line.is_engraved and not outlines_only)
    ]  # fmt: skip
    items, lost = _items(kept, paper, plain=outlines_only)
    sheet = FoundSheet(
        width=width,
        height=height,
        unit=unit,
        container=paper.region(walls),
        gap=gap,
        areas_in_shares=shares,
        items=items,
        walls=tuple(paper.down(wall.line) for wall in seen) if room else None,
        said={"not_kept": [LINES_ALONE], "changed": [*_lost(walls[0], items), *left_out(lost)]},
    )
    return assembled(sheet, name)


def _canvas(header: dict[str, list[float]]) -> tuple[float, float, Unit]:
    codes, sizes = header.get("$INSUNITS", []), header.get("$LIMMAX", [])
    unit = _UNITS.get(round(codes[0])) if codes else None
    if unit is None or len(sizes) != 2 or not min(sizes) > 0:
        raise UnfitError(f"states no size and unit, {_NOT_OURS}")
    if max(sizes) > MAX_COORDINATE:
        raise UnfitError(
            f"states a sheet of {sizes[0]:g} x {sizes[1]:g}; up to {MAX_COORDINATE:g} can be used"
        )
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


@dataclass(frozen=True)
class _Paper:
    """Height of a sheet, how far chords may lie off arcs, the length of a px there.

    ``is_straight``: whether the container has no arcs.
    """

    height: float
    tolerance: float
    pixel: float
    is_straight: bool

    def region(self, lines: Sequence[DxfLine]) -> Region:
        """Region that closed lines enclose, y down."""
        return region([self.down(one.line) for one in lines], "evenodd")

    def down(self, line: ArcLine) -> FloatArray:
        """Points of a line, y turned down from the sheet's top."""
        return self.turned(line).flattened(self.tolerance)

    def turns_exactly(self, lines: Sequence[DxfLine]) -> bool:
        """Whether lines are straight, and the turn leaves all of their digits that count."""
        points = np.concatenate([one.line.points for one in lines])
        reach = max(self.height, float(np.abs(points).max()))
        is_bent = any(one.line.bulges.any() for one in lines)
        return not is_bent and is_near(reach, float(np.ptp(points, axis=0).max()))

    def turned(self, line: ArcLine) -> ArcLine:
        """A line with its arcs, y turned down from the sheet's top."""
        return line.mapped(np.array([[1.0, 0.0, 0.0], [0.0, -1.0, self.height]]), 0.0)


def _items(lines: Sequence[DxfLine], paper: _Paper, *, plain: bool) -> tuple[list[FoundItem], int]:
    """Items in the order of their numbers, and the number of engraved lines that leave theirs.

    Each may have several lines, then engraved ones.
    """
    together: dict[str, list[DxfLine]] = {}
    number = ""
    for line in lines:
        if not line.is_engraved:
            if len(line.said) != 3:
                raise UnfitError(f"has lines on the layer cut that name no item, {_NOT_OURS}")
            number = line.said[0]
        together.setdefault(number, []).append(line)
    found = [_item(own, paper, plain=plain) for own in together.values() if own[0].said]
    return [item for item, _ in found], sum(lost for _, lost in found)


def _item(lines: Sequence[DxfLine], paper: _Paper, *, plain: bool) -> tuple[FoundItem, int]:
    number, name, weight = lines[0].said
    around = [line for line in lines if not line.is_engraved]
    shape = paper.region(around)
    is_straight = paper.is_straight and paper.turns_exactly(around)
    if plain or not (len(around) < len(lines) or any(one.line.bulges.any() for one in around)):
        return FoundItem(name, shape, sound_weight(weight), is_straight=is_straight), 0
    outline = sound_outline(shape, f"item {number} ({name})")
    cut = tuple(paper.turned(one.line) for one in around)
    marks = [one for one in lines if one.is_engraved]
    room = LineRoom(outline.region, outline.extent) if marks else None
    engraved = tuple(
        EngravedLine(drawn.points, drawn.bulges, drawn.is_closed, one.colour, one.layer)
        for one in marks
        if (drawn := paper.turned(one.line)) and room and room.holds(drawn)
    )
    art = line_art(cut, engraved, outline.extent, outline.region, paper.pixel)
    x, y = outline.centroid.tolist()
    back = affine.similarity(-x, -y, 0.0, 1.0)
    own = outline.mapped(back)
    item = Item(name, name, own, own, replace(art, matrix=back))
    place = affine.similarity(x, y, 0.0, 1.0)
    found = FoundItem(name, item, sound_weight(weight), place, is_straight)
    return found, len(marks) - len(engraved)
