"""SVGs of open paths to containers with an opening."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import shapely

from packwork.arrays import FloatArray
from packwork.geometry.overlay import valid
from packwork.geometry.polygon import Region
from packwork.readers.files import read_bytes, stem
from packwork.readers.gate.door import MAX_BYTES
from packwork.readers.options import AS_DRAWN, ReadOptions
from packwork.readers.regions import clean_union
from packwork.readers.svg.container import stated_unit
from packwork.readers.svg.curve import PathLine, lines_of
from packwork.readers.svg.drawing import read_drawing
from packwork.readers.trimming import canvas_box
from packwork.readers.unfit import UnfitError, naming
from packwork.scene.canvas import placed_container
from packwork.scene.container import Container
from packwork.units import DEFAULT_SIDE, convert

LEAST_AREA = 1e-6
"""Share of the page below which what a path surrounds is nothing. Chosen."""


def walled_container(
    source: str, side: float | None, reading: ReadOptions = AS_DRAWN
) -> tuple[Container, FloatArray] | None:
    """Container of an SVG's open paths, and its openings; None if it draws none.

    What an open path and the straight line between its ends surround is the container; that
    line is the opening. Closed paths beside it count as they are.

    Parameters
    ----------
    side
        Longer side of the canvas; None leaves it to the file.

    Returns
    -------
    tuple of Container and FloatArray
        Openings as ``(m, 2, 2)``: their ends, canvas units.
    """
    with naming(source):
        drawing = read_drawing(read_bytes(source, MAX_BYTES))
        page = drawing.page
        shown = [line.points for line in lines_of(drawing, 1.0)] if page is None else []
        box = np.vstack(shown).max(axis=0).tolist() if shown else (1.0, 1.0)
        width, height = box if page is None else (page.width, page.height)
        lines = lines_of(drawing, max(width, height))
        unit = stated_unit(drawing.root) if side is None else None
        if all(line.is_closed for line in lines):
            return None
        regions = [_inside(line) for line in lines]
        solid = [region for region in regions if region.area > LEAST_AREA * width * height]
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
    return placed if unit is None else replace(placed, unit=unit), openings


def _inside(line: PathLine) -> Region:
    points = line.points
    return valid(shapely.Polygon(points)) if len(points) > 2 else shapely.Polygon()
