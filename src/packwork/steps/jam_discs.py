"""Discs of given proportions, jammed: a road of its own past levels and finish."""

from __future__ import annotations

from dataclasses import replace
from typing import final

import numpy as np

from packwork.arrays import FloatArray
from packwork.compaction.options import HAIR
from packwork.geometry.bezier import FLATTENING
from packwork.pipeline.job import Job
from packwork.pipeline.plan.limits import check_padding, too_much_padding
from packwork.pipeline.state import RunContext, RunState, RunStep
from packwork.progress import Step, until_over
from packwork.scene.pose import Poses
from packwork.separation.discs import DiscSearch
from packwork.solve.solver import Ending
from packwork.steps.place import first_angles
from packwork.steps.starts import may_rearrange

ROUND = 0.99
"""Share of the disc about it that an item covers to be taken for one. Larger refuses drawn circles,
smaller leaves room round ovals. Chosen."""

FEWEST = 20
"""Discs at least: fewer are packed as tightly by the finish, which tries every contact. Tried."""

WORK = {"draft": 0.0, "normal": 1.2e7, "best": 2e8}
"""Steps of the descent times discs, by effort; some 1.5 s for each 2e7. More gains ever less, and
only where there are few thousands. Tried."""


def jams_discs(job: Job) -> bool:
    """Whether a job with shared sizes is many discs of which nothing else is asked."""
    plan = job.plan
    if len(job.items) < FEWEST or plan.method or plan.share or not may_rearrange(job):
        return False
    outlines = {item.outline for item in job.items}
    return all(one.area > ROUND * np.pi * one.radius**2 for one in outlines)


@final
class JamDiscs(RunStep):
    """Places and common scale of discs, exact."""

    share = 1.0

    def run(self, state: RunState, context: RunContext) -> RunState:
        """State in which no disc comes nearer than the gap to another or to the edge."""
        job, context = state.job, context.heard_by(state.recorder)
        plan, outline = job.plan, job.container.outline
        angles = first_angles(job, np.random.default_rng(plan.seed))
        check_padding(job.container, plan.gap, len(job.items))
        areas = np.array([item.outline.area for item in job.items])
        # What of an item an area of its weight has, about its origin and with its curves' bulge.
        unit = np.sqrt(job.weights / areas)
        radii = unit * [(1 + 4 * FLATTENING) * item.outline.radius for item in job.items]

        def poses(centres: FloatArray, scale: float) -> Poses:
            x, y = centres.T.copy()
            return Poses(x, y, angles, scale * unit)

        def tell(share: float, centres: FloatArray, scale: float) -> None:
            covered = float(job.weights.sum() * scale**2 / outline.area)
            context.observer.on_step(
                Step(
                    0, 1, 0, 0, share, poses(centres, scale), lambda: (covered, 0.0, 0.0),
                    is_finish=True, stage="finish",
                )
            )  # fmt: skip

        with job.clock.time("finish"):
            search = DiscSearch(
                outline, radii, plan.gap + 2 * HAIR * job.container.side, plan.seed,
                WORK[plan.effort], tell, until_over(context.stop, job.seconds_left(0.9)),
            )  # fmt: skip
            found = search.run()
        if not found.scale > 0:
            raise too_much_padding(
                job.container, plan.gap, len(job.items), "there is no room at all"
            )
        ending = Ending.STOPPED if context.stop() else Ending.DONE
        return replace(
            state, poses=poses(found.centres, found.scale), nominal=unit * found.scale,
            method="jamming", ending=ending,
        )  # fmt: skip
