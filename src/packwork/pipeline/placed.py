"""What a run has while it goes along the road."""

from __future__ import annotations

from dataclasses import dataclass

from packwork.arrays import FloatArray, IntArray
from packwork.finish.finish import Finished
from packwork.pipeline.film.recorder import Recorder
from packwork.pipeline.job import Job
from packwork.pipeline.result import Filling
from packwork.pipeline.start import Beginning
from packwork.scene.pose import Poses
from packwork.solve.solver import Outcome


@dataclass(frozen=True, eq=False, kw_only=True)
class Placed:
    """Items in their places, stage by stage.

    Parameters
    ----------
    job
        Its items are those that were placed.
    start
        First poses, and what they have to keep.
    outcome
        Of the levels.
    exact
        Of the exact finish and of the filling of voids; None without one.
    filling
        How voids were filled; None if they were not.
    numbers
        What the items are called by in steps, where some of those in voids have left again.
    before
        The job without what was put into voids; None where nothing was.
    recorder
        Records the way of the items; None if that was not asked for.
    """

    job: Job
    start: Beginning
    outcome: Outcome
    exact: Finished | None = None
    filling: Filling | None = None
    numbers: IntArray | None = None
    before: Job | None = None
    recorder: Recorder | None = None

    @property
    def poses(self) -> Poses:
        """Where all items are now."""
        return self.outcome.poses if self.exact is None else self.exact.poses

    @property
    def asked_for(self) -> Job:
        """The job of those items that were asked for: without what was put into voids."""
        return self.before or self.job

    @property
    def largest(self) -> FloatArray:
        """``(n,)`` scales that no item may exceed."""
        limits, nominal, poses = self.start.limits, self.start.nominal, self.poses
        if limits is not None and len(limits.largest) == len(poses):
            return limits.largest
        if self.job.plan.sizes == "free" and len(nominal) == len(poses):
            return nominal * self.job.plan.size_ratio
        return poses.scale
