"""Exchanges of items between levels: away from their kind, among parts, down what forces ask."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import shapely

from packwork.arrays import FloatArray, IntArray
from packwork.assignment.orders import balanced_order, min_conflicts_order, parts_of
from packwork.forces.exchanges import exchanged
from packwork.forces.forces import NO_FORCES, Forces
from packwork.geometry.outline import Outline
from packwork.geometry.simplify import hull_areas
from packwork.scene.neighbours import side_by_side
from packwork.scene.pose import Limits, Poses

ALIKE = 1.3
"""Factor in the size of the hull, as a length, between items that change places among
parts. Larger finds more partners and upsets the layout more. Chosen."""


def exchange(
    container: Outline,
    outlines: Sequence[Outline],
    poses: Poses,
    limits: Limits,
    smallest: FloatArray,
    largest: FloatArray,
    rng: np.random.Generator,
    forces: Forces = NO_FORCES,
) -> tuple[Poses, list[int]]:
    """Poses in which items have changed places, and the indices of those that were moved.

    Among the parts of a container, where sizes may change, until all parts can fill alike; then
    down what forces ask for; then, where kinds matter, until few items lie beside their kind. An
    item takes the place and, within its bounds ``(n,)``, the size of hull of the one that lay
    there.
    """
    groups = limits.groups if limits.binds else np.zeros(len(poses), dtype=np.int64)
    hulls = hull_areas(outlines)
    moved: set[int] = set()

    def change(order: IntArray) -> Poses:
        changed, items = _changed_places(order, hulls, poses, smallest, largest)
        moved.update(items)
        return changed

    if shapely.get_num_geometries(container.region) > 1 and (smallest < largest).any():
        poses = change(_order_among_parts(container, outlines, poses, groups, rng))
    if forces.acts:
        poses = change(_order_by_forces(forces, outlines, poses, groups, smallest, largest))
    if limits.keeps_kinds_apart:
        poses = change(_order_apart(outlines, poses, limits.kinds, groups, rng))
    return poses, sorted(moved)


def _order_apart(
    outlines: Sequence[Outline],
    poses: Poses,
    kinds: IntArray,
    groups: IntArray,
    rng: np.random.Generator,
) -> IntArray:
    placed = [outline.mapped(poses.matrix(k)) for k, outline in enumerate(outlines)]
    return min_conflicts_order(kinds, side_by_side(placed), groups, rng)


def _order_by_forces(
    forces: Forces,
    outlines: Sequence[Outline],
    poses: Poses,
    groups: IntArray,
    smallest: FloatArray,
    largest: FloatArray,
) -> IntArray:
    areas = np.array([outline.area for outline in outlines]) * poses.scale**2
    places = np.column_stack([poses.x, poses.y])
    lengths = np.sqrt(hull_areas(outlines))
    sizes = np.log(lengths * poses.scale)
    # An item that may grow and shrink fits into places as far from its own as its bounds are.
    is_free = bool((smallest < largest).any())
    factor = np.log(max(float(np.median(largest / smallest)), ALIKE))
    kinds = forces.kinds if is_free else None
    return exchanged(forces, places, areas, sizes / factor, groups, kinds)


def _order_among_parts(
    container: Outline,
    outlines: Sequence[Outline],
    poses: Poses,
    groups: IntArray,
    rng: np.random.Generator,
) -> IntArray:
    """Order in which items fill as much of their hulls in one part as in the others."""
    hulls = hull_areas(outlines)
    solid = np.array([outline.area for outline in outlines]) / hulls
    sizes = np.log(np.sqrt(hulls) * poses.scale) / np.log(ALIKE)
    return balanced_order(solid, parts_of(container, poses.x, poses.y), groups, sizes, rng)


def _changed_places(
    order: IntArray, hulls: FloatArray, poses: Poses, smallest: FloatArray, largest: FloatArray
) -> tuple[Poses, list[int]]:
    """Poses with item ``order[p]`` in place p, and the indices of those that were moved."""
    moved = np.flatnonzero(order != np.arange(len(order)))
    comers = order[moved]
    x, y, scale = poses.x.copy(), poses.y.copy(), poses.scale.copy()
    x[comers], y[comers] = poses.x[moved], poses.y[moved]
    fitting = poses.scale[moved] * np.sqrt(hulls[moved] / hulls[comers])
    scale[comers] = np.clip(fitting, smallest[comers], largest[comers])
    return replace(poses, x=x, y=y, scale=scale), [int(k) for k in comers]
