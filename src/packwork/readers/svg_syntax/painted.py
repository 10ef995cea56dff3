"""Painted shapes, clips and texts, as a walk through a drawing finds them, and their bounds."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property
from typing import TypeAlias

import numpy as np
import shapely

from packwork.arrays import FloatArray
from packwork.geometry import affine
from packwork.geometry.polygon import Region
from packwork.readers.reading import UnfitError
from packwork.readers.svg_syntax.lengths import MAX_COORDINATE
from packwork.readers.svg_syntax.painting import Painting
from packwork.readers.svg_syntax.path_data import SubPath
from packwork.readers.svg_syntax.shapes import Viewport


@dataclass(frozen=True, eq=False)
class Painted:
    """One shape that leaves ink.

    Parameters
    ----------
    pieces
        In the shape's own units.
    matrix
        2 x 3 map from those to CSS pixels.
    window
        What the page and viewports show of it, in CSS pixels; None if all.
    clips
        Clip paths, each of which cuts it.
    """

    pieces: list[SubPath]
    matrix: FloatArray
    painting: Painting
    window: Region | None
    element: ET.Element
    clips: tuple[Clip, ...] = ()

    @cached_property
    def bounds(self) -> tuple[float, float, float, float]:
        """Left, top, right and bottom of all starts, handles and ends, in CSS pixels."""
        placed = self._control_points
        (left, top), (right, bottom) = placed.min(axis=0).tolist(), placed.max(axis=0).tolist()
        return left, top, right, bottom

    @cached_property
    def lengths(self) -> tuple[float, float]:
        """Way from point to point across and down, all pieces together, in CSS pixels."""
        across, down = np.abs(np.diff(self._control_points, axis=0)).sum(axis=0).tolist()
        return across, down

    @cached_property
    def _control_points(self) -> FloatArray:
        points = [piece.segments.reshape(-1, 2) for piece in self.pieces]
        points.append(np.array([piece.start for piece in self.pieces]))
        return affine.apply(self.matrix, np.concatenate(points))


@dataclass(frozen=True, eq=False)
class Clip:
    """A clip path where it is used.

    Parameters
    ----------
    shapes
        Those that let through what lies inside any of them.
    """

    shapes: tuple[Painted, ...]


@dataclass(frozen=True, eq=False)
class PlacedText:
    """One text element where it stands, not where a ``use`` repeats it.

    Parameters
    ----------
    matrix
        2 x 3 map from its own units to CSS pixels.
    viewport
        What its percentages refer to.
    above
        What it stands in, outermost first.
    """

    element: ET.Element
    matrix: FloatArray
    viewport: Viewport
    above: tuple[ET.Element, ...]


Box: TypeAlias = tuple[float, float, float, float]
"""Left, top, right and bottom in CSS pixels."""


def drawing_box(shapes: Iterable[Painted]) -> Box | None:
    """Box round control points and pens that can show; None if nothing can.

    Raises
    ------
    UnfitError
        If coordinates are absurd.

    Examples
    --------
    >>> drawing_box([]) is None
    True
    """
    boxes = [box for shape in shapes if (box := shown_box(shape)) is not None]
    if not boxes:
        return None
    lefts, tops, rights, bottoms = zip(*boxes, strict=True)
    return min(lefts), min(tops), max(rights), max(bottoms)


def shown_box(shape: Painted, *, is_safe: bool = False) -> Box | None:
    """Box of what can show of one shape: cut by its windows and clips.

    Parameters
    ----------
    is_safe
        Whether the box is to hold the farthest corners that the pen may draw.

    Raises
    ------
    UnfitError
        If coordinates are absurd.
    """
    box: Box | None = whole_box(shape, is_safe=is_safe)
    if shape.window is not None:
        if shape.window.is_empty:
            return None
        box = _common(box, shape.window.bounds)
    for clip in shape.clips:
        box = _common(box, drawing_box(clip.shapes))
    return box


def whole_box(shape: Painted, *, is_safe: bool = False) -> Box:
    """Box of one shape's control points and half its pen's width, uncut.

    Parameters
    ----------
    is_safe
        Whether the box is to hold the farthest corners that the pen may draw, which
        hardly ever are drawn.

    Raises
    ------
    UnfitError
        If coordinates are absurd.
    """
    left, top, right, bottom = shape.bounds
    margin = 0.0
    if shape.painting.has_stroke:
        pen = shape.painting.pen
        reach = max(math.sqrt(2), pen.miter_limit) if is_safe else 1.0
        margin = stretch(shape.matrix) * reach * pen.width / 2
    box = (left - margin, top - margin, right + margin, bottom + margin)
    if not all(abs(side) <= MAX_COORDINATE for side in box) and not is_safe:
        raise UnfitError(f"reaches beyond {MAX_COORDINATE:g} px; give it a smaller scale")
    return box


def is_inside(window: Region, box: Box) -> bool:
    """Whether a box lies within a region.

    Examples
    --------
    >>> is_inside(shapely.box(0, 0, 4, 4), (0.0, 1.0, 4.0, 3.0))
    True
    """
    left, top, right, bottom = window.bounds
    if not (left <= box[0] and top <= box[1] and box[2] <= right and box[3] <= bottom):
        return False
    return bool(shapely.covers(window, shapely.box(*box)))


def stretch(matrix: FloatArray) -> float:
    """Greater singular value of a 2 x 3 map: the largest factor by which it lengthens.

    Examples
    --------
    >>> import numpy as np
    >>> stretch(np.array([[0.0, -3.0, 5.0], [2.0, 0.0, 7.0]]))
    3.0
    """
    (a, c, _), (b, d, _) = matrix.tolist()
    return math.hypot(a + d, b - c) / 2 + math.hypot(a - d, b + c) / 2


def _common(box: Box | None, other: Box | None) -> Box | None:
    if box is None or other is None:
        return None
    left, top = max(box[0], other[0]), max(box[1], other[1])
    right, bottom = min(box[2], other[2]), min(box[3], other[3])
    return (left, top, right, bottom) if right >= left and bottom >= top else None
