"""One item by itself: it keeps its own pose where it comes out as large so as turned."""

from __future__ import annotations

from dataclasses import replace

from packwork.finish.finish import Finished
from packwork.pipeline.job import Job
from packwork.recipe.rules import Rotation

AS_LARGE = 0.97
"""Area that an item has upright, as a share of what it has turned, from which it is left upright.
Larger turns it for a gain too small to be seen, smaller wastes room. Chosen."""

_STILL = Rotation(limit=0.0)


def upright_job(job: Job) -> Job | None:
    """The same job with its one item upright; None where it is not alone or not free to turn.

    Not where an angle, a force, an earlier layout or a time was asked for.
    """
    plan = job.plan
    if len(job.items) != 1 or plan.rotation.is_still or plan.rotation.choices is not None:
        return None
    asked = job.asked[0]
    is_told = asked.rotation is not None or "angle" in asked.pin or bool(plan.forces)
    if (
        is_told
        or job.earlier is not None
        or plan.seconds is not None
        or not plan.is_exact
        or plan.voids is not None
    ):
        return None
    return replace(job, plan=replace(plan, rotation=_STILL))


def is_as_good(upright: Finished, turned: Finished) -> bool:
    """Whether the upright item is clean and about as large as the turned one."""
    if len(upright.conflicts) > 0:
        return False
    sizes = float(upright.poses.scale[0] ** 2), float(turned.poses.scale[0] ** 2)
    return len(turned.conflicts) > 0 or sizes[0] >= AS_LARGE * sizes[1]
