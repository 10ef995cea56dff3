"""A run that heaps items of given sizes, under forces, in a container that may be open."""

from __future__ import annotations

import logging
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, final

import numpy as np
import shapely

from packwork.arrays import FloatArray, IntArray
from packwork.compaction.options import HAIR
from packwork.errors import RecipeError
from packwork.forces.forces import Forces
from packwork.geometry.outline import Outline
from packwork.geometry.simplify import hull_areas
from packwork.metrics.exact import compactness
from packwork.phrasing import number_of
from packwork.pipeline.findings import Sentence, Unplaced
from packwork.pipeline.job import Job, UseOf
from packwork.pipeline.plan.counts import widest_cu
from packwork.pipeline.plan.forces import forces_of
from packwork.pipeline.plan.limits import given_scales
from packwork.pipeline.recorder import Recorder
from packwork.pipeline.registration import matched
from packwork.pipeline.state import RunContext, RunState, RunStep
from packwork.recipe.piles import PileOptions
from packwork.scene.container import brought_over
from packwork.scene.layout import Layout
from packwork.scene.pose import Limits, Poses
from packwork.settle.pile import Arrival, Piled, SettleOptions, pile
from packwork.settle.round_pack import begin_as_discs
from packwork.start.angles_and_sizes import nearest_allowed, spread_angles
from packwork.start.first_fit.lowest_fit import Falling, lowest_fit
from packwork.start.first_fit.pour import pour
from packwork.steps.finish import gap_with_bulge
from packwork.steps.line_weights import evened
from packwork.steps.measure import RemarkCount
from packwork.steps.place import first_angles
from packwork.steps.shortfalls import Advise, TellOneColour
from packwork.uses.icons import NO_CONTAINER
from packwork.uses.piles.opening import opened, source_of

FULL = 0.42
"""Share of the container that the items' convex hulls come to: heaped, they leave about a third of
what they reach into free, so the pile is two thirds high. Larger leaves some without room, smaller
piles look lost. Measured on square, heart, bear and cat of 20 and 60 icons: 0.55 to 0.70 high."""

WIDEST = 0.6
"""Longest item over the container's widest place, at most. Larger may wedge. Chosen."""

SMALLER, TRIES = 0.93, 6
"""Factor on all sizes while some items find no room, and how often. Smaller ends sooner with a
lower pile. Chosen."""


def is_size_open(job: Job, asked: PileOptions) -> bool:
    """Whether the run may choose how large its items are."""
    is_alone = job.container.name == NO_CONTAINER
    return asked.size is None and not job.is_counted and not is_alone


def fitting_factor(job: Job) -> float:
    """Factor on the sizes of the files at which the pile is about two thirds high.

    Where an earlier layout is gone on from, that at which its items keep their sizes.
    """
    container = job.container
    scales = given_scales(job.items, job.weights, container.unit, container.side)
    if job.earlier is not None:
        names = ([item.name for item in items] for items in (job.items, job.earlier.items))
        found = matched(*names)
        known = np.flatnonzero(found >= 0)
        if len(known):
            then = brought_over(job.earlier.poses, job.earlier.container, container)
            own = [job.items[k].outline.extent for k in known]
            before = [job.earlier.items[k].outline.extent for k in found[known]]
            sizes = then.scale[found[known]] * np.array(before) / np.array(own)
            return float(np.median(sizes / scales[known]))
    outlines = job.solid_outlines
    covered = float((hull_areas(outlines) * scales**2).sum())
    factor = float(np.sqrt(FULL * container.outline.area / covered))
    across = widest_cu(container.outline)
    longest = float((2 * np.array([o.radius for o in outlines]) * scales).max())
    return float(min(factor, WIDEST * across / longest))


_LOG = logging.getLogger(__name__)

SHUFFLE, SHUFFLE_ALONE = 0.6, 0.15
"""Logarithm of size within which items come in random order, in a container and without one.
Larger leaves more gaps, and below 0.82 of the circle in a round pack; smaller puts copies of
one thing side by side. Tried, the first by eye."""

MANY = 2_000
"""Items above which it is said that the pile takes long. Of 1,000 it takes 10 to 14 s of the
processor, of 3,000 36 s; of 10,000 nobody has waited for the end: rounds grow with the pile's
height, and what each costs with the items. Measured."""

MOST_ANGLES, LEAST_ANGLES, ALL_ANGLES = 32, 8, 16_000
"""Angles tried for an item that may turn, at most and at least, and about how many of all items
together. More find closer places, ever less so, and take as many times longer. Tried."""

AT_EDGE = 1e-3
"""Distance from the canvas' edge, as a share of its longer side, below which an item counts
as held by it. Chosen."""


@dataclass(frozen=True, eq=False)
class Heap:
    """Request of a pile.

    Parameters
    ----------
    mouths
        ``(m, 2, 2)`` ends of the openings that a container of open paths has; None if none.
    """

    options: PileOptions
    mouths: FloatArray | None = None


@final
class HeapUp(RunStep):
    """Items fall and settle; there are no levels."""

    share = 1.0

    def __init__(self, heap: Heap) -> None:
        self._heap = heap

    def run(self, state: RunState, context: RunContext) -> RunState:
        """State of those items that found room."""
        if len(state.job.items) > MANY:
            _LOG.warning(
                "a pile of %s takes minutes to come to rest, one of 1,000 a quarter of one; use "
                "fewer, or stop it with Ctrl-C, which writes it as it lies by then",
                number_of(len(state.job.items), "item"),
            )
        recorder = Recorder() if state.job.is_recorded else None
        job, piled = _heaped_to_fit(state.job, self._heap, context.heard_by(recorder))
        found = replace(state, job=job, recorder=recorder)
        return _without_those_left(self._heap.options, found, piled, context.stop())


def _heaped_to_fit(job: Job, heap: Heap, context: RunContext) -> tuple[Job, Piled]:
    """The heap, of sizes at which all find room unless sizes were given."""
    if not is_size_open(job, heap.options):
        return _heaped(job, heap, 1.0, context)
    factor = fitting_factor(job)
    for _ in range(TRIES):
        done, piled = _heaped(job, heap, factor, context)
        if len(piled.placed) == len(job.items) or context.stop():
            break
        factor *= SMALLER
    return done, piled


def _heaped(job: Job, heap: Heap, factor: float, context: RunContext) -> tuple[Job, Piled]:
    """The heap of items whose sizes are multiplied by a factor, and the job in its container."""
    clock, asked = job.clock, heap.options
    with clock.time("start"):
        poses, known = _first_poses(job, asked, factor)
        # Sizes are known: what lies closer with thinner lines may do so.
        job = evened(job, poses, tells=False)
        outlines = job.solid_outlines
        discs = np.pi * (np.array([o.radius for o in outlines]) * poses.scale) ** 2
        room = opened(job.container, asked.open, heap.mouths, float(discs.sum()))
        job = replace(job, container=room.container)
        largest = float((np.array([o.radius for o in outlines]) * poses.scale).max())
        basin = room.basin or room.container.outline
        source = source_of(asked, room.container, basin, largest)
        forces = forces_of(job.plan.forces, job.items, job.weights, room.container)
    with clock.time("finish"):
        options = _options(job, poses)
        is_alone = room.container.name == NO_CONTAINER
        arrival = Arrival(
            known=known,
            about=None if source is None or source.every else source.points,
            shuffle=SHUFFLE_ALONE if is_alone else SHUFFLE,
            is_round=is_alone,
        )
        rng = np.random.default_rng(job.plan.seed)
        if source is not None and source.every:
            falling = _falling(job, poses, forces, options, rng)
            poured = pour(room.container, basin, falling, source, rng, context.stop)
            poses, rounds = poured.poses, poured.rounds()
            arrival = replace(arrival, known=poured.items, keeps=False, rounds=rounds)
        elif falls(arrival, forces, outlines, poses.scale):
            falling = _falling(job, poses, forces, options, rng)
            poses, known = lowest_fit(room.container, falling, rng, context.stop)
            arrival = replace(arrival, known=known, keeps=False)
        piled = pile(
            room.container, outlines, poses, forces, options, room.basin,
            arrival, context.observer, context.stop,
        )  # fmt: skip
    return job, piled


def falls(
    arrival: Arrival, forces: Forces, outlines: Sequence[Outline], scales: FloatArray
) -> bool:
    """True where nothing but fields says where items lie, and true outlines lie closest."""
    is_told = arrival.about is not None or len(arrival.known) > 0
    if is_told or forces.bonds:
        return False
    return arrival.centre(forces) is None or not begin_as_discs(outlines, scales)


def _falling(
    job: Job, poses: Poses, forces: Forces, options: SettleOptions, rng: np.random.Generator
) -> Falling:
    """Items in the order in which they fall, by lot among those of about one size."""
    outlines = job.solid_outlines
    angles = _angles_tried(job, poses.angle, rng)
    radii = np.array([outline.radius for outline in outlines]) * poses.scale
    mixed = radii * np.exp(rng.uniform(-SHUFFLE, SHUFFLE, len(radii)))
    rotations = [one.rotation or job.plan.rotation for one in job.asked]
    return Falling(
        outlines, poses.scale, angles, np.argsort(-mixed, kind="stable"), forces.fields,
        options.gap_cu / 2 + HAIR * job.container.side,
        np.array([rotation.is_free for rotation in rotations]),
    )  # fmt: skip


def _angles_tried(job: Job, first: FloatArray, rng: np.random.Generator) -> list[FloatArray]:
    """For each item the angles to try, the same for all that may turn alike."""
    rotations = [one.rotation or job.plan.rotation for one in job.asked]
    many = min(max(ALL_ANGLES // len(first), LEAST_ANGLES), MOST_ANGLES)
    spread = {r: spread_angles(many, r.limit, rng) for r in dict.fromkeys(rotations)}
    spread |= {r: np.array(r.choices) for r in spread if r.choices}
    return [first[k : k + 1] if r.limit == 0.0 else spread[r] for k, r in enumerate(rotations)]


def check_pile(job: Job) -> None:
    """Refuse what a heap cannot do."""
    plan = job.plan
    if plan.sizes != "fixed":
        raise RecipeError("sizes", f"items of a pile keep their sizes; use fixed, not {plan.sizes}")
    for one in job.asked:
        one.refuse(("pin", "region", "scale"), "a pile")
    if plan.voids.fills or not plan.is_exact:
        raise RecipeError("pile", "is settled in exact geometry, and its voids stay as they are")


def _first_poses(job: Job, asked: PileOptions, factor: float) -> tuple[Poses, IntArray]:
    """Poses to begin with, and which items an earlier layout has places for."""
    rng = np.random.default_rng(job.plan.seed)
    container = job.container
    own = given_scales(job.items, job.weights, container.unit, container.side, asked.size)
    scales = factor * own
    middle = np.array(container.outline.bounds).reshape(2, 2).mean(axis=0)
    x, y = np.tile(middle, (len(scales), 1)).T
    poses = Poses(x, y, first_angles(job, rng), scales)
    if job.earlier is None:
        return poses, np.arange(0)
    then = brought_over(job.earlier.poses, job.earlier.container, container)
    found = matched([i.name for i in job.items], [i.name for i in job.earlier.items])
    known = np.flatnonzero(found >= 0)
    before = then.subset(found[known])
    limits = job.plan.rotation.limit, job.plan.rotation.choices
    angles = nearest_allowed(before.angle, *limits)
    return poses.with_some(known, replace(before, angle=angles, scale=scales[known])), known


def _options(job: Job, poses: Poses) -> SettleOptions:
    rotations = [one.rotation or job.plan.rotation for one in job.asked]
    limits = [rotation.limit for rotation in rotations if rotation.limit is not None]
    turning = not any(rotation.is_still for rotation in rotations)
    return SettleOptions(
        gap_cu=gap_with_bulge(job, np.arange(len(job.items)), poses.scale),
        turning=turning,
        turn_limit=min(limits) if limits and turning else None,
        seed=job.plan.seed,
    )


def _without_those_left(
    asked: PileOptions, state: RunState, heap: Piled, was_stopped: bool
) -> RunState:
    """State of those items that found room, and the others named, with why they did not."""
    job, kept, total = state.job, heap.placed, len(state.job.items)
    left = np.setdiff1d(np.arange(total), kept)
    if len(kept) == 0:
        none = "the item does not fit" if total == 1 else f"none of the {total} items fits"
        raise RecipeError("size", f"{none} into the container; use smaller ones")
    why = (Sentence.STOPPED if was_stopped else Sentence.NO_ROOM).of()
    unplaced = tuple(Unplaced(job.items[k].name, int(k), why) for k in left)
    if len(left):
        state = state.with_finding(Sentence.PILE_FULL, placed=len(kept), count=total)
    smaller = job.subset(kept)
    poses = heap.poses.subset(kept)
    layout = Layout(smaller.container, smaller.items, poses, smaller.weights)
    lies: dict[str, Any] = {"rounds": heap.rounds, "mean_height": heap.mean_height}
    if was_stopped:
        lies["stopped"] = True
    if asked.compact:
        lies["compact"] = compactness(layout.outlines)
    _tell_who_is_held_by_the_edge(layout)
    return replace(
        state,
        job=smaller,
        poses=poses,
        method="lowest" if job.earlier is None else "layout",
        numbers=kept,
        limits=Limits.free(len(kept)),
        unplaced=unplaced,
        left_out=len(left),
        pile=lies,
    )


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


@final
@dataclass(frozen=True, eq=False)
class PileUse(UseOf):
    """A heap of what another use reads."""

    heap: Heap
    matches_by_name = True

    def steps(self, job: Job) -> Sequence[RunStep]:
        """Items fall and settle; the content dresses them."""
        check_pile(job)
        return [HeapUp(self.heap), *self.report(job)]

    def report(self, job: Job) -> Sequence[RunStep]:
        """As of the content, but for the shape, which a heap does not show."""
        own = [step for step in self.content.report(job) if not isinstance(step, NOT_OF_PILES)]
        return [*own, RemarkCount(by_width=False)] if job.is_counted and not self.words else own


NOT_OF_PILES = (Advise, RemarkCount, TellOneColour)
"""Steps of other uses' reports that speak of filling a container."""
