"""Parts as the search sees them: edges, poles, and spans of pixel rows at each allowed turn."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt
import shapely

from packwork.compaction.kernels.outer_simplify import simplify_outward
from packwork.geometry.outline import Outline
from packwork.geometry.overlay import buffered, prepared
from packwork.geometry.polygon import Region
from packwork.separation.kernels.collision import POLES

Floats = npt.NDArray[np.float64]

MOST_CORNERS = 64
"""Outlines with more are simplified, outward, for the search."""

FINEST = 2e-5
"""Distance by which they grow at first, over the diameter; twice as far until there are few."""

COARSEST = 0.01
"""Most of that. Many rings never have few corners: ten dots would become one field. Tried."""

FREE_TURNS = 32
"""Angles at which a part that may lie at any is drawn; fewer propose worse places."""

POLE_CELLS = 100
"""Cells of the longer side of the grid on which poles are sought."""

DECAY_SHARE = 0.01
"""Depth below which the price of an overlap falls off slowly, over a part's diameter."""


@dataclass(frozen=True, kw_only=True)
class Part:
    """A region of fixed size, how many of it are wanted, and at which angles it may lie.

    It is turned about its own origin.
    """

    region: Region
    count: int = 1
    turns: tuple[float, ...] | None = (0.0,)
    """Allowed angles in radians, clockwise on screen; None: any within ``reach``."""

    reach: float = math.inf
    """Largest turn to either side where any is allowed; infinite for none."""

    mirrors: bool = False
    """Whether it may be mirrored, left to right, before it is turned."""

    priority: int = 0
    """On sheets, parts of a higher one are laid first."""

    is_optional: bool = False
    """Whether it only fills what all others leave of the sheets that they take."""

    together: str = ""
    """Name of the parts that lie on the same sheet as this one."""


class ShapeTable(NamedTuple):
    """Edges (ax, ay, bx, by) of all shapes and where each one's begin; poles (x, y, radius).

    ``poles``: ``(shapes, 3, POLES)``.
    """

    edges: Floats
    poles: Floats
    edge_at: npt.NDArray[np.int64]


class TurnTable(NamedTuple):
    """Rows cosine, sine, angle and side (-1: mirrored) of all turns, and spans of each.

    ``spans``: (row, from, to), in pixels; ``reach``: the largest turn of a shape that is free.
    """

    turns: Floats
    turn_at: npt.NDArray[np.int64]
    is_free: npt.NDArray[np.bool_]
    span_at: npt.NDArray[np.int64]
    spans: npt.NDArray[np.int64]
    reach: Floats


def spare(region: Region, gap: float) -> Region:
    """A region with few corners that holds all within half the gap of another one."""
    plain = region
    if shapely.get_num_coordinates(region) > MOST_CORNERS:
        x0, y0, x1, y1 = region.bounds
        size, rings = math.hypot(x1 - x0, y1 - y0), Outline.from_region(region).rings
        tolerance = FINEST * size
        while tolerance <= COARSEST * size:
            plainer = Outline.from_rings([simplify_outward(ring, tolerance) for ring in rings])
            if not plainer.region.is_valid or plainer.region.area < region.area:
                break
            plain, tolerance = plainer.region, 2.0 * tolerance
            if shapely.get_num_coordinates(plain) <= MOST_CORNERS:
                break
    return buffered(plain, gap / 2.0, join_style="mitre") if gap else plain


def boxes_of(part: Part) -> tuple[Floats, Floats]:
    """Angles that a part may have, ``(n,)``, and its box about its origin at each, ``(n, 4)``."""
    points = shapely.get_coordinates(part.region.convex_hull)
    turns = np.arange(0.0, math.pi, 0.01) if part.turns is None else np.array(part.turns)
    cosine, sine = np.cos(turns)[:, None], np.sin(turns)[:, None]
    x, y = cosine * points[:, 0] - sine * points[:, 1], sine * points[:, 0] + cosine * points[:, 1]
    return turns, np.column_stack([x.min(1), y.min(1), x.max(1), y.max(1)])


def flattest(parts: Sequence[Part], height: float) -> tuple[Floats, Floats]:
    """Boxes of parts about their own origins, and angles, at which they are least wide and fit."""
    boxes, angles = np.zeros((len(parts), 4)), np.zeros(len(parts))
    for k, part in enumerate(parts):
        turns, found = boxes_of(part)
        wide, tall = found[:, 2] - found[:, 0], found[:, 3] - found[:, 1]
        best = int(np.argmin(np.where(tall <= height, wide, np.inf)))
        boxes[k], angles[k] = found[best], turns[best]
    return boxes, angles


def placed(region: Region, pose: Floats) -> Region:
    """A region at a pose (x, y, angle, side)."""
    x, y, angle, side = pose
    cosine, sine = math.cos(angle), math.sin(angle)
    matrix = np.array([[side * cosine, -sine], [side * sine, cosine]])
    return shapely.transform(region, lambda points: points @ matrix.T + (x, y))


def rings_of(region: Region) -> list[Floats]:
    """All rings of a region, closed, ``(n, 2)`` each."""
    parts = shapely.get_parts(region)
    return [
        np.asarray(ring.coords)[:, :2]
        for part in parts
        for ring in (part.exterior, *part.interiors)
    ]


def edges_of(region: Region) -> Floats:
    """All edges of its rings as columns (ax, ay, bx, by)."""
    return np.vstack([np.hstack([ring[:-1], ring[1:]]) for ring in rings_of(region)]).T.copy()


@lru_cache(maxsize=4096)
def poles_of(region: Region) -> Floats:
    """Circles inside a region that do not overlap, each the largest that is left (greedily).

    Where no more have room, the last ones are points, at the centre of the first.
    """
    x0, y0, x1, y1 = region.bounds
    cell = max(x1 - x0, y1 - y0) / POLE_CELLS
    x, y = (one.ravel() for one in np.meshgrid(np.arange(x0 + cell / 2, x1, cell),
                                               np.arange(y0 + cell / 2, y1, cell)))  # fmt: skip
    inside = shapely.contains_xy(prepared(region), x, y)
    x, y = x[inside], y[inside]
    room = shapely.distance(region.boundary, shapely.points(x, y))
    poles: list[tuple[float, float, float]] = []
    while len(room) and len(poles) < POLES:
        k = int(np.argmax(room))
        radius = float(room[k])
        if radius < cell / 2:
            break
        poles.append((float(x[k]), float(y[k]), radius))
        room = np.minimum(room, np.hypot(x - x[k], y - y[k]) - radius)
    if not poles:
        # Thinner than a cell.
        inner = region.representative_point()
        poles.append((inner.x, inner.y, float(shapely.distance(region.boundary, inner))))
    poles += [(*poles[0][:2], 0.0)] * (POLES - len(poles))
    return np.array(poles).T.copy()


def spans_of(edges: Floats, pixel: float) -> npt.NDArray[np.int64]:
    """Pixels (row, from, before) that a shape covers on the middle lines of rows."""
    ax, ay, bx, by = edges
    rows = np.arange(math.ceil(edges[1].min() / pixel), math.floor(edges[1].max() / pixel) + 1)
    lines = (rows * pixel)[:, None]
    row, edge = np.nonzero((ay > lines) != (by > lines))
    if len(row) == 0:
        first = round(float(edges[0].min()) / pixel)
        end = max(round(float(edges[0].max()) / pixel), first + 1)
        return np.array([[0], [first], [end]], dtype=np.int64)
    y = lines[row, 0]
    cuts = ax[edge] + (y - ay[edge]) / (by[edge] - ay[edge]) * (bx[edge] - ax[edge])
    order = np.lexsort((cuts, row))
    ends = np.rint(cuts[order] / pixel).astype(np.int64)
    return np.vstack([rows[row[order][::2]], ends[::2], np.maximum(ends[1::2], ends[::2] + 1)])


@lru_cache(maxsize=16_384)
def _spans_at(
    region: Region, cosine: float, sine: float, side: float, pixel: float
) -> npt.NDArray[np.int64]:
    ax, ay, bx, by = edges_of(region)
    ax, bx = side * ax, side * bx
    return spans_of(
        np.vstack([cosine * ax - sine * ay, sine * ax + cosine * ay,
                   cosine * bx - sine * by, sine * bx + cosine * by]), pixel,
    )  # fmt: skip


def tables(parts: Sequence[Part], pixel: float) -> tuple[ShapeTable, TurnTable]:
    """All that the kernels read of parts, which never changes."""
    edges, poles = ([of(part.region) for part in parts] for of in (edges_of, poles_of))
    rows, spans = list[Floats](), list[npt.NDArray[np.int64]]()
    for part in parts:
        allowed = part.turns
        if allowed is None and math.isfinite(part.reach):
            many = max(math.ceil(part.reach / math.pi * FREE_TURNS), 2)
            allowed = tuple(np.linspace(-part.reach, part.reach, many))
        elif allowed is None:
            allowed = tuple(np.arange(FREE_TURNS) * (2 * math.pi / FREE_TURNS))
        found = np.array([[math.cos(turn), math.sin(turn), turn, 1.0] for turn in allowed]).T
        found[:2] = np.round(found[:2], 15)
        rows.append(np.hstack([found, found * [[1], [1], [1], [-1]]]) if part.mirrors else found)
        for c, s, _, side in rows[-1].T:
            spans.append(_spans_at(part.region, c, s, side, pixel))
    shapes = ShapeTable(np.hstack(edges), np.stack(poles), starts(edges))
    turns = TurnTable(
        np.hstack(rows), starts(rows),
        np.array([part.turns is None for part in parts]), starts(spans), np.hstack(spans),
        np.array([part.reach for part in parts]),
    )  # fmt: skip
    return shapes, turns


def starts(arrays: Sequence[npt.NDArray[Any]]) -> npt.NDArray[np.int64]:
    """Columns at which each of several arrays begins in all of them side by side, and the end."""
    return np.concatenate([[0], np.cumsum([one.shape[1] for one in arrays])]).astype(np.int64)
