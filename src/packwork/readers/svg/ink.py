"""Regions that painted shapes cover: fills by their rule and strokes, clipped, then all together.

Where rings neither cross nor touch, nothing has to be cut: how often the others go round a ring
tells whether it is an edge of the region, which makes a compound path some thirty times cheaper.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TypeAlias, final

import numpy as np
import shapely
from shapely.geometry import LinearRing, MultiLineString, Polygon

from packwork.arrays import BoolArray, FloatArray
from packwork.geometry import affine
from packwork.geometry.bezier import FLATTENING, MAX_STEPS
from packwork.geometry.overlay import buffered, intersection, union
from packwork.geometry.polygon import FillRule, Region, enclosed, polygon_parts, region, signed_area
from packwork.readers.budget.crossings import (
    MAX_CROSSINGS,
    MAX_UNION_CROSSINGS,
    Allowance,
    check_nesting,
)
from packwork.readers.reading import TooRichError, spend
from packwork.readers.svg.strokes import FinePoints, piece_strokes
from packwork.readers.svg_syntax.painted import (
    Clip,
    Painted,
    StrokeStyle,
    drawing_box,
    is_inside,
    shown_box,
    stretch,
    whole_box,
)
from packwork.readers.svg_syntax.path_data import SubPath
from packwork.readers.svg_syntax.shapes import flattened_all, step_counts

_MANY = 2_000


def filled(rings: Sequence[FloatArray], rule: FillRule, allowance: Allowance) -> Region:
    """Region that closed rings ``(n, 2)`` fill under SVG's ``rule``; valid, possibly empty.

    >>> square = np.array([[0, 0], [4, 0], [4, 4], [0, 4.0]])
    >>> filled([square, square / 4 + 1], "evenodd", Allowance(9)).area
    15.0
    >>> filled([square, square / 4 + 1], "nonzero", Allowance(9)).area
    16.0
    """
    kept = [LinearRing(ring) for ring in rings if len(ring) >= 3]
    is_large = sum(len(ring) for ring in rings) > _MANY
    if is_large:
        # Before crossings are looked for one by one, which may take as long.
        allowance.spend(rings)
        check_nesting(kept)
    together = MultiLineString(kept)
    if not kept or not together.is_simple:
        if not is_large:
            allowance.spend(rings)
        return region(rings, rule)
    if len(kept) == 1:
        return Polygon(kept[0])
    if rule == "nonzero":
        kept = [ring for ring, is_edge in zip(kept, _are_edges(kept), strict=True) if is_edge]
    return enclosed(kept)


def _are_edges(rings: Sequence[LinearRing]) -> BoolArray:
    """Rings that part what is wound about from what is not.

    They neither cross nor touch, so the winding number is the same all along a ring.
    """
    faces = shapely.polygons(rings)
    signs = np.array([np.sign(signed_area(shapely.get_coordinates(ring))) for ring in rings])
    corners = shapely.points([ring.coords[0] for ring in rings])
    inner, outer = shapely.STRtree(faces).query(corners, predicate="within")
    is_other = inner != outer
    around = np.bincount(inner[is_other], signs[outer[is_other]], minlength=len(rings))
    return np.asarray((around != 0) != (around + signs != 0))


BRIDGED_SHARE = 0.1
"""Gap of a dashed line, as a share of the drawing's extent, up to which an outline passes
over it. Larger fills real openings, smaller lets items into dotted frames. Chosen."""

_FILL_NS, _STROKE_NS, _POINT_NS, _PEN_NS = 2e5, 6e5, 2e3, 2e4
"""For a fill, a stroke, a point of an outline that is settled, and of a line that is widened.
Measured."""

_TOO_MUCH = "has more shapes and points than can be followed"

_FLAT = 1e-12
"""Determinant of a map, over its squared stretch, below which it leaves no area."""


@final
class Follower:
    """Follows curves to a tolerance; what it has computed for a shape it remembers.

    ``extent`` is the longer side of the drawing's box, in CSS pixels, ``flattening`` the largest
    distance of a curve from its chords, as a share of that.
    """

    def __init__(self, extent: float, flattening: float = FLATTENING) -> None:
        self._extent = extent
        self._tolerance = flattening * extent
        self._fills: dict[Painted, Region] = {}
        self._strokes: dict[tuple[Painted, bool], Region] = {}
        self._clips: dict[Clip, Region] = {}
        self._fine_points = FinePoints()
        self._allowance = Allowance(MAX_CROSSINGS)
        self._union_allowance = Allowance(MAX_UNION_CROSSINGS)

    def parts(self, shape: Painted, *, is_bridged: bool = False) -> list[Region]:
        """Visible regions of fill and stroke, with ``is_bridged`` over short gaps of dashes."""
        parts = [self.fill(shape)] if shape.painting.has_fill else []
        if shape.painting.has_stroke:
            parts.append(self.stroke(shape, is_bridged=is_bridged))
        return parts

    def united(self, regions: Iterable[Region]) -> Region:
        """Union of regions; empty if there are none."""
        several = [region for region in regions if not region.is_empty]
        if len(several) == 1:
            return several[0]
        if several:
            count = int(shapely.get_num_coordinates(several).sum())
            spend(_POINT_NS * count, _TOO_MUCH)
            self._union_allowance.spend(_rings(several))
        return union(several)

    def fill(self, shape: Painted) -> Region:
        """Visible region of the fill, whatever its paint."""
        return self._shown(self._whole_fill(shape), shape)

    def stroke(self, shape: Painted, *, is_bridged: bool = False) -> Region:
        """Visible region of the stroke."""
        return self._shown(self._whole_stroke(shape, is_bridged), shape)

    def is_cut(self, shape: Painted) -> bool:
        """Whether the page or a viewport cuts off some of the shape."""
        if shape.window is None or is_inside(shape.window, whole_box(shape, is_safe=True)):
            return False
        slack = buffered(shape.window, self._tolerance, join_style="mitre")
        painted = [self._whole_fill(shape)] if shape.painting.has_fill else []
        if shape.painting.has_stroke:
            painted.append(self._whole_stroke(shape, is_bridged=False))
        return not all(shapely.covers(slack, region) for region in painted)

    def _shown(self, painted: Region, shape: Painted) -> Region:
        windows = [] if shape.window is None else [shape.window]
        for window in (*windows, *map(self._let_through, shape.clips)):
            if not painted.is_empty and not is_inside(window, painted.bounds):
                painted = self._clipped(painted, window)
        return painted

    def _clipped(self, painted: Region, window: Region) -> Region:
        return self.united(polygon_parts(intersection(painted, window)))

    def _let_through(self, clip: Clip) -> Region:
        if clip not in self._clips:
            self._clips[clip] = self.united(self.fill(shape) for shape in clip.shapes)
        return self._clips[clip]

    def _whole_fill(self, shape: Painted) -> Region:
        if shape not in self._fills:
            placed = [piece.placed(shape.matrix) for piece in shape.pieces]
            rings = flattened_all(placed, self._tolerance)
            spend(_FILL_NS + _POINT_NS * sum(map(len, rings)), _TOO_MUCH)
            self._fills[shape] = filled(rings, shape.painting.fill_rule, self._allowance)
        return self._fills[shape]

    def _whole_stroke(self, shape: Painted, is_bridged: bool) -> Region:
        if (shape, is_bridged) not in self._strokes:
            self._strokes[shape, is_bridged] = self._stroked(shape, is_bridged)
        return self._strokes[shape, is_bridged]

    def _pen_strokes(self, pieces: Sequence[SubPath], pen: StrokeStyle, tolerance: float) -> Region:
        """Stroke of all pieces of one shape, in its own units."""
        for line in flattened_all(pieces, tolerance):
            spend(_STROKE_NS + _PEN_NS * len(line), _TOO_MUCH)
            if len(line) > 1 and not shapely.LineString(line).is_simple:
                self._allowance.spend([line])
        return self.united(piece_strokes(pieces, pen, tolerance, self._fine_points))

    def _stroked(self, shape: Painted, is_bridged: bool) -> Region:
        """Stroke in the shape's own units, where the pen is round, then placed."""
        factor = stretch(shape.matrix)
        if factor == 0 or abs(np.linalg.det(shape.matrix[:, :2])) < _FLAT * factor**2:
            return Polygon()
        pen = shape.painting.pen
        if is_bridged and pen.longest_gap * factor <= BRIDGED_SHARE * self._extent:
            pen = replace(pen, dashes=())
        painted = self._pen_strokes(shape.pieces, pen, self._tolerance / factor)
        return shapely.transform(painted, lambda points: affine.apply(shape.matrix, points))


def _rings(regions: Sequence[Region]) -> list[FloatArray]:
    points, ring = shapely.get_coordinates(shapely.get_rings(regions), return_index=True)
    return np.split(points, np.flatnonzero(np.diff(ring)) + 1)


MAX_POINTS = 500_000
"""Vertices of one drawing after flattening. Chosen."""

_MOST_COVERS, _LEAST_COVER = 4, 0.05
"""Large fills that are tried for hiding other shapes, and the least share of the drawing
that they have to cover. More tries cost time where nothing is hidden. Chosen."""


@final
@dataclass(frozen=True, eq=False)
class TracedInk:
    """Region of a drawing traced from a picture, fills and strokes not told apart.

    ``body`` is the same with its lines drawn solid.
    """

    whole: Region
    body: Region
    is_cut: bool = True

    @property
    def fills(self) -> Region:
        """All of it."""
        return self.body

    @property
    def lines(self) -> Region:
        """None of it."""
        return Polygon()


@final
class PaintedInk:
    """Region of a drawing computed from its shapes; each part is computed when it is asked for.

    ``extent`` is the longer side of the box round what shows of them, ``flattening`` the largest
    distance of a curve from its chords, as a share of that.
    """

    def __init__(
        self, shapes: Sequence[Painted], extent: float, flattening: float = FLATTENING
    ) -> None:
        self._shapes = [shape for shape in shapes if shown_box(shape) is not None]
        self._has_hidden = len(self._shapes) < len(shapes)
        self._extent = extent
        self._follower = Follower(extent, flattening)

    @cached_property
    def whole(self) -> Region:
        """All that is painted."""
        return self._together(is_bridged=False)

    @cached_property
    def body(self) -> Region:
        """Region with the short gaps of dashed lines closed: what an outline goes round."""
        is_dashed = any(shape.painting.pen.dashes for shape in self._shapes)
        return self._together(is_bridged=True) if is_dashed else self.whole

    @cached_property
    def fills(self) -> Region:
        """Region of all fills."""
        return self._follower.united(
            self._follower.fill(s) for s in self._shapes if s.painting.has_fill
        )

    @cached_property
    def lines(self) -> Region:
        """Region of the strokes of shapes without a fill, dashes as solid lines."""
        return self._follower.united(
            self._follower.stroke(shape, is_bridged=True)
            for shape in self._shapes
            if shape.painting.has_stroke and not shape.painting.has_fill
        )

    @cached_property
    def is_cut(self) -> bool:
        """Whether the page or a viewport cuts off part of any shape."""
        return self._has_hidden or any(self._follower.is_cut(shape) for shape in self._shapes)

    def _together(self, *, is_bridged: bool) -> Region:
        """Union of all shapes but those that larger ones hide: these are never followed."""
        boxes = [shown_box(shape, is_safe=True) for shape in self._shapes]
        sizes = [0.0 if b is None else (b[2] - b[0]) * (b[3] - b[1]) for b in boxes]
        covers: list[Region] = []
        regions: list[Region] = []
        for k in sorted(range(len(sizes)), key=sizes.__getitem__, reverse=True):
            shape, box = self._shapes[k], boxes[k]
            if box is None or any(is_inside(cover, box) for cover in covers):
                continue
            regions += self._follower.parts(shape, is_bridged=is_bridged)
            is_large = sizes[k] > _LEAST_COVER * self._extent**2
            if is_large and shape.painting.has_fill and len(covers) < _MOST_COVERS:
                covers.append(self._follower.fill(shape))
                shapely.prepare(covers[-1])
        return self._follower.united(regions)


Ink: TypeAlias = TracedInk | PaintedInk
"""Region of a drawing, in CSS pixels."""


def painted_ink(shapes: Sequence[Painted], tolerance: float | None = None) -> Ink:
    """Ink of shapes in painting order, curves followed to ``FLATTENING`` of the drawing's extent.

    ``tolerance`` is the largest distance of a curve from its chords, in CSS pixels, where that is
    to be finer.
    """
    box = drawing_box(shapes)
    extent = 0.0 if box is None else max(box[2] - box[0], box[3] - box[1])
    if extent <= 0:
        return TracedInk(Polygon(), Polygon(), is_cut=False)
    flattening = FLATTENING if tolerance is None else min(FLATTENING, tolerance / extent)
    _check_detail(shapes, flattening * extent)
    ink = PaintedInk(shapes, extent, flattening)
    if tolerance is not None or ink.body.is_empty:
        return ink
    # Of shapes that reach far beyond what shows of them, that is followed as finely.
    left, top, right, bottom = ink.body.bounds
    shown = max(right - left, bottom - top)
    if shown > extent / 2:
        return ink
    _check_detail(shapes, FLATTENING * shown)
    return PaintedInk(shapes, extent, FLATTENING * shown / extent)


def _check_detail(shapes: Sequence[Painted], tolerance: float) -> None:
    pieces = (piece for shape in shapes for piece in shape.pieces)
    if sum(len(piece.segments) for piece in pieces) * MAX_STEPS <= MAX_POINTS:
        return
    placed = (piece.placed(shape.matrix) for shape in shapes for piece in shape.pieces)
    total = sum(float(step_counts(piece.segments, tolerance).sum()) for piece in placed)
    if total > MAX_POINTS:
        raise TooRichError(f"needs {total:,.0f} points to follow its curves")
