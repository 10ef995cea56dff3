"""Which way of finding first places suits a run, and the places that it finds."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from packwork.arrays import FloatArray, IntArray
from packwork.compaction.detail import FINE
from packwork.compaction.options import HAIR
from packwork.errors import RecipeError
from packwork.finish.finish import COMMON_COARSE
from packwork.forces.forces import PRESSURE, FieldForce, Forces
from packwork.geometry.outline import Outline
from packwork.pipeline.alike import homes_alike
from packwork.pipeline.arranging import homes_in_order
from packwork.pipeline.job import Job
from packwork.pipeline.plan.leaning import job_leanings
from packwork.pipeline.plan.shares import kinds_of
from packwork.progress import Stop, never, until_over
from packwork.scene.container import Container
from packwork.scene.leaning import turn_sides
from packwork.scene.limits import Limits
from packwork.scene.pose import Poses
from packwork.start.angles import spread_angles
from packwork.start.erosion import is_thread, scales_within, spread_along
from packwork.start.first_fit.first_fit import first_fit
from packwork.start.first_fit.homes import Homes
from packwork.start.first_poses import FirstPoses, disc_radii, first_poses, poses_apart

ATTEMPTS = {"draft": 1, "normal": 4, "best": 24}
"""Orders tried for each size, by effort. More find a little more, ever less so. Tried."""

ANGLES, ANY_ANGLES = 5, 8
"""Angles tried for an item that may turn within a limit, and for one that may turn any way."""

MOST_ANGLES = 8_000
"""Angles of all items together: of thousands each is tried at fewer. Larger takes longer, of 2,000
words at any angle 190 s in place of 60. Measured."""

SNUG = 0.9
"""Radius of the disc round an item in a thread over the one that fits there. Larger has no room
for the gap, smaller has farther to grow. Chosen."""

FEW = 50
"""Items up to which the finish is not shortened: it takes no time, and few have farther to grow.
Larger takes longer for nothing, smaller leaves room where items are few. Chosen."""

SPARE = 1.25
"""Room left for coarse covers of outlines, over their tolerance: they stand out by a little more.
Smaller begins with conflicts, larger wastes room. Chosen."""

TIME_SHARE = 0.3
"""Share of the time left that it may take, where one was given. Chosen."""


def first_places(
    job: Job,
    container: Container,
    outlines: Sequence[Outline],
    scales: FloatArray,
    angles: FloatArray,
    limits: Limits,
    rng: np.random.Generator,
    forces: Forces,
    stop: Stop = never,
) -> FirstPoses:
    """Poses by the method asked for, or else by the one that suits.

    Raises
    ------
    RecipeError
        If that method was asked for where it cannot be.
    """
    plan = job.plan
    asked = plan.method == "first-fit"
    if asked and plan.sizes != "shared":
        raise RecipeError(
            "start",
            f"first-fit seeks one size for all; use it with sizes shared, not {plan.sizes}",
        )
    if asked or (not plan.method and _suits(job, forces)):
        is_over = until_over(stop, job.seconds_left(TIME_SHARE))
        poses = first_fit(
            container,
            outlines,
            scales,
            _angles(job, angles, limits),
            np.random.default_rng(plan.seed),
            margin_cu=plan.gap / 2 + HAIR * job.container.side,
            slack=FINE if is_only_refined(job, forces) else SPARE * COMMON_COARSE,
            attempts=ATTEMPTS[plan.effort],
            limits=limits,
            fields=_fields(job),
            kinds=_kinds(job),
            homes=_homes(job, container, np.random.default_rng(plan.seed)),
            stop=is_over,
        )
        if poses is not None:
            return FirstPoses(poses, "first-fit")
        # Once a run is to stop, there is no time to take apart what others leave overlapping.
        apart = (
            None if limits.binds or not stop() else poses_apart(container, outlines, scales, angles)
        )
        if apart is not None:
            return FirstPoses(apart, "distance-field")
    return first_poses(container, outlines, scales, angles, plan.start_options(), rng, limits)


def places_along_thread(
    job: Job, container: Container, outlines: Sequence[Outline], nominal: FloatArray,
    angles: FloatArray, rng: np.random.Generator,
) -> tuple[Poses, FloatArray] | None:  # fmt: skip
    """Poses in a container that is a thread to its items, and their typical scales; else None.

    No image of the levels shows such a container, and items of usual sizes have no place in it.

    Parameters
    ----------
    nominal
        ``(n,)`` scales that weights ask for; the typical ones are in these proportions.
    """
    plan, forces = job.plan, job.forces
    is_told = plan.method or job.is_limited or forces.acts or needs_levels(job, forces)
    if is_told or plan.sizes == "fixed":
        return None
    if not is_thread(container.outline, disc_radii(outlines, nominal)):
        return None
    found = spread_along(container.outline, len(outlines), rng)
    if found is None:
        return None
    room = SNUG * found.radius - (plan.gap + HAIR * job.container.side) / 2
    scales, typical = scales_within(outlines, nominal, room, is_common=plan.sizes == "shared")
    return Poses(found.x, found.y, angles, scales), typical


def needs_levels(job: Job, forces: Forces) -> bool:
    """Whether something is asked that only the levels know."""
    plan = job.plan
    return (
        bool(plan.levels or plan.epochs or plan.losses)
        or not plan.is_default
        or not plan.is_exact
        or plan.stretch > 1.0
        or plan.keeps_apart
        or bool(forces.bonds)
        # Icons in an order are placed as well by the levels, and cover more.
        or (job.keeps_order and job.vectors is None and not job.use.words)
    )


def is_only_refined(job: Job, forces: Forces) -> bool:
    """Whether a few small steps of the finish do with what first fit has put down.

    So it is where many words keep their angles: those that turn, and icons, gain by as many larger
    ones.
    """
    is_told = forces.acts or job.is_limited or job.plan.effort == "best"
    are_words = len(job.use.words) == len(job.items) > FEW
    is_still = job.plan.rotation.is_still and are_words
    return job.plan.sizes == "shared" and is_still and not is_told


def _suits(job: Job, forces: Forces) -> bool:
    """Whether putting items one after another leaves less room than the levels would.

    So it does where all have one size.
    """
    return (
        job.plan.sizes == "shared"
        and not needs_levels(job, forces)
        and job.use.suits_first_fit(len(job.items), job.plan.rotation.is_free)
    )


def _homes(job: Job, container: Container, rng: np.random.Generator) -> Homes | None:
    """Points near which items had better lie; None if anywhere."""
    alike = homes_alike(job, container, rng)
    return homes_in_order(job, container, rng) if alike is None else alike


def _kinds(job: Job) -> IntArray | None:
    """Numbers of words, photos and items where they have shares; None if nothing is to be mixed."""
    if not job.plan.share:
        return None
    return np.unique(kinds_of(job.items, job.use.words), return_inverse=True)[1].astype(np.int64)


def _fields(job: Job) -> Sequence[FieldForce]:
    """What draws items to places, with little of what draws all alike.

    That would only press them together. No item is pushed the other way, as in the levels: those
    drawn least would fill the far ends first, and leave the near ones to the smallest.
    """
    found = []
    for force in job.forces.fields:
        pull = force.strengths
        least = pull[np.argmin(np.abs(pull))]
        found.append(FieldForce(force.field, pull - (1 - PRESSURE) * least))
    return found


def _angles(job: Job, first: FloatArray, limits: Limits) -> list[FloatArray]:
    """For each item the angles to try; the first alone where it must be kept."""
    rng = np.random.default_rng(job.plan.seed)
    leans = job_leanings(job)
    found = []
    for k, one in enumerate(job.asked):
        rotation = one.rotation or job.plan.rotation
        if limits.held[k, 2] or rotation.is_still or rotation.choices:
            found.append(first[k : k + 1])
        else:
            number = ANY_ANGLES if rotation.is_free else ANGLES
            number = max(1, min(number, MOST_ANGLES // len(job.asked)))
            spread = spread_angles(number, rotation.limit, rng)
            if leans[k]:
                sides = turn_sides(rotation.farthest, np.full(number, leans[k]))
                spread = np.clip(spread, *sides)
            found.append(spread)
    return found
