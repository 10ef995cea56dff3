"""Arrays, outlines and art as plain values, and back bit for bit.

What comes from a file goes through the gates of its kind.

Lines for a machine are kept where they lie in their part, in and out alike.
"""

from __future__ import annotations

import base64
import binascii
import logging
import re
from typing import Any

import numpy as np
from shapely import LinearRing

from packwork.arrays import FloatArray
from packwork.errors import ShapeError
from packwork.geometry.arcs import ArcLine
from packwork.geometry.outline import Outline
from packwork.geometry.overlay import valid
from packwork.live.file.records import (
    FARTHEST,
    MOST_LINES,
    MOST_PATH,
    PATH,
    ArcLineRecord,
    ArtRecord,
    EngravedRecord,
    FlatRecord,
    LineRecord,
    Matrix,
    OutlineRecord,
    PhotoRecord,
    PictureRecord,
    VectorRecord,
    kept_text,
)
from packwork.phrasing import number_of
from packwork.readers.budget.crossings import Allowance, check_nesting
from packwork.readers.gate.door import MAX_BYTES
from packwork.readers.layouts.line_room import LineRoom
from packwork.readers.pictures.decode import opened
from packwork.readers.reading import UnfitError
from packwork.readers.regions import MAX_POINTS
from packwork.readers.svg.art import KeptOriginal, kept_art
from packwork.scene.colour import css_colour
from packwork.scene.item import Art, FlatArt, PhotoArt, PictureArt, VectorArt
from packwork.scene.line_art import EngravedLine, LineArt
from packwork.uses.cutting import cropped

SAME = 1e-9
"""By how much, relatively, two ways to compute one area may differ. Derived: rounding."""


def text_of(points: FloatArray) -> str:
    """Base64 of an array's bytes.

    Examples
    --------
    >>> points_of(text_of(np.array([[1.0, 2.5]]))).tolist()
    [[1.0, 2.5]]
    """
    return base64.b64encode(np.ascontiguousarray(points, "<f8").tobytes()).decode("ascii")


def bytes_of(text: str) -> bytes:
    """Bytes of base64."""
    try:
        return base64.b64decode(text, validate=True)
    except (binascii.Error, ValueError):
        raise UnfitError("holds an array that is cut short") from None


def points_of(text: str) -> FloatArray:
    """``(n, 2)`` points of base64."""
    data = bytes_of(text)
    if len(data) % 16 or len(data) > 16 * MAX_POINTS:
        raise UnfitError(f"holds {len(data) // 16:,} points, or parts of one; {MAX_POINTS:,} go")
    points = np.frombuffer(data, "<f8").reshape(-1, 2).astype(np.float64)
    if not (np.abs(points) <= FARTHEST).all():
        raise UnfitError("holds points that are no numbers")
    return points


def outline_record(outline: Outline) -> OutlineRecord:
    """An outline as plain values."""
    return OutlineRecord(
        points=text_of(outline.points), starts=tuple(int(k) for k in outline.starts)
    )


def outline_of(record: OutlineRecord, allowance: Allowance) -> Outline:
    """The outline bit for bit; mended, if its rings are not what an outline's have to be."""
    points, starts = points_of(record.points), np.array(record.starts, dtype=np.int64)
    if (
        len(starts) < 2
        or starts[0] != 0
        or starts[-1] != len(points)
        or (np.diff(starts) < 3).any()
    ):
        raise UnfitError("holds an outline whose rings do not fit its points")
    outline = Outline(points, starts)
    allowance.spend(outline.rings)
    check_nesting([LinearRing(ring) for ring in outline.rings])
    region = outline.region
    if not region.is_valid or not np.isclose(region.area, outline.area, rtol=SAME):
        outline = Outline.from_region(valid(region))
    if not outline.area > 0:
        raise ShapeError("an outline has no area")
    return outline


LONGEST_PRINT = 4_000.0
"""Longer side of a photograph in a session file, px: 34 cm at 300 to the inch. Larger makes files
of hundreds of megabytes. Chosen."""

HALVES = 4
"""How often a photograph whose file would be too large is halved at most. Chosen."""


def art_record(art: Art, outline: Outline, name: str) -> ArtRecord:
    """An art as plain values; ``outline`` and ``name``: of its item."""
    if isinstance(art, FlatArt):
        return FlatRecord(fill=art.fill)
    if isinstance(art, LineArt):
        return _lines_record(art, outline, name)
    if isinstance(art, VectorArt):
        return _vector_record(art)
    if isinstance(art, PhotoArt):
        return photo_record(art, outline.extent)
    png = base64.b64encode(art.png).decode("ascii")
    return PictureRecord(
        png=png, width=art.width, height=art.height,
        matrix=matrix_record(art.matrix), is_traced=art.is_traced,
    )  # fmt: skip


def photo_record(art: PhotoArt, extent: float) -> PhotoRecord:
    """A photograph as plain values, its large copy no larger than the gate lets pass."""
    share, crop = min(1.0, LONGEST_PRINT / extent), None
    if (part := art.crop) is not None:
        art, crop = part.whole, (part.zoom, part.x, part.y)
    printed = art.original.printed(share)
    for _ in range(HALVES):
        if len(printed.markup) < MAX_BYTES - 1_000:
            break
        share /= 2
        printed = art.original.printed(share)
    return PhotoRecord(
        preview=_vector_record(art.preview), printed=_vector_record(printed), crop=crop
    )


def art_of(record: ArtRecord, outline: Outline) -> Art:
    """The art of a record; lines for a machine lie in the outline that stands for them."""
    if isinstance(record, FlatRecord):
        return FlatArt(colour_of(record.fill))
    if isinstance(record, LineRecord):
        return _lines_of(record, outline)
    if isinstance(record, VectorRecord):
        return _vector_of(record)
    if isinstance(record, PhotoRecord):
        photo = photo_of(record)
        return photo if record.crop is None else cropped(photo, outline, *record.crop)
    png = bytes_of(record.png)
    with opened(png) as image:
        if image.format != "PNG" or image.size != (record.width, record.height):
            raise UnfitError("holds a picture that is not the PNG it is said to be")
    matrix = matrix_of(record.matrix)
    return PictureArt(png, record.width, record.height, matrix, record.is_traced)


def photo_of(record: PhotoRecord) -> PhotoArt:
    """The photograph of a record."""
    return PhotoArt(_vector_of(record.preview), KeptOriginal(_vector_of(record.printed)))


def matrix_record(matrix: FloatArray) -> Matrix:
    """A 2 x 3 map as plain numbers."""
    a, b, x, c, d, y = (float(value) for value in matrix.ravel())
    return a, b, x, c, d, y


def matrix_of(record: Matrix) -> FloatArray:
    """The 2 x 3 map of plain numbers."""
    return np.array(record, dtype=np.float64).reshape(2, 3)


def _vector_record(art: VectorArt) -> VectorRecord:
    return VectorRecord(
        markup=art.markup, matrix=matrix_record(art.matrix), is_traced=art.is_traced
    )


def _vector_of(record: VectorRecord) -> VectorArt:
    return kept_art(record.markup, matrix_of(record.matrix), is_traced=record.is_traced)


def colour_of(text: str) -> str:
    """The same text, if it is a colour."""
    try:
        css_colour(text)
    except ValueError:
        raise UnfitError(f"holds {text[:40]!r}, which is no colour") from None
    return text


_LOG = logging.getLogger("packwork")


def _lines_record(art: LineArt, outline: Outline, name: str) -> VectorRecord:
    """An art of lines as plain values; what would be refused when it is read is left out and told.

    ``outline`` and ``name``: of its item.
    """

    def fields(line: ArcLine) -> dict[str, Any]:
        bulges = tuple(line.bulges.tolist())
        return {"points": text_of(line.points), "bulges": bulges, "is_closed": line.is_closed}

    drawn, room = _vector_record(art), LineRoom(outline.region, outline.extent)
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


def _lines_of(record: LineRecord, outline: Outline) -> LineArt:
    """Art of a record; UnfitError of lines that leave their outline."""

    def arcs(one: ArcLineRecord) -> tuple[FloatArray, FloatArray, bool]:
        points, bulges = points_of(one.points), np.array(one.bulges, dtype=np.float64)
        if len(points) != len(bulges) or len(points) < 2:
            raise UnfitError("holds a line whose arcs do not fit its points")
        return points, bulges, one.is_closed

    cut = tuple(ArcLine(*arcs(one)) for one in record.cut)
    engraved = tuple(EngravedLine(*arcs(one), one.colour, one.layer) for one in record.engraved)
    art, path = _vector_of(record), record.path or ""
    room = LineRoom(outline.region, outline.extent)
    # What would be cut or engraved there is beyond what is certified.
    is_in = room.holds(*cut, *engraved, matrix=art.matrix)
    if not is_in or (path and not room.holds_path(path, art.matrix)):
        raise UnfitError("holds lines for a machine that leave their part, or too many of them")
    return LineArt(
        art.markup, art.matrix, art.is_traced, cut, engraved, path, is_painted=record.is_painted
    )
