"""Which items of a run are held to one side of upright."""

from __future__ import annotations

import math

import numpy as np

from packwork.arrays import FloatArray
from packwork.pipeline.job import Job
from packwork.scene.item import PhotoArt
from packwork.scene.leaning import leanings


def job_leanings(job: Job) -> FloatArray | None:
    """``(n,)`` least tilts of photos that may turn within a limit, 0 of all others.

    None where nothing is held: icons balance by themselves, since no common angle makes them
    fit better.
    """
    plan = job.plan
    rotation = plan.rotation
    if not plan.leans or rotation.choices is not None:
        return None
    if rotation.is_still or rotation.limit is None or rotation.limit >= math.pi / 2:
        return None
    is_leaning = np.array(
        [
            isinstance(item.art, PhotoArt) and one.rotation is None and "angle" not in one.pin
            for item, one in zip(job.items, job.asked, strict=True)
        ]
    )
    found = np.zeros(len(job.items))
    found[is_leaning] = leanings(int(is_leaning.sum()), rotation.limit)
    return found
