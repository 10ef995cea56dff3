"""SVG curves as straight pieces, for forces, and as walls of containers with an opening."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import shapely

from packwork.arrays import FloatArray
from packwork.errors import ReadError
from packwork.geometry import affine
from packwork.geometry.bezier import FLATTENING
from packwork.geometry.overlay import valid
from packwork.geometry.polygon import Region
from packwork.readers.gate.door import MAX_BYTES
from packwork.readers.options import AS_DRAWN, ReadOptions
from packwork.readers.reading import UnfitError, read_bytes, reading_file, stem
from packwork.readers.regions import SPECK, canvas_box, clean_union
from packwork.readers.svg.container import stated_unit
from packwork.readers.svg.drawing import PaintedDrawing, read_drawing
from packwork.readers.svg_syntax.painted import Painted
from packwork.readers.svg_syntax.shapes import flattened_all
from packwork.scene.colour import css_colour
from packwork.scene.container import Container, placed_container
from packwork.units import DEFAULT_SIDE, convert

CLOSED = 1e-6
"""Distance of a path's ends, as a share of the page, below which it is closed. Chosen."""


@dataclass(frozen=True, eq=False)
class PathLine:
    """One connected piece of a path: ``(n, 2)`` points in CSS pixels of the page.

    The first is repeated at the end if it is closed.
    """

    points: FloatArray
    is_closed: bool


def lines_of(drawing: PaintedDrawing, extent: float) -> list[PathLine]:
    """Every piece of every path that a drawing shows, as fine as a page of ``extent`` needs."""
    found = []
    for shape in drawing.shapes:
        pieces = [piece for piece in shape.pieces if len(piece.segments)]
        determinant = abs(float(np.linalg.det(shape.matrix[:, :2])))
        tolerance = FLATTENING * extent / max(determinant, 1e-12) ** 0.5
        for piece, points in zip(pieces, flattened_all(pieces, tolerance), strict=True):
            placed = affine.apply(shape.matrix, points)
            ends_meet = float(np.hypot(*(placed[0] - placed[-1]))) < CLOSED * extent
            is_closed = piece.is_closed or ends_meet
            if is_closed and not ends_meet:
                placed = np.vstack([placed, placed[:1]])
            found.append(PathLine(placed, is_closed))
    return found


def read_curve(file: str, width: float, height: float) -> tuple[FloatArray, FloatArray]:
    """Straight pieces ``(m, 2)`` and ``(m, 2)`` of all that an SVG draws.

    Its page is fitted into the canvas, so that what was drawn on the container lies there.
    """
    with reading_file(file):
        drawing = read_drawing(read_bytes(file, MAX_BYTES))
        page = drawing.page
        box = (width, height) if page is None else (page.width, page.height)
        scale = min(width / box[0], height / box[1])
        corner = (np.array([width, height]) - np.array(box) * scale) / 2
        lines = [line.points * scale + corner for line in lines_of(drawing, max(box))]
    begins = np.concatenate([np.zeros((0, 2)), *(line[:-1] for line in lines)])
    ends = np.concatenate([np.zeros((0, 2)), *(line[1:] for line in lines)])
    if np.hypot(*(ends - begins).T).sum() <= 0:
        raise ReadError(file, "draws no line that has a length; give an SVG with a path")
    return begins, ends


def walled_container(
    source: str, side: float | None, reading: ReadOptions = AS_DRAWN
) -> tuple[Container, FloatArray] | None:
    """Container of an SVG's open paths, and its openings; None if it draws none.

    What an open path and the straight line between its ends surround is the container; that
    line is the opening, ``(2, 2)`` in canvas units. Closed paths beside it count as they are,
    a white sheet behind all does not. Where closed paths surround more than open ones, these are
    parts of a drawing, as the handle of a cup is, and no walls. A ``side`` of None leaves the
    canvas's longer side to the file.
    """
    with reading_file(source):
        drawing = read_drawing(read_bytes(source, MAX_BYTES), is_on_paper=True, keep_page=False)
        page = drawing.page
        shown = [line.points for line in lines_of(drawing, 1.0)] if page is None else []
        box = np.vstack(shown).max(axis=0).tolist() if shown else (1.0, 1.0)
        width, height = box if page is None else (page.width, page.height)
        lines = lines_of(drawing, max(width, height))
        unit = stated_unit(drawing.root) if side is None else None
        regions = [_inside(line) for line in lines]
        walled, whole = (
            sum(r.area for r, line in zip(regions, lines, strict=True) if line.is_closed == closed)
            for closed in (False, True)
        )
        if walled < whole or all(line.is_closed for line in lines):
            return None
        solid = [region for region in regions if region.area > SPECK * width * height]
        if not solid:
            raise UnfitError("its open paths surround nothing; draw walls with an opening")
        mouths = [line.points[[0, -1]] for line in lines if not line.is_closed]
        inside = clean_union(*solid)
        canvas = (0.0, 0.0, width, height)
        if page is not None:
            canvas = canvas_box(inside.bounds, (width, height), reading.trim, unit)
        left, top, *sides = canvas
        if unit is not None:
            side = convert(max(sides), "px", unit)
        side = side or DEFAULT_SIDE
        placed = placed_container(stem(source), source, inside, canvas, side)
    scale = side / max(sides)
    openings = (np.array(mouths) - (left, top)) * scale
    placed = replace(placed, unit=unit or placed.unit, pen=_pen(drawing.shapes, scale, side))
    return placed, openings


WIDEST_PEN = 0.02
"""Width of a line over its container's side at most. Items lie on half of it. Chosen."""


def _pen(shapes: Sequence[Painted], scale: float, side: float) -> tuple[str, float] | None:
    """Colour and width, canvas units, of the first shape that draws a line; None if none does."""
    for shape in shapes:
        if not shape.painting.has_stroke:
            continue
        try:
            *channels, _ = css_colour(shape.painting.stroke)
        except ValueError:
            # A gradient, say, is no colour of a line.
            continue
        width = shape.painting.pen.width * abs(float(np.linalg.det(shape.matrix[:, :2]))) ** 0.5
        return f"#{bytes(channels).hex()}", min(width * scale, WIDEST_PEN * side)
    return None


def _inside(line: PathLine) -> Region:
    points = line.points
    return valid(shapely.Polygon(points)) if len(points) > 2 else shapely.Polygon()
