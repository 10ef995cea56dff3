"""Open containers, a side taken off or none at all, and the places that items come from."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import shapely

from packwork.arrays import FloatArray
from packwork.errors import RecipeError
from packwork.geometry.distance import snap_rounded
from packwork.geometry.outline import Outline
from packwork.geometry.overlay import buffered, difference, intersection, prepared, union
from packwork.geometry.polygon import Region, oriented_rings, polygon_parts
from packwork.pipeline.plan.forces import point_at
from packwork.readers.container import read_container
from packwork.readers.options import AS_DRAWN
from packwork.readers.svg.curve import read_curve
from packwork.recipe.piles import Emitter, PileOptions, Side, parse_emitter
from packwork.scene.container import Container
from packwork.scene.layout import sheet
from packwork.start.first_fit.pour import Source
from packwork.units import CanvasSize

LID = 0.1
"""Depth of the lid that is taken off, as a share of the container's height or width on that
side. Larger opens round containers wider, smaller leaves jars a narrow neck. Chosen by eye."""

WAYS: dict[Side, tuple[float, float]] = {
    "top": (0.0, -1.0), "bottom": (0.0, 1.0), "left": (-1.0, 0.0), "right": (1.0, 0.0),
}  # fmt: skip

LOOSE = 0.5
"""Share of the room above an opening that items take on their way in, each as the disc that
holds it. Larger may leave some without a first place, smaller is slower. Chosen."""

AROUND = 0.4
"""Share of a canvas without container that items cover, as the discs that hold them. Larger
leaves less paper about a pack, smaller more. Chosen by eye."""

HAIR = 1e-6
"""Width, as a share of the container, by which an opening is narrowed so that the walls beside
it stay. Chosen: nothing that is seen."""

SIDE_BY_SIDE = 2.2
"""Width of such a canvas at least, radii of its two largest items together: 2 hold them side by
side with nothing round them. Chosen."""


@dataclass(frozen=True, eq=False)
class Opened:
    """A container that items come into.

    Parameters
    ----------
    container
        With what lies beyond its openings, up to the canvas' edge.
    basin
        The same and more room beyond; None if it has no opening.
    """

    container: Container
    basin: Outline | None


def opened(
    container: Container, sides: Sequence[Side], mouths: FloatArray | None, discs_cu2: float
) -> Opened:
    """Container without its lids.

    Parameters
    ----------
    sides
        Whose lids to take off.
    mouths
        ``(m, 2, 2)`` ends of openings that are drawn; None for none.
    discs_cu2
        Area of all items as discs: how much room they need on their way in.

    Examples
    --------
    >>> tile = Outline.from_rings([np.array([[2.0, 5], [8, 5], [8, 10], [2, 10]])])
    >>> jar = opened(Container("", "", tile, 10.0, 10.0), ["top"], None, 6.0)
    >>> jar.container.outline.bounds, jar.basin.bounds[3]
    ((2.0, 0.0, 8.0, 10.0), 10.0)
    """
    region = container.outline.region
    gates: list[tuple[Region, FloatArray]] = []
    gates += [(_lid(region, side), np.array(WAYS[side])) for side in sides]
    for mouth in () if mouths is None else mouths:
        gates.append((shapely.LineString(mouth), _outward(region, mouth)))
    if not gates:
        return Opened(container, None)
    canvas = math.hypot(container.width, container.height)
    beyond = [region, *(_swept(gate, way * canvas) for gate, way in gates)]
    sheet = shapely.box(0, 0, container.width, container.height)
    whole = union([region, *(intersection(b, sheet) for b in beyond[1:])])
    needed = discs_cu2 / LOOSE / len(gates)
    far = [
        _swept(gate, way * (canvas + needed / max(_breadth(gate, way), 1e-9 * canvas)))
        for gate, way in gates
    ]
    outline = Outline.from_region(snap_rounded(_solid(whole)))
    inside = replace(container, outline=outline, walls=_walls(region, gates, beyond[1:]))
    return Opened(inside, Outline.from_region(snap_rounded(_solid(union([whole, *far])))))


def nowhere(size: CanvasSize | None, radii_cu: FloatArray) -> Container:
    """Sheet that stands for no container at all; items may lie anywhere on it.

    Parameters
    ----------
    size
        Of the sheet; None for one on which discs of radii ``(n,)`` lie in its middle.
    """
    width = math.sqrt(math.pi * float((radii_cu**2).sum()) / AROUND)
    width = max(
        width, 4 * float(radii_cu.max()), SIDE_BY_SIDE * float(np.sort(radii_cu)[-2:].sum())
    )
    if size is not None:
        width = size.width
    height = width if size is None or size.height is None else size.height
    return sheet("none", width, height, "px" if size is None else size.unit)


def _walls(
    region: Region, gates: Sequence[tuple[Region, FloatArray]], beyond: Sequence[Region]
) -> tuple[FloatArray, ...]:
    """Parts of a region's edge that remain once openings are taken out of it."""
    left, top, right, bottom = region.bounds
    hair = HAIR * max(right - left, bottom - top)
    # Narrowed, since walls along which an opening leads lie on its edge; a gate that is a line
    # lies there too, and is no wall.
    narrowed = buffered(union(list(beyond)), -hair, join_style="mitre")
    lines = [buffered(g, hair) for g, _ in gates if isinstance(g, shapely.LineString)]
    within = union([narrowed, *lines])
    edge = shapely.multilinestrings(
        [shapely.LineString(np.vstack([r, r[:1]])) for r in oriented_rings(region)]
    )
    kept = difference(edge, within)
    parts = shapely.get_parts(shapely.line_merge(kept))
    return tuple(shapely.get_coordinates(part) for part in parts if part.length > 4 * hair)


def _lid(region: Region, side: Side) -> Region:
    """The part of a region within the lid's depth of one side."""
    left, top, right, bottom = region.bounds
    deep, wide = LID * (bottom - top), LID * (right - left)
    boxes = {
        "top": (left, top, right, top + deep),
        "bottom": (left, bottom - deep, right, bottom),
        "left": (left, top, left + wide, bottom),
        "right": (right - wide, top, right, bottom),
    }
    return intersection(region, shapely.box(*boxes[side]))


def _outward(region: Region, mouth: FloatArray) -> FloatArray:
    """Unit normal of an opening that leads out of the region."""
    along = mouth[1] - mouth[0]
    normal = np.array([along[1], -along[0]]) / max(float(np.hypot(*along)), 1e-300)
    middle, length = mouth.mean(axis=0), float(np.hypot(*along))
    strips = [
        shapely.Polygon([mouth[0], mouth[1], mouth[1] + way, mouth[0] + way])
        for way in (LID * length * normal, -LID * length * normal)
    ]
    # The side on which less of the container lies.
    inner = [intersection(region, strip).area for strip in strips]
    if inner[0] == inner[1]:
        return (
            normal
            if (middle - shapely.get_coordinates(region.centroid)[0]) @ normal > 0
            else -normal
        )
    return normal if inner[0] < inner[1] else -normal


def _swept(gate: Region, way: FloatArray) -> Region:
    """All that a gate passes over on a straight way."""
    if isinstance(gate, shapely.LineString):
        lines = [shapely.get_coordinates(gate)]
    else:
        lines = [np.vstack([ring, ring[:1]]) for ring in oriented_rings(gate)]
    quads = []
    for line in lines:
        a, b = line[:-1], line[1:]
        corners = np.stack([a, b, b + way, a + way, a], axis=1)
        quads += [q for q in shapely.polygons(corners) if q.area > 0]
    return union([*polygon_parts(gate), *quads])


def _breadth(gate: Region, way: FloatArray) -> float:
    """Extent of a gate across a way."""
    across = shapely.get_coordinates(gate) @ np.array([-way[1], way[0]])
    return float(np.ptp(across))


def _solid(region: Region) -> Region:
    """The same without slits that rounding leaves between parts."""
    parts = polygon_parts(region)
    return union([shapely.Polygon(part.exterior, part.interiors) for part in parts])


PLACES = 400
"""Places along a line, or in a region, at most. More look no better. Chosen."""

OFF = 1.05
"""Distance of an edge's places from it, in radii of the largest item. Chosen."""


def source_of(
    asked: PileOptions, container: Container, room: Outline, radius: float
) -> Source | None:
    """Source of items; None if nothing is asked.

    Parameters
    ----------
    room
        In which they may lie.
    radius
        Of the largest item, canvas units.
    """
    if asked.emit is None:
        return None
    emitter = parse_emitter(asked.emit)
    if emitter.side is not None:
        points, ranks = _edge(emitter, container, radius)
    else:
        points = _places(emitter, container)
        ranks = np.zeros(len(points), dtype=np.int64)
    inside = shapely.contains_xy(prepared(room.region), points[:, 0], points[:, 1])
    if not inside.any():
        raise RecipeError(
            "emit",
            f"{asked.emit!r} lies outside the container; give a place inside it or its opening",
        )
    return Source(points[inside], ranks[inside], asked.release)


def _edge(emitter: Emitter, container: Container, radius: float) -> tuple[FloatArray, FloatArray]:
    """Places beyond an edge of the canvas, then on it, then within."""
    width, height = container.width, container.height
    share = (np.arange(PLACES) + 0.5) / PLACES
    is_flat = emitter.side in ("top", "bottom")
    along = share * (width if is_flat else height)
    edge = {"top": 0.0, "left": 0.0, "bottom": height, "right": width}[emitter.side or "top"]
    outward = -1.0 if emitter.side in ("top", "left") else 1.0
    offs = (OFF * radius, 0.0, -OFF * radius)
    across = np.repeat([edge + outward * off for off in offs], PLACES)
    along = np.tile(along, len(offs))
    points = np.column_stack([along, across] if is_flat else [across, along])
    return points, np.repeat(np.arange(len(offs)), PLACES)


def _places(emitter: Emitter, container: Container) -> FloatArray:
    if emitter.region is not None:
        size = CanvasSize(container.width, container.height, container.unit)
        return _within(read_container(emitter.region, size, reading=AS_DRAWN).outline)
    if emitter.file is not None:
        begins, ends = read_curve(emitter.file, container.width, container.height)
    else:
        points = np.array([point_at(pair, container, "emit") for pair in emitter.points])
        if len(points) == 1:
            return points
        begins, ends = points[:-1], points[1:]
    lengths = np.hypot(*(ends - begins).T)
    if lengths.sum() <= 0:
        raise RecipeError("emit", "the line has no length; give two points")
    at = (np.arange(PLACES) + 0.5) / PLACES * lengths.sum()
    piece = np.minimum(np.searchsorted(np.cumsum(lengths), at), len(lengths) - 1)
    since = at - (np.cumsum(lengths) - lengths)[piece]
    share = since / np.maximum(lengths[piece], 1e-300)
    return np.asarray(begins[piece] + share[:, None] * (ends - begins)[piece])


def _within(region: Outline) -> FloatArray:
    """Places on a grid within a region."""
    left, top, right, bottom = region.bounds
    step = np.sqrt(region.area / PLACES)
    x, y = np.meshgrid(
        np.arange(left + step / 2, right, step), np.arange(top + step / 2, bottom, step)
    )
    points = np.column_stack([x.ravel(), y.ravel()])
    return np.asarray(points[shapely.contains_xy(prepared(region.region), *points.T)])
