"""Lines for a machine in session files: kept where they lie in their part, in and out alike."""

from __future__ import annotations

import logging
import re
from collections.abc import Callable
from typing import Any

import numpy as np

from packwork.arrays import FloatArray
from packwork.geometry.arcs import ArcLine
from packwork.geometry.outline import Outline
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
from packwork.readers.layouts.line_room import LineRoom
from packwork.readers.reading import UnfitError
from packwork.scene.item import VectorArt
from packwork.scene.line_art import EngravedLine, LineArt

_LOG = logging.getLogger("packwork")


def lines_record(
    art: LineArt, drawn: VectorRecord, outline: Outline, name: str, text_of: Callable[..., str]
) -> VectorRecord:
    """An art of lines as plain values; what would be refused when it is read is left out and told.

    ``drawn``: its markup; ``outline`` and ``name``: of its item; ``text_of``: points as text.
    """

    def fields(line: ArcLine) -> dict[str, Any]:
        bulges = tuple(line.bulges.tolist())
        return {"points": text_of(line.points), "bulges": bulges, "is_closed": line.is_closed}

    room = LineRoom(outline.region, outline.extent)
    if len(art.cut) > MOST_LINES or not room.holds(*art.cut, matrix=art.matrix):
        _LOG.warning(
            "%s: its lines to cut leave its outline, or are too many; the session keeps the "
            "outline in their place, without arcs and engraved lines", name,
        )  # fmt: skip
        return drawn
    engraved = art.engraved[:MOST_LINES]
    if not room.holds(*engraved, matrix=art.matrix):
        engraved = tuple(one for one in engraved if room.holds(one, matrix=art.matrix))
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
        path=art.path if art.path and is_kept and room.holds_path(art.path, art.matrix) else None,
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
    room, path = LineRoom(outline.region, outline.extent), record.path or ""
    # What would be cut or engraved there is beyond what is certified.
    is_in = room.holds(*cut, *engraved, matrix=art.matrix)
    if not is_in or (path and not room.holds_path(path, art.matrix)):
        raise UnfitError("holds lines for a machine that leave their part, or too many of them")
    return LineArt(
        art.markup, art.matrix, art.is_traced, cut, engraved, path, is_painted=record.is_painted
    )
