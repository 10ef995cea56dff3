"""Entities of a DXF's model space as lines with arcs, blocks put in their places.

The tags are read by ezdxf. Nothing else than the file's bytes is: references to other drawings and
pictures stay what they are, names.
"""

from __future__ import annotations

import io
import logging
import math
import re
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from packwork.arrays import FloatArray
from packwork.geometry.arcs import ArcLine, arc, arcs_along, circle, ellipse
from packwork.installed import command_to_install
from packwork.phrasing import number_of
from packwork.readers.reading import UnfitError, notice

if TYPE_CHECKING:
    from ezdxf.document import Drawing

MAX_DXF_BYTES = 32_000_000
"""Size of a file: most lines of text are short. Chosen."""

MOST_LINES = 500_000
"""Lines of text, two to a tag, some 25 to an entity: ezdxf takes three seconds for them, twice that
where entities are as short as can be. Chosen."""

MOST_POINTS = 400_000
"""Points of all lines, those of a block as often as it is inserted. Chosen."""

PIECE_POINTS = 8
"""Points that a line counts for beside its own: short ones cost no less time. Measured."""

MOST_INSERTS = 10_000
"""Copies of blocks, those in blocks among them. Chosen."""

FARTHEST = 1e9
"""Coordinate, in the drawing's units, beyond which it is a mistake. Chosen."""

CURVES = 1e-7
"""Largest distance of ellipses and splines from the arcs that stand for them, as a share of the
curve's size. Larger shows in what is cut, smaller costs points. Chosen: a tenth of the least gap
that is certified."""

FLAT = 1e-9
"""Slant of an entity's plane, against the sheet's, that is rounding. Chosen."""

MILLIMETRES = {
    1: 25.4, 2: 304.8, 3: 1_609_344.0, 4: 1.0, 5: 10.0, 6: 1e3, 7: 1e6, 8: 2.54e-5, 9: 0.0254,
    10: 914.4, 11: 1e-7, 12: 1e-6, 13: 1e-3, 14: 100.0, 15: 1e4, 16: 1e5,
}  # fmt: skip
"""Units by the codes that DXF has for them; what is larger is of the sky."""

_HIDDEN = re.compile(r"center|centre|hidden|phantom|dashdot", re.IGNORECASE)
"""Line types of what is not there: axes, edges behind."""

BY_BLOCK = "by block"

_BINARY = b"AutoCAD Binary DXF"
_DWG = re.compile(rb"AC10\d\d")


@dataclass(frozen=True, eq=False)
class CadLine:
    """A line of a drawing, in its units, y up.

    ``kind`` is the entity that it was; ``colour`` is empty of layer 0, whose place in a block that
    of the insert takes, and ``BY_BLOCK`` where it is that of the insert itself. ``page_height``, in
    mm, is that of an SVG, whose lines are called by their colour and their places from the top.
    """

    line: ArcLine
    layer: str
    kind: str
    colour: str = ""
    page_height: float | None = None


@dataclass(frozen=True, eq=False)
class CadDrawing:
    """Lines of a drawing, what was left out by kind and number, and millimetres of its unit.

    ``millimetres`` is None where the drawing states no unit; ``is_metric`` is what it says of
    that elsewhere, None where it says nothing.
    """

    pieces: tuple[CadLine, ...]
    left_out: Counter[str]
    millimetres: float | None
    is_metric: bool | None


def read_drawing(data: bytes) -> CadDrawing:
    """Lines of a DXF's bytes.

    Raises ``UnfitError`` where they are no DXF, or more of one than can be worked on.
    """
    if data.startswith(_BINARY):
        raise UnfitError("is a binary DXF; save it as ASCII DXF")
    if _DWG.match(data):
        raise UnfitError("is a DWG; save it as DXF")
    if data.count(b"\n") > MOST_LINES:
        raise UnfitError(f"has more than {MOST_LINES:,} lines of text; export the outlines alone")
    document = _parsed(data)
    walk = _BlockReader(document)
    own = {"": walk.colour(document.layers.get("0"), "0"), BY_BLOCK: ""}
    found = walk.pieces(document.modelspace())
    pieces = tuple(replace(one, colour=own.get(one.colour, one.colour)) for one in found)
    millimetres, is_metric = _unit(document)
    return CadDrawing(pieces, walk.left_out, millimetres, is_metric)


def _parsed(data: bytes) -> Drawing:
    try:
        from ezdxf import DXFError, recover
    except ImportError:
        how = command_to_install(["ezdxf"])
        raise UnfitError(f"needs the package ezdxf; install it: {how}") from None
    logging.getLogger("ezdxf").setLevel(logging.CRITICAL)
    try:
        document, audit = recover.read(io.BytesIO(data))
    except (DXFError, *_MALFORMED) as error:
        why = " ".join(str(error).split())[:80]
        raise UnfitError(f"is no DXF that can be read ({why}); save it as ASCII DXF") from None
    flaws = [
        one for one in (*audit.errors, *audit.fixes)
        if one.code not in _OF_STYLES and not one.message.startswith(_OF_DICTIONARIES)
    ]  # fmt: skip
    if flaws:
        first = " ".join(str(flaws[0].message).split())[:80]
        count = number_of(len(flaws), "flaw was", "flaws were")
        notice(f"is damaged; {count} mended or left out, the first: {first}")
    return document


_OF_STYLES = frozenset({100, 101, 102, 112, 207, 213})
_OF_DICTIONARIES = ("Removed invalid key", "Fixed invalid owner handle")
"""Flaws of which no line is lost, as ``ezdxf.audit.AuditError`` numbers or ezdxf names them: each
file that Inkscape writes has such a one."""


_MALFORMED = (
    ArithmeticError, AssertionError, AttributeError, LookupError, RecursionError, TypeError,
    ValueError,
)  # fmt: skip
"""Errors that entities with missing or senseless values cause in ezdxf and here."""


def _unit(document: Drawing) -> tuple[float | None, bool | None]:
    measured = document.header.get("$MEASUREMENT", None)
    return MILLIMETRES.get(document.header.get("$INSUNITS", 0)), (
        None if measured is None else measured != 0
    )


@dataclass(eq=False)
class _BlockReader:
    """Reading of one document, and what is left of its bounds."""

    document: Drawing
    left_out: Counter[str] = field(default_factory=Counter)
    blocks: dict[str, list[CadLine] | None] = field(default_factory=dict)
    inserts: int = 0
    points: int = 0

    def pieces(self, entities: Any) -> Iterator[CadLine]:
        """Lines of entities that are shown."""
        for entity in entities:
            kind, layer = entity.dxftype(), str(entity.dxf.get("layer", "0"))
            if not self._is_shown(entity, layer):
                self.left_out["hidden or construction"] += 1
                continue
            try:
                found = list(self._of_entity(entity, kind, layer))
            except _MALFORMED as error:
                why = " ".join(str(error).split())[:60]
                raise UnfitError(
                    f"layer {layer[:40]!r}: the entity {kind} cannot be read ({why})"
                ) from None
            self._count(found)
            yield from found

    def _count(self, found: list[CadLine]) -> None:
        for piece in found:
            if (
                not (np.abs(piece.line.points) < FARTHEST).all()
                or not np.isfinite(piece.line.bulges).all()
            ):
                raise UnfitError(
                    f"layer {piece.layer[:40]!r}: the {piece.kind} has coordinates that are NaN, "
                    f"infinite or beyond {FARTHEST:g}"
                )
        self.points += self._bounded(found, 1)

    def _bounded(self, found: list[CadLine], copies: int) -> int:
        """Points of copies of some lines, if no more than are left."""
        count = copies * sum(PIECE_POINTS + len(piece.line.points) for piece in found)
        if self.points + count > MOST_POINTS:
            raise UnfitError(f"has more than {MOST_POINTS:,} points; export fewer parts at once")
        return count

    def _is_shown(self, entity: Any, layer: str) -> bool:
        if entity.dxf.get("invisible", 0) or layer.casefold() == "defpoints":
            return False
        layers = self.document.layers
        style = str(entity.dxf.get("linetype", "BYLAYER"))
        if layer in layers:
            held = layers.get(layer)
            if held.is_off() or held.is_frozen() or not held.dxf.get("plot", 1):
                return False
            if style.upper() == "BYLAYER":
                style = str(held.dxf.get("linetype", ""))
        return not _HIDDEN.match(style)

    def colour(self, entity: Any, layer: str) -> str:
        """Colour as ``#rrggbb``; empty if it is that of layer 0, or ``BY_BLOCK``."""
        from ezdxf.colors import BYBLOCK, BYLAYER, RGB, aci2rgb

        layers = self.document.layers
        for one in (entity, *([layers.get(layer)] if layer in layers and layer != "0" else [])):
            number = abs(int(one.dxf.get("color", BYLAYER)))
            if one.rgb is not None or number == BYBLOCK:
                return BY_BLOCK if one.rgb is None else RGB(*one.rgb).to_hex()
            if number < BYLAYER:
                # Number 7 stands out from the ground.
                return (RGB(0, 0, 0) if number == 7 else aci2rgb(number)).to_hex()
        return ""

    def _of_entity(self, entity: Any, kind: str, layer: str) -> Iterator[CadLine]:
        if kind == "INSERT":
            yield from self._inserted(entity, layer)
            return
        line = _LINES[kind](entity) if kind in _LINES else None
        plane = None if line is None else _plane(entity, kind)
        if line is None or plane is None:
            self.left_out[kind if line is None else f"{kind} out of the sheet's plane"] += 1
            return
        yield CadLine(line.mapped(plane, math.inf), layer, kind, self.colour(entity, layer))

    def _inserted(self, insert: Any, layer: str) -> Iterator[CadLine]:
        name = str(insert.dxf.name)
        copies = max(int(insert.mcount), 1)
        self.inserts += copies
        if self.inserts > MOST_INSERTS:
            raise UnfitError(f"inserts blocks more than {MOST_INSERTS:,} times; export fewer parts")
        own = self._block(name)
        layers = self.document.layers
        of_layer = self.colour(layers.get(layer), layer) if layer in layers and layer != "0" else ""
        colours = {"": of_layer, BY_BLOCK: self.colour(insert, layer)}
        self._bounded(own, copies)
        for one in insert.multi_insert() if copies > 1 else [insert]:
            matrix = _flat_map(one.matrix44())
            if matrix is None:
                self.left_out["INSERT out of the sheet's plane"] += 1
                continue
            for piece in own:
                line = piece.line.mapped(matrix, _tolerance(piece.line, matrix))
                shown = layer if piece.layer == "0" else piece.layer
                colour = colours.get(piece.colour, piece.colour)
                yield replace(piece, line=line, layer=shown, colour=colour)

    def _block(self, name: str) -> list[CadLine]:
        """Lines of a block in its own units, read once."""
        key = name.casefold()
        if key not in self.blocks:
            self.blocks[key] = None
            block = self.document.blocks.get(name)
            if block is None:
                raise UnfitError(f"inserts the block {name[:40]!r}, which it lacks")
            if block.block is not None and block.block.is_xref:
                self.left_out["INSERT of another drawing"] += 1
            self.blocks[key] = list(self.pieces(block))
        found = self.blocks[key]
        if found is None:
            raise UnfitError(f"has a block, {name[:40]!r}, that holds itself")
        return found


def _flat_map(matrix: Any) -> FloatArray | None:
    """A 3D map as one of the plane (2 x 3); None if it tilts."""
    rows = np.array([list(row) for row in matrix.rows()])
    size = np.abs(rows[:2, :2]).max()
    if not size > 0 or np.abs(rows[:2, 2]).max() > FLAT * size:
        return None
    return np.asarray(np.column_stack([rows[:2, :2].T, rows[3, :2]]))


def _tolerance(line: ArcLine, matrix: FloatArray) -> float:
    size = float(np.ptp(line.points, axis=0).max()) if len(line.points) else 0.0
    return CURVES * max(size, 1e-9) * float(np.linalg.norm(matrix[:, :2], 2))


def _plane(entity: Any, kind: str) -> FloatArray | None:
    """Map from the plane that an entity is drawn in; None if that is not the sheet's."""
    upright = np.array([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
    if kind in {"LINE", "SPLINE", "ELLIPSE"}:
        return upright
    x, y, z = entity.dxf.get("extrusion", (0.0, 0.0, 1.0))
    if max(abs(x), abs(y)) > FLAT * abs(z):
        return None
    # Seen from below, as mirrored parts are.
    return upright if z > 0 else upright * [[-1.0], [1.0]]


def _xy(point: Any) -> tuple[float, float]:
    return float(point[0]), float(point[1])


def _of_line(entity: Any) -> ArcLine:
    return ArcLine(np.array([_xy(entity.dxf.start), _xy(entity.dxf.end)]), np.zeros(2))


def _of_circle(entity: Any) -> ArcLine:
    return circle(_xy(entity.dxf.center), abs(float(entity.dxf.radius)))


def _of_arc(entity: Any) -> ArcLine:
    start, end = (math.radians(float(entity.dxf.get(f"{one}_angle"))) for one in ("start", "end"))
    sweep = (end - start) % (2 * math.pi) or 2 * math.pi
    return arc(_xy(entity.dxf.center), abs(float(entity.dxf.radius)), start, sweep)


def _of_ellipse(entity: Any) -> ArcLine:
    first, second = np.array(entity.dxf.major_axis), np.array(entity.minor_axis)
    start, end = float(entity.dxf.start_param), float(entity.dxf.end_param)
    sweep = (end - start) % (2 * math.pi) or 2 * math.pi
    size = float(np.hypot(*first[:2]))
    centre = np.array(_xy(entity.dxf.center))
    line = ellipse(centre, first[:2], second[:2], (start, start + sweep), CURVES * size)
    return _closed_if_full(line, is_full=sweep > 2 * math.pi - FLAT)


def _of_polyline(entity: Any) -> ArcLine | None:
    if not (entity.is_2d_polyline or entity.is_3d_polyline):
        return None
    # Corners of the frame of a curve are not on it.
    shown = [vertex for vertex in entity.vertices if not int(vertex.dxf.get("flags", 0)) & 16]
    points = [_xy(vertex.dxf.location) for vertex in shown]
    bulges = [float(vertex.dxf.get("bulge", 0.0)) for vertex in shown]
    return _polyline(points, bulges, is_closed=bool(entity.is_closed))


def _of_light_polyline(entity: Any) -> ArcLine | None:
    rows = [tuple(map(float, row)) for row in entity.get_points("xyb")]
    return _polyline([row[:2] for row in rows], [row[2] for row in rows],
                     is_closed=bool(entity.closed))  # fmt: skip


def _polyline(points: list[Any], bulges: list[float], *, is_closed: bool) -> ArcLine | None:
    if len(points) < 2:
        return None
    return ArcLine(np.array(points), np.array(bulges), is_closed)


def _of_spline(entity: Any) -> ArcLine:
    # Loads what only splines need.
    from scipy.interpolate import BSpline

    tool = entity.construction_tool()
    points = np.array([_xy(point) for point in tool.control_points])
    weights = np.array(tool.weights() or np.ones(len(points)), dtype=np.float64)
    knots, degree = np.array(tool.knots(), dtype=np.float64), int(tool.degree)
    spline = BSpline(knots, np.column_stack([points * weights[:, None], weights]), degree)
    slope = spline.derivative()

    def curve(t: FloatArray) -> tuple[FloatArray, FloatArray]:
        at, by = spline(t), slope(t)
        whole = at[:, 2:]
        places = at[:, :2] / whole
        return places, (by[:, :2] - places * by[:, 2:]) / whole

    inner = knots[degree : len(knots) - degree]
    size = float(np.ptp(points, axis=0).max())
    line = arcs_along(curve, inner, CURVES * size)
    first, last = line.points[0], line.points[-1]
    return _closed_if_full(line, is_full=float(np.hypot(*(last - first))) <= FLAT * size)


def _closed_if_full(line: ArcLine, *, is_full: bool) -> ArcLine:
    return ArcLine(line.points[:-1], line.bulges[:-1], is_closed=True) if is_full else line


_LINES: dict[str, Callable[[Any], ArcLine | None]] = {
    "LINE": _of_line,
    "CIRCLE": _of_circle,
    "ARC": _of_arc,
    "ELLIPSE": _of_ellipse,
    "LWPOLYLINE": _of_light_polyline,
    "POLYLINE": _of_polyline,
    "SPLINE": _of_spline,
}
