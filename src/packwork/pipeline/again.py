"""A finish that is repeated where one size for all came out small."""

from __future__ import annotations

import numpy as np

from packwork.finish.finish import Finished
from packwork.pipeline.beginning import Beginning
from packwork.pipeline.finishing import finished
from packwork.pipeline.job import Job
from packwork.progress import Observer, Stop
from packwork.scene.pose import Poses

KEPT = 0.95
"""Common factor on the levels' sizes from which a finish went well. Where a few items had to
be taken apart by far, all come down to them, and there is room that nothing uses; so the
next finish, which begins without conflicts, gains most of it back. Larger repeats more
often for less. Tried on word clouds: 0.08 of a bird became 0.38."""

MOST = 4
"""Finishes in all: each takes as long as the first. Tried: without the trials of turns and
exchanges the later ones gain less than half as much."""

WORTHWHILE = 1.02
"""Factor in size that one has to gain for another to follow. Chosen."""


def finished_well(
    job: Job, start: Beginning, poses: Poses, observer: Observer | None, stop: Stop
) -> Finished:
    """Exact poses near the solver's; where sizes are shared, as large as a few finishes get."""
    best = finished(job, start, poses, observer, stop)
    recipe = job.recipe
    if recipe.sizes != "shared" or start.limits is not None:
        return best
    # A time that was asked for is used up by the first, and whoever is to stay does.
    if recipe.stay or recipe.time is not None:
        return best
    for _ in range(MOST - 1):
        if not best.clean or stop() or _factor(best.poses, poses) >= KEPT:
            break
        again = finished(job, start, best.poses, observer, stop)
        gain = _factor(again.poses, best.poses)
        if not again.clean or gain <= 1:
            break
        best = again
        if gain < WORTHWHILE:
            break
    return best


def _factor(now: Poses, before: Poses) -> float:
    """The common factor between two layouts' sizes."""
    return float(np.min(now.scale / before.scale))
