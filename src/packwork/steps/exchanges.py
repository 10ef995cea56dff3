"""Exchanges of places before the levels, for forces and for kinds apart, and what they share."""

from __future__ import annotations

from dataclasses import replace
from typing import final

import numpy as np

from packwork.arrays import FloatArray, IntArray
from packwork.assignment.orders import min_conflicts_order
from packwork.forces.exchanges import exchanged
from packwork.geometry.simplify import hull_areas
from packwork.pipeline.job import Job
from packwork.pipeline.state import RunContext, RunState, RunStep
from packwork.scene.container import Container
from packwork.scene.neighbours import neighbour_pairs
from packwork.scene.pose import Poses
from packwork.start.first_poses import container_image, disc_radii, start_resolution
from packwork.start.places import stippled


def even_points(region: Container, count: int, rng: np.random.Generator) -> FloatArray:
    """``(count, 2)`` points spread evenly over a container, canvas units."""
    inside, px_per_cu = container_image(region, start_resolution(count))
    found = stippled(inside, np.ones_like(inside), count, rng)
    return np.column_stack([found.x, found.y]) / px_per_cu


def shape_features(job: Job, movable: IntArray) -> FloatArray:
    """``(n, 2)`` logarithms of width over height, and of the share that fills the box."""
    found = []
    for k in movable:
        outline = job.items[k].outline
        left, top, right, bottom = outline.bounds
        wide, high = right - left, bottom - top
        found.append((np.log(wide / high), np.log(outline.area / (wide * high))))
    return np.array(found)


def with_places_of(job: Job, poses: Poses, places: IntArray, comers: IntArray) -> Poses:
    """Poses in which ``comers`` have the places, angles and sizes of hull of ``places``."""
    hulls = hull_areas([item.outline for item in job.items])
    x, y, angle, scale = (getattr(poses, name).copy() for name in ("x", "y", "angle", "scale"))
    x[comers], y[comers], angle[comers] = poses.x[places], poses.y[places], poses.angle[places]
    scale[comers] = poses.scale[places] * np.sqrt(hulls[places] / hulls[comers])
    return replace(poses, x=x, y=y, angle=angle, scale=scale)


ALIKE = 1.3
"""Factor in radius between two items that may change places to come apart from others of
their kind. Larger finds more partners and upsets the start more. Chosen."""

FORCED_ALIKE = 2.0
"""The same between two that may change places for a force's sake, before all others: what is too
large or too small there the levels still mend. Larger leaves them more to mend. Tried."""


@final
class ExchangeByForces(RunStep):
    """Items change places to where forces would have them."""

    def run(self, state: RunState, context: RunContext) -> RunState:
        """State with places given out anew."""
        outlines, poses = state.job.solid_outlines, state.poses
        with state.job.clock.time("start"):
            places = np.column_stack([poses.x, poses.y])
            areas = np.array([outline.area for outline in outlines]) * poses.scale**2
            sizes = np.log(disc_radii(outlines, poses.scale)) / np.log(FORCED_ALIKE)
            order = exchanged(state.forces, places, areas, sizes, state.limits.groups)
            return replace(state, poses=_with_order(poses, order))


@final
class KindsApart(RunStep):
    """Items of about one size change places, away from their kind."""

    def run(self, state: RunState, context: RunContext) -> RunState:
        """State with places given out anew."""
        poses, limits = state.poses, state.limits
        if not limits.keeps_kinds_apart:
            return state
        with state.job.clock.time("start"):
            radii = disc_radii(state.job.solid_outlines, poses.scale)
            sizes = np.log(radii) / np.log(ALIKE)
            pairs = neighbour_pairs(poses.x, poses.y)
            rng = np.random.default_rng(state.job.plan.seed)
            order = min_conflicts_order(limits.kinds, pairs, limits.groups, rng, sizes)
            return replace(state, poses=_with_order(poses, order))


def _with_order(poses: Poses, order: IntArray) -> Poses:
    """Poses in which items have come to the places of others."""
    x, y = poses.x.copy(), poses.y.copy()
    x[order], y[order] = poses.x, poses.y
    return replace(poses, x=x, y=y)
