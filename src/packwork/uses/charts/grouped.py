"""Common part of charts whose groups are filled one after another."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from packwork.arrays import FloatArray, IntArray
from packwork.pipeline.findings import Unplaced
from packwork.pipeline.job import Job
from packwork.progress import Observer, Step
from packwork.scene.container import Container
from packwork.scene.pose import Poses
from packwork.solve.solver import LevelReport


@dataclass(frozen=True, eq=False)
class Grouped:
    """All groups of a chart in their places, and the container of several parts that they fill."""

    poses: Poses
    kept: IntArray
    container: Container
    method: str
    unplaced: tuple[Unplaced, ...]
    levels: list[LevelReport] = field(default_factory=list)


class GroupSteps:
    """Passes steps of one group on, moved to its place, the groups before it beside it."""

    def __init__(
        self,
        observer: Observer,
        poses: Poses,
        before: IntArray,
        own: IntArray,
        offset: FloatArray,
    ) -> None:
        self._observer, self._poses, self._before = observer, poses, before
        self._own, self._offset = own, offset
        self.every = observer.every

    def on_step(self, step: Step) -> None:
        """Tell of all that are there."""
        own = self._own if step.ids is None else self._own[step.ids]
        there = np.concatenate([self._before, own])
        all_of_them = self._poses.with_some(own, moved(step.poses, self._offset))
        begun, share = len(self._before), len(self._own)
        progress = (begun + share * step.progress) / len(self._poses)
        self._observer.on_step(
            replace(step, poses=all_of_them.subset(there), ids=there, progress=progress)
        )


def moved(poses: Poses, offset: FloatArray) -> Poses:
    """Poses somewhere else.

    Examples
    --------
    >>> one = np.ones(1)
    >>> moved(Poses(one, one, one, one), np.array([2.0, 0.0])).x.tolist()
    [3.0]
    """
    return replace(poses, x=poses.x + offset[0], y=poses.y + offset[1])


def unit_scales(job: Job) -> FloatArray:
    """``(n,)`` scales at which areas of marks are their weights."""
    own = np.array([item.outline.area for item in job.items])
    return np.asarray(np.sqrt(job.weights / own))
