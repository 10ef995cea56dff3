"""Starts that begin anew: along a thread, by a picture's detail, by first fit, by a method.

Where a picture is to be shown, small items come where it has much to show. Of items each of one
colour, so many to the square that their number goes with the change of colour across a place shows
a picture with the least squared error (A. Gersho, "Asymptotically optimal block quantization", IEEE
Transactions on Information Theory 25 (1979), 373-380, doi:10.1109/TIT.1979.1056067); Lloyd's method
finds such places where it weighs pixels by the square of that change.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import final

import numpy as np

from packwork.arrays import FloatArray, Image, IntArray
from packwork.compaction.arrangement import FINE
from packwork.compaction.options import HAIR
from packwork.errors import RecipeError
from packwork.fields.filters import box_mean
from packwork.finish.finish import COMMON_COARSE
from packwork.forces.forces import PRESSURE, FieldForce
from packwork.pipeline.job import Job
from packwork.pipeline.plan.copies import kinds_of
from packwork.pipeline.plan.limits import held_to, job_leanings
from packwork.pipeline.state import RunState
from packwork.progress import until_over
from packwork.recipe.presets import DEFAULT
from packwork.scene.contrast import oklabs_of_light
from packwork.scene.pose import Limits, Poses, turn_sides
from packwork.scene.target import TargetPicture, blurred
from packwork.start.angles_and_sizes import spread_angles
from packwork.start.erosion import is_thread, scales_within, spread_along
from packwork.start.first_fit.preferences import Homes
from packwork.start.first_poses import (
    container_image,
    disc_radii,
    first_poses,
    poses_apart,
    start_resolution,
)
from packwork.start.places import stippled
from packwork.steps.assign_by_embedding import homes_alike
from packwork.steps.assign_in_order import homes_in_order
from packwork.steps.place import Setting, Start, unburied

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

FARTHEST = 4.0
"""Side of the largest places over that of the smallest, about, at a detail of 1. Larger shows finer
lines by coarser areas. Chosen by eye."""

CLEAR = 0.98
"""Share of the pixels whose change of colour is below the most that counts. Larger lets one sharp
edge take all small items. Chosen."""

SMOOTH, SPREAD = 0.25, 0.5
"""Sides of the squares over which the picture is averaged before its change of colour is taken, and
over which that is averaged, over that of an item's share of the canvas. Smaller ones follow grain,
larger ones miss lines. Chosen."""

MOST_FIRST_FIT = 1_500
"""Items at most that are put one after another unless asked: 100 upright icons take 0.7 s of
processor time, 400 take 5 s, 1,000 take 10 s, 1,500 take 14 s. Measured."""

MOST_TURNING = 150
"""The same of items that may turn any way, and are no words: 100 of them take 3 s, 400 take 40 s,
where the levels take 0.6 s and 2.5 s. Measured."""


def needs_levels(job: Job) -> bool:
    """Whether something is asked that only the levels know."""
    plan = job.plan
    return (
        bool(plan.levels or plan.epochs or plan.losses)
        or plan.preset is not DEFAULT
        or not plan.is_exact
        or plan.stretch > 1.0
        or plan.keeps_apart
        or bool(job.forces.bonds)
        # Icons in an order are placed as well by the levels, and cover more.
        or (job.plan.keeps_order and job.vectors is None and not job.use.words)
    )


def may_rearrange(job: Job) -> bool:
    """Whether nothing is asked of where items lie, so that another search may place them all."""
    has_places = job.earlier is not None or job.target is not None or job.vectors is not None
    return not (
        has_places or job.is_limited or job.forces.acts or job.plan.keeps_order or needs_levels(job)
    )


def fits_first(job: Job) -> bool:
    """Whether items are few enough to be put one after another, for items that are no words."""
    most = MOST_TURNING if job.plan.rotation.is_free else MOST_FIRST_FIT
    return len(job.items) <= most


def new_starts(job: Job, *, suits_first_fit: bool) -> list[Start]:
    """Starts of a job that begins anew, in the order in which they are tried.

    Parameters
    ----------
    suits_first_fit
        Whether first fit does these items good where all have one size.
    """
    plan, found = job.plan, list[Start]()
    is_open = not (plan.method or job.is_limited or job.forces.acts or needs_levels(job))
    if is_open and plan.sizes != "fixed":
        found.append(AlongThread())
    if job.target is not None and plan.detail:
        found.append(ByDetail(job.target))
    if plan.method == "first-fit" and plan.sizes != "shared":
        raise RecipeError(
            "start",
            f"first-fit seeks one size for all; use it with sizes shared, not {plan.sizes}",
        )
    suits = plan.sizes == "shared" and not needs_levels(job) and suits_first_fit
    if plan.method == "first-fit" or (not plan.method and suits):
        found.append(ByFirstFit())
    return [*found, ByMethod()]


@final
class AlongThread(Start):
    """Along the middle line of a container that is a thread to its items.

    No image of the levels shows such a container, and items of usual sizes have no place in it.
    """

    def find(self, setting: Setting) -> RunState | None:
        """Poses at which discs round the items fit; None in a container of any other form."""
        job, angles = setting.job, setting.angles
        radii = disc_radii(setting.outlines, setting.nominal)
        if not is_thread(setting.region.outline, radii):
            return None
        found = spread_along(setting.region.outline, len(radii), setting.rng)
        if found is None:
            return None
        room = SNUG * found.radius - (job.plan.gap + HAIR * job.container.side) / 2
        scales, setting.nominal = scales_within(
            setting.outlines, setting.nominal, room, is_common=job.plan.sizes == "shared"
        )
        poses = Poses(found.x, found.y, angles, scales)
        return setting.placed(poses, "erosion", Limits.free(len(poses)), is_tight=True)


@final
class ByDetail(Start):
    """Small items where a picture has much to show, but for what rules ask."""

    def __init__(self, target: TargetPicture) -> None:
        self._target = target

    def find(self, setting: Setting) -> RunState:
        """A place for each item, the heaviest ones where the picture has least to show."""
        job, rng, angles = setting.job, setting.rng, setting.angles
        count = len(job.items)
        inside, px_per_cu = container_image(setting.region, start_resolution(count))
        density = _density(self._target, inside.shape, px_per_cu, count) ** job.plan.detail
        found = stippled(inside, density, count, rng)
        # Items of one weight come anywhere, copies of one drawing not all to one end.
        shuffled = rng.permutation(count)
        items = shuffled[np.argsort(-job.weights[shuffled], kind="stable")]
        of_item = np.empty(count, dtype=np.int64)
        is_ranked = np.ptp(job.weights) > 0
        of_item[items] = np.argsort(-found.areas, kind="stable") if is_ranked else np.arange(count)
        x, y = found.x[of_item] / px_per_cu, found.y[of_item] / px_per_cu
        setting.share_out(found.areas[of_item])
        limits, scales = setting.limits(angles)
        return setting.placed(held_to(limits, Poses(x, y, angles, scales)), "stippling", limits)


@final
class ByFirstFit(Start):
    """One item after another, each where it fits, at the largest common size."""

    def find(self, setting: Setting) -> RunState | None:
        """Poses in which nothing overlaps; None where no size is found."""
        from packwork.start.first_fit.first_fit import first_fit

        job, plan = setting.job, setting.job.plan
        limits, scales = setting.limits(setting.angles)
        few_steps = is_only_refined(job)
        seeded = np.random.default_rng
        poses = first_fit(
            setting.region,
            setting.outlines,
            scales,
            _angles_tried(job, setting.angles, limits),
            seeded(plan.seed),
            margin_cu=plan.gap / 2 + HAIR * job.container.side,
            slack=FINE if few_steps else SPARE * COMMON_COARSE,
            attempts=ATTEMPTS[plan.effort],
            limits=limits,
            fields=_fields(job),
            kinds=_kinds(job),
            homes=_homes(setting),
            stop=until_over(setting.stop, job.seconds_left(TIME_SHARE)),
        )
        if poses is not None:
            is_tight = not needs_levels(job)
            found = setting.placed(poses, "first-fit", limits, is_tight=is_tight)
            return replace(found, is_only_refined=is_tight and few_steps)
        # Once a run is to stop, there is no time to take apart what others leave overlapping.
        apart = None
        if not limits.binds and setting.stop():
            apart = poses_apart(setting.region, setting.outlines, scales, setting.angles)
        return None if apart is None else setting.placed(apart, "distance-field", limits)


@final
class ByMethod(Start):
    """Places by the method that the plan names, or by the distance field."""

    def find(self, setting: Setting) -> RunState:
        """Poses of all items, which may overlap."""
        limits, scales = setting.limits(setting.angles)
        found = first_poses(
            setting.region, setting.outlines, scales, setting.angles,
            setting.job.plan.start_options(), setting.rng, limits,
        )  # fmt: skip
        poses = found.poses
        if found.method == "scatter":
            poses, _ = unburied(setting, poses, limits)
        return setting.placed(poses, str(found.method), limits)


def is_only_refined(job: Job) -> bool:
    """Whether a few small steps of the finish do with what first fit has put down.

    So it is where many words keep their angles: those that turn, and icons, gain by as many larger
    ones. Of thousands that turn, a hair of conflict between specks would make all much smaller.
    """
    is_told = job.forces.acts or job.is_limited or job.plan.effort == "best"
    are_words = len(job.use.words) == len(job.items) > FEW
    is_still = job.plan.rotation.is_still or len(job.items) * ANGLES > MOST_ANGLES
    return job.plan.sizes == "shared" and are_words and is_still and not is_told


def _homes(setting: Setting) -> Homes | None:
    """Points near which items had better lie; None if anywhere."""
    job, rng = setting.job, np.random.default_rng(setting.job.plan.seed)
    alike = homes_alike(job, setting.region, rng)
    return homes_in_order(job, setting.region, rng) if alike is None else alike


def _kinds(job: Job) -> IntArray | None:
    """Numbers of words, photos and items where they have shares; None if nothing is to be mixed."""
    if not job.plan.share:
        return None
    return np.unique(kinds_of(job.items, job.use.words), return_inverse=True)[1].astype(np.int64)


def _fields(job: Job) -> Sequence[FieldForce]:
    """Forces that draw items to places, with little of what draws all alike.

    That would only press them together. No item is pushed the other way, as in the levels: those
    drawn least would fill the far ends first, and leave the near ones to the smallest.
    """
    found = []
    for force in job.forces.fields:
        pull = force.strengths
        least = pull[np.argmin(np.abs(pull))]
        found.append(FieldForce(force.field, pull - (1 - PRESSURE) * least))
    return found


def _angles_tried(job: Job, first: FloatArray, limits: Limits) -> list[FloatArray]:
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


def _density(target: TargetPicture, shape: tuple[int, ...], px_per_cu: float, count: int) -> Image:
    """Squared change of colour across each pixel, over the most that counts."""
    labs = oklabs_of_light(blurred(target.light, SMOOTH, count))
    down, across = np.gradient(labs, axis=(0, 1))
    change = (down**2 + across**2).sum(axis=2)
    wide = 2 * int(SPREAD * np.sqrt(change.size / count) / 2) + 1
    seen = box_mean(np.ascontiguousarray(change), wide) if wide > 1 else change
    rows, columns = (
        np.minimum(((np.arange(n) + 0.5) / px_per_cu * target.px_per_cu).astype(int), most - 1)
        for n, most in zip(shape, seen.shape, strict=True)
    )
    laid = seen[np.ix_(rows, columns)]
    most = max(float(np.quantile(laid, CLEAR)), 1e-12)
    return np.asarray(np.clip(laid / most, FARTHEST**-4, 1.0))
