"""Tiles: a canvas without walls, which repeats without a seam, of what another use reads.

A tile is a choice of container and of steps: what would need walls or places its recipe refuses.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import final

from packwork.pipeline.job import Job, UseOf
from packwork.pipeline.state import RunStep
from packwork.steps.control import Replan
from packwork.steps.finish import Finish
from packwork.steps.levels import Levels
from packwork.steps.place import Place
from packwork.steps.repeat import IntoCell, Strewn, TellRepeat
from packwork.steps.track import StartRecording


@final
@dataclass(frozen=True, eq=False)
class TileUse(UseOf):
    """Items of another use, on a canvas that repeats."""

    def steps(self, job: Job) -> Sequence[RunStep]:
        """Places on the torus, levels, finish; the content measures and dresses."""
        steps: list[RunStep] = []
        if job.plan.sizes == "graded":
            # Sizes that give way in turn are found against walls.
            steps.append(Replan(sizes="shared"))
            job = job.replanned(sizes="shared")
        steps.append(Place([Strewn()]))
        if job.is_recorded:
            steps.append(StartRecording())
        steps.append(Levels())
        if job.plan.is_exact:
            steps.append(Finish())
        return [*steps, IntoCell(), *self.report(job)]

    def report(self, job: Job) -> Sequence[RunStep]:
        """As of the content; and whether one item shows the repeat."""
        return [*self.content.report(job), TellRepeat()]
