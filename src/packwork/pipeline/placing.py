"""Which way of finding first places suits a run, and the places that it finds."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from packwork.arrays import FloatArray, IntArray
from packwork.errors import RecipeError
from packwork.finish.finish import COMMON_COARSE
from packwork.finish.options import HAIR
from packwork.forces.forces import PRESSURE, FieldForce, Forces
from packwork.geometry.outline import Outline
from packwork.pipeline.forcing import forces_of
from packwork.pipeline.job import Job
from packwork.pipeline.leaning import job_leanings
from packwork.pipeline.sharing import kinds_of
from packwork.progress import Stop, never, until_over
from packwork.scene.container import Container
from packwork.scene.leaning import turn_sides
from packwork.scene.limits import Limits
from packwork.start.angles import spread_angles
from packwork.start.first_fit.first_fit import first_fit
from packwork.start.first_poses import FirstPoses, first_poses

ATTEMPTS = {"draft": 1, "normal": 4, "best": 24}
"""Orders tried for each size, by effort. More find a little more, ever less so. Tried."""

ANGLES, ANY_ANGLES = 5, 8
"""Angles tried for an item that may turn within a limit, and for one that may turn any way."""

MOST_ITEMS = 1_500
"""Items at most that are put one after another unless asked: 100 upright icons take 0.7 s of
processor time, 400 take 5 s, 1,000 take 10 s, 1,500 take 14 s. Measured."""

MOST_TURNING = 150
"""The same of items that may turn any way, and are no words: 100 of them take 3 s, 400 take 40 s,
where the levels take 0.6 s and 2.5 s. Measured."""

TIME_SHARE = 0.3
"""Share of the time left that it may take, where one was given. Chosen."""


def first_places(
    job: Job,
    container: Container,
    outlines: Sequence[Outline],
    scales: FloatArray,
    angles: FloatArray,
    limits: Limits | None,
    rng: np.random.Generator,
    forces: Forces | None = None,
    stop: Stop = never,
) -> FirstPoses:
    """Poses by the method asked for, or else by the one that suits.

    Raises
    ------
    RecipeError
        If that method was asked for where it cannot be.
    """
    recipe = job.recipe
    asked = recipe.start == "first-fit"
    if asked and recipe.sizes != "shared":
        raise RecipeError(
            "start",
            f"first-fit seeks one size for all; use it with sizes shared, not {recipe.sizes}",
        )
    if asked or (recipe.start is None and _suits(job, forces)):
        is_over = until_over(stop, job.seconds_left(TIME_SHARE))
        poses = first_fit(
            container,
            outlines,
            scales,
            _angles(job, angles, limits),
            np.random.default_rng(recipe.seed),
            margin_cu=recipe.padding_cu(job.container) / 2 + HAIR * job.container.side,
            slack=COMMON_COARSE,
            attempts=ATTEMPTS[recipe.effort],
            limits=limits,
            fields=_fields(job),
            kinds=_kinds(job),
            stop=is_over,
        )
        if poses is not None:
            return FirstPoses(poses, "first-fit")
    return first_poses(container, outlines, scales, angles, recipe.start_options(), rng, limits)


def needs_levels(job: Job, forces: Forces | None) -> bool:
    """Whether something is asked that only the levels know."""
    recipe = job.recipe
    has_bonds = forces is not None and bool(forces.bonds)
    return (
        bool(recipe.levels or recipe.epochs or recipe.losses)
        or recipe.preset != "default"
        or recipe.finish != "exact"
        or recipe.stretch > 1.0
        or recipe.keeps_apart
        or has_bonds
    )


def _suits(job: Job, forces: Forces | None) -> bool:
    """Whether putting items one after another leaves less room than the levels would.

    So it does where all have one size, and of words. Photos by themselves fill more by the
    levels: three points.
    """
    recipe = job.recipe
    is_turning = recipe.rotation.limit is None and recipe.rotation.choices is None
    most = MOST_TURNING if is_turning and recipe.words is None else MOST_ITEMS
    return (
        recipe.sizes == "shared"
        and not needs_levels(job, forces)
        and (recipe.words is not None or recipe.photos is None)
        and len(job.items) <= most
    )


def _kinds(job: Job) -> IntArray | None:
    """Numbers of words, photos and items where they have shares; None if nothing is to be mixed."""
    if job.recipe.share is None:
        return None
    spoken = () if job.words is None else job.words.items
    return np.unique(kinds_of(job.items, spoken), return_inverse=True)[1].astype(np.int64)


def _fields(job: Job) -> Sequence[FieldForce]:
    """What draws items to places, with little of what draws all alike.

    That would only press them together. Nobody is pushed the other way, as in the levels: those
    drawn least would fill the far ends first, and leave the near ones to the smallest.
    """
    texts = job.recipe.force
    if not texts:
        return ()
    forces = forces_of(texts, job.items, job.weights, job.container)
    found = []
    for force in forces.fields:
        pull = force.strengths
        least = pull[np.argmin(np.abs(pull))]
        found.append(FieldForce(force.field, pull - (1 - PRESSURE) * least))
    return found


def _angles(job: Job, first: FloatArray, limits: Limits | None) -> list[FloatArray]:
    """For each item the angles to try; the first alone where it must be kept."""
    rng = np.random.default_rng(job.recipe.seed)
    leans = job_leanings(job)
    found = []
    for k, one in enumerate(job.asked):
        rotation = one.rotation or job.recipe.rotation
        is_given = limits is not None and bool(limits.held[k, 2])
        if is_given or rotation.is_still or rotation.choices is not None:
            found.append(first[k : k + 1])
        else:
            number = ANY_ANGLES if rotation.limit is None else ANGLES
            spread = spread_angles(number, rotation.limit, rng)
            if leans is not None and leans[k] and rotation.limit is not None:
                spread = np.clip(spread, *turn_sides(rotation.limit, np.full(number, leans[k])))
            found.append(spread)
    return found
