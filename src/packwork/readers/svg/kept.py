"""Cache of drawings that were read before, by content, options and version of the code.

What is kept is numbers and text, never code: a header of JSON, then the arrays as they lie in
memory. It comes back bit for bit.
"""

from __future__ import annotations

import hashlib
import json
import logging
from collections.abc import Callable
from dataclasses import fields
from typing import Any

import numpy as np
import shapely

from packwork.errors import ShapeError
from packwork.folders import Store
from packwork.geometry.outline import Outline
from packwork.geometry.polygon import Region
from packwork.readers.pages import PageFate, Read
from packwork.readers.version import reader_version
from packwork.scene.item import Item, VectorArt

MOST_BYTES = 300_000_000
"""Size of all that is kept: about 10,000 icons of 30 kB. Chosen."""

NOT_KEPT = (b"\0", b"text", b"TEXT")
"""What drawings hold whose reading may differ elsewhere: letters are drawn by the fonts that are
installed. A zero is of encodings in which that could not be seen."""

STORE = Store("drawings", MOST_BYTES)

_LOG = logging.getLogger("packwork")


def read_once(
    data: bytes, how: tuple[Any, ...], name: str, source: str, read: Callable[[], Read]
) -> Read:
    """Result of ``read`` for a drawing, now or at an earlier time.

    Parameters
    ----------
    how
        All else that the reading depends on.
    """
    if any(mark in data for mark in NOT_KEPT):
        return read()
    key = f"{reader_version()} {how!r} {hashlib.sha256(data).hexdigest()}"
    kept = STORE.get(key)
    if kept is not None:
        found = unpacked(kept, name, source)
        if found is not None:
            return found
    with _Listening() as said:
        fresh = read()
    # What is said of a drawing is to be said each time.
    if not said.anything:
        bytes_ = packed(fresh)
        if bytes_ is not None:
            STORE.put(key, bytes_)
    return fresh


def followed_once(data: bytes, tolerance: float, follow: Callable[[bytes], Region]) -> Region:
    """Region that a drawing of ours paints, now or at an earlier time.

    Parameters
    ----------
    tolerance
        Largest distance of a curve from its chords, in the document's units.
    """
    if any(mark in data for mark in NOT_KEPT):
        return follow(data)
    key = f"{reader_version()} followed {tolerance!r} {hashlib.sha256(data).hexdigest()}"
    kept = STORE.get(key)
    if kept is not None:
        return shapely.from_wkb(kept)
    region = follow(data)
    STORE.put(key, shapely.to_wkb(region))
    return region


def packed(read: Read) -> bytes | None:
    """Bytes of a reading; None for one that is not only numbers and text.

    Examples
    --------
    >>> square = Outline.from_rings([np.array([[0, 0], [2, 0], [2, 2], [0, 2.0]])])
    >>> art = VectorArt("<path/>", np.eye(2, 3))
    >>> there = packed(Read(Item("a", "a.svg", square, square, art)))
    >>> back = unpacked(there, "b", "b.svg")
    >>> back.item.name, back.item.outline.area, back.item.art.markup
    ('b', 4.0, '<path/>')
    """
    item = read.item
    if not isinstance(item.art, VectorArt) or not _is_known(read):
        return None
    outlines = [item.outline] if item.ink is item.outline else [item.outline, item.ink]
    arrays = [array for outline in outlines for array in (outline.points, outline.starts)]
    header = {
        "fate": read.page.name,
        "traced": item.art.is_traced,
        "markup": item.art.markup,
        "lengths": [array.size for array in arrays],
    }
    parts = [item.art.matrix.astype("<f8"), *(a.astype(f"<{a.dtype.kind}8") for a in arrays)]
    first = json.dumps(header).encode("utf-8", "surrogatepass")
    return first + b"\n" + b"".join(part.tobytes() for part in parts)


def unpacked(data: bytes, name: str, source: str) -> Read | None:
    """Reading of bytes; None if they are none."""
    first, _, rest = data.partition(b"\n")
    try:
        header = json.loads(first)
        numbers = np.frombuffer(rest, "<f8")
        matrix, numbers = numbers[:6].reshape(2, 3).copy(), numbers[6:]
        cuts = np.split(numbers, np.cumsum(header["lengths"]))
        outlines = [
            Outline(points.reshape(-1, 2).copy(), starts.view("<i8").copy())
            for points, starts in zip(cuts[:-1:2], cuts[1:-1:2], strict=True)
        ]
        art = VectorArt(str(header["markup"]), matrix, bool(header["traced"]))
        item = Item(name, source, outlines[0], outlines[-1], art)
        fate = PageFate[header["fate"]]
    except (ValueError, KeyError, TypeError, IndexError, ShapeError):
        return None
    return Read(item, source, fate) if len(cuts[-1]) == 0 else None


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
        """Note a record."""
        self.anything = True

    def __enter__(self) -> _Listening:
        _LOG.addHandler(self)
        return self

    def __exit__(self, *_: object) -> None:
        _LOG.removeHandler(self)
