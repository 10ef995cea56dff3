"""Layouts as DXF, for cutters and plotters: true outlines in real units, y up.

Each ring is one closed polyline. Items that were read from a DXF have their arcs, as bulges;
of others it has the very points that were measured: curves were flattened when they were read,
drawings to 2e-5 of their extent. Lines have no width:
what the tool takes away belongs to the padding. Which item a ring belongs to, and what
the run promised, stands in extended data that other programs pass over.
"""

from __future__ import annotations

import io
import math
from collections.abc import Iterable, Iterator, Sequence, Set
from contextlib import contextmanager
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from packwork.arrays import FloatArray
from packwork.geometry import affine
from packwork.geometry.arcs import ArcLine
from packwork.geometry.overlay import difference
from packwork.geometry.polygon import oriented_rings, polygon_parts
from packwork.scene.colour import css_colour
from packwork.scene.item import Item
from packwork.scene.layout import Layout
from packwork.scene.line_art import CUT, ENGRAVE, EngravedLine, LineArt
from packwork.scene.notation import decimals, sound_text
from packwork.units import convert
from packwork.writers.cutting import CutOptions, cut_rings
from packwork.writers.geojson import PRECISION
from packwork.writers.promise import finest, is_nest, promised, stated_weights
from packwork.writers.svg import NAME_LENGTH

if TYPE_CHECKING:
    from ezdxf.document import Drawing
    from ezdxf.entities import DXFGraphic
    from ezdxf.layouts import Modelspace

VERSION, TRUE_COLOURS = "R2000", "R2004"
"""The oldest form with closed light polylines: the one that most tools read. And with colours that
have no number."""

LAYERS = {CUT: 1, ENGRAVE: 5, "container": 8}
"""Names and colour numbers (red, blue, grey). ``cut`` holds the outlines of the items,
``engrave`` lines that go with them, and the edges of what is left bare inside them, as the hole of
a ring that was packed as a disc; lines with a colour or layer of their own keep it. Where other
lines are to be cut, outlines are on ``items``."""

ITEMS = {"items": 9}
"""Name and colour number (light grey) of the layer of outlines that are not cut."""

ROOM = {"room": 9}
"""Name and colour number (light grey) of the layer of what items may lie in, which is switched off,
where the container has openings: on the layer ``container`` are then its walls, open lines."""

APPLICATION = "PACKWORK"
"""Name under which extended data are kept."""

_TEXT = 1_000
_INSERT_UNITS = {"in": 1, "mm": 4, "cm": 5}
"""What DXF calls the units it knows; a canvas in others is written in mm."""

_SLIVER = 1e-9
"""Share of an outline's area below which something bare in it is rounding. Chosen."""


def dxf_bytes(layout: Layout, cut: CutOptions | None = None) -> bytes:
    """DXF file of a layout; its limits are the sheet. The same bytes every time.

    On the layer ``cut`` are the lines that are asked for, else the items' outlines.

    Examples
    --------
    >>> from packwork.scene.layout import blank
    >>> b"LWPOLYLINE" in dxf_bytes(blank(unit="cm"))
    True
    """
    layout.container.check_edge("output", "lines for a DXF")
    lines = [
        (lot, line)
        for lot in _lots(layout, cut or CutOptions())
        for line in _to_paper(layout, lot.lines)
    ]
    points = np.concatenate([line.points for _, line in lines])
    with _without_dates():
        colours = {lot.colour: _colour_tags(lot.colour) for lot, _ in lines}
        version = TRUE_COLOURS if any(len(one) > 1 for one in colours.values()) else VERSION
        drawing = _empty_drawing(layout, {lot.layer for lot, _ in lines}, version)
        space = drawing.modelspace()
        space.reset_extents(points.min(axis=0).tolist(), points.max(axis=0).tolist())
        for lot, line in lines:
            drawn = _drawn(space, line, {"layer": lot.layer, **colours[lot.colour]})
            if lot.said:
                drawn.set_xdata(APPLICATION, [(_TEXT, text) for text in lot.said])
        stream = io.StringIO()
        drawing.write(stream)
    return drawing.encode(stream.getvalue())


def _colour_tags(colour: str) -> dict[str, int]:
    """Colour of an entity: its number, or the next one and its red, green and blue, if it has one.

    >>> _colour_tags(""), _colour_tags("#00ff00"), _colour_tags("#2a6f97")
    ({}, {'color': 3}, {'color': 145, 'true_color': 2781079})
    """
    from ezdxf.colors import aci2rgb

    if not colour:
        return {}
    wanted = css_colour(colour)[:3]
    # Not 1, the red of what is cut; 7 is black or white.
    number = min((2, 3, 4, 5, 6, *range(8, 256)), key=lambda k: math.dist(aci2rgb(k), wanted))
    true = {} if aci2rgb(number) == wanted else {"true_color": int(colour[1:7], 16)}
    return {"color": number, **true}


def _drawn(space: Modelspace, line: ArcLine, attributes: dict[str, Any]) -> DXFGraphic:
    """A line as an entity: a circle of two halves as that, all else as a light polyline."""
    if line.is_closed and len(line.points) == 2 and abs(line.bulges.sum()) == 2.0:
        centre = line.points.mean(axis=0)
        radius = float(np.hypot(*(line.points[0] - centre)))
        return space.add_circle(tuple(centre.tolist()), radius, dxfattribs=attributes)
    drawn = space.add_lwpolyline([], close=line.is_closed, dxfattribs=attributes)
    drawn.lwpoints = LinePoints(line.points, line.bulges)  # type: ignore[assignment]
    return drawn


def paper_unit(unit: str) -> str:
    """The unit in which a canvas is drawn: its own where DXF has it, else mm."""
    return unit if unit in _INSERT_UNITS else "mm"


def _empty_drawing(layout: Layout, used: Set[str], version: str) -> Drawing:
    import ezdxf

    container = layout.container
    unit = paper_unit(container.unit)
    width, height = (convert(v, container.unit, unit) for v in (container.width, container.height))
    drawing = ezdxf.new(version, units=_INSERT_UNITS[unit])
    more = {name: colour for name, colour in {**ITEMS, **ROOM}.items() if name in used}
    own = dict.fromkeys(sorted(used - LAYERS.keys()), LAYERS[ENGRAVE])
    for name, colour in {**LAYERS, **own, **more}.items():
        # Names of layers are the same in capitals.
        if name not in drawing.layers:
            drawing.layers.add(name, color=colour)
    if ROOM.keys() & used:
        drawing.layers.get("room").off()
    drawing.appids.add(APPLICATION)
    drawing.modelspace().reset_limits((0.0, 0.0), (width, height))
    drawing.set_modelspace_vport(height, center=(width / 2, height / 2))
    return drawing


@dataclass(frozen=True, eq=False)
class _Lot:
    """Lines that belong together, in place, canvas units.

    ``said`` are texts that go with each: of the container the gap that was promised and whether
    areas are in shares, of an item its number, name and weight.
    """

    layer: str
    lines: Sequence[ArcLine]
    said: tuple[str, ...] = ()
    colour: str = ""


def _lots(layout: Layout, cut: CutOptions) -> Iterator[_Lot]:
    curves = PRECISION * layout.container.side
    is_other = cut.kiss is not None or cut.line == "silhouette"
    walls = layout.container.walls
    layer = "container" if walls is None else "room"
    yield _Lot(layer, _straight(layout.container.outline.rings), _promise(layout))
    yield _Lot("container", _straight(walls or (), is_closed=False))
    weights = stated_weights(layout)
    lines_of = _lines_to_cut if is_nest(layout) else _lines_of
    drawn = {item: lines_of(item) for item in layout.items}
    for k, item in enumerate(layout.items):
        name = " ".join(sound_text(item.label.name or item.name).split())[:NAME_LENGTH]
        own = drawn[item]
        matrix = affine.compose(layout.poses.matrix(k), own.matrix)
        outline = (
            [line.mapped(matrix, curves) for line in own.cut]
            if own.cut else _straight(layout.outlines[k].rings)
        )  # fmt: skip
        layer = "items" if is_other else CUT
        yield _Lot(layer, outline, (str(k + 1), name, weights[k] or "1"))
        for line in own.engraved:
            yield _Lot(line.own_layer, [line.mapped(matrix, curves)], colour=line.own_colour)
    if is_other:
        yield _Lot(CUT, _straight(cut_rings(layout, cut)))


def _straight(rings: Iterable[FloatArray], *, is_closed: bool = True) -> list[ArcLine]:
    return [ArcLine(ring, np.zeros(len(ring)), is_closed) for ring in rings]


@dataclass(frozen=True, eq=False)
class _ItemLines:
    """Lines of an item, and a map (2 x 3) to its own units.

    None to cut: those of its outline as placed.
    """

    cut: Sequence[ArcLine]
    engraved: Sequence[EngravedLine]
    matrix: FloatArray


def _lines_to_cut(item: Item) -> _ItemLines:
    """Lines of a part of a nest, whose holes are cut though nothing lies in them."""
    if isinstance(item.art, LineArt):
        return _lines_of(item)
    return _ItemLines(_straight(item.ink.rings), (), affine.identity())


def _lines_of(item: Item) -> _ItemLines:
    if isinstance(item.art, LineArt):
        return _ItemLines(item.art.cut, item.art.engraved, item.art.matrix)
    bare = [EngravedLine(ring, np.zeros(len(ring)), is_closed=True) for ring in _bare_rings(item)]
    return _ItemLines((), bare, affine.identity())


@dataclass(frozen=True, eq=False)
class LinePoints:
    """Points of a line ``(n, 2)``, and its bulges, as ezdxf asks for them when it writes.

    In place of its own, which make two tags of each: half a million points took 5 s.
    """

    points: FloatArray
    bulges: FloatArray

    def __len__(self) -> int:
        return len(self.points)

    def dxftags(self) -> tuple[LinePoints]:
        """All tags in one."""
        return (self,)

    def dxfstr(self) -> str:
        """Text that is written in its place."""
        if not self.bulges.any():
            return " 10\n%s\n 20\n%s\n" * len(self.points) % tuple(self.points.ravel().tolist())
        rows = np.column_stack([self.points, self.bulges])
        return " 10\n%s\n 20\n%s\n 42\n%s\n" * len(rows) % tuple(rows.ravel().tolist())


def _promise(layout: Layout) -> tuple[str, ...]:
    """Gap, in units of the paper, whether shares are kept, and how many items; or nothing."""
    gap, shares = promised(layout)
    unit = layout.container.unit
    if not gap:
        return ()
    length = f"{convert(float(gap), unit, paper_unit(unit)):.12g}"
    return length, "1" if shares else "0", str(len(layout.items))


def _bare_rings(item: Item) -> list[FloatArray]:
    """Edges of what is not drawn inside an item's outline, in its own units."""
    bare = difference(item.outline.region, item.ink.region)
    least = _SLIVER * item.outline.area
    parts = [part for part in polygon_parts(bare) if part.area > least]
    return [ring for part in parts for ring in oriented_rings(part)]


def _to_paper(layout: Layout, lines: Iterable[ArcLine]) -> Iterator[ArcLine]:
    """Lines as they are written: real units, y up, points rounded."""
    container = layout.container
    scale = convert(1.0, container.unit, paper_unit(container.unit))
    flip = np.array([[scale, 0.0, 0.0], [0.0, -scale, scale * container.height]])
    digits = decimals(container.side * scale * finest(layout, PRECISION))
    for line in lines:
        drawn = line.mapped(flip, 0.0)
        yield replace(drawn, points=np.round(drawn.points, digits))


@contextmanager
def _without_dates() -> Iterator[None]:
    """Let ezdxf write fixed dates and marks of identity inside the block."""
    import ezdxf

    before = ezdxf.options.write_fixed_meta_data_for_testing
    ezdxf.options.write_fixed_meta_data_for_testing = True
    try:
        yield
    finally:
        ezdxf.options.write_fixed_meta_data_for_testing = before
