"""Exchanges of places before the levels: for forces, by likeness, in an order, kinds apart."""

from __future__ import annotations

from dataclasses import replace
from typing import final

import numpy as np

from packwork.arrays import IntArray
from packwork.assignment.conflicts import min_conflicts_order
from packwork.forces.exchanges import exchanged
from packwork.pipeline.state import RunState
from packwork.pipeline.step import RunStep
from packwork.pipeline.watch import RunContext
from packwork.scene.neighbours import neighbour_pairs
from packwork.scene.pose import Poses
from packwork.start.first_poses import disc_radii
from packwork.steps.alike import assign_by_embedding
from packwork.steps.arranging import assign_in_order

ALIKE = 1.3
"""Factor in radius between two items that may change places to come apart from others of
their kind. Larger finds more partners and upsets the start more. Chosen."""

FORCED_ALIKE = 2.0
"""The same between two that may change places for a force's sake, before all others: what is too
large or too small there the levels still mend. Larger leaves them more to mend. Tried."""


@final
class ExchangeByForces(RunStep):
    """Items change places to where forces would have them."""

    def run(self, state: RunState, watch: RunContext) -> RunState:
        """State with places given out anew."""
        outlines, poses = state.job.solid_outlines, state.poses
        with state.job.clock.time("start"):
            places = np.column_stack([poses.x, poses.y])
            areas = np.array([outline.area for outline in outlines]) * poses.scale**2
            sizes = np.log(disc_radii(outlines, poses.scale)) / np.log(FORCED_ALIKE)
            order = exchanged(state.forces, places, areas, sizes, state.limits.groups)
            return replace(state, poses=_moved(poses, order))


@final
class AssignByEmbedding(RunStep):
    """Items change places so that what is alike lies together."""

    def run(self, state: RunState, watch: RunContext) -> RunState:
        """State with places given out anew."""
        job = state.job
        with job.clock.time("start"):
            rng = np.random.default_rng(job.plan.seed)
            poses = assign_by_embedding(job, job.solid_outlines, state.poses, rng)
            return replace(state, poses=poses)


@final
class AssignInOrder(RunStep):
    """Items change places so that they lie in the order asked for."""

    def run(self, state: RunState, watch: RunContext) -> RunState:
        """State with places given out anew."""
        with state.job.clock.time("start"):
            return replace(state, poses=assign_in_order(state.job, state.poses, state.nominal))


@final
class KindsApart(RunStep):
    """Items of about one size change places, away from their kind."""

    def run(self, state: RunState, watch: RunContext) -> RunState:
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
            return replace(state, poses=_moved(poses, order))


def _moved(poses: Poses, order: IntArray) -> Poses:
    """Poses in which items have come to the places of others."""
    x, y = poses.x.copy(), poses.y.copy()
    x[order], y[order] = poses.x, poses.y
    return replace(poses, x=x, y=y)
