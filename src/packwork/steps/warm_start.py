"""Start from an earlier layout: its poses as near as what is asked now allows.

A run that is to stay near it (``--stay``) skips the levels, or runs them calmed and with a force
that holds items at home.
"""

from __future__ import annotations

from dataclasses import replace
from typing import final

import numpy as np

from packwork.arrays import FloatArray, IntArray
from packwork.errors import RecipeError
from packwork.forces.bonds import Home
from packwork.forces.forces import BondForce, Forces
from packwork.geometry.overlay import symmetric_difference
from packwork.pipeline.job import Job
from packwork.pipeline.plan.limits import held_to
from packwork.pipeline.registration import match_items, new_items
from packwork.pipeline.state import RunState
from packwork.recipe.presets import DEFAULT
from packwork.recipe.rules import Rotation
from packwork.scene.container import brought_over
from packwork.scene.layout import Layout
from packwork.scene.pose import Poses
from packwork.solve.options import SolveOptions
from packwork.solve.solver import scale_bounds
from packwork.start.angles_and_sizes import nearest_allowed
from packwork.start.first_poses import relocated
from packwork.steps.place import BURIED_SHARE, Setting, Start, allowed_angles, unburied

ROUGH_SHARE, ROUGH_ITEMS = 0.1, 0.1
"""Share of an item under others or outside, and share of the items of which so much is, from which
an earlier layout goes through the levels. Larger leave more to the finish, which moves items little
and shrinks them. Chosen."""

SAME = 1e-3
"""Share of the container's area by which another one may differ and count as the same. Larger
leaves more to the finish, which moves items little. Chosen."""

HOME_STRENGTH = 3.0
"""How strongly items are held near home where the container has changed. Larger keeps them
nearer and fills less. Tried."""

CALM = 0.2
"""Factor on the longest moves of such a run. Larger mixes items more, smaller may leave some
outside. Tried."""


@final
class FromLayout(Start):
    """Poses of an earlier layout, what lies buried moved into voids."""

    def __init__(self, earlier: Layout) -> None:
        self._earlier = earlier

    def find(self, setting: Setting) -> RunState:
        """Poses as near the earlier ones as the recipe, rules and pins allow."""
        job = setting.job
        poses = _poses_of(job, self._earlier, setting.nominal)

        def nearest(items: IntArray, rotation: Rotation) -> FloatArray:
            return nearest_allowed(poses.angle[items], rotation.limit, rotation.choices)

        angles = allowed_angles(job, nearest)
        limits, _ = setting.limits(angles)
        poses = held_to(limits, replace(poses, angle=angles))
        if job.plan.stays:
            new = new_items(job)
            poses = relocated(setting.region, setting.outlines, poses, new, setting.rng, limits)
            return replace(setting.placed(poses, "layout", limits), is_warm_start=True)
        poses, violation = unburied(setting, poses, limits)
        is_warm_start = float(np.mean(violation > BURIED_SHARE)) <= ROUGH_ITEMS
        is_tight = is_warm_start and _suffices(job, violation)
        return replace(
            setting.placed(poses, "layout", limits, is_tight=is_tight), is_warm_start=is_warm_start
        )


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


def with_homes(state: RunState) -> Forces:
    """The forces of a state, and one that holds each item near where it begins."""
    poses, forces = state.poses, state.forces
    homes = np.column_stack([poses.x, poses.y])
    homes[new_items(state.job)] = np.nan
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
    found = match_items(job, job.earlier)
    known = np.flatnonzero(found >= 0)
    before = brought_over(job.earlier.poses, job.earlier.container, job.container)
    return poses.with_some(known, before.subset(found[known]))


def calmed(options: SolveOptions) -> SolveOptions:
    """Options of a solve that moves items no farther than it has to: none is lifted into a void."""
    rates = {name: CALM * getattr(options, name) for name in ("position_rate", "turn_rate")}
    return options.model_copy(update={**rates, "relocating": False})


def _suffices(job: Job, violation: FloatArray) -> bool:
    """Whether an earlier layout is such that only the exact finish has to go on with it.

    So it is where hardly anything overlaps or sticks out, and nothing is asked of which the
    finish knows nothing.
    """
    plan = job.plan
    is_asked = (
        bool(plan.losses) or plan.keeps_apart or plan.preset is not DEFAULT or not plan.is_exact
    )
    is_rough = float(np.mean(violation > ROUGH_SHARE)) > ROUGH_ITEMS
    return not (is_asked or is_rough) and not job.forces.acts


def _poses_of(job: Job, earlier: Layout, nominal: FloatArray) -> Poses:
    """Poses of an earlier layout, sizes and stretches within the recipe's bounds.

    On a canvas of another size or unit their container's box is brought onto this one's.
    """
    plan = job.plan
    poses = brought_over(earlier.poses, earlier.container, job.container)
    if plan.stays:
        poses = _of_now(job, earlier, poses, nominal)
    elif len(poses) == len(nominal) and (found := match_items(job, earlier)).min() >= 0:
        poses = poses.subset(found)
    if len(poses) != len(nominal):
        raise RecipeError(
            "start",
            f"{job.recipe.start} has {len(poses)} items, this run {len(nominal)}; give as many",
        )
    if plan.sizes == "shared" and plan.stays:
        # What most have; one that is to be larger now makes not all others so.
        scale = nominal * np.median(poses.scale / nominal)
    elif plan.sizes == "shared":
        scale = nominal * np.sqrt(np.mean((poses.scale / nominal) ** 2))
    elif plan.sizes == "fixed":
        scale = nominal
    else:
        scale = np.clip(poses.scale, *scale_bounds(nominal, nominal, plan.solve_options()))
    stretch = np.clip(poses.stretch, 1 / plan.stretch, plan.stretch)
    return replace(poses, scale=np.asarray(scale), stretch=stretch)


def _of_now(job: Job, earlier: Layout, poses: Poses, nominal: FloatArray) -> Poses:
    """Poses of the items of now; those that are new lie in the middle, upright."""
    found = match_items(job, earlier)
    known = found >= 0
    if not known.any():
        raise RecipeError("start", f"{job.recipe.start} has none of these items; leave --stay out")
    middle = np.reshape(job.container.outline.bounds, (2, 2)).mean(axis=0)
    ratio = float(np.median(poses.scale[found[known]] / nominal[known]))
    x, y, angle = (np.full(len(found), value) for value in (*middle, 0.0))
    of_now = Poses(x, y, angle, nominal * ratio)
    return of_now.with_some(np.flatnonzero(known), poses.subset(found[known]))
