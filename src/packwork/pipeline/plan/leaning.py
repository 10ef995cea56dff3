"""Items of a run that are held to one side of upright."""

from __future__ import annotations

import math

import numpy as np

from packwork.arrays import FloatArray
from packwork.pipeline.job import Job
from packwork.scene.item import PhotoArt
from packwork.scene.leaning import leanings


def job_leanings(job: Job) -> FloatArray:
    """``(n,)`` least tilts of photos that may turn within a limit, 0 of all others.

    Icons are not held: they balance by themselves, since no common angle makes them fit better.
    """
    rotation = job.plan.rotation
    found = np.zeros(len(job.items))
    is_narrow = rotation.farthest < math.pi / 2 and not rotation.choices
    if not (job.plan.leans and is_narrow) or rotation.is_still:
        return found
    is_leaning = np.array(
        [
            isinstance(item.art, PhotoArt) and one.rotation is None and "angle" not in one.pin
            for item, one in zip(job.items, job.asked, strict=True)
        ]
    )
    found[is_leaning] = leanings(int(is_leaning.sum()), rotation.farthest)
    return found
