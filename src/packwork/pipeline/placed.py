"""What a run has while it goes along the road."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from packwork.arrays import FloatArray, IntArray
from packwork.finish.finished import Finished
from packwork.pipeline.beginning import Beginning
from packwork.pipeline.film.recorder import Recorder
from packwork.pipeline.job import Job
from packwork.pipeline.result import Filling
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
        Of the exact finish and of the filling of voids; without them what the levels found.
    numbers
        ``(n,)`` what the items are called by in steps, where some of those in voids have left.
    asked_for
        The job of those items that were asked for: without what was put into voids.
    recorder
        Records the way of the items.
    filling
        How voids were filled; None if they were not.
    """

    job: Job
    start: Beginning
    outcome: Outcome
    exact: Finished
    numbers: IntArray
    asked_for: Job
    recorder: Recorder
    filling: Filling | None = None

    @classmethod
    def of(cls, start: Beginning, outcome: Outcome, recorder: Recorder) -> Placed:
        """What the levels found, before any exact finish."""
        job = start.job
        return cls(
            job=job,
            start=start,
            outcome=outcome,
            exact=Finished.as_is(outcome.poses),
            numbers=np.arange(len(job.items)),
            asked_for=job,
            recorder=recorder,
        )

    @property
    def poses(self) -> Poses:
        """Where all items are now."""
        return self.exact.poses

    @property
    def largest(self) -> FloatArray:
        """``(n,)`` scales that no item may exceed."""
        limits, nominal, poses = self.start.limits, self.start.nominal, self.poses
        if limits.binds and len(limits.largest) == len(poses):
            return limits.largest
        if self.job.plan.sizes == "free" and len(nominal) == len(poses):
            return nominal * self.job.plan.size_ratio
        return poses.scale
