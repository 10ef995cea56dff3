"""Arrays as text, and back bit for bit."""

from __future__ import annotations

import base64
import binascii

import numpy as np
from shapely import LinearRing

from packwork.arrays import FloatArray
from packwork.errors import ShapeError
from packwork.geometry.outline import Outline
from packwork.geometry.overlay import valid
from packwork.live.file.records import FARTHEST, OutlineRecord
from packwork.readers.budget.crossings import Allowance, check_nesting
from packwork.readers.reading import UnfitError
from packwork.readers.regions import MAX_POINTS

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
    """Bytes of base64.

    Raises
    ------
    UnfitError
        If it is none.
    """
    try:
        return base64.b64decode(text, validate=True)
    except (binascii.Error, ValueError):
        raise UnfitError("holds an array that is cut short") from None


def points_of(text: str) -> FloatArray:
    """``(n, 2)`` points of base64.

    Raises
    ------
    UnfitError
        If it holds none, or more than a run takes.
    """
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
    """The outline bit for bit; mended, if its rings are not what an outline's have to be.

    Raises
    ------
    UnfitError
        If it is none, or a scribble.
    ShapeError
        If it has no area.
    """
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
