"""Caches of what was read before: on disk, by content, options and version of the code; in memory.

On the disk there are numbers and text, never code: a header of JSON, then arrays as they lie in
memory. They come back bit for bit.
"""

from __future__ import annotations

import functools
import hashlib
import json
import logging
import math
import sys
from collections import OrderedDict
from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields
from importlib.metadata import version
from pathlib import Path
from threading import Lock
from typing import Any, Concatenate, ParamSpec, Protocol, TypeVar

import numpy as np
import shapely
from shapely.errors import GEOSException

from packwork import folders
from packwork.errors import ShapeError
from packwork.geometry.outline import Outline
from packwork.geometry.polygon import Region
from packwork.readers.pages import PageFate, Read
from packwork.scene.item import Item, VectorArt

DRAWINGS = folders.Store("drawings", 300_000_000)
"""Readings of SVGs: about 10,000 icons of 30 kB."""

GLYPHS = folders.Store("glyphs", 50_000_000)
"""Regions of glyphs: about 5,000 letters of 10 kB."""

FOLDERS = ("readers", "geometry", "raster", "fields", "fit", "scene")
"""Parts of the package that say what a drawing or a letter is read as."""

NOT_KEPT = (b"\0", b"text", b"TEXT")
"""What drawings hold whose reading may differ elsewhere: letters are drawn by the fonts that are
installed. A zero is of encodings in which that could not be seen."""

_LOG = logging.getLogger("packwork")
_DAMAGED = (
    ValueError, KeyError, TypeError, IndexError, OverflowError, RecursionError, MemoryError,
    ShapeError, GEOSException,
)  # fmt: skip


@functools.cache
def reader_version() -> str:
    """One word for all code that reads drawings and letters."""
    # By what is installed: to import SciPy for its number takes longer.
    numbers = [version(name) for name in ("numpy", "scipy", "shapely", "resvg_py", "uharfbuzz")]
    whole = hashlib.sha256(repr((sys.version, shapely.geos_version, numbers)).encode())
    root = Path(folders.__file__).parent
    paths = [*root.glob("*.py"), *(p for f in FOLDERS for p in (root / f).rglob("*.py"))]
    for path in sorted(paths):
        whole.update(path.relative_to(root).as_posix().encode())
        whole.update(path.read_bytes())
    return whole.hexdigest()


def _packed(header: dict[str, Any], arrays: Sequence[np.ndarray[Any, Any]]) -> bytes:
    forms = [[array.dtype.str, array.shape] for array in arrays]
    first = json.dumps(header | {"arrays": forms}).encode("utf-8", "surrogatepass")
    return first + b"\n" + b"".join(array.tobytes() for array in arrays)


def _unpacked(data: bytes) -> tuple[dict[str, Any], list[np.ndarray[Any, Any]]]:
    """Header and arrays of packed bytes; of damaged ones one of the errors ``_DAMAGED``."""
    first, _, rest = data.partition(b"\n")
    header = json.loads(first)
    arrays, place = [], 0
    for form, shape in header["arrays"]:
        kind, count = np.dtype(form), math.prod(shape)
        if kind.kind not in "fiu" or min(shape) < 0:
            raise ValueError(form)
        arrays.append(np.frombuffer(rest, kind, count, place).reshape(shape).copy())
        place += count * kind.itemsize
    if place != len(rest):
        raise ValueError("too long")
    return header, arrays


def read_once(
    data: bytes, how: tuple[Any, ...], name: str, source: str, read: Callable[[], Read]
) -> Read:
    """Result of ``read`` for a drawing, now or earlier; ``how`` is all else that it depends on."""
    if any(mark in data for mark in NOT_KEPT):
        return read()
    key = f"{reader_version()} {how!r} {hashlib.sha256(data).hexdigest()}"
    kept = DRAWINGS.get(key)
    if kept is not None:
        found = unpacked_read(kept, name, source)
        if found is not None:
            return found
    with _Listening() as heard:
        fresh = read()
    # What is said of a drawing is to be said each time.
    if not heard.anything:
        content = packed_read(fresh)
        if content is not None:
            DRAWINGS.put(key, content)
    return fresh


def followed_once(data: bytes, tolerance: float, follow: Callable[[bytes], Region]) -> Region:
    """Region that a drawing of ours paints, now or at an earlier time.

    ``tolerance`` is the largest distance of a curve from its chords, in the document's units.
    """
    if any(mark in data for mark in NOT_KEPT):
        return follow(data)
    key = f"{reader_version()} followed {tolerance!r} {hashlib.sha256(data).hexdigest()}"
    kept = DRAWINGS.get(key)
    if kept is not None:
        return shapely.from_wkb(kept)
    region = follow(data)
    DRAWINGS.put(key, shapely.to_wkb(region))
    return region


def packed_read(read: Read) -> bytes | None:
    """Bytes of a reading; None for one that is not only numbers and text.

    >>> square = Outline.from_rings([np.array([[0, 0], [2, 0], [2, 2], [0, 2.0]])])
    >>> art = VectorArt("<path/>", np.eye(2, 3))
    >>> there = packed_read(Read(Item("a", "a.svg", square, square, art)))
    >>> back = unpacked_read(there, "b", "b.svg")
    >>> back.item.name, back.item.outline.area, back.item.art.markup
    ('b', 4.0, '<path/>')
    """
    item = read.item
    if not isinstance(item.art, VectorArt) or not _is_known(read):
        return None
    outlines = [item.outline] if item.ink is item.outline else [item.outline, item.ink]
    header = {
        "fate": read.page.name,
        "traced": item.art.is_traced,
        "markup": item.art.markup,
    }
    return _packed(header, [item.art.matrix, *_arrays_of(outlines)])


def unpacked_read(data: bytes, name: str, source: str) -> Read | None:
    """Reading of bytes; None if they are none."""
    try:
        header, (matrix, *arrays) = _unpacked(data)
        outlines = _outlines_of(arrays)
        art = VectorArt(str(header["markup"]), matrix.reshape(2, 3), bool(header["traced"]))
        item = Item(name, source, outlines[0], outlines[-1], art)
        return Read(item, source, PageFate[header["fate"]])
    except _DAMAGED:
        return None


def _arrays_of(outlines: Sequence[Outline]) -> list[np.ndarray[Any, Any]]:
    return [array for outline in outlines for array in (outline.points, outline.starts)]


def _outlines_of(arrays: Sequence[np.ndarray[Any, Any]]) -> list[Outline]:
    return [Outline(*pair) for pair in zip(arrays[::2], arrays[1::2], strict=True)]


def _is_known(read: Read) -> bool:
    """Whether a reading holds no more than what is kept of it."""
    item = read.item
    plain = Read(item, read.file, read.page)
    bare = Item(item.name, item.source, item.outline, item.ink, item.art)
    return all(
        getattr(whole, field.name) == getattr(part, field.name)
        for whole, part in ((read, plain), (item, bare))
        for field in fields(whole)
    )


class _Listening(logging.Handler):
    """Handler that notes if anything is logged while the block runs."""

    def __init__(self) -> None:
        super().__init__()
        self.anything = False

    def emit(self, record: logging.LogRecord) -> None:
        self.anything = True

    def __enter__(self) -> _Listening:
        _LOG.addHandler(self)
        return self

    def __exit__(self, *_: object) -> None:
        _LOG.removeHandler(self)


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
    """Result of ``draw`` for a glyph, now or earlier; ``what`` is all that it depends on."""
    key = f"{reader_version()} {what!r}"
    kept = GLYPHS.get(key)
    found = None if kept is None else unpacked_glyph(kept)
    if found is None:
        found = draw()
        GLYPHS.put(key, packed_glyph(found))
    return found


def packed_glyph(glyph: GlyphInk) -> bytes:
    """Bytes of what a glyph covers.

    >>> tile = Outline.box(0.0, 0.0, 2.0, 1.0)
    >>> back = unpacked_glyph(packed_glyph(GlyphInk(tile.region, tile, tile, 0.5)))
    >>> back.ink.area, back.region.area, back.clearance
    (2.0, 2.0, 0.5)
    """
    outlines = [one for one in (glyph.ink, glyph.silhouette) if one is not None]
    region = np.frombuffer(shapely.to_wkb(glyph.region), np.uint8)
    return _packed({"clearance": glyph.clearance}, [region, *_arrays_of(outlines)])


def unpacked_glyph(data: bytes) -> GlyphInk | None:
    """Region of a glyph out of bytes; None if they are none."""
    try:
        header, (region, *arrays) = _unpacked(data)
        ink, silhouette = _outlines_of(arrays) if arrays else (None, None)
        whole = shapely.from_wkb(region.tobytes())
        return GlyphInk(whole, ink, silhouette, float(header["clearance"]))
    except _DAMAGED:
        return None


class _Identified(Protocol):
    @property
    def identity(self) -> Any: ...


P = ParamSpec("P")
R = TypeVar("R")
T = TypeVar("T", bound=_Identified)


MOST_POINTS_KEPT = 4_000_000
"""Points of all results of one function that are remembered: 64 MB, ten times those of a thousand
words. Chosen."""


def cached_by_identity(
    most: int, points_of: Callable[[Any], int] = lambda _: 0
) -> Callable[[Callable[Concatenate[T, P], R]], Callable[Concatenate[T, P], R]]:
    """Keep the ``most`` results of a function of a typeface that were last asked for.

    Fewer where ``points_of`` them are more than ``MOST_POINTS_KEPT``: glyphs of strangers' fonts
    may have many.

    Typefaces of the same content are one. A typeface is opened anew for each run, so results that
    were kept by the object would never be found again, and would keep its file in memory.

    >>> from packwork.readers.fonts.face import Typeface, bundled_typeface
    >>> asked = []
    >>> @cached_by_identity(2)
    ... def count_of(face: Typeface, text: str) -> int:
    ...     asked.append(text)
    ...     return len(face.shaped(text).glyphs)
    >>> [count_of(bundled_typeface(), text) for text in ("bear", "fox", "bear", "owl", "fox")]
    [4, 3, 4, 3, 3]
    >>> asked
    ['bear', 'fox', 'owl', 'fox']
    """

    def caching(compute: Callable[Concatenate[T, P], R]) -> Callable[Concatenate[T, P], R]:
        known: OrderedDict[Any, R] = OrderedDict()
        lock, points = Lock(), 0

        @functools.wraps(compute)
        def cached(one: T, /, *args: P.args, **options: P.kwargs) -> R:
            nonlocal points
            key = (one.identity, args, *(sorted(options.items()) if options else ()))
            with lock:
                if key in known:
                    known.move_to_end(key)
                    return known[key]
            found = compute(one, *args, **options)
            with lock:
                # Another thread may have been as fast.
                if key not in known:
                    points += points_of(found)
                known[key] = found
                while len(known) > most or points > MOST_POINTS_KEPT:
                    points -= points_of(known.popitem(last=False)[1])
            return found

        return cached

    return caching
