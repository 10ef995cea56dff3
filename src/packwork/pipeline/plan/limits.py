"""Limits of single items in numbers, whether they can be met; the room that a padding leaves."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from itertools import combinations

import numpy as np
import shapely

from packwork.arrays import FloatArray
from packwork.compaction.arrangement import Conflict
from packwork.errors import RecipeError
from packwork.geometry.overlay import difference, intersection, prepared
from packwork.geometry.polygon import Region
from packwork.geometry.simplify import grown
from packwork.phrasing import number_of
from packwork.pipeline.job import Job
from packwork.pipeline.plan.copies import RuleSource, kinds
from packwork.pipeline.plan.resolution import largest_scales
from packwork.scene.container import Container
from packwork.scene.item import Item, PhotoArt
from packwork.scene.pose import Limits, Poses, leanings
from packwork.units import Unit, convert, parse_length


def given_scales(
    items: Sequence[Item],
    weights: FloatArray,
    unit: Unit,
    side: float,
    size: str | float | None = None,
) -> FloatArray:
    """``(n,)`` scales of items of given sizes.

    Parameters
    ----------
    weights
        ``(n,)`` share of area of each.
    unit, side
        Of the canvas, and its longer side.
    size
        Longer side of an item of weight 1, a length; None for sizes as in the files.
    """
    if size is None:
        # Items are in px, as their files say; the canvas may be in mm.
        return np.full(len(items), convert(1.0, "px", unit))
    length = parse_length(str(size), unit, side)
    return np.array([length / item.outline.extent for item in items]) * np.sqrt(weights)


def job_leanings(job: Job) -> FloatArray:
    """``(n,)`` least tilts of photos that may turn within a limit, 0 of all others.

    Icons are not held: they balance by themselves, since no common angle makes them fit better.
    """
    rotation = job.plan.rotation
    found = np.zeros(len(job.items))
    is_narrow = rotation.farthest < math.pi / 2 and not rotation.choices
    if not (job.plan.leans and is_narrow) or rotation.is_still:
        return found
    is_leaning = np.array(
        [
            isinstance(item.art, PhotoArt) and one.rotation is None and "angle_deg" not in one.pin
            for item, one in zip(job.items, job.asked, strict=True)
        ]
    )
    found[is_leaning] = leanings(int(is_leaning.sum()), rotation.farthest)
    return found


STICKS_OUT = 1e-3
"""Share of a pinned item that may lie outside the container: the flattening of two curves
that are drawn alike, no more. Chosen."""

LEAD = 0.6
"""Longer side of other items over the hero's, at most, where sizes are free. Larger ones
rival it, smaller ones make many. Chosen by eye."""

COVERED = 0.5
"""Share of a pinned item under another pinned one from which they count as pinned onto
each other. Smaller refuses what items may still turn or shrink away from. Chosen."""


def pinned_scales(job: Job) -> FloatArray:
    """``(n,)`` scales of items that are pinned in size, NaN for the others."""
    scales = np.full(len(job.items), np.nan)
    for k, one in enumerate(job.asked):
        if "size" in one.pin:
            container = job.container
            size = parse_length(str(one.pin["size"]), container.unit, container.side)
            scales[k] = size / job.items[k].outline.extent
    return scales


def item_limits(job: Job, nominal: FloatArray, scales: FloatArray, angles: FloatArray) -> Limits:
    """Limits of all items: the recipe's for all, those of rules for some.

    Parameters
    ----------
    nominal, scales, angles
        ``(n,)``: typical and first scales, first angles.
    """
    container = job.container
    smallest, largest = _scale_ranges(job, nominal, scales)
    rotations = [one.rotation or job.plan.rotation for one in job.asked]
    still = [
        r.is_still or "angle_deg" in one.pin for r, one in zip(rotations, job.asked, strict=True)
    ]
    turns = np.array([rotation.farthest for rotation in rotations])
    return Limits(
        x=_places(job, "x", container.width),
        y=_places(job, "y", container.height),
        angle=np.where(still, angles, np.nan),
        turn_limit=np.where(still, np.inf, turns),
        smallest=smallest,
        largest=largest,
        rigid=np.array(["size" in one.pin for one in job.asked]),
        kinds=kinds(job.items) if job.plan.keeps_apart else np.arange(len(job.items)),
        zones=tuple(region.zone for region in job.regions),
    )


def held_to(limits: Limits, poses: Poses) -> Poses:
    """Poses changed no more than it takes to keep the limits of their own values."""
    x, y, angle = (
        np.where(np.isnan(given), own, given)
        for given, own in (
            (limits.x, poses.x), (limits.y, poses.y), (limits.angle, poses.angle)
        )
    )  # fmt: skip
    angle = np.clip(angle, -limits.turn_limit, limits.turn_limit)
    scale = np.clip(poses.scale, limits.smallest, limits.largest)
    return Poses(x, y, angle, scale, np.where(limits.rigid, 1.0, poses.stretch))


def check_poses(job: Job, container: Container, poses: Poses, limits: Limits) -> None:
    """Refuse what no solve can keep to."""
    homes = {int(k): region for region in job.regions for k in region.zone.items}
    for k, one in enumerate(job.asked):
        if not one.pin:
            continue
        home, words = container.outline.region, "the container"
        if k in homes:
            home = intersection(home, homes[k].zone.outline.region)
            words = f"its region {homes[k].words}"
        _check_place(job, k, home, words, limits)
        if "size" in one.pin:
            _check_room(job, k, home, words, poses, limits)
    _check_pairs(job, poses, limits)


def _check_place(job: Job, k: int, home: Region, words: str, limits: Limits) -> None:
    """The point or the line that an item is pinned to, against the room it has."""
    one, name = job.asked[k], job.items[k].name
    x, y = float(limits.x[k]), float(limits.y[k])
    if one.is_placed and not shapely.intersects_xy(prepared(home), x, y):
        raise one.sources["pin.x"].error(f"pins {name} at {x:g}, {y:g}, outside {words}")
    low, high = -job.container.side, 2 * job.container.side
    for axis, ends in (("x", [(x, low), (x, high)]), ("y", [(low, y), (high, y)])):
        if axis in one.pin and not shapely.LineString(ends).intersects(home):
            at = x if axis == "x" else y
            raise one.sources[f"pin.{axis}"].error(
                f"pins {name} at {axis} = {at:g}, outside {words}"
            )


def _check_room(job: Job, k: int, home: Region, words: str, poses: Poses, limits: Limits) -> None:
    """The size that an item is pinned to, against the room it has."""
    one, item = job.asked[k], job.items[k]
    area = item.outline.area * float(poses.scale[k]) ** 2
    beyond = max(area - home.area, 0.0)
    if one.is_placed and not np.isnan(limits.angle[k]):
        placed = item.outline.mapped(poses.matrix(k)).region
        beyond = difference(placed, home).area
    if beyond > STICKS_OUT * area:
        share = f"{100 * beyond / area:.2g} % of it lies outside {words}"
        raise one.sources["pin.size"].error(
            f"pins {item.name} so that {share}; make it smaller or move it"
        )


def _check_pairs(job: Job, poses: Poses, limits: Limits) -> None:
    """Items that are pinned to points, against each other at their smallest."""
    pinned = [k for k, one in enumerate(job.asked) if one.is_placed]
    least = replace(poses, scale=np.where(limits.smallest > 0, limits.smallest, poses.scale))
    regions = {k: job.items[k].outline.mapped(least.matrix(k)).region for k in pinned}
    for a, b in combinations(pinned, 2):
        shared = intersection(regions[a], regions[b]).area
        allowed = STICKS_OUT if limits.held[[a, b], :4].all() else COVERED
        if shared > allowed * min(regions[a].area, regions[b].area):
            source, other = (job.asked[k].sources["pin.x"] for k in (b, a))
            first = "" if other == source else f" of {(other.place or other.key).strip(' :')}"
            raise source.error(
                f"pins {job.items[b].name} onto {job.items[a].name}{first}; move one of them"
            )


def _scale_ranges(
    job: Job, nominal: FloatArray, scales: FloatArray
) -> tuple[FloatArray, FloatArray]:
    plan = job.plan
    finest = largest_scales(job)
    if plan.sizes == "fixed":
        return scales.copy(), scales.copy()
    ranges = np.full((len(nominal), 2), (1 / plan.size_ratio, plan.size_ratio))
    if plan.sizes == "shared":
        ranges[:] = (0.0, np.inf)
    for k, one in enumerate(job.asked):
        ranges[k] = one.values.get("scale", ranges[k])
        if "size" in one.pin:
            ranges[k] = 1.0
    smallest, largest = nominal * ranges[:, 0], nominal * ranges[:, 1]
    if plan.sizes == "free":
        most = np.minimum(_below_the_hero(job, nominal), finest)
        smallest, largest = np.minimum(smallest, most), np.minimum(largest, most)
    return smallest, largest


def _below_the_hero(job: Job, nominal: FloatArray) -> FloatArray:
    """``(n,)`` scales at which items stay well below the hero, if there is one."""
    extents = np.array([item.outline.extent for item in job.items])
    heroes = [one.sources.get("pin.size", RuleSource("")).key == "hero" for one in job.asked]
    sizes = (nominal * extents)[heroes]
    return np.where(heroes, np.inf, np.min(LEAD * sizes, initial=np.inf) / extents)


def _places(job: Job, axis: str, whole: float) -> FloatArray:
    unit = job.container.unit
    return np.array(
        [
            parse_length(str(one.pin[axis]), unit, whole) if axis in one.pin else np.nan
            for one in job.asked
        ]
    )


BEARABLE = 0.2
"""Padding that is proposed, over the side of an item's share of the container. Larger leaves
items that can hardly be seen. Chosen."""

MOST_STUCK = 0.5
"""Share of the items that may have found no room and the layout be shown all the same. Larger
shows specks, smaller refuses what could be mended by hand. Chosen."""


def padded(container: Container, padding: float) -> Container:
    """Container drawn in by half the padding; the items' own margins are the other half.

    A tile stays as it is: about it lies the next one.
    """
    if container.lattice is not None:
        return container
    return replace(container, outline=grown(container.outline, -padding / 2))


def check_padding(container: Container, padding: float, count: int, whose: str = "") -> None:
    """Refuse a padding with which not even items as small as points could be placed.

    Points that keep a distance from each other are centres of discs of half that size, which
    do not overlap and keep half of it from the edge; their area cannot be more than there is.

    Parameters
    ----------
    padding
        Canvas units.
    whose
        What is said of the container; `` of a group`` for one of several.

    Examples
    --------
    >>> from packwork.geometry.outline import Outline
    >>> tile = Outline.from_rings([np.array([[0.0, 0], [100, 0], [100, 100], [0, 100]])])
    >>> square = Container("square", "square", tile, 100.0, 100.0)
    >>> check_padding(square, 10.0, 25)
    >>> check_padding(square, 20.0, 25)
    Traceback (most recent call last):
    packwork.errors.RecipeError: padding: 20 px is too much for 25 items: ...
    """
    if padding <= 0:
        return
    unit, outline = container.unit, container.outline
    if grown(outline, -padding) is outline:
        raise RecipeError(
            "padding",
            f"{padding:g} {unit} leaves nothing of the container{whose}; use a smaller one, "
            "or a larger canvas",
        )
    if count * np.pi * (padding / 2) ** 2 > grown(outline, -padding / 2).area:
        raise too_much_padding(container, padding, count, "even as points they would not find room")


def check_found(
    container: Container, padding: float, conflicts: Sequence[Conflict], count: int
) -> None:
    """Refuse a padding with which most items found no room, however small they were made."""
    stuck = len({found.item for found in conflicts})
    if padding > 0 and stuck > MOST_STUCK * count:
        why = f"{stuck} of {count} found no room, however small"
        raise too_much_padding(container, padding, count, why)


def too_much_padding(container: Container, padding: float, count: int, why: str) -> RecipeError:
    """Error that says why there is no room with a padding, and which one would do."""
    unit, better = container.unit, BEARABLE * np.sqrt(container.outline.area / count)
    return RecipeError(
        "padding",
        f"{padding:g} {unit} is too much for {number_of(count, 'item')}: {why}; "
        f"use {better:.2g} {unit} or less, or fewer items",
    )
