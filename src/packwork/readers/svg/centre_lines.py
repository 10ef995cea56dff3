"""The polylines that a pen follows: whole pieces, or their dashes.

Flat and square caps stand across the line's end. The last chord of a flattened curve is off
its direction by the root of the tolerance, and a wide pen carries that to the corners; so
the ends are followed finer, and only they.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import shapely

from packwork.arrays import FloatArray
from packwork.readers.svg.dashing import dashed
from packwork.readers.svg.path_data import SubPath
from packwork.readers.svg.shapes import flattened_all
from packwork.readers.svg.strokes import Pen

FINER = 256
"""Factor in tolerance by which ends are followed finer: a sixteenth of a chord's length, so
of its error in direction. Larger costs time on dashed lines and lets GEOS pass over ends
that are short for a wide pen, smaller leaves corners off. Tried: on a quarter of a circle
with a pen of a tenth of its radius, corners were off by 3e-4 of its extent, and are by 2e-5."""


def centre_lines(
    pieces: Sequence[SubPath], pen: Pen, tolerance: float
) -> list[tuple[FloatArray, bool]]:
    """Polylines ``(n, 2)`` within ``tolerance``, each with whether it is closed.

    Examples
    --------
    >>> from packwork.readers.svg.path_data import parse_path
    >>> (line, is_closed), = centre_lines(parse_path("M0 0h4v4z"), Pen(), 0.1)
    >>> line.tolist(), is_closed
    ([[0.0, 0.0], [4.0, 0.0], [4.0, 4.0]], True)
    """
    if not pen.dashes and (pen.cap == "round" or all(piece.is_closed for piece in pieces)):
        lines = flattened_all(pieces, tolerance)
        return [(line, p.is_closed) for line, p in zip(lines, pieces, strict=True)]
    found: list[tuple[FloatArray, bool]] = []
    for piece, line in zip(pieces, flattened_all(pieces, tolerance / FINER), strict=True):
        if pen.dashes:
            parts = dashed(line, piece.is_closed, pen.dashes, pen.dash_offset)
            found += [(_thinned(part, tolerance), False) for part in parts]
        else:
            found.append((_thinned(line, tolerance), piece.is_closed))
    return found


def _thinned(line: FloatArray, tolerance: float) -> FloatArray:
    """The same line with fewer points but for its first and its last two."""
    if len(line) < 5:
        return line
    inner = shapely.simplify(shapely.LineString(line[1:-1]), tolerance * (1 - 1 / FINER))
    return np.concatenate([line[:1], shapely.get_coordinates(inner), line[-1:]])
