"""Items of one common scale made larger: a search that lets them overlap, then the exact finish."""

from __future__ import annotations

from dataclasses import replace
from typing import final

import numpy as np

from packwork.arrays import FloatArray, IntArray
from packwork.compaction.options import HAIR
from packwork.geometry.affine import similarity
from packwork.geometry.outline import Outline
from packwork.geometry.overlay import buffered, polygon_parts
from packwork.pipeline.state import RunContext, RunState, RunStep
from packwork.progress import until_over
from packwork.separation.container import ContainerSearch
from packwork.separation.shapes import Part, spare
from packwork.steps.finish import finished, gap_with_bulge

ROUNDS = 8
"""Searches that are followed by a finish. More gain ever less: decision 0045. Measured."""

PASSES = 10
"""Passes of a search at most: what overlaps then is left to the finish. Thrice as many gain in one
container of four, and take half as long again. Tried."""

LARGER, SMALLER = 1.005, 0.9975
"""Factors on the scale that the next search aims at, over that of the best layout, after a search
that left nothing overlapping, and after one that did. Tried."""

TIME_SHARE = 0.5
"""Share of the time left after which no round begins, where one was given. Chosen."""


@final
class Separate(RunStep):
    """Search for another arrangement with larger items, from one in which nothing overlaps.

    It never makes them smaller: what is not larger, or not clean, is forgotten.
    """

    share = 0.4

    def run(self, state: RunState, context: RunContext) -> RunState:
        """State with the largest items that were met."""
        job = state.job
        if state.conflicts or context.stop():
            return state
        with job.clock.time("separate"):
            return _searched(state, context)


def _searched(state: RunState, context: RunContext) -> RunState:
    job, first, gap = state.job, state.poses, _gap_of(state)
    room = buffered(job.container.outline.region, -gap / 2, join_style="mitre")
    if not polygon_parts(room):
        return state
    parts, order = _parts_of(state, gap)
    search = ContainerSearch(
        parts, room, _places(state)[order], seed=job.plan.seed, stop=context.stop
    )
    # Trials cost more than a round.
    settled = replace(state, job=job.replanned(effort="draft"), is_tight=True)
    is_over = until_over(context.stop, job.seconds_left(TIME_SHARE))
    best, aim = state, 1.0
    with search.pool:
        for number in range(ROUNDS):
            if is_over():
                break
            factor = aim * float(best.poses.scale[0] / first.scale[0])
            places = _places(best)
            places[order], loss = search.separated(places[order], factor, PASSES, fresh=number == 0)
            x, y, angle = places.T.copy()
            moved = replace(first, x=x, y=y, angle=angle, scale=first.scale * factor)
            part = context.part(number / ROUNDS, 1.0)
            found = finished(replace(settled, poses=moved, is_only_refined=loss == 0.0), part)
            aim *= LARGER if loss == 0.0 else SMALLER
            if not found.conflicts and found.poses.scale[0] > best.poses.scale[0]:
                best = found
    return replace(best, job=job, is_tight=state.is_tight, is_only_refined=state.is_only_refined)


def _places(state: RunState) -> FloatArray:
    poses = state.poses
    return np.column_stack([poses.x, poses.y, poses.angle])


def _gap_of(state: RunState) -> float:
    job = state.job
    return gap_with_bulge(job, np.arange(len(job.items)), state.poses.scale) + (
        HAIR * job.container.side
    )


def _parts_of(state: RunState, gap: float) -> tuple[list[Part], IntArray]:
    """Items as parts of the size that they have, alike ones as one, and the items in that order."""
    poses, rotation, outlines = state.poses, state.job.plan.rotation, state.job.solid_outlines
    alike: dict[tuple[Outline, float, float | None], list[int]] = {}
    for k, outline in enumerate(outlines):
        angle = float(poses.angle[k]) if rotation.is_still else None
        alike.setdefault((outline, float(poses.scale[k]), angle), []).append(k)
    parts = [
        Part(
            region=spare(outline.mapped(similarity(0.0, 0.0, 0.0, scale)).region, gap),
            count=len(items),
            turns=None if angle is None else (angle,),
            reach=rotation.farthest,
        )
        for (outline, scale, angle), items in alike.items()
    ]
    return parts, np.concatenate([np.array(items) for items in alike.values()])
