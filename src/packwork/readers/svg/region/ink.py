"""Region that a drawing covers: all its fills and strokes together."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from functools import cached_property
from typing import final

import shapely
from shapely.geometry import Polygon

from packwork.geometry.bezier import FLATTENING, MAX_STEPS
from packwork.geometry.polygon import Region
from packwork.readers.reading import TooRichError
from packwork.readers.svg.region.follow import Follower
from packwork.readers.svg_syntax.painted import Painted, drawing_box, is_inside, shown_box
from packwork.readers.svg_syntax.shapes import step_counts

MAX_POINTS = 500_000
"""Vertices of one drawing after flattening. Chosen."""

_MOST_COVERS, _LEAST_COVER = 4, 0.05
"""Large fills that are tried for hiding other shapes, and the least share of the drawing
that they have to cover. More tries cost time where nothing is hidden. Chosen."""


class Ink(ABC):
    """Region of a drawing, in CSS pixels; each part is computed when it is asked for."""

    @property
    @abstractmethod
    def whole(self) -> Region:
        """All that is painted."""

    @property
    @abstractmethod
    def body(self) -> Region:
        """Region with the short gaps of dashed lines closed: what an outline goes round."""

    @property
    @abstractmethod
    def fills(self) -> Region:
        """Region of all fills; possibly empty."""

    @property
    @abstractmethod
    def lines(self) -> Region:
        """Region of the strokes of shapes without a fill; possibly empty."""

    @property
    @abstractmethod
    def is_cut(self) -> bool:
        """Whether a page or a viewport cuts off part of what is drawn."""


def painted_ink(shapes: Sequence[Painted], tolerance: float | None = None) -> Ink:
    """Ink of shapes, curves followed to ``FLATTENING`` of the drawing's extent.

    Parameters
    ----------
    shapes
        In painting order.
    tolerance
        Largest distance of a curve from its chords, in CSS pixels, where that is to be
        finer.

    Raises
    ------
    UnfitError
        If coordinates are absurd.
    TooRichError
        If outlines need too much detail; asking for a region also if its edges cross too
        often.

    Examples
    --------
    >>> painted_ink([]).whole.is_empty
    True
    """
    box = drawing_box(shapes)
    extent = 0.0 if box is None else max(box[2] - box[0], box[3] - box[1])
    if extent <= 0:
        return TracedInk(Polygon(), is_cut=False)
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


@final
class TracedInk(Ink):
    """Ink traced from a picture: one region, fills and strokes not told apart."""

    def __init__(self, whole: Region, body: Region = None, *, is_cut: bool = True) -> None:
        self._whole = whole
        self._body = whole if body is None else body
        self._is_cut = is_cut

    @property
    def whole(self) -> Region:
        """The region that was found."""
        return self._whole

    @property
    def body(self) -> Region:
        """The region that was found with its lines drawn solid."""
        return self._body

    @property
    def fills(self) -> Region:
        """All of it."""
        return self._body

    @property
    def lines(self) -> Region:
        """None of it."""
        return Polygon()

    @property
    def is_cut(self) -> bool:
        """Whether the drawing was shown on its page."""
        return self._is_cut


@final
class PaintedInk(Ink):
    """Ink computed from a drawing's shapes.

    Parameters
    ----------
    shapes
        In painting order.
    extent
        Longer side of the box round what shows of them.
    flattening
        Largest distance of a curve from its chords, as a share of that.
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
        """Region with the short gaps of dashed lines closed."""
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


def _check_detail(shapes: Sequence[Painted], tolerance: float) -> None:
    pieces = (piece for shape in shapes for piece in shape.pieces)
    if sum(len(piece.segments) for piece in pieces) * MAX_STEPS <= MAX_POINTS:
        return
    placed = (piece.placed(shape.matrix) for shape in shapes for piece in shape.pieces)
    total = sum(float(step_counts(piece.segments, tolerance).sum()) for piece in placed)
    if total > MAX_POINTS:
        raise TooRichError(f"needs {total:,.0f} points to follow its curves")
