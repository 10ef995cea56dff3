"""Emitters of a recipe as places on the canvas."""

from __future__ import annotations

import numpy as np
import shapely

from packwork.arrays import FloatArray
from packwork.errors import RecipeError
from packwork.geometry.outline import Outline
from packwork.pipeline.plan.forces import point_at
from packwork.readers.container import read_container
from packwork.readers.options import AS_DRAWN
from packwork.readers.svg.curve import read_curve
from packwork.recipe.piles import Emitter, PileOptions, parse_emitter
from packwork.scene.container import Container
from packwork.settle.pour import Source
from packwork.units import CanvasSize

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

    Raises
    ------
    ReadError
        If a curve or a region cannot be used.
    RecipeError
        If the emitter lies outside the room.
    """
    if asked.emit is None:
        return None
    emitter = parse_emitter(asked.emit)
    if emitter.side is not None:
        points, ranks = _edge(emitter, container, radius)
    else:
        points = _places(emitter, container)
        ranks = np.zeros(len(points), dtype=np.int64)
    inside = shapely.contains_xy(room.region, points[:, 0], points[:, 1])
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
    return np.asarray(points[shapely.contains_xy(region.region, points[:, 0], points[:, 1])])
