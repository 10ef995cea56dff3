"""Glyphs that were drawn before, kept by their font's content and the version of the code.

Letters recur in every run. What is kept is numbers: a region as well-known binary, outlines as
arrays. It comes back bit for bit.

A typeface is opened anew for each run, so results that were kept by the object would never be
found again, and would keep its file in memory.
"""

from __future__ import annotations

import struct
from collections import OrderedDict
from collections.abc import Callable
from dataclasses import dataclass
from functools import wraps
from threading import Lock
from typing import Any, Concatenate, ParamSpec, TypeVar

import numpy as np
import shapely
import uharfbuzz
from shapely.errors import GEOSException

from packwork.errors import ShapeError
from packwork.folders import Store
from packwork.geometry.outline import Outline
from packwork.geometry.polygon import Region
from packwork.readers.fonts.face import Typeface
from packwork.readers.version import reader_version

P = ParamSpec("P")
R = TypeVar("R")

_OfFont = Callable[Concatenate[Typeface, P], R]


def remembered_by_font(most: int) -> Callable[[_OfFont[P, R]], _OfFont[P, R]]:
    """Keep the ``most`` results of a function of a typeface that were last asked for.

    Typefaces of the same content are one; none is kept itself.

    Examples
    --------
    >>> from packwork.readers.fonts.face import bundled_typeface
    >>> asked = []
    >>> @remembered_by_font(2)
    ... def count_of(face: Typeface, text: str) -> int:
    ...     asked.append(text)
    ...     return len(face.shaped(text).glyphs)
    >>> [count_of(bundled_typeface(), text) for text in ("bear", "fox", "bear", "owl", "fox")]
    [4, 3, 4, 3, 3]
    >>> asked
    ['bear', 'fox', 'owl', 'fox']
    """

    def remembering(compute: _OfFont[P, R]) -> _OfFont[P, R]:
        known: OrderedDict[Any, R] = OrderedDict()
        lock = Lock()

        @wraps(compute)
        def told(face: Typeface, /, *args: P.args, **options: P.kwargs) -> R:
            key = (face.identity, args, *sorted(options.items()))
            with lock:
                if key in known:
                    known.move_to_end(key)
                    return known[key]
            found = compute(face, *args, **options)
            with lock:
                known[key] = found
                while len(known) > most:
                    known.popitem(last=False)
            return found

        return told

    return remembering


MOST_BYTES = 50_000_000
"""Size of all that is kept: about 5,000 letters of 10 kB. Chosen."""

STORE = Store("glyphs", MOST_BYTES)

_HEAD = struct.Struct("<d5q")
"""Clearance, then bytes of the region and numbers of each array."""


@dataclass(frozen=True, eq=False)
class GlyphInk:
    """Region of a glyph about its origin, in its font's units.

    Parameters
    ----------
    region
        The same as a region; empty for a space.
    ink, silhouette
        Its rings, and those of its silhouette, without holes; None for a space.
    clearance
        By how much a vertex may move before rings meet; ``CLEAR`` of its extent at most.
    """

    region: Region
    ink: Outline | None
    silhouette: Outline | None
    clearance: float


def kept_glyph(what: tuple[Any, ...], draw: Callable[[], GlyphInk]) -> GlyphInk:
    """Result of ``draw`` for a glyph, now or at an earlier time.

    Parameters
    ----------
    what
        All that it depends on beside the code: the font, the glyph, the tolerance.
    """
    key = f"{reader_version()} {uharfbuzz.__version__} {what!r}"
    kept = STORE.get(key)
    found = None if kept is None else unpacked(kept)
    if found is None:
        found = draw()
        STORE.put(key, packed(found))
    return found


def packed(glyph: GlyphInk) -> bytes:
    """Bytes of what a glyph covers.

    Examples
    --------
    >>> tile = Outline.box(0.0, 0.0, 2.0, 1.0)
    >>> back = unpacked(packed(GlyphInk(tile.region, tile, tile, 0.5)))
    >>> back.ink.area, back.region.area, back.clearance
    (2.0, 2.0, 0.5)
    >>> unpacked(b"no glyph") is None
    True
    """
    region: bytes = shapely.to_wkb(glyph.region)
    arrays = [
        array
        for outline in (glyph.ink, glyph.silhouette)
        for array in ((outline.points, outline.starts) if outline is not None else (_NO, _NO))
    ]
    head = _HEAD.pack(glyph.clearance, len(region), *(array.size for array in arrays))
    kinds = ("<f8", "<i8") * 2
    numbers = (a.astype(kind).tobytes() for a, kind in zip(arrays, kinds, strict=True))
    return head + region + b"".join(numbers)


def unpacked(data: bytes) -> GlyphInk | None:
    """Region of a glyph out of bytes; None if they are none."""
    try:
        clearance, length, *sizes = _HEAD.unpack_from(data)
        begin = _HEAD.size + length
        region = shapely.from_wkb(data[_HEAD.size : begin])
        numbers = np.frombuffer(data[begin:], "<f8")
        if len(numbers) != sum(sizes):
            return None
        cuts = np.split(numbers, np.cumsum(sizes))
        ink, silhouette = _outline(*cuts[:2]), _outline(*cuts[2:4])
    except (ValueError, struct.error, GEOSException, ShapeError):
        return None
    return GlyphInk(region, ink, silhouette, clearance)


_NO = np.zeros(0)


def _outline(points: Any, starts: Any) -> Outline | None:
    if len(starts) == 0:
        return None
    return Outline(points.reshape(-1, 2).copy(), starts.view("<i8").copy())
