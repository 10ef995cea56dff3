"""Painted shapes to the regions their fills and strokes cover."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
import shapely
from shapely.geometry import Polygon

from packwork.arrays import FloatArray
from packwork.geometry import affine
from packwork.geometry.polygon import Region, oriented_rings, polygon_parts, region
from packwork.readers.svg.lengths import MAX_COORDINATE
from packwork.readers.svg.path_data import SubPath
from packwork.readers.svg.shapes import flattened, step_counts
from packwork.readers.svg.strokes import Pen, stroke_region
from packwork.readers.svg.walk import Painted
from packwork.readers.unfit import UnfitError

FLATTENING = 2e-5
"""Largest distance of a curve from its chords, as a share of the drawing's extent: half
a pixel of a print 25,000 px wide. Smaller costs vertices everywhere, larger shows on
posters. Chosen."""

MAX_POINTS = 500_000
"""Vertices of one drawing after flattening. Chosen."""

MAX_CROSSINGS = 20_000
"""Places where one shape may cross itself, by estimate: some seconds' work. Chosen."""

MAX_UNION_CROSSINGS = 500_000
"""Places where the shapes of a drawing may cross, by estimate: as long. Chosen."""

_SAMPLED, _COMPARED = 60, 20_000
"""Edges whose crossings are counted for the estimate, and those they are met with."""


@dataclass(frozen=True, eq=False)
class Ink:
    """What a drawing covers, in CSS pixels.

    Parameters
    ----------
    fills, strokes
        Regions, each possibly empty.
    lines
        The part of ``strokes`` that belongs to shapes without a fill.
    is_cut
        Whether a page or a viewport cuts off part of what is drawn.
    """

    fills: Region
    strokes: Region
    lines: Region
    is_cut: bool


def painted_ink(shapes: Sequence[Painted]) -> Ink:
    """Union of all fills and union of all strokes; either may be empty.

    Raises
    ------
    UnfitError
        If coordinates are absurd or outlines need too much detail.

    Examples
    --------
    >>> painted_ink([]).fills.is_empty
    True
    """
    box = drawing_box(shapes)
    extent = 0.0 if box is None else float((box[2:] - box[:2]).max())
    if extent <= 0:
        return Ink(Polygon(), Polygon(), Polygon(), is_cut=False)
    tolerance = FLATTENING * extent
    _check_detail(shapes, tolerance)
    cut: list[Painted] = []

    def shown(painted: Region, shape: Painted) -> Region:
        if shape.window is None or _holds(shape.window, painted, tolerance):
            return painted
        cut.append(shape)
        return _clipped(painted, shape.window)

    fills = [shown(_fill(s, tolerance), s) for s in shapes if s.painting.has_fill]
    stroked = [(s, shown(_stroke(s, tolerance), s)) for s in shapes if s.painting.has_stroke]
    lines = [region for shape, region in stroked if not shape.painting.has_fill]
    strokes = [region for _, region in stroked]
    return Ink(_union(fills), _union(strokes), _union(lines), is_cut=bool(cut))


def drawing_box(shapes: Iterable[Painted]) -> FloatArray | None:
    """Box ``(left, top, right, bottom)`` round control points and pens that can show.

    Examples
    --------
    >>> drawing_box([]) is None
    True
    """
    boxes = [box for shape in shapes if (box := _box(shape)) is not None]
    if not boxes:
        return None
    low = np.min([box[:2] for box in boxes], axis=0)
    high = np.max([box[2:] for box in boxes], axis=0)
    return np.concatenate([low, high])


def _box(shape: Painted) -> FloatArray | None:
    points = [np.array([piece.start]) for piece in shape.pieces]
    points += [piece.segments.reshape(-1, 2) for piece in shape.pieces]
    placed = affine.apply(shape.matrix, np.concatenate(points))
    margin = _stretch(shape.matrix) * _pen_width(shape) / 2
    box = np.concatenate([placed.min(axis=0) - margin, placed.max(axis=0) + margin])
    if not np.isfinite(box).all() or np.abs(box).max() > MAX_COORDINATE:
        raise UnfitError(f"reaches beyond {MAX_COORDINATE:g} px; give it a smaller scale")
    if shape.window is not None:
        if shape.window.is_empty:
            return None
        left, top, right, bottom = shape.window.bounds
        box[:2] = np.maximum(box[:2], (left, top))
        box[2:] = np.minimum(box[2:], (right, bottom))
    return box if (box[2:] >= box[:2]).all() else None


def _pen_width(shape: Painted) -> float:
    return shape.painting.pen.width if shape.painting.has_stroke else 0.0


def _stretch(matrix: FloatArray) -> float:
    """Largest factor by which a map lengthens anything."""
    return float(np.linalg.norm(matrix[:, :2], 2))


def _check_detail(shapes: Sequence[Painted], tolerance: float) -> None:
    total = 0.0
    for shape in shapes:
        for piece in shape.pieces:
            total += float(step_counts(_placed(piece, shape.matrix).segments, tolerance).sum())
    if total > MAX_POINTS:
        raise UnfitError(
            f"needs {total:,.0f} points to follow its curves; {MAX_POINTS:,} are the most, "
            "so simplify it"
        )


def _placed(piece: SubPath, matrix: FloatArray) -> SubPath:
    """Piece in CSS pixels."""
    points = np.concatenate([np.array([piece.start]), piece.segments.reshape(-1, 2)])
    placed = affine.apply(matrix, points)
    start = (float(placed[0, 0]), float(placed[0, 1]))
    return SubPath(placed[1:].reshape(-1, 4, 2), start, piece.is_closed)


def _fill(shape: Painted, tolerance: float) -> Region:
    rings = [flattened(_placed(piece, shape.matrix), tolerance) for piece in shape.pieces]
    check_crossings(rings)
    return region(rings, shape.painting.fill_rule)


def _stroke(shape: Painted, tolerance: float) -> Region:
    """Stroke in the shape's own units, where the pen is round, then placed."""
    stretch = _stretch(shape.matrix)
    if stretch == 0 or abs(np.linalg.det(shape.matrix[:, :2])) < 1e-12 * stretch**2:
        return Polygon()
    own_tolerance = tolerance / stretch
    painted = [_pen_stroke(piece, shape.painting.pen, own_tolerance) for piece in shape.pieces]
    return shapely.transform(
        shapely.union_all(painted), lambda points: affine.apply(shape.matrix, points)
    )


def _union(regions: Sequence[Region]) -> Region:
    rings = [ring for each in regions for ring in oriented_rings(each)]
    check_crossings(rings, MAX_UNION_CROSSINGS)
    return shapely.union_all(regions)


def _pen_stroke(piece: SubPath, pen: Pen, tolerance: float) -> Region:
    line = flattened(piece, tolerance)
    check_crossings([line])
    return stroke_region(line, piece.is_closed, pen, tolerance)


def _holds(window: Region, painted: Region, slack: float) -> bool:
    return bool(shapely.covers(window.buffer(slack, join_style="mitre"), painted))


def _clipped(painted: Region, window: Region) -> Region:
    return shapely.union_all(polygon_parts(shapely.intersection(painted, window)))


def check_crossings(rings: Sequence[FloatArray], most: float = MAX_CROSSINGS) -> None:
    """Refuse scribbles whose crossings would take minutes to resolve.

    The number is estimated from evenly spaced edges.

    Examples
    --------
    >>> check_crossings([np.random.default_rng(0).random((5000, 2))])
    Traceback (most recent call last):
    packwork.readers.unfit.UnfitError: crosses itself about ... times; ...
    """
    if sum(len(ring) for ring in rings) ** 2 / 2 <= most:
        return
    edges = shapely.linestrings(
        np.concatenate([np.stack([ring, np.roll(ring, -1, axis=0)], axis=1) for ring in rings])
    )
    others = edges[:: 1 + len(edges) // _COMPARED]
    sample = edges[:: 1 + len(edges) // _SAMPLED]
    pairs = shapely.STRtree(others).query(sample, predicate="crosses")
    share = pairs.shape[1] / (len(sample) * len(others))
    crossings = share * len(edges) ** 2 / 2
    if crossings > most:
        raise UnfitError(f"crosses itself about {crossings:,.0f} times; simplify it")
