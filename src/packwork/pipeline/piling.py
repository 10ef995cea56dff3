"""A run that heaps items of given sizes, under forces, in a container that may be open."""

from __future__ import annotations

import logging
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import shapely
from pydantic import ValidationError

from packwork.arrays import IntArray
from packwork.errors import RecipeError
from packwork.finish.options import FinishOptions
from packwork.finish.settling.pile import Piled, pile
from packwork.metrics.compactness import compactness
from packwork.piles import PileOptions
from packwork.pipeline.beginning import first_angles
from packwork.pipeline.emitting import source_of
from packwork.pipeline.finishing import gap_with_bulge, solid_outlines
from packwork.pipeline.forcing import forces_of
from packwork.pipeline.given import given_scales
from packwork.pipeline.job import NO_CONTAINER, Job
from packwork.pipeline.judging import Judged, judged
from packwork.pipeline.line_weights import evened
from packwork.pipeline.matching import matched
from packwork.pipeline.opening import Opened, opened
from packwork.pipeline.outcome import Run, Unplaced
from packwork.pipeline.pile_sizes import SMALLER, TRIES, fitting_factor, is_size_open
from packwork.progress import Observer, Stop
from packwork.recipe import Recipe, make_recipe
from packwork.refusals import refusal
from packwork.scene.canvas import brought_over
from packwork.scene.layout import Layout
from packwork.scene.pose import Poses
from packwork.solve.solver import Ending, Outcome
from packwork.start.angles import nearest_allowed

_LOG = logging.getLogger(__name__)

DEFAULT_FORCE, DEFAULT_FORCE_ALONE = "down", "towards centre"
"""What heaps items in a container, and where there is none."""

SHUFFLE, SHUFFLE_ALONE = 0.6, 0.15
"""Logarithm of size within which items come in random order, in a container and without one.
Larger leaves more gaps, and below 0.82 of the circle in a round pack; smaller puts copies of
one thing side by side. Tried, the first by eye."""

AT_EDGE = 1e-3
"""Distance from the canvas' edge, as a share of its longer side, below which an item counts
as held by it. Chosen."""


def pile_recipe(container: str, items: Sequence[str], **options: Any) -> Recipe:
    """Recipe that heaps items, from the options of ``pile`` and of all runs alike.

    Raises
    ------
    RecipeError
        Naming the option, what was met and what would do.

    Examples
    --------
    >>> recipe = pile_recipe("square", ["star"], count=9, open="top")
    >>> recipe.force, recipe.sizes, recipe.pile.open
    (('down',), 'fixed', ('top',))
    """
    own = {key: options.pop(key) for key in list(options) if key in PileOptions.model_fields}
    try:
        asked = PileOptions.model_validate(_given(own))
    except ValidationError as error:
        raise refusal(error, PileOptions) from error
    if options.get("sizes", "fixed") != "fixed":
        raise RecipeError("sizes", "items of a pile keep their sizes; give --size")
    plain = {**_given(options), "sizes": "fixed", "pile": asked}
    default = DEFAULT_FORCE_ALONE if container == NO_CONTAINER else DEFAULT_FORCE
    plain["force"] = plain.get("force") or (default,)
    if container == NO_CONTAINER and asked.open:
        raise RecipeError("open", "there is no container to open; leave it out")
    return make_recipe(container=container, items=list(items), **plain)


def _given(options: Mapping[str, Any]) -> dict[str, Any]:
    return {key: value for key, value in options.items() if value is not None}


def run_pile(job: Job, asked: PileOptions, observer: Observer | None, stop: Stop) -> Run:
    """Heap and measure what was read."""
    _check(job)
    if not is_size_open(job):
        return _judged(asked, *_heaped(job, asked, 1.0, observer, stop))
    factor = fitting_factor(job)
    for _ in range(TRIES):
        done, heap, room = _heaped(job, asked, factor, observer, stop)
        if len(heap.placed) == len(job.items) or stop():
            break
        factor *= SMALLER
    return _judged(asked, done, heap, room)


def _heaped(
    job: Job, asked: PileOptions, factor: float, observer: Observer | None, stop: Stop
) -> tuple[Job, Piled, Opened]:
    """The heap of items whose sizes are multiplied by a factor, and the job in its container."""
    clock = job.clock
    with clock.time("start"):
        poses, known = _first_poses(job, factor)
        # Sizes are known: what lies closer with thinner lines may do so.
        job = evened(job, poses, tells=False)
        outlines = solid_outlines(job.recipe, job.items)
        discs = np.pi * (np.array([o.radius for o in outlines]) * poses.scale) ** 2
        room = opened(job.container, asked.open, job.mouths, float(discs.sum()))
        job = replace(job, container=room.container)
        largest = float((np.array([o.radius for o in outlines]) * poses.scale).max())
        basin = room.basin or room.container.outline
        source = source_of(asked, room.container, basin, largest)
        forces = forces_of(job.recipe.force or (), job.items, job.weights, room.container)
    with clock.time("finish"):
        options = _options(job, poses)
        is_alone = room.container.name == NO_CONTAINER
        heap = pile(
            room.container, outlines, poses, forces, options, room.basin, observer, stop,
            known=known if len(known) else None,
            source=source,
            shuffle=SHUFFLE_ALONE if is_alone else SHUFFLE,
            is_round=is_alone,
        )  # fmt: skip
    return job, heap, room


def _check(job: Job) -> None:
    """Refuse what a heap cannot do."""
    recipe = job.recipe
    if recipe.sizes != "fixed":
        raise RecipeError(
            "sizes", f"items of a pile keep their sizes; use fixed, not {recipe.sizes}"
        )
    for one in job.asked:
        one.refuse(("pin", "region", "scale"), "a pile")
    if recipe.fills_gaps or recipe.finish == "none":
        raise RecipeError("pile", "is settled in exact geometry, and its voids stay as they are")


def _first_poses(job: Job, factor: float) -> tuple[Poses, IntArray]:
    """Poses to begin with, and which items an earlier layout has places for.

    Parameters
    ----------
    factor
        On the sizes that items are given.
    """
    rng = np.random.default_rng(job.recipe.seed)
    container = job.container
    own = given_scales(job.recipe, job.items, job.weights, container.unit, container.side)
    scales = factor * own
    middle = np.array(container.outline.bounds).reshape(2, 2).mean(axis=0)
    x, y = np.tile(middle, (len(scales), 1)).T
    poses = Poses(x, y, first_angles(job, rng, None), scales)
    if job.earlier is None:
        return poses, np.arange(0)
    then = brought_over(job.earlier.poses, job.earlier.container, container)
    found = matched([i.name for i in job.items], [i.name for i in job.earlier.items])
    known = np.flatnonzero(found >= 0)
    before = then.some(found[known])
    limits = job.recipe.rotation.limit, job.recipe.rotation.choices
    angles = nearest_allowed(before.angle, *limits)
    return poses.with_some(known, replace(before, angle=angles, scale=scales[known])), known


def _options(job: Job, poses: Poses) -> FinishOptions:
    rotations = [one.rotation or job.recipe.rotation for one in job.asked]
    limits = [rotation.limit for rotation in rotations if rotation.limit is not None]
    turning = not any(rotation.is_still for rotation in rotations)
    return FinishOptions(
        gap_cu=gap_with_bulge(job, np.arange(len(job.items)), poses.scale),
        sizes="fixed",
        turning=turning,
        turn_limit=min(limits) if limits and turning else None,
        seed=job.recipe.seed,
    )


def _judged(asked: PileOptions, job: Job, heap: Piled, room: Opened) -> Run:
    """The result with those items that found room."""
    kept = heap.placed
    total = len(job.items)
    left = np.setdiff1d(np.arange(total), kept)
    if len(kept) == 0:
        raise RecipeError(
            "size", f"none of the {total} items fits into the container; use smaller ones"
        )
    unplaced = tuple(
        Unplaced(job.items[k].name, int(k), "there was no room left at its size") for k in left
    )
    faults: tuple[str, ...] = ()
    if len(left):
        faults = (f"{len(kept)} of {total} items fit into the container at their sizes",)
    smaller = replace(
        job,
        items=tuple(job.items[k] for k in kept),
        asked=tuple(job.asked[k] for k in kept),
        weights=job.weights[kept],
    )
    poses = heap.poses.some(kept)
    layout = Layout(smaller.container, smaller.items, poses, smaller.weights)
    lies: dict[str, Any] = {"rounds": heap.rounds, "mean_height": heap.mean_height}
    if asked.compact:
        lies["compact"] = compactness(layout.outlines)
    _tell_who_is_held_by_the_edge(layout)
    return judged(
        smaller,
        Judged(
            poses, "lowest" if job.earlier is None else "layout", None,
            Outcome(poses, Ending.DONE), unplaced, None, len(left), lies, faults, kept,
        ),
    )  # fmt: skip


def _tell_who_is_held_by_the_edge(layout: Layout) -> None:
    """A notice where there is no container and the forces press items off the canvas."""
    container = layout.container
    if container.name != NO_CONTAINER:
        return
    near = AT_EDGE * container.side
    sheet = shapely.box(near, near, container.width - near, container.height - near)
    held = sum(not shapely.contains_properly(sheet, o.region) for o in layout.outlines)
    if held:
        _LOG.warning(
            "the forces press items off the canvas; its edge holds %d of %d",
            held, len(layout.items),
        )  # fmt: skip
