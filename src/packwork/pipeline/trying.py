"""Several starts, of which a run goes on with the one that promises most."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from packwork.forces.forces import Forces
from packwork.pipeline.beginning import Beginning
from packwork.pipeline.finishing import finished
from packwork.pipeline.job import Job
from packwork.progress import Observer, Step, Stop
from packwork.scene.pose import Poses

PHOTO_STARTS = ("distance-field", "medial-axis", "scatter")
"""Starts that are tried of photos. Each takes 0.7 s of 60; what a short finish makes of its
levels tells which ends best. Mean of seeds 0 to 5: fish 0.883, moon 0.922, heart 0.913 from the
first alone with seven trials, in 4.3 s of processor time; 0.891, 0.922, 0.916 from the best of
these with six, in 4.5 s. Measured."""


def jobs_tried(job: Job) -> list[Job]:
    """The job, or one for each start that is to be tried.

    Several only of photos by themselves whose sizes are free, where nobody chose a start, the
    time or a draft.
    """
    recipe = job.recipe
    is_open = recipe.start is None and recipe.time is None and recipe.effort != "draft"
    is_free = recipe.sizes == "free" and recipe.finish == "exact"
    if recipe.photos is None or recipe.words is not None or not (is_open and is_free):
        return [job]
    return [
        replace(job, recipe=recipe.model_copy(update={"start": start})) for start in PHOTO_STARTS
    ]


class Turn:
    """Passes steps of one start of several on, its progress a part of that of all.

    Parameters
    ----------
    observer
        Who listens.
    number, count
        Which of how many, from 0.

    Examples
    --------
    >>> from types import SimpleNamespace
    >>> Turn(SimpleNamespace(every=20), 1, 3).every
    20
    """

    def __init__(self, observer: Observer, number: int, count: int) -> None:
        self._observer, self._number, self._count = observer, number, count
        self.every = observer.every

    def on_step(self, step: Step) -> None:
        """Tell of it."""
        progress = (self._number + step.progress) / self._count
        self._observer.on_step(replace(step, progress=progress))


def worth(
    job: Job, start: Beginning, poses: Poses, stop: Stop, forces: Forces | None
) -> tuple[bool, float]:
    """Whether a finish without trials comes out clean, and the area that is covered then."""
    quick = replace(job, recipe=job.recipe.model_copy(update={"effort": "draft"}))
    exact = finished(quick, start, poses, None, stop, forces)
    own = np.array([item.outline.area for item in job.items])
    return not exact.offenders, float(own @ exact.poses.scale**2)
