"""First poses: sizes and angles by the plan, places by the first start that finds any."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import final

import numpy as np

from packwork.arrays import FloatArray, IntArray
from packwork.geometry.simplify import hull_areas
from packwork.pipeline.job import Job
from packwork.pipeline.plan.limits import (
    check_padding,
    check_poses,
    given_scales,
    item_limits,
    job_leanings,
    padded,
    pinned_scales,
)
from packwork.pipeline.state import RunContext, RunState, RunStep
from packwork.progress import Stop
from packwork.recipe.rules import Rotation
from packwork.scene.pose import Limits, Poses
from packwork.solve.level import Level
from packwork.solve.outlines import simplify_for_level
from packwork.solve.relocate_trapped import violation_shares
from packwork.start.angles_and_sizes import (
    nominal_scales,
    shared_scales,
    start_angles,
    yielding_scales,
)
from packwork.start.first_poses import relocated

NOMINAL_COVERAGE = 0.82
"""With free sizes: area of all items' hulls at their nominal sizes over the container's.
Smaller lets the largest stand out more. Tried."""


class Setting:
    """Setting for first poses: room, sizes, angles, random numbers."""

    def __init__(self, state: RunState, stop: Stop) -> None:
        job = state.job
        self.state, self.job, self.stop, self.forces = state, job, stop, state.forces
        gap = job.plan.gap
        self.region = padded(job.container, gap) if gap else job.container
        self.outlines = job.solid_outlines
        self.rng = np.random.default_rng(job.plan.seed)
        self.share_out(job.weights)

    def share_out(self, weights: FloatArray) -> None:
        """Set nominal and first scales by ``(n,)`` weights, in the room that pinned items leave."""
        job, plan, outlines = self.job, self.job.plan, self.outlines
        pinned = pinned_scales(job)
        self.nominal, self.scales = nominal, scales = pinned.copy(), pinned.copy()
        free = np.flatnonzero(np.isnan(pinned))
        true = np.array([item.outline.area for item in job.items])
        room = self.region.outline.area - float(np.nansum(true * pinned**2))
        if room <= 0:
            k = int(np.nanargmax(true * pinned**2))
            raise (
                job.asked[k]
                .sources["pin.size"]
                .error(f"pins {job.items[k].name} so large that no room is left in the container")
            )
        if len(free) == 0:
            return
        total = plan.start_options().coverage * room
        seen = [outlines[k] for k in free]
        areas = np.array([outline.area for outline in seen])
        if plan.sizes == "fixed":
            given = given_scales(job.items, weights, job.container.unit, job.container.side)
            nominal[free] = scales[free] = given[free]
        elif plan.sizes == "shared":
            nominal[free] = scales[free] = shared_scales(true[free], areas, weights[free], total)
        else:
            hulls = hull_areas(seen)
            nominal[free] = nominal_scales(hulls, weights[free], NOMINAL_COVERAGE * room)
            scales[free] = yielding_scales(areas, hulls, nominal[free], plan.size_ratio, total)

    @cached_property
    def angles(self) -> FloatArray:
        """``(n,)`` first angles, as the recipe, rules and pins allow."""
        return first_angles(self.job, self.rng)

    def limits(self, angles: FloatArray) -> tuple[Limits, FloatArray]:
        """Limits of rules on single items, and first scales that keep them."""
        limits = Limits.free(len(angles))
        if self.job.is_limited:
            limits = item_limits(self.job, self.nominal, self.scales, angles)
        return limits, np.clip(self.scales, limits.smallest, limits.largest)

    def placed(
        self, poses: Poses, method: str, limits: Limits, *, is_tight: bool = False
    ) -> RunState:
        """State in which items have these first poses."""
        return replace(
            self.state, poses=poses, method=method, limits=limits, is_tight=is_tight,
            nominal=self.nominal,
        )  # fmt: skip


class Start(ABC):
    """One way of finding first poses."""

    @abstractmethod
    def find(self, setting: Setting) -> RunState | None:
        """State with first poses; None where this way does not suit."""


@final
@dataclass(frozen=True)
class Place(RunStep):
    """First poses by the first of several starts that finds any; the last one always does."""

    starts: Sequence[Start]

    def run(self, state: RunState, context: RunContext) -> RunState:
        """State with first poses of the outlines that the solver will see."""
        job = state.job
        with job.clock.time("start"):
            if job.plan.gap:
                check_padding(job.container, job.plan.gap, len(job.items))
            setting = Setting(state, context.stop)
            found = next(one for start in self.starts if (one := start.find(setting)))
            if job.is_limited:
                check_poses(job, setting.region, found.poses, found.limits)
            return found


def first_angles(job: Job, rng: np.random.Generator) -> FloatArray:
    """``(n,)`` first angles, as the recipe, rules and pins allow."""

    def random(items: IntArray, rotation: Rotation) -> FloatArray:
        return start_angles(len(items), rotation.limit, rotation.choices, rng)

    return allowed_angles(job, random)


def allowed_angles(job: Job, choose: Callable[[IntArray, Rotation], FloatArray]) -> FloatArray:
    """``(n,)`` angles of all items, those of some of them by ``choose`` within a rotation."""
    rotation = job.plan.rotation
    angles = choose(np.arange(len(job.items)), rotation).copy()
    leans = job_leanings(job) if job.plan.leans else np.zeros(len(angles))
    if leans.any():
        # As far beyond its least tilt as any other turn from upright, but to its own side.
        rest = np.abs(angles) * (1 - np.abs(leans) / rotation.farthest)
        angles = np.where(leans == 0, angles, leans + np.sign(leans) * rest)
    for k, one in enumerate(job.asked):
        if "rotate" in one.values and one.rotation:
            angles[k] = choose(np.array([k]), one.rotation)[0]
        if "angle_deg" in one.pin:
            angles[k] = np.radians(one.pin["angle_deg"])
    return angles


BURIED_PX = 200
"""Pixels on the longer side of the image on which buried items are found. Chosen."""

BURIED_SHARE = 0.5
"""Share of an item under others or outside from which it is moved before a run that did
not choose its own start. Smaller undoes more of that start. Chosen."""


def unburied(setting: Setting, poses: Poses, limits: Limits) -> tuple[Poses, FloatArray]:
    """Poses in which buried items have been moved into voids.

    Returns
    -------
    poses
        Of all items.
    violation
        ``(n,)`` share of each item that lay under others or outside before.
    """
    seen = simplify_for_level(setting.outlines, poses, BURIED_PX / setting.region.side)
    level = Level(setting.region, seen, BURIED_PX, limits=limits)
    violation = violation_shares(level, poses, level.density(poses))
    buried = np.flatnonzero(violation > BURIED_SHARE)
    if len(buried):
        poses = relocated(setting.region, setting.outlines, poses, buried, setting.rng, limits)
    return poses, violation
