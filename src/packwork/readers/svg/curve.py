"""SVG curves as straight pieces, for forces and for walls with an opening."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from packwork.arrays import FloatArray
from packwork.errors import ReadError
from packwork.geometry import affine
from packwork.geometry.bezier import FLATTENING
from packwork.readers.files import read_bytes
from packwork.readers.gate.door import MAX_BYTES
from packwork.readers.svg.drawing import Drawing, read_drawing
from packwork.readers.svg_syntax.shapes import flattened_all
from packwork.readers.unfit import naming

CLOSED = 1e-6
"""Distance of a path's ends, as a share of the page, below which it is closed. Chosen."""


@dataclass(frozen=True, eq=False)
class PathLine:
    """One connected piece of a path.

    Parameters
    ----------
    points
        ``(n, 2)`` in CSS pixels of the page; the first is repeated at the end if closed.
    is_closed
        Whether it ends where it begins.
    """

    points: FloatArray
    is_closed: bool


def lines_of(drawing: Drawing, extent: float) -> list[PathLine]:
    """Every piece of every path that a drawing shows.

    Parameters
    ----------
    extent
        Longer side of the page: how fine curves are followed.
    """
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

    Raises
    ------
    ReadError
        If the file cannot be used, or draws nothing that has a length.
    """
    with naming(file):
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
