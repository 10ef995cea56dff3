"""Small scenes of known geometry, for every test that needs items in a container."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import fields

import numpy as np
import numpy.typing as npt
import shapely

from packwork.arrays import FloatArray
from packwork.geometry import affine
from packwork.geometry.outline import Outline
from packwork.scene.container import Container
from packwork.scene.item import FlatArt, Item
from packwork.scene.pose import Poses


def box(left: float, top: float, right: float, bottom: float) -> Outline:
    """Upright rectangle."""
    return Outline.from_region(shapely.box(left, top, right, bottom))


def square(half: float = 1.0) -> Outline:
    """Square about the origin, its half side given."""
    return box(-half, -half, half, half)


def disc(radius: float = 1.0, corners: int = 32) -> Outline:
    """Regular polygon about the origin, its corners on a circle."""
    turns = 2 * np.pi * np.arange(corners) / corners
    return Outline.from_rings([radius * np.column_stack([np.cos(turns), np.sin(turns)])])


def star(radius: float = 1.0, points: int = 5) -> Outline:
    """Star about the origin: it has a turn to it, and bays."""
    turns = np.pi * np.arange(2 * points) / points
    radii = radius * np.where(np.arange(2 * points) % 2, 0.45, 1.0)
    return Outline.from_rings([radii[:, None] * np.column_stack([np.cos(turns), np.sin(turns)])])


def square_container(side: float = 100.0, margin: float = 5.0) -> Container:
    """Square region on a square canvas, ``margin`` from its edges."""
    region = box(margin, margin, side - margin, side - margin)
    return Container("square", "square", region, side, side)


def round_container(side: float = 100.0) -> Container:
    """Disc on a square canvas, a twentieth from its edges."""
    place = affine.similarity(side / 2, side / 2, 0.0, 1.0)
    return Container("disc", "disc", disc(0.45 * side, 64).mapped(place), side, side)


def flat_item(name: str, outline: Outline) -> Item:
    """Item in one colour, its ink the outline itself."""
    return Item(name, name, outline, outline, FlatArt())


def poses(
    x: npt.ArrayLike,
    y: npt.ArrayLike,
    angle: npt.ArrayLike = 0.0,
    scale: npt.ArrayLike = 1.0,
    stretch: npt.ArrayLike = 1.0,
) -> Poses:
    """Poses of as many items as ``x`` has entries; single numbers hold for all."""
    given = (np.asarray(v, np.float64) for v in (x, y, angle, scale, stretch))
    columns = np.broadcast_arrays(*given)
    return Poses(*(column.copy() for column in columns))


def taken(all_poses: Poses, order: Sequence[int] | npt.NDArray[np.int64]) -> Poses:
    """The same poses in another order."""
    k = np.asarray(order)
    return Poses(*(getattr(all_poses, field.name)[k] for field in fields(Poses)))


def as_array(all_poses: Poses) -> FloatArray:
    """``(n, 5)``: x, y, angle, log scale and log stretch, as in a pose gradient."""
    logs = np.log(all_poses.scale), np.log(all_poses.stretch)
    return np.column_stack([all_poses.x, all_poses.y, all_poses.angle, *logs])


def from_array(numbers: FloatArray) -> Poses:
    """Inverse of :func:`as_array`."""
    x, y, angle, log_scale, log_stretch = numbers.T
    return Poses(x.copy(), y.copy(), angle.copy(), np.exp(log_scale), np.exp(log_stretch))


def placed(outlines: Sequence[Outline], all_poses: Poses) -> list[Outline]:
    """Outlines where the poses put them."""
    return [outline.mapped(all_poses.matrix(k)) for k, outline in enumerate(outlines)]


def overlap_area(outlines: Sequence[Outline]) -> float:
    """Sum over all pairs of the area they share."""
    regions = [outline.region for outline in outlines]
    return float(
        sum(a.intersection(b).area for k, a in enumerate(regions) for b in regions[k + 1 :])
    )


def share_inside(outline: Outline, container: Container) -> float:
    """How much of an outline lies in the container, 0..1."""
    return float(outline.region.intersection(container.outline.region).area / outline.area)
