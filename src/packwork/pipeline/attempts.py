"""What a run tries again: several starts, one item upright, fewer words.

Each of these is a choice among jobs that take the same road, which ``pipeline.run.along`` shows.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import count

import numpy as np

from packwork.finish.finished import Finished
from packwork.pipeline.exact import finished
from packwork.pipeline.job import Job
from packwork.pipeline.placed import Placed
from packwork.pipeline.watch import LEVELS, Watch
from packwork.progress import Stop
from packwork.recipe.rules import Rotation

AS_LARGE = 0.97
"""Area that an item has upright, as a share of what it has turned, from which it is left upright.
Larger turns it for a gain too small to be seen, smaller wastes room. Chosen."""

_STILL = Rotation(limit=0.0)


@dataclass(frozen=True, eq=False)
class Attempt:
    """One way along the road, to the exact finish.

    Parameters
    ----------
    job
        What is placed.
    watch
        What it tells and asks.
    is_spare
        Whether it may fail, for another attempt did not.
    """

    job: Job
    watch: Watch
    is_spare: bool = False

    def starts(self) -> Iterator[tuple[Watch, Job]]:
        """Jobs that differ in their starts alone, each with its part of the watch."""
        return self.watch.part(0.0, self._levels).turns(self.job.use.starts(self.job))

    @property
    def finishing(self) -> Watch:
        """Watch of the exact finish."""
        return self.watch.part(self._levels, 1.0)

    @property
    def _levels(self) -> float:
        """How far the attempt is when its levels are done."""
        return LEVELS if self.job.plan.is_exact else 1.0


class Attempts:
    """Attempts at a job, one after another, until one came out as asked.

    Parameters
    ----------
    job
        What is to be placed.
    watch
        What all attempts together tell and ask.
    """

    placed: Placed
    """The best so far of what came of them."""

    def __init__(self, job: Job, watch: Watch) -> None:
        self._job, self._watch = job.use.before(job, watch.stop), watch
        self._taken: list[Placed] = []

    def __iter__(self) -> Iterator[Attempt]:
        """Attempts; what was taken of one says whether there is another.

        Where items come out otherwise than they may be, as words whose letters are too small,
        fewer are placed anew.
        """
        job, stop = self._job, self._watch.stop
        for number in count(1):
            self._taken.clear()
            for turn, one in self._watch.turns((job, *upright_jobs(job))):
                yield Attempt(one, turn, is_spare=one is not job)
            self.placed = _as_good_upright(job, *self._taken)
            fewer = job if stop() else job.use.fewer(job, self.placed.poses, number)
            if fewer is job:
                return
            job = fewer

    def take(self, placed: Placed) -> None:
        """Take what came of an attempt."""
        self._taken.append(placed)


def upright_jobs(job: Job) -> Sequence[Job]:
    """The same job with its one item upright, which is tried besides; none if that is settled.

    Not where there are more items, or an angle, a force, an earlier layout or a time was asked for.
    """
    plan = job.plan
    if len(job.items) != 1 or plan.rotation.is_still or plan.rotation.choices:
        return ()
    asked = job.asked[0]
    is_told = "rotate" in asked.values or "angle" in asked.pin or plan.is_from_layout
    if is_told or plan.forces or plan.seconds is not None:
        return ()
    is_plain = plan.is_exact and not plan.voids.fills
    return (replace(job, plan=replace(plan, rotation=_STILL)),) if is_plain else ()


def _as_good_upright(job: Job, turned: Placed, *upright: Placed) -> Placed:
    """What was placed upright if it is clean and about as large as the turned one; else that."""
    for one in upright:
        if _is_as_good(one.exact, turned.exact):
            return replace(one, job=job, asked_for=job)
    return turned


def _is_as_good(upright: Finished, turned: Finished) -> bool:
    if len(upright.conflicts) > 0:
        return False
    sizes = float(upright.poses.scale[0] ** 2), float(turned.poses.scale[0] ** 2)
    return len(turned.conflicts) > 0 or sizes[0] >= AS_LARGE * sizes[1]


def most_promising(solved: Sequence[Placed], stop: Stop) -> Placed:
    """Of what levels made of several starts, that from which most comes to be covered."""
    if len(solved) == 1 or stop():
        return solved[0]
    with solved[0].job.clock.time("finish"):
        return max(solved, key=lambda one: _worth(one, stop))


def _worth(solved: Placed, stop: Stop) -> tuple[bool, float]:
    """Whether a finish without trials comes out clean, and the area that is covered then."""
    job = solved.job
    quick = replace(job, plan=replace(job.plan, effort="draft"))
    exact = finished(quick, solved.start, solved.poses, Watch(stop=stop))
    own = np.array([item.outline.area for item in job.items])
    return not exact.conflicts, float(own @ exact.poses.scale**2)
