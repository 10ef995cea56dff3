"""Ten thin or branched containers: bundled shapes and icons, letters of thin strokes, a tree."""

from __future__ import annotations

import math
from collections.abc import Iterator

import shapely

from packwork.geometry import affine
from packwork.geometry.outline import Outline
from packwork.readers.builtin import builtin_item
from packwork.readers.container import read_container
from packwork.scene.container import Container

SIDE = 600.0
MARGIN = 0.03
"""Of the canvas, round each shape. Chosen."""

BUILT_IN = ("cat", "islands", "snake")
ICONS = ("anchor", "bicycle", "ribbon", "spiral", "sunburst")

STROKE = 0.09
"""Width of the letters' strokes over their height, as in light text faces. Chosen."""

LETTERS = (
    [(0, 1), (0.4, 0), (0.8, 1)], [(0.15, 0.65), (0.65, 0.65)],
    [(1.1, 0), (1.1, 1)], [(1.7, 0), (1.1, 0.6)], [(1.3, 0.42), (1.75, 1)],
    [(2.1, 0), (2.1, 1), (2.65, 1)], [(2.1, 0), (2.65, 0)], [(2.1, 0.48), (2.55, 0.48)],
)  # fmt: skip
"""Strokes of A, K and E, of height 1, y down."""

FORK, SHORTER, LIMBS = math.radians(27), 0.78, 5
"""A branch forks by that angle to both sides, into two of that share of its length, so often."""

TAPER = 0.76
"""Width of a branch over that of the one it grows from."""


def thin_shapes() -> list[Container]:
    """All ten; the canvas of those that are made here is 600."""
    icons = [container_of(name, builtin_item(name, "keep").outline) for name in ICONS]
    made = [container_of("light letters", letters()), container_of("branched tree", tree())]
    return [*map(read_container, BUILT_IN), *icons, *made]


def container_of(name: str, outline: Outline) -> Container:
    """An outline in the middle of a canvas of 600."""
    left, top, right, bottom = outline.bounds
    scale = SIDE * (1 - 2 * MARGIN) / max(right - left, bottom - top)
    at = [SIDE / 2 - scale * middle for middle in ((left + right) / 2, (top + bottom) / 2)]
    moved = outline.mapped(affine.similarity(at[0], at[1], 0.0, scale))
    return Container(name, "benchmark", moved, SIDE, SIDE)


def letters() -> Outline:
    """Three letters of strokes of one width."""
    strokes = [shapely.LineString(points).buffer(STROKE / 2) for points in LETTERS]
    return Outline.from_region(shapely.union_all(strokes))


def tree() -> Outline:
    """A trunk that forks again and again."""
    limbs = [
        shapely.LineString([start, end]).buffer(width / 2)
        for start, end, width in _limbs((0.0, 0.0), -math.pi / 2, 1.0, 0.22, LIMBS)
    ]
    return Outline.from_region(shapely.union_all(limbs))


_Point = tuple[float, float]


def _limbs(
    at: _Point, heading: float, length: float, width: float, more: int
) -> Iterator[tuple[_Point, _Point, float]]:
    end = (at[0] + length * math.cos(heading), at[1] + length * math.sin(heading))
    yield at, end, width
    if more > 1:
        for turn in (-FORK, FORK):
            yield from _limbs(end, heading + turn, length * SHORTER, width * TAPER, more - 1)
