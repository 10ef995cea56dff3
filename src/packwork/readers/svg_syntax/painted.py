"""Painted shapes, clips and texts, as a walk through a drawing finds them."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from packwork.arrays import FloatArray
from packwork.geometry import affine
from packwork.geometry.polygon import Region
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
    painting
        How it is filled and stroked.
    window
        What the page and viewports show of it, in CSS pixels; None if all.
    element
        Where it comes from in the tree.
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
    element
        In the tree.
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
