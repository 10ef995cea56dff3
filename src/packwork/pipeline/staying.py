"""Runs that begin from an earlier layout and keep near it."""

from __future__ import annotations

import numpy as np

from packwork.forces.bonds import Home
from packwork.forces.forces import BondForce, Forces
from packwork.geometry.overlay import symmetric_difference
from packwork.pipeline.beginning import Beginning
from packwork.pipeline.earlier import new_items, who_is_who
from packwork.pipeline.job import Job
from packwork.scene.canvas import brought_over
from packwork.scene.pose import Poses
from packwork.solve.options import SolveOptions

SAME = 1e-3
"""Share of the container's area by which another one may differ and count as the same. Larger
leaves more to the finish, which moves items little. Chosen."""

HOME_STRENGTH = 3.0
"""How strongly items are held near home where the container has changed. Larger keeps them
nearer and fills less. Tried."""

CALM = 0.2
"""Factor on the longest moves of such a run. Larger mixes items more, smaller may leave some
outside. Tried."""


def needs_no_levels(job: Job) -> bool:
    """Whether the exact finish alone can bring an earlier layout to what is asked now."""
    if not job.plan.stays or job.earlier is None or len(new_items(job)):
        # What is new needs room that only the levels can make.
        return False
    before, now = job.earlier.container, job.container
    if before.canvas != now.canvas:
        return False
    changed = symmetric_difference(before.outline.region, now.outline.region).area
    return bool(changed < SAME * now.outline.area)


def with_homes(begun: Beginning) -> Forces:
    """The forces of a beginning, and one that holds each item near where it begins."""
    poses, forces = begun.poses, begun.forces
    homes = np.column_stack([poses.x, poses.y])
    homes[new_items(begun.job)] = np.nan
    held = BondForce(Home(homes), np.full(len(poses), HOME_STRENGTH))
    # Held by nothing but their homes, no two items have anything to exchange.
    kinds = forces.kinds if forces.acts else np.zeros(len(poses), dtype=np.int64)
    return Forces(forces.fields, [*forces.bonds, held], kinds, forces.side)


def as_it_was(job: Job, poses: Poses) -> Poses:
    """First poses, those of the earlier layout's items as they were in it: the start of a film.

    A run begins with sizes that fit what is asked for now.
    """
    if not job.plan.stays or job.earlier is None:
        return poses
    found = who_is_who(job, job.earlier)
    known = np.flatnonzero(found >= 0)
    before = brought_over(job.earlier.poses, job.earlier.container, job.container)
    return poses.with_some(known, before.some(found[known]))


def calmed(options: SolveOptions) -> SolveOptions:
    """Options of a solve that moves items no farther than it has to: none is lifted into a void."""
    rates = {name: CALM * getattr(options, name) for name in ("position_rate", "turn_rate")}
    return options.model_copy(update={**rates, "relocating": False})
