"""Nests of rectangles: best fit, of exact sums, so that rows fill a sheet to its edge."""

from __future__ import annotations

import math
import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from shapely.geometry import box

from packwork.geometry.polygon import Region
from packwork.geometry.rectangles import exact_boxes
from packwork.progress import Stop
from packwork.scene.item import FlatArt, Item
from packwork.scene.line_art import LineArt
from packwork.separation.best_fit import Placed, best_fit, is_too_much
from packwork.separation.push import pushed
from packwork.separation.windows import LaidSheet
from packwork.uses.nested import Sheet, SheetPart

_CURVES = re.compile("[CcSsQqTtAa]")
_SQUARE = 1e-9
"""Angle off a quarter of a turn, rad, up to which it is one."""


@dataclass(frozen=True)
class Tiling:
    """Sheets of a nest, parts without room by kind, the parts as straight ones.

    ``is_least``: whether they cannot lie on less.
    """

    sheets: tuple[LaidSheet, ...]
    missing: Counter[int]
    parts: tuple[SheetPart, ...]
    is_least: bool


def is_straight(item: Item) -> bool:
    """Whether an item is an upright rectangle drawn by straight lines alone.

    False for curves that only seem straight, and for a rectangle with holes, which not all file
    formats keep as drawn.

    Examples
    --------
    >>> is_straight(Item("tile", outline=[(0, 0), (4, 0), (4, 2), (0, 2)]))
    True
    """
    if exact_boxes([item.outline]) is None or len(item.ink.rings) > 1:
        return False
    if isinstance(item.art, LineArt):
        arcs = any(line.bulges.any() for line in item.art.cut)
        return not arcs and not _CURVES.search(item.art.path)
    return isinstance(item.art, FlatArt)


def tiling_of(
    parts: Sequence[SheetPart], sheets: Sequence[Sheet], gap: float, margin: float, seed: int,
    stop: Stop,
) -> Tiling | None:  # fmt: skip
    """Plain rectangles on plain sheets of one kind, or on a strip; None of others, or too many.

    ``gap``, ``margin``: distance of parts, and of parts to the edge, in the sheet's unit.
    """
    sheet = sheets[0]
    is_plain = len(sheets) == 1 and sheet.outline is None and sheet.held is None
    turns = [_right_angles(one.angles) for one in parts]
    if (
        not is_plain or sheet.is_square or not all(turns)
        or any(one.is_optional or one.together or one.priority for one in parts)
        or not all(is_straight(one.item) for one in parts)
    ):  # fmt: skip
        return None
    boxes = [[_turned(one, angle) for angle in found]
             for one, found in zip(parts, turns, strict=True)]  # fmt: skip
    # Each has the gap behind it and below it.
    sizes = [[(x1 - x0 + gap, y1 - y0 + gap) for x0, y0, x1, y1 in kind] for kind in boxes]
    most = math.inf if sheet.count is None else sheet.count
    room = sheet.length - 2.0 * margin + gap, sheet.height - 2.0 * margin + gap
    counts = [one.count for one in parts]
    if min(room) <= 0.0 or is_too_much(sizes, counts):
        return None
    found, is_least = best_fit(sizes, counts, room, most, seed, stop)
    laid = tuple(
        LaidSheet(
            k, tuple(one.kind for one in placed),
            np.array([
                (margin + one.x - boxes[one.kind][one.turn][0],
                 margin + one.y - boxes[one.kind][one.turn][1],
                 turns[one.kind][one.turn], 1.0)
                for one in placed
            ]),
        )
        for k, placed in enumerate(_together(on_it, sizes, room) for on_it in found.sheets)
    )  # fmt: skip
    straight = tuple(replace(one, item=replace(one.item, coarseness=0.0)) for one in parts)
    missing = Counter({kind: count for kind, count in enumerate(found.left) if count})
    return Tiling(laid, missing, straight, is_least)


def _together(
    placed: Sequence[Placed], sizes: Sequence[Sequence[tuple[float, float]]],
    room: tuple[float, float],
) -> list[Placed]:  # fmt: skip
    """Rectangles, pushed together."""
    boxes = list[Region]()
    for one in placed:
        w, h = sizes[one.kind][one.turn]
        boxes.append(box(one.x, one.y, one.x + w, one.y + h))
    length = min(room[0], max(one.bounds[2] for one in boxes))
    ways = pushed(boxes, box(0.0, 0.0, length, room[1]))
    return [replace(one, x=one.x + x, y=one.y + y)
            for one, (x, y) in zip(placed, ways.tolist(), strict=True)]  # fmt: skip


def _right_angles(angles: tuple[float, ...] | None) -> list[float]:
    """An upright angle and one across, of those allowed.

    >>> _right_angles((0.0, math.pi / 2, math.pi)), _right_angles((0.3,))
    ([0.0, 1.5707963267948966], [])
    """
    found: dict[int, float] = {}
    for angle in (0.0, math.pi / 2) if angles is None else angles:
        quarters = round(angle / (math.pi / 2))
        if abs(angle - quarters * math.pi / 2) < _SQUARE:
            found.setdefault(quarters % 2, angle)
    return list(found.values())


def _turned(part: SheetPart, angle: float) -> tuple[float, float, float, float]:
    """Box of a part about its own origin at a right angle, sheet units."""
    x0, y0, x1, y1 = part.item.outline.bounds
    cosine, sine = round(math.cos(angle)), round(math.sin(angle))
    x = [part.scale * (cosine * x - sine * y) for x, y in ((x0, y0), (x1, y1))]
    y = [part.scale * (sine * x + cosine * y) for x, y in ((x0, y0), (x1, y1))]
    return min(x), min(y), max(x), max(y)
