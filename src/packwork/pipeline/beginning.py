"""From what was read to the first poses: sizes, angles, limits, places."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from packwork.arrays import FloatArray, IntArray
from packwork.errors import RecipeError
from packwork.forces.exchanges import exchanged
from packwork.forces.forces import Forces
from packwork.geometry.outline import Outline
from packwork.geometry.simplify import hull_areas
from packwork.pipeline.alike import placed_alike
from packwork.pipeline.arranging import arranged
from packwork.pipeline.by_detail import DetailedPlaces, places_by_detail
from packwork.pipeline.earlier import new_items, who_is_who
from packwork.pipeline.first_places import (
    first_places,
    is_only_refined,
    needs_levels,
    places_along_thread,
)
from packwork.pipeline.job import Job
from packwork.pipeline.plan.leaning import job_leanings
from packwork.pipeline.plan.limits import check_poses, held_to, item_limits, pinned_scales
from packwork.pipeline.plan.padding import check_padding, padded
from packwork.pipeline.plan.sizes import given_scales
from packwork.progress import Stop, never
from packwork.recipe.rules import Rotation
from packwork.scene.canvas import brought_over
from packwork.scene.container import Container
from packwork.scene.layout import Layout
from packwork.scene.limits import Limits
from packwork.scene.mixing import mixed
from packwork.scene.neighbours import neighbour_pairs
from packwork.scene.pose import Poses
from packwork.solve.detail import seen_posed
from packwork.solve.level import Level
from packwork.solve.relocate_trapped import violation_shares
from packwork.solve.solver import scale_bounds
from packwork.start.angles import nearest_allowed, start_angles
from packwork.start.first_poses import disc_radii
from packwork.start.relocate_buried import relocated
from packwork.start.sizes import nominal_scales, shared_scales, yielding_scales

NOMINAL_COVERAGE = 0.82
"""With free sizes: area of all items' hulls at their nominal sizes over the container's.
Smaller lets the largest stand out more. Tried."""

BURIED_RESOLUTION = 200
"""Pixels on the longer side of the image on which buried items are found. Chosen."""

BURIED_SHARE = 0.5
"""Share of an item under others or outside from which it is moved before a run that did
not choose its own start. Smaller undoes more of that start. Chosen."""

ROUGH_SHARE, ROUGH_ITEMS = 0.1, 0.1
"""Share of an item under others or outside, and share of the items of which so much is, from which
an earlier layout goes through the levels. Larger leave more to the finish, which moves items little
and shrinks them. Chosen."""

ALIKE = 1.3
"""Factor in radius between two items that may change places to come apart from others of
their kind. Larger finds more partners and upsets the start more. Chosen."""

FORCED_ALIKE = 2.0
"""The same between two that may change places for a force's sake, before all others: what is too
large or too small there the levels still mend. Larger leaves them more to mend. Tried."""


@dataclass(frozen=True, eq=False)
class Beginning:
    """All that the levels begin from, and what stays the same until all is finished.

    Parameters
    ----------
    job
        What is placed.
    region
        The container, drawn in by half the gap.
    outlines
        What items are taken for.
    forces
        What pulls them about, with what makes room for the heavy.
    poses
        First poses, which keep the limits.
    nominal
        ``(n,)`` scales that weights ask for.
    method
        How places were found.
    limits
        What rules ask of single items.
    is_tight
        Whether nothing overlaps, and the levels have nothing to add.
    goes_on
        Whether items keep their order, as those of an earlier layout that is no mere heap do.
    is_clean
        Whether nothing meets in exact geometry, gap included, but for pixels that are only grazed:
        the finish only refines.
    """

    job: Job
    region: Container
    outlines: Sequence[Outline]
    forces: Forces
    poses: Poses
    nominal: FloatArray
    method: str
    limits: Limits
    is_tight: bool = False
    goes_on: bool = False
    is_clean: bool = False

    @property
    def is_refined(self) -> bool:
        """Whether an earlier layout is gone on from that has to be refined only."""
        return self.is_tight and self.goes_on


def begin(job: Job, stop: Stop = never) -> Beginning:
    """First poses of the outlines that the solver will see, in the padded container.

    Raises
    ------
    RecipeError
        If what is asked of single items cannot be, or the padding leaves no room.
    """
    with job.clock.time("start"):
        outlines = job.solid_outlines
        check_padding(job.container, job.plan.gap, len(job.items))
        start = _Start(job, padded(job.container, job.plan.gap), outlines)
        return start.anew(stop) if job.earlier is None else start.from_layout(job.earlier)


class _Start:
    """What comes before first poses: sizes, forces and random numbers."""

    def __init__(self, job: Job, region: Container, outlines: Sequence[Outline]) -> None:
        self._job, self._region, self._outlines = job, region, outlines
        self._forces = job.forces.buoyant(job.weights)
        self._rng = np.random.default_rng(job.plan.seed)
        self._nominal, self._scales = _scales(job, region, outlines, job.weights)

    def anew(self, stop: Stop) -> Beginning:
        """First poses by the method asked for, or else by the one that suits."""
        job, forces, outlines = self._job, self._forces, self._outlines
        if own := job.use.own_places:
            self._nominal = own.poses.scale
            begun = self._beginning(own.poses, "first-fit", own.limits, is_tight=True)
            return replace(begun, is_clean=True)
        angles = first_angles(job, self._rng)
        thread = places_along_thread(job, self._region, outlines, self._nominal, angles, self._rng)
        if thread is not None:
            poses, self._nominal = thread
            return self._beginning(poses, "erosion", Limits.free(len(poses)), is_tight=True)
        if (detailed := places_by_detail(job, self._region, self._rng)) is not None:
            return self._by_detail(detailed, angles)
        limits, scales = self._limits(angles)
        first = first_places(
            job, self._region, outlines, scales, angles, limits, self._rng, forces, stop
        )
        is_tight = first.method == "first-fit" and not needs_levels(job, forces)
        poses = first.poses
        if forces.acts and not is_tight:
            poses = _by_forces(outlines, poses, limits, forces)
        if job.keeps_order and not is_tight:
            if job.vectors is not None:
                poses = placed_alike(job, outlines, poses, self._rng)
            else:
                poses = arranged(job, poses, self._nominal)
        begun = self._beginning(poses, str(first.method), limits, is_tight=is_tight)
        return replace(begun, is_clean=is_tight and is_only_refined(job, forces))

    def _by_detail(self, places: DetailedPlaces, angles: FloatArray) -> Beginning:
        """Places and sizes that follow a picture, but for what rules ask."""
        self._nominal, self._scales = _scales(
            self._job, self._region, self._outlines, places.shares
        )
        limits, scales = self._limits(angles)
        poses = held_to(limits, Poses(places.x, places.y, angles, scales))
        poses = placed_alike(self._job, self._outlines, poses, self._rng)
        return self._beginning(poses, "stippling", limits)

    def from_layout(self, earlier: Layout) -> Beginning:
        """The poses of an earlier layout, as near as what is asked now allows."""
        poses = _earlier_poses(self._job, earlier, self._nominal)
        angles = _kept_angles(self._job, poses.angle)
        limits, _ = self._limits(angles)
        return self._beginning(held_to(limits, replace(poses, angle=angles)), "layout", limits)

    def _limits(self, angles: FloatArray) -> tuple[Limits, FloatArray]:
        """What rules ask of single items, and first scales that keep it."""
        limits = Limits.free(len(angles))
        if self._job.is_limited:
            limits = item_limits(self._job, self._nominal, self._scales, angles)
        return limits, np.clip(self._scales, limits.smallest, limits.largest)

    def _beginning(
        self, poses: Poses, method: str, limits: Limits, *, is_tight: bool = False
    ) -> Beginning:
        """The beginning from these poses, once they are checked and nothing lies buried."""
        job, outlines, goes_on = self._job, self._outlines, self._job.plan.stays
        check_poses(job, self._region, poses, limits)
        if job.plan.stays:
            buried = new_items(job)
            poses = relocated(self._region, outlines, poses, buried, self._rng, limits)
        elif method in {"layout", "scatter"}:
            shares = _violation(self._region, outlines, poses, limits)
            poses = _unburied(self._region, outlines, poses, shares, self._rng, limits)
            goes_on = method == "layout" and _share_above(BURIED_SHARE, shares) <= ROUGH_ITEMS
            is_tight = goes_on and _needs_no_levels(job, shares)
        if limits.keeps_kinds_apart:
            poses = _kinds_apart(outlines, poses, limits)
        return Beginning(
            job, self._region, outlines, self._forces, poses, self._nominal, method, limits,
            is_tight, goes_on,
        )  # fmt: skip


def _scales(
    job: Job, container: Container, outlines: Sequence[Outline], weights: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Nominal and first scales by ``(n,)`` weights.

    The items that are free share what pinned ones leave.
    """
    plan = job.plan
    pinned = pinned_scales(job)
    scales, nominal = pinned.copy(), pinned.copy()
    free = [k for k, scale in enumerate(pinned) if np.isnan(scale)]
    true = np.array([item.outline.area for item in job.items])
    room = container.outline.area - float(np.nansum(true * pinned**2))
    if room <= 0:
        largest = int(np.nanargmax(true * pinned**2))
        raise (
            job.asked[largest]
            .voices["pin.size"]
            .error(f"pins {job.items[largest].name} so large that no room is left in the container")
        )
    if len(free) == 0:
        return nominal, scales
    total = plan.start_options().coverage * room
    seen = [outlines[k] for k in free]
    areas = np.array([outline.area for outline in seen])
    if plan.sizes == "fixed":
        given = given_scales(job.items, weights, container.unit, container.side)
        nominal[free] = scales[free] = given[free]
    elif plan.sizes == "shared":
        nominal[free] = scales[free] = shared_scales(true[free], areas, weights[free], total)
    else:
        hulls = hull_areas(seen)
        nominal[free] = nominal_scales(hulls, weights[free], NOMINAL_COVERAGE * room)
        scales[free] = yielding_scales(areas, hulls, nominal[free], plan.size_ratio, total)
    return nominal, scales


def first_angles(job: Job, rng: np.random.Generator) -> FloatArray:
    """``(n,)`` first angles, as the recipe, rules and pins allow."""

    def some(items: IntArray, rotation: Rotation) -> FloatArray:
        return start_angles(len(items), rotation.limit, rotation.choices, rng)

    return _angles(job, some)


def _kept_angles(job: Job, angles: FloatArray) -> FloatArray:
    """``(n,)`` angles of an earlier layout, as near as the recipe, rules and pins allow."""

    def nearest(items: IntArray, rotation: Rotation) -> FloatArray:
        return nearest_allowed(angles[items], rotation.limit, rotation.choices)

    return _angles(job, nearest)


def _angles(job: Job, allowed: Callable[[IntArray, Rotation], FloatArray]) -> FloatArray:
    """Angles of all items, ``allowed`` for some of them within a rotation."""
    rotation = job.plan.rotation
    angles = allowed(np.arange(len(job.items)), rotation).copy()
    leans = job_leanings(job)
    if leans.any():
        # As far beyond its least tilt as any other turn from upright, but to its own side.
        rest = np.abs(angles) * (1 - np.abs(leans) / rotation.farthest)
        angles = np.where(leans == 0, angles, leans + np.sign(leans) * rest)
    for k, one in enumerate(job.asked):
        if one.rotation:
            angles[k] = allowed(np.array([k]), one.rotation)[0]
        if "angle" in one.pin:
            angles[k] = np.radians(one.pin["angle"])
    return angles


def _of_now(job: Job, earlier: Layout, poses: Poses, nominal: FloatArray) -> Poses:
    """Poses of the items of now; those that are new lie in the middle, upright."""
    found = who_is_who(job, earlier)
    known = found >= 0
    if not known.any():
        raise RecipeError("start", f"{job.recipe.start} has none of these items; leave --stay out")
    middle = np.reshape(job.container.outline.bounds, (2, 2)).mean(axis=0)
    ratio = float(np.median(poses.scale[found[known]] / nominal[known]))
    x, y, angle = (np.full(len(found), value) for value in (*middle, 0.0))
    of_now = Poses(x, y, angle, nominal * ratio)
    return of_now.with_some(np.flatnonzero(known), poses.some(found[known]))


def _violation(
    container: Container, outlines: Sequence[Outline], poses: Poses, limits: Limits
) -> FloatArray:
    """``(n,)`` share of each item that lies under others or outside."""
    seen = seen_posed(outlines, poses, BURIED_RESOLUTION / container.side)
    level = Level(container, seen, BURIED_RESOLUTION, limits=limits)
    return violation_shares(level, poses, level.density(poses))


def _share_above(bound: float, violation: FloatArray) -> float:
    return float(np.mean(violation > bound))


def _needs_no_levels(job: Job, violation: FloatArray) -> bool:
    """Whether an earlier layout is such that only the exact finish has to go on with it.

    So it is where hardly anything overlaps or sticks out, and nothing is asked of which the
    finish knows nothing.
    """
    plan = job.plan
    is_asked = bool(plan.losses) or plan.keeps_apart or not plan.is_default or not plan.is_exact
    is_rough = _share_above(ROUGH_SHARE, violation) > ROUGH_ITEMS
    return not (is_asked or is_rough) and not job.forces.acts


def _unburied(
    container: Container,
    outlines: Sequence[Outline],
    poses: Poses,
    violation: FloatArray,
    rng: np.random.Generator,
    limits: Limits,
) -> Poses:
    """Poses in which items that lie mostly under others or outside have been moved."""
    buried = np.flatnonzero(violation > BURIED_SHARE)
    return relocated(container, outlines, poses, buried, rng, limits) if len(buried) else poses


def _kinds_apart(outlines: Sequence[Outline], poses: Poses, limits: Limits) -> Poses:
    """Poses in which items of about one size have changed places, away from their kind."""
    sizes = np.log(disc_radii(outlines, poses.scale)) / np.log(ALIKE)
    pairs = neighbour_pairs(poses.x, poses.y)
    return _exchanged(poses, mixed(limits.kinds, pairs, limits.groups, sizes))


def _by_forces(outlines: Sequence[Outline], poses: Poses, limits: Limits, forces: Forces) -> Poses:
    """Poses in which items have changed places to where forces would have them."""
    radii = disc_radii(outlines, poses.scale)
    places = np.column_stack([poses.x, poses.y])
    areas = np.array([outline.area for outline in outlines]) * poses.scale**2
    sizes = np.log(radii) / np.log(FORCED_ALIKE)
    return _exchanged(poses, exchanged(forces, places, areas, sizes, limits.groups))


def _exchanged(poses: Poses, order: IntArray) -> Poses:
    """Poses in which items have come to the places of others."""
    x, y = poses.x.copy(), poses.y.copy()
    x[order], y[order] = poses.x, poses.y
    return replace(poses, x=x, y=y)


def _earlier_poses(job: Job, earlier: Layout, nominal: FloatArray) -> Poses:
    """Poses of an earlier layout, sizes and stretches within the recipe's bounds.

    On a canvas of another size or unit their container's box is brought onto this one's.
    """
    plan = job.plan
    poses = brought_over(earlier.poses, earlier.container, job.container)
    if plan.stays:
        poses = _of_now(job, earlier, poses, nominal)
    elif len(poses) == len(nominal) and (found := who_is_who(job, earlier)).min() >= 0:
        poses = poses.some(found)
    if len(poses) != len(nominal):
        raise RecipeError(
            "start",
            f"{job.recipe.start} has {len(poses)} items, this run {len(nominal)}; give as many",
        )
    if plan.sizes == "shared" and plan.stays:
        # What most have; one that is to be larger now makes not all others so.
        scale = nominal * np.median(poses.scale / nominal)
    elif plan.sizes == "shared":
        scale = nominal * np.sqrt(np.mean((poses.scale / nominal) ** 2))
    elif plan.sizes == "fixed":
        scale = nominal
    else:
        scale = np.clip(poses.scale, *scale_bounds(nominal, nominal, plan.solve_options()))
    stretch = np.clip(poses.stretch, 1 / plan.stretch, plan.stretch)
    return replace(poses, scale=np.asarray(scale), stretch=stretch)
