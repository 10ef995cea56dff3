"""DXF tags: pairs of a group code and a value.

Only what our own files hold is understood, with the standard library: a measure should
not lean on the program that wrote what is measured.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from packwork.arrays import FloatArray
from packwork.readers.svg_syntax.lengths import MAX_COORDINATE
from packwork.readers.unfit import UnfitError

APPLICATION = "PACKWORK"
"""Name under which our files say what a line belongs to."""

OPEN_LAYER = "container"
"""Where lines may be open: the walls of a container that has openings."""

MOST_LINES = 6_000_000
"""Of a file, two for each tag: one takes about 100 bytes. Larger: a gigabyte. Chosen."""

Tag: TypeAlias = tuple[int, str]

_CLOSED = 1
_FIRST_EXTENDED = 1_000


@dataclass(frozen=True, eq=False)
class DxfLine:
    """One polyline.

    Parameters
    ----------
    layer
        Its layer.
    points
        ``(n, 2)``, drawing units, y up.
    said
        What our files say of it: numbers and texts in order.
    is_closed
        Whether its end is its begin.
    """

    layer: str
    points: FloatArray
    said: tuple[str, ...]
    is_closed: bool = True


def tags_of(text: str) -> list[Tag]:
    r"""Pairs of a file in turn.

    Raises
    ------
    UnfitError
        If it is not DXF in text form, or too long.

    Examples
    --------
    >>> tags_of("0\nEOF\n")
    [(0, 'EOF')]
    """
    if text.count("\n") > MOST_LINES:
        raise UnfitError(f"has more than {MOST_LINES:,} lines; simplify it")
    lines = text.rstrip().split("\n")
    try:
        numbers = [int(number) for number in lines[0::2]]
    except ValueError:
        raise UnfitError("is not DXF in text form; save it as ASCII DXF") from None
    return list(zip(numbers, (value.strip() for value in lines[1::2]), strict=False))


def header_of(tags: Sequence[Tag]) -> dict[str, list[float]]:
    """Numbers of each variable of the header that has some.

    Examples
    --------
    >>> header_of([(9, "$INSUNITS"), (70, "4"), (9, "$LIMMAX"), (10, "20"), (20, "15")])
    {'$INSUNITS': [4.0], '$LIMMAX': [20.0, 15.0]}
    """
    found: dict[str, list[float]] = {}
    name = ""
    for code, value in tags:
        if code == 0 and value == "ENDSEC":
            break
        if code == 9:
            name = value
        elif name:
            number = _number(value)
            if math.isfinite(number):
                found.setdefault(name, []).append(number)
    return found


def lines_of(tags: Sequence[Tag]) -> list[DxfLine]:
    """Polylines of the drawing, in their order.

    Raises
    ------
    UnfitError
        If one is bent, has coordinates that are none, or is open and no wall of a container.

    Examples
    --------
    >>> corners = [(10, "0"), (20, "0"), (10, "2"), (20, "0"), (10, "2"), (20, "1")]
    >>> tags = [(2, "ENTITIES"), (0, "LWPOLYLINE"), (8, "cut"), (70, "1"), *corners, (0, "EOF")]
    >>> line, = lines_of(tags)
    >>> line.layer, line.points[2].tolist()
    ('cut', [2.0, 1.0])
    """
    return [_line(own) for kind, own in _entities(tags) if kind == "LWPOLYLINE"]


def _entities(tags: Sequence[Tag]) -> Iterator[tuple[str, list[Tag]]]:
    """Kind and tags of each entity of the section that holds what is drawn."""
    start = next((k for k, tag in enumerate(tags) if tag == (2, "ENTITIES")), len(tags))
    kind, own = "", list[Tag]()
    for code, value in tags[start + 1 :]:
        if code != 0:
            own.append((code, value))
            continue
        if kind:
            yield kind, own
        if value in {"ENDSEC", "EOF"}:
            return
        kind, own = value, []


def _line(tags: Sequence[Tag]) -> DxfLine:
    plain = [tag for tag in tags if tag[0] < _FIRST_EXTENDED]
    layer = next((value for code, value in plain if code == 8), "")
    flags = next((_number(value) for code, value in plain if code == 70), 0.0)
    x, y = ([_number(value) for code, value in plain if code == axis] for axis in (10, 20))
    is_bent = any(code == 42 and _number(value) != 0 for code, value in plain)
    is_closed = flags == flags and bool(int(flags) & _CLOSED)
    if is_bent or not (is_closed or layer == OPEN_LAYER):
        raise UnfitError(f"holds a line on layer {layer[:20]!r} that is open or bent")
    if len(x) != len(y) or len(x) < (3 if is_closed else 2) or not _is_sane([*x, *y]):
        raise UnfitError(f"holds a line on layer {layer[:20]!r} whose points are none")
    return DxfLine(layer, np.column_stack([x, y]), tuple(_said(tags)), is_closed)


def _said(tags: Sequence[Tag]) -> Iterator[str]:
    is_ours = False
    for code, value in tags:
        if code == _FIRST_EXTENDED + 1:
            is_ours = value == APPLICATION
        elif code >= _FIRST_EXTENDED and is_ours:
            yield value


def _number(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        return math.nan


def _is_sane(numbers: Sequence[float]) -> bool:
    return all(abs(number) <= MAX_COORDINATE for number in numbers)
