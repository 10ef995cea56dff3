"""Similar items side by side: which item gets which place, by the vectors of ``--embeddings``.

A neighbour embedding whose repulsion is that two items cannot lie in one place
(:mod:`packwork.assignment.embedding`). Items take each other's places before the levels, which
then make room for their forms, draw like neighbours closer and unlike ones apart, and lift none
into a void elsewhere, as the finish exchanges none.
What is put one by one gets a point near which it had better lie.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import final

import numpy as np

from packwork.arrays import BoolArray, FloatArray, IntArray
from packwork.assignment.embedding import assigned
from packwork.assignment.graph import NeighbourGraph, likeness, unit_rows
from packwork.forces.bonds import SimilarityBond
from packwork.forces.forces import BondForce, Forces
from packwork.geometry.outline import Outline
from packwork.pipeline.job import Job
from packwork.pipeline.plan.vectors import ItemVectors
from packwork.pipeline.state import RunContext, RunState, RunStep
from packwork.scene.container import Container
from packwork.scene.pose import Poses
from packwork.start.first_fit.preferences import Homes
from packwork.start.first_poses import disc_radii
from packwork.steps.exchanges import even_points

FACTOR, KEPT_FACTOR = 1.6, 1.3
"""Factor between the radii of an item and of its new place that costs as much as lying a spacing
farther from all its neighbours: where sizes are free, and where they are not. Larger brings more
together and covers less. Tried."""

TIED = 2.5
"""How strongly neighbours are drawn together or apart in the levels. Larger parts clusters better
and covers less. Tried."""

UNLIKE = 0.77
"""Likeness below which neighbours are drawn apart. Larger only drives apart, smaller draws whole
clusters together: both leave more bare. Tried."""

MOST_TIED = 4_000
"""Items up to which each two are tied. More take memory by their square. Chosen."""


HOMEWARD = 8.0
"""Score that an item gives for lying the canvas' side nearer to its own point, where it is put by
itself. Larger brings more together and fills less. Tried."""


CENTRAL = 100.0
"""The same of what names those about it. Larger changes nothing. Chosen."""


def assign_by_embedding(
    job: Job, outlines: Sequence[Outline], poses: Poses, rng: np.random.Generator
) -> Poses:
    """First poses in which items have changed places; sizes and angles stay with the items."""
    if job.vectors is None:
        return poses
    radii = disc_radii(outlines, poses.scale)
    factor = FACTOR if job.plan.sizes == "free" else KEPT_FACTOR
    sizes = (np.log(radii) / np.log(factor))[:, None]
    points = np.column_stack([poses.x, poses.y])
    put = [one.is_put for one in job.asked]
    free: BoolArray = np.logical_not(np.array(put, dtype=bool))
    vectors = job.vectors.of(job.items)
    drawn, along = _anchored(job.vectors, vectors, points)
    at = assigned(
        vectors, points, rng, own=sizes, there=sizes, drawn=drawn, along=along, free=free,
        ties=_likeness(job),
    )  # fmt: skip
    at = _names_in_the_middle(job, points, at)
    return replace(poses, x=poses.x[at], y=poses.y[at])


def with_similarity_bond(job: Job, forces: Forces) -> Forces:
    """The forces, and one that draws like neighbours together in the levels, unlike ones apart."""
    like = _likeness(job)
    if like is None:
        return forces
    count = len(like)
    # Where all are about as like each other, none is to be drawn anywhere.
    ties = (like - max(UNLIKE, float(like.sum()) / (count * (count - 1)))) / UNLIKE
    known: BoolArray = np.asarray(like.any(axis=1))
    ties *= known[:, None] & known
    np.fill_diagonal(ties, 0.0)
    tied = BondForce(SimilarityBond(ties), np.full(count, TIED))
    return Forces(forces.fields, [*forces.bonds, tied], forces.kinds, forces.side)


def _likeness(job: Job) -> FloatArray | None:
    """``(n, n)`` how alike items are, 0 of each and itself; None where that is not asked."""
    if job.vectors is None or not 1 < len(job.items) <= MOST_TIED:
        return None
    rng = np.random.default_rng(job.plan.seed)
    vectors = job.vectors.of(job.items)
    like = likeness(NeighbourGraph.of(vectors, rng))
    known: BoolArray = np.asarray(vectors.any(axis=1))
    # What has no vector may lie anywhere.
    like *= known[:, None] & known
    np.fill_diagonal(like, 0.0)
    return like


def homes_alike(job: Job, region: Container, rng: np.random.Generator) -> Homes | None:
    """Homes of items that are put one by one; None if anywhere will do.

    Points spread evenly over the container.
    """
    if job.vectors is None:
        return None
    points = even_points(region, len(job.items), rng)
    vectors = job.vectors.of(job.items)
    drawn, along = _anchored(job.vectors, vectors, points)
    at = assigned(vectors, points, rng, drawn=drawn, along=along)
    at = _names_in_the_middle(job, points, at)
    is_central = np.array([one.is_central for one in job.asked], dtype=bool)
    return Homes(points[at], np.where(is_central, CENTRAL, HOMEWARD), is_central)


def _names_in_the_middle(job: Job, points: FloatArray, at: IntArray) -> IntArray:
    """Places after names of groups have changed theirs with the most central of their groups."""
    at, groups = at.copy(), None if job.vectors is None else job.vectors.groups_of(job.items)
    for k, one in enumerate(job.asked):
        if one.is_central and groups is not None:
            own = np.array([j for j, group in enumerate(groups) if group == groups[k]])
            own = own[[not job.asked[j].is_put for j in own]]
            away = points[at[own]] - points[at[own]].mean(axis=0)
            other = own[np.argmin(np.hypot(*away.T))]
            at[k], at[other] = at[other], at[k]
    return at


def _anchored(
    known: ItemVectors, vectors: FloatArray, points: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Pull on items along the way of each anchor, and how far along it points lie."""
    drawn, along = np.zeros((len(vectors), 0)), np.zeros((len(points), 0))
    units, about = unit_rows(vectors), points - points.mean(axis=0)
    for angle, vector in known.anchors:
        like = np.maximum(units @ unit_rows(vector[None])[0], 0.0)
        most = float(like.max(initial=0.0))
        turn = np.radians(angle or 0.0)
        far = -np.hypot(*about.T) if angle is None else about @ [np.cos(turn), np.sin(turn)]
        drawn = np.column_stack([drawn, like / most if most > 0 else like])
        along = np.column_stack([along, far])
    return drawn, along


@final
class AssignByEmbedding(RunStep):
    """Items change places so that what is alike lies together."""

    def run(self, state: RunState, context: RunContext) -> RunState:
        """State with places given out anew."""
        job = state.job
        with job.clock.time("start"):
            rng = np.random.default_rng(job.plan.seed)
            poses = assign_by_embedding(job, job.solid_outlines, state.poses, rng)
            return replace(state, poses=poses)
