"""Steps of a tile: first places on the torus, and items brought into one cell at the end."""

from __future__ import annotations

from dataclasses import replace
from typing import final

import numpy as np

from packwork.errors import RecipeError
from packwork.fields.voids import Clearance
from packwork.geometry.lattice import Lattice
from packwork.pipeline.findings import Sentence
from packwork.pipeline.job import Job
from packwork.pipeline.state import RunContext, RunState, RunStep
from packwork.scene.pose import Poses
from packwork.start.first_poses import disc_radii, start_resolution
from packwork.start.places import elbow_room, place_discs
from packwork.steps.place import Setting, Start


def lattice_of(job: Job) -> Lattice:
    """Lattice by which a job's items repeat."""
    lattice = job.container.lattice
    if lattice is None:
        raise RecipeError("tile", "the container does not repeat")
    return lattice


MOST_OF_ALL, TIMES_NEXT = 0.1, 2.0
"""Share of what is drawn, and times the next in area, from which one item shows the repeat. Larger
pass a giant in wallpaper, smaller blame the largest of a dozen free sizes (.23; 1.4). By eye."""


@final
class TellRepeat(RunStep):
    """Advice on a tile whose largest item shows where it repeats."""

    def run(self, state: RunState, context: RunContext) -> RunState:
        """State with the advice."""
        layout, _ = state.measured
        if len(layout.items) < 2:
            return state
        order = np.argsort(-layout.areas, kind="stable")
        largest, following = layout.areas[order[:2]].tolist()
        share, times = largest / float(layout.areas.sum()), largest / following
        if share < MOST_OF_ALL or times < TIMES_NEXT:
            return state
        is_weighted = bool(np.ptp(layout.weights) > 0)
        return state.with_finding(
            Sentence.SHOWS_REPEAT,
            item=layout.items[order[0]].name,
            percent=100 * share,
            times=times,
            remedy="weights that differ less" if is_weighted else "more items",
        )


@final
class Strewn(Start):
    """Largest first, each where the items and their repeats leave most room.

    As the distance field of Wang and Lu 2025, section 3.4, on a torus.
    """

    def find(self, setting: Setting) -> RunState:
        """Poses of all items, which may overlap."""
        lattice, count = lattice_of(setting.job), len(setting.outlines)
        side = max(lattice.width, lattice.height)
        px_per_cu = start_resolution(count) / side
        margin = round(side * px_per_cu / 2)
        rows, columns = (round(v * px_per_cu) + 2 * margin for v in (lattice.height, lattice.width))
        room = Clearance(
            np.ones((rows, columns), dtype=bool), lattice.neighbours() * px_per_cu, margin
        )
        radii = disc_radii(setting.outlines, setting.scales) * elbow_room(count) * px_per_cu
        x, y = ((v - margin) / px_per_cu for v in place_discs(room, radii, setting.rng))
        limits, scales = setting.limits(setting.angles)
        poses = Poses(x, y, setting.angles, scales)
        return setting.placed(poses, "distance-field", limits)


@final
class IntoCell(RunStep):
    """Items brought into one cell: where they lie in the plane says nothing."""

    def run(self, state: RunState, context: RunContext) -> RunState:
        """State with the same layout on the torus."""
        poses = state.poses
        x, y = lattice_of(state.job).wrapped(np.column_stack([poses.x, poses.y])).T.copy()
        return replace(state, poses=replace(poses, x=x, y=y))
