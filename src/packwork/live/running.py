"""Runs that are shown on their way."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from packwork import threads
from packwork.arrays import IntArray
from packwork.pipeline import run
from packwork.pipeline.job import Job
from packwork.precompile import warm_up_once
from packwork.progress import Step, Stop, never
from packwork.scene.container import Container
from packwork.scene.item import Item
from packwork.scene.layout import Layout
from packwork.scene.pose import Poses

EPOCHS_BETWEEN = 3
"""Epochs between two moments that are shown. Fewer take time from the run, more jump. Chosen."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Moment:
    """View of a run on its way.

    Parameters
    ----------
    poses
        As many as items; None before they have a place.
    progress
        From 0 to 1.
    stage
        Which part of the run this is, as steps name it.
    """

    container: Container
    items: tuple[Item, ...]
    poses: Poses | None
    progress: float
    stage: str


Shown = Callable[[Moment], object]


def run_shown(job: Job, shown: Shown, stop: Stop = never) -> tuple[Layout, IntArray]:
    """Layout of a run, every moment of it shown, and which of its items are in it."""
    shown(_moment(job, None, 0.0, "read"))
    with threads.using(job.recipe.threads):
        warm_up_once()
        done = run(job, _Watcher(job, shown), stop)
    return done.layout, np.arange(len(job.items)) if done.kept is None else np.asarray(done.kept)


class _Watcher:
    """Shows moments of a run."""

    every = EPOCHS_BETWEEN

    def __init__(self, job: Job, shown: Shown) -> None:
        self._job, self._shown = job, shown

    def on_step(self, step: Step) -> None:
        """Show it, unless other items are there by now than were read."""
        count = len(self._job.items)
        poses = step.poses if step.ids is None and len(step.poses) == count else None
        if poses is not None:
            self._shown(_moment(self._job, poses, step.progress, step.stage))


def _moment(job: Job, poses: Poses | None, progress: float, stage: str) -> Moment:
    return Moment(
        container=job.container, items=job.items, poses=poses, progress=progress, stage=stage
    )
