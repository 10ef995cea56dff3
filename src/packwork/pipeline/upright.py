"""One item by itself: it keeps its own pose where it comes out as large so as turned."""

from __future__ import annotations

from dataclasses import replace

from packwork.finish.finish import Finished
from packwork.pipeline.job import Job

AS_LARGE = 0.97
"""Area that an item has upright, as a share of what it has turned, from which it is left upright.
Larger turns it for what nobody sees, smaller wastes room. Chosen."""


def upright_job(job: Job) -> Job | None:
    """The same job with its one item upright; None where it is not alone or not free to turn.

    Where someone chose an angle, a force, an earlier layout or the time, that holds.
    """
    recipe = job.recipe
    if len(job.items) != 1 or recipe.rotation.is_still or recipe.rotation.choices is not None:
        return None
    asked = job.asked[0]
    is_told = asked.rotation is not None or "angle" in asked.pin or recipe.force or job.earlier
    if is_told or recipe.time is not None or recipe.finish != "exact" or recipe.fills_gaps:
        return None
    return replace(job, recipe=recipe.model_copy(update={"rotate": "none"}))


def is_as_good(upright: Finished, turned: Finished) -> bool:
    """Whether the upright item is clean and about as large as the turned one."""
    if len(upright.offenders) > 0:
        return False
    sizes = float(upright.poses.scale[0] ** 2), float(turned.poses.scale[0] ** 2)
    return len(turned.offenders) > 0 or sizes[0] >= AS_LARGE * sizes[1]
