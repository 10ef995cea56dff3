"""Room of a part for the lines that a machine follows and the paint that goes with them."""

from __future__ import annotations

from typing import Any, final

import numpy as np
import shapely

from packwork.arrays import FloatArray
from packwork.geometry import affine
from packwork.geometry.arcs import STRAIGHT, ArcLine
from packwork.geometry.overlay import buffered
from packwork.geometry.polygon import Region
from packwork.readers.reading import UnfitError, one_budget
from packwork.readers.regions import MAX_POINTS
from packwork.readers.svg_syntax.coordinates import MAX_COORDINATE
from packwork.readers.svg_syntax.path_data import SubPath, parse_path

LINES_OFF = 1e-4
"""How far lines for a machine may lie beyond their part's outline, as a share of its extent.
Chosen: above rounding, below what is seen."""

PAINT_OFF = 1e-3
"""How far artwork may be painted beyond its part's outline, as a share of its extent. Chosen: it is
followed anew, and nothing is cut there."""

_FINENESS = 4.0
"""How many times closer than ``LINES_OFF`` the chords that are looked at lie to their arcs."""

_MOST_SAMPLES = 4 * MAX_POINTS
"""Points of one part's lines, with those of its arcs, that are looked at. Chosen."""

_SAME = affine.identity()


@final
class LineRoom:
    """A part's outline, but for rounding.

    ``matrix``: map ``(2, 3)`` from the units of what is held against it to its own.

    Examples
    --------
    >>> room = LineRoom(shapely.box(0, 0, 9, 9), 9.0)
    >>> half = ArcLine(np.array([[3.0, 5.0], [6.0, 5.0]]), np.array([1.0, 0.0]))
    >>> room.holds(half), room.holds(ArcLine(half.points, 9 * half.bulges))
    (True, False)
    >>> room.holds_path("M1 1C2 9 7 9 8 1Z"), room.holds_path("M1 1C2 19 7 19 8 1Z")
    (True, False)
    >>> room.holds_path("M1 1Z"), room.holds_path("M1 1L2 2ZM3 3Z")
    (False, True)
    >>> room.holds(half, matrix=2.0 * affine.identity())
    False
    """

    def __init__(self, region: Region, extent: float) -> None:
        """``extent``: the part's size, in the units of its region."""
        self._extent, self._left = extent, _MOST_SAMPLES
        self._region = buffered(region, LINES_OFF * extent)
        shapely.prepare(self._region)

    def holds(self, *lines: ArcLine, matrix: FloatArray = _SAME) -> bool:
        """Whether lines lie in it; work is bounded by what is left for all that the part has."""
        lines = tuple(line for line in lines if line.sides > 0)
        if not lines:
            return True
        starts = np.concatenate([line.points[: line.sides] for line in lines])
        bulges = np.concatenate([line.bulges[: line.sides] for line in lines])
        ends = np.concatenate([line.ends for line in lines])
        chords = ends - starts
        across = np.column_stack([chords[:, 1], -chords[:, 0]])
        is_bent = np.abs(bulges) > STRAIGHT
        bends = np.where(is_bent, bulges, 1.0)[:, None]
        middles = starts + chords / 2
        # Tops of arcs, and where those of more than half a circle are widest: the image of what
        # lies between these is no larger than a few parts, however much the map stretches.
        wide = chords * (1 + bends**2) / (4 * bends)
        centres = middles + across * (bends - 1 / bends) / 4
        is_most = np.abs(bulges) > 1.0
        outermost = [
            starts, ends, (middles + across * bends / 2)[is_bent],
            (centres + wide)[is_most], (centres - wide)[is_most],
        ]  # fmt: skip
        if not self._is_near(np.concatenate(outermost), matrix):
            return False
        turns = np.where(is_bent, 4 * np.arctan(bulges), 0.0)
        reach = sum(np.hypot(*(one @ matrix[:, :2].T).T) for one in (chords, across))
        curving = np.abs(turns) ** 2 * reach * (1 + bends[:, 0] ** 2) / (4 * np.abs(bends[:, 0]))
        side, shares = self._samples(curving)
        if side is None:
            return False
        spokes = np.where(is_bent[:, None], starts - centres, 0.0)
        turned = np.column_stack([-spokes[:, 1], spokes[:, 0]])
        at = (shares * turns[side])[:, None]
        seen = (starts - spokes)[side] + spokes[side] * np.cos(at) + turned[side] * np.sin(at)
        of_line = np.repeat(np.arange(len(lines)), [line.sides for line in lines])
        lasts = np.cumsum([line.sides for line in lines]) - 1
        return self._covers(seen, ends[lasts], of_line[side], matrix)

    def holds_path(self, path: str, matrix: FloatArray = _SAME) -> bool:
        """Whether SVG path data draws something, and all of it lies in it."""
        try:
            with one_budget():
                # A point alone draws nothing.
                pieces = [_whole(one) for one in parse_path(path) if len(one.segments)]
        except UnfitError:
            return False
        if not pieces:
            return False
        cubics = np.concatenate(pieces)
        if not self._is_near(cubics[:, [0, 3]].reshape(-1, 2), matrix):
            return False
        corners = cubics @ matrix[:, :2].T
        bends = np.hypot(*np.moveaxis(np.diff(corners, n=2, axis=1), 2, 0)).max(axis=1)
        side, u = self._samples(6 * bends)
        if side is None:
            return False
        v, p = 1 - u, np.moveaxis(cubics[side], 1, 0)
        shares = (v**3, 3 * v * v * u, 3 * v * u * u, u**3)
        seen = np.asarray(sum(s[:, None] * corner for s, corner in zip(shares, p, strict=True)))
        sizes = [len(one) for one in pieces]
        of_piece = np.repeat(np.arange(len(pieces)), sizes)
        return self._covers(seen, cubics[np.cumsum(sizes) - 1, 3], of_piece[side], matrix)

    def holds_paint(self, paint: Region, matrix: FloatArray) -> bool:
        """Whether what is painted lies in it and no more than ``PAINT_OFF`` beyond it."""
        if not (np.abs(matrix) <= MAX_COORDINATE).all():
            return False
        region = shapely.transform(paint, lambda points: affine.apply(matrix, points))
        return bool(buffered(self._region, PAINT_OFF * self._extent).covers(region))

    def _is_near(self, points: FloatArray, matrix: FloatArray) -> bool:
        """Whether the images of points lie in its box, before anything between them is followed."""
        x, y = affine.apply(matrix, points).T
        left, top, right, bottom = self._region.bounds
        return bool(((x >= left) & (x <= right) & (y >= top) & (y <= bottom)).all())

    def _samples(self, curving: FloatArray) -> tuple[Any, FloatArray]:
        """Sides, and where on them to look, 0 to 1, for second derivatives; None if too many."""
        # A chord lies off a curve by an eighth of that at most.
        off = LINES_OFF * self._extent / _FINENESS
        counts = np.maximum(np.ceil(np.sqrt(curving / (8 * off))), 1.0)
        # What is no number is too many, too.
        if not counts.sum() <= self._left:
            return None, counts
        whole = counts.astype(np.int64)
        total = int(whole.sum())
        self._left -= total
        side = np.repeat(np.arange(len(whole)), whole)
        return side, (np.arange(total) - np.repeat(np.cumsum(whole) - whole, whole)) / counts[side]

    def _covers(
        self, points: FloatArray, lasts: FloatArray, of_line: Any, matrix: FloatArray
    ) -> bool:
        """Whether chords lie in it: of points one after another on each line, then its last one."""
        order = np.argsort(np.concatenate([of_line, np.arange(len(lasts))]), kind="stable")
        whole = affine.apply(matrix, np.concatenate([points, lasts])[order])
        counts = np.bincount(of_line) + 1
        drawn = shapely.linestrings(whole, indices=np.repeat(np.arange(len(lasts)), counts))
        return bool(shapely.covers(self._region, drawn).all())


def _whole(piece: SubPath) -> FloatArray:
    """Cubics of a piece of a path, the line that closes it among them."""
    begin, end = np.array(piece.start), piece.segments[-1, 3]
    if not piece.is_closed or (begin == end).all():
        return piece.segments
    return np.concatenate([piece.segments, [[end, end, begin, begin]]])
