"""Lines for a machine in session files: kept where they lie in their part, in and out alike."""

from __future__ import annotations

import logging
import re
from collections.abc import Callable
from typing import Any, final

import numpy as np
import shapely

from packwork.arrays import FloatArray
from packwork.geometry import affine
from packwork.geometry.arcs import STRAIGHT, ArcLine
from packwork.geometry.outline import Outline
from packwork.geometry.overlay import buffered
from packwork.live.file.records import (
    MOST_LINES,
    MOST_PATH,
    PATH,
    ArcLineRecord,
    EngravedRecord,
    LineRecord,
    VectorRecord,
    kept_text,
)
from packwork.phrasing import number_of
from packwork.readers.layouts.marks import LINES_OFF
from packwork.readers.reading import UnfitError, one_budget
from packwork.readers.regions import MAX_POINTS
from packwork.readers.svg_syntax.path_data import parse_path
from packwork.scene.item import VectorArt
from packwork.scene.line_art import EngravedLine, LineArt

_LOG = logging.getLogger("packwork")

_MOST_SAMPLES = 4 * MAX_POINTS
"""Points of one part's lines, with those of its arcs, that are looked at. Chosen."""


def lines_record(
    art: LineArt, drawn: VectorRecord, outline: Outline, name: str, text_of: Callable[..., str]
) -> VectorRecord:
    """An art of lines as plain values; what would be refused when it is read is left out and told.

    ``drawn``: its markup; ``outline`` and ``name``: of its item; ``text_of``: points as text.
    """

    def fields(line: ArcLine) -> dict[str, Any]:
        bulges = tuple(line.bulges.tolist())
        return {"points": text_of(line.points), "bulges": bulges, "is_closed": line.is_closed}

    room = LineRoom(outline, art.matrix)
    if len(art.cut) > MOST_LINES or not room.holds(*art.cut):
        _LOG.warning(
            "%s: its lines to cut leave its outline, or are too many; the session keeps the "
            "outline in their place, without arcs and engraved lines", name,
        )  # fmt: skip
        return drawn
    engraved = art.engraved[:MOST_LINES]
    if not room.holds(*engraved):
        engraved = tuple(filter(room.holds, engraved))
    if lost := len(art.engraved) - len(engraved):
        _LOG.warning("%s: the session is written without %s that would leave the part, or are too "
                     "many", name, number_of(lost, "engraved line"))  # fmt: skip
    is_kept = len(art.path) <= MOST_PATH and re.fullmatch(PATH, art.path) is not None
    return LineRecord(
        **drawn.model_dump(exclude={"kind"}), is_painted=art.is_painted,
        cut=tuple(ArcLineRecord(**fields(line)) for line in art.cut),
        engraved=tuple(
            EngravedRecord(**fields(line), colour=line.colour, layer=kept_text(line.layer))
            for line in engraved
        ),
        path=art.path if art.path and is_kept and room.holds_path(art.path) else None,
    )  # fmt: skip


def lines_of(
    record: LineRecord, art: VectorArt, outline: Outline, points_of: Callable[[str], FloatArray]
) -> LineArt:
    """Art of a record, whose markup is ``art``; UnfitError of lines that leave their outline."""

    def arcs(one: ArcLineRecord) -> tuple[FloatArray, FloatArray, bool]:
        points, bulges = points_of(one.points), np.array(one.bulges, dtype=np.float64)
        if len(points) != len(bulges) or len(points) < 2:
            raise UnfitError("holds a line whose arcs do not fit its points")
        return points, bulges, one.is_closed

    cut = tuple(ArcLine(*arcs(one)) for one in record.cut)
    engraved = tuple(EngravedLine(*arcs(one), one.colour, one.layer) for one in record.engraved)
    room, path = LineRoom(outline, art.matrix), record.path or ""
    # What would be cut or engraved there is beyond what is certified.
    if not room.holds(*cut, *engraved) or (path and not room.holds_path(path)):
        raise UnfitError("holds lines for a machine that leave their part, or too many of them")
    return LineArt(
        art.markup, art.matrix, art.is_traced, cut, engraved, path, is_painted=record.is_painted
    )


@final
class LineRoom:
    """Room for the lines of a part, and the map ``(2, 3)`` from their units to its outline's.

    Examples
    --------
    >>> room = LineRoom(Outline.from_region(shapely.box(0, 0, 9, 9)), affine.identity())
    >>> half = ArcLine(np.array([[3.0, 5.0], [6.0, 5.0]]), np.array([1.0, 0.0]))
    >>> room.holds(half), room.holds(ArcLine(half.points, 9 * half.bulges))
    (True, False)
    >>> room.holds_path("M1 1C2 9 7 9 8 1Z"), room.holds_path("M1 1C2 19 7 19 8 1Z")
    (True, False)
    """

    def __init__(self, outline: Outline, matrix: FloatArray) -> None:
        self._slack = LINES_OFF * outline.extent
        self._room = buffered(outline.region, self._slack)
        shapely.prepare(self._room)
        self._matrix, self._left = matrix, _MOST_SAMPLES

    def holds(self, *lines: ArcLine) -> bool:
        """Whether lines lie in the part; work is bounded by what is left for all that it has."""
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
        if not self._covers(np.concatenate(outermost)):
            return False
        turns = np.where(is_bent, 4 * np.arctan(bulges), 0.0)
        linear = self._matrix[:, :2].T
        reach = sum(np.hypot(*(one @ linear).T) for one in (chords, across))
        curving = np.abs(turns) ** 2 * reach * (1 + bends[:, 0] ** 2) / (4 * np.abs(bends[:, 0]))
        side, shares = self._samples(curving)
        if side is None:
            return False
        spokes = np.where(is_bent[:, None], starts - centres, 0.0)
        turned = np.column_stack([-spokes[:, 1], spokes[:, 0]])
        at = (shares * turns[side])[:, None]
        seen = (starts - spokes)[side] + spokes[side] * np.cos(at) + turned[side] * np.sin(at)
        return self._covers(seen)

    def holds_path(self, path: str) -> bool:
        """Whether all that SVG path data draws lies in the part."""
        try:
            with one_budget():
                cubics = np.concatenate([one.segments for one in parse_path(path)])
        except (UnfitError, ValueError):
            return False
        corners = cubics @ self._matrix[:, :2].T
        bends = np.hypot(*np.moveaxis(np.diff(corners, n=2, axis=1), 2, 0)).max(axis=1)
        side, u = self._samples(6 * bends)
        if side is None:
            return False
        v, p = 1 - u, np.moveaxis(cubics[side], 1, 0)
        shares = (v**3, 3 * v * v * u, 3 * v * u * u, u**3)
        seen = sum(share[:, None] * corner for share, corner in zip(shares, p, strict=True))
        return self._covers(np.concatenate([seen, cubics[:, 3]]))

    def _samples(self, curving: FloatArray) -> tuple[Any, FloatArray]:
        """Sides, and where on them to look, 0 to 1, for second derivatives; None if too many."""
        # A chord lies off a curve by an eighth of that at most.
        counts = np.maximum(np.ceil(np.sqrt(curving / (8 * self._slack))), 1.0)
        # What is no number is too many, too.
        if not counts.sum() <= self._left:
            return None, counts
        whole = counts.astype(np.int64)
        total = int(whole.sum())
        self._left -= total
        side = np.repeat(np.arange(len(whole)), whole)
        return side, (np.arange(total) - np.repeat(np.cumsum(whole) - whole, whole)) / counts[side]

    def _covers(self, points: FloatArray) -> bool:
        x, y = affine.apply(self._matrix, points).T
        left, top, right, bottom = self._room.bounds
        if not ((x >= left) & (x <= right) & (y >= top) & (y <= bottom)).all():
            return False
        return bool(shapely.intersects_xy(self._room, x, y).all())
