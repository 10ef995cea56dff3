"""Items in an order along a way: by weight, hue, lightness, name or the numbers of a file.

First places are given out anew by an optimal assignment (Crouse 2016, as in
``steps.assign_by_colour``): each item has a share along the way, that of the area of all that come
before it, and so has each place; their squared difference is least in sum. Levels and finish then
keep every item about there.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import final

import numpy as np

from packwork.arrays import FloatArray, IntArray
from packwork.assignment.quadratic import cheapest
from packwork.errors import ReadError, RecipeError
from packwork.fields.distance_transform import lengthwise
from packwork.geometry.simplify import hull_areas
from packwork.pipeline.job import Job
from packwork.pipeline.state import RunContext, RunState, RunStep
from packwork.readers.tables.pairs import read_pairs
from packwork.recipe.order import FILES, MEASURES, Ordering, parse_arrangement
from packwork.scene.container import Container
from packwork.scene.contrast import oklabs_of_light
from packwork.scene.pose import Poses
from packwork.scene.swatch import mean_lights
from packwork.start.first_fit.preferences import Homes
from packwork.start.first_poses import container_image
from packwork.steps.exchanges import even_points, shape_features, with_places_of

UNLIKE, UNLIKE_SIZE = 0.01, 0.03
"""What squared logarithms of a factor in shape, and where sizes are given in size, weigh beside
squared shares of the way. Larger keeps the first places better, smaller the order. Tried."""

HOMEWARD = 40.0
"""Score that an item gives for lying the canvas' side nearer to its own point, where it is put by
itself. Larger keeps the order no better, smaller worse. Tried."""

WAY_PX = 160
"""Pixels on the longer side of the image in which ways along the container are found. Larger
takes longer and parts lines that lie closer. Chosen."""

LEAST_INSIDE = 0.5
"""Coverage from which a pixel is a part of the way. Larger parts thin lines. Chosen."""

GREY = 0.02
"""Chroma in Oklab below which a colour has no hue that is seen. Chosen."""


def with_order(job: Job) -> Job:
    """The job with the numbers of its order, which is refused if it has no meaning."""
    recipe = job.recipe
    if recipe.arrange is None:
        return job
    if recipe.chart is not None or recipe.pile is not None:
        raise RecipeError("arrange", "is for items that fill a container; leave it out here")
    if job.target is not None:
        raise RecipeError("arrange", "and --picture both say where items lie; use one of them")
    by = parse_arrangement(recipe.arrange).by
    if by in {"hue", "lightness"} and recipe.palette is not None:
        raise RecipeError(
            "arrange", f"goes by the {by} of items' own colours, and --palette gives them others"
        )
    if by not in MEASURES and by.lower().endswith(FILES):
        job = replace(job, numbers=_of_file(job, by))
    measured(job, by)
    return job


def measured(job: Job, by: str) -> FloatArray:
    """``(n,)`` what items are put in order by; NaN for grey where that is hue."""
    if job.numbers is not None:
        values = np.array([job.numbers[item.name] for item in job.items])
    elif by not in MEASURES:
        values = job.use.column(job, by)
    elif by == "weight":
        values = job.weights
    elif by == "name":
        names = [item.name.casefold() for item in job.items]
        values = np.unique(names, return_inverse=True)[1].astype(np.float64)
    else:
        lightness, *ab = oklabs_of_light(mean_lights(job.items)).T
        hue = np.where(np.hypot(*ab) < GREY, np.nan, np.arctan2(ab[1], ab[0]))
        values = lightness if by == "lightness" else hue
    known = values[np.isfinite(values)]
    if len(known) == 0 or (len(values) > 1 and np.ptp(known) < 1e-9):
        what = "are all grey" if len(known) == 0 else f"all have the same {by}"
        raise RecipeError("arrange", f"the items {what}, which gives no order; use another measure")
    return np.asarray(values, dtype=np.float64)


def assign_in_order(job: Job, poses: Poses, nominal: FloatArray) -> Poses:
    """First poses given out anew, so that items lie in the order asked for.

    Items that rules put somewhere stay; the others take each other's places and angles and, where
    sizes are free, sizes of hull as far as they may.
    """
    asked = parse_arrangement(job.recipe.arrange or "")
    is_put = [bool(one.pin) or "region" in one.values for one in job.asked]
    movable = np.flatnonzero(np.logical_not(is_put))
    if len(movable) < 2:
        return poses
    changed = with_places_of(job, poses, movable, movable[_order(job, asked, poses, movable)])
    if job.plan.sizes != "free":
        return replace(changed, angle=poses.angle, scale=poses.scale)
    ratio = job.plan.size_ratio
    scale = np.clip(changed.scale, nominal / ratio, nominal * ratio)
    is_limited = bool(job.is_limited)
    return replace(changed, angle=poses.angle, scale=poses.scale if is_limited else scale)


def homes_in_order(job: Job, region: Container, rng: np.random.Generator) -> Homes | None:
    """Homes of items that are put one by one; None if anywhere will do.

    Points spread evenly over the container, in the order asked for.
    """
    if job.recipe.arrange is None or not job.plan.keeps_order:
        return None
    asked, everything = parse_arrangement(job.recipe.arrange), np.arange(len(job.items))
    points = even_points(region, len(everything), rng)
    away = _away(job, asked, points, np.ones(len(points)), job.weights, everything)
    homes = np.empty_like(points)
    homes[cheapest(away)] = points
    return Homes.of(homes, HOMEWARD)


def _order(job: Job, asked: Ordering, poses: Poses, movable: IntArray) -> IntArray:
    """Assignment of the movable items to their places."""
    hulls = hull_areas([job.items[k].outline for k in movable])
    areas = hulls * poses.scale[movable] ** 2
    points = np.column_stack([poses.x, poses.y])[movable]
    away = _away(job, asked, points, areas, areas, movable)
    own = shape_features(job, movable)
    unlike = UNLIKE * ((own[None] - own[:, None]) ** 2).sum(axis=2)
    if job.plan.sizes != "free":
        sizes = np.log(areas) / 2
        unlike = unlike + UNLIKE_SIZE * (sizes[None] - sizes[:, None]) ** 2
    return cheapest(away + unlike)


def _away(
    job: Job,
    asked: Ordering,
    points: FloatArray,
    rooms: FloatArray,
    areas: FloatArray,
    items: IntArray,
) -> FloatArray:
    """``(places, items)`` squared distances of places from where items had better lie.

    Parameters
    ----------
    points, rooms
        ``(places, 2)`` and areas of the places.
    """
    values = measured(job, asked.by)[items]
    middle = np.array([*job.container.outline.centroid])
    off = points - middle
    if asked.way == "around":
        return _away_around(job, asked, values, off, rooms, areas, items)
    values = np.where(np.isfinite(values), values, np.nanmin(values) - 1.0)
    along = _lengthwise(job, points) if asked.way == "along" else _along(asked, off)
    return np.asarray((_shares(values, areas)[None] - _shares(along, rooms)[:, None]) ** 2)


def _along(asked: Ordering, off: FloatArray) -> FloatArray:
    """``(n,)`` how far along the way places lie, by their way from the middle ``(n, 2)``."""
    if asked.way == "right":
        turn = math.radians(asked.angle)
        return np.asarray(off @ np.array([math.cos(turn), math.sin(turn)]))
    away = np.hypot(off[:, 0], off[:, 1])
    return np.asarray(away if asked.way == "outwards" else -away)


def _lengthwise(job: Job, places: FloatArray) -> FloatArray:
    """``(n,)`` how far inside the container places ``(n, 2)`` lie from one of its ends, pixels."""
    # Needed for such arrangements alone.
    from scipy.spatial import cKDTree

    image, px_per_cu = container_image(job.container, WAY_PX)
    inside = image > LEAST_INSIDE
    away = lengthwise(inside)
    rows, columns = np.nonzero(inside)
    pixels = cKDTree(np.column_stack([columns, rows]) + 0.5)
    _, nearest = pixels.query(places * px_per_cu)
    return np.asarray(away[rows, columns][nearest])


def _away_around(
    job: Job,
    asked: Ordering,
    values: FloatArray,
    off: FloatArray,
    rooms: FloatArray,
    areas: FloatArray,
    movable: IntArray,
) -> FloatArray:
    """``(places, items)`` squared distances on a disc that all places and all items fill evenly.

    By hue the dull lie within the vivid, as on a colour wheel; what has no hue lies in the middle.
    """
    place = np.sqrt(_shares(np.hypot(off[:, 0], off[:, 1]), rooms))
    at = place * np.exp(1j * np.arctan2(off[:, 1], off[:, 0]))
    is_known = np.isfinite(values)
    turns = np.zeros(len(values))
    turns[is_known] = _shares(values[is_known], areas[is_known])
    # From the top, clockwise.
    wanted = np.exp(2j * np.pi * turns - 0.5j * np.pi)
    if asked.by != "hue":
        return np.asarray(np.abs(wanted[None] * place[:, None] - at[:, None]) ** 2)
    _, *ab = oklabs_of_light(mean_lights([job.items[k] for k in movable])).T
    vivid = np.where(is_known, np.sqrt(_shares(np.hypot(*ab), areas)), 0.0)
    return np.asarray(np.abs((vivid * wanted)[None] - at[:, None]) ** 2)


def _shares(values: FloatArray, areas: FloatArray) -> FloatArray:
    """``(n,)`` share of all area that comes before each, and half of its own.

    Examples
    --------
    >>> _shares(np.array([3.0, 1.0, 2.0]), np.array([2.0, 1.0, 1.0])).tolist()
    [0.75, 0.125, 0.375]
    """
    order = np.argsort(values, kind="stable")
    own = areas[order] / areas.sum()
    found = np.empty(len(values))
    found[order] = np.cumsum(own) - own / 2
    # What is alike in value is alike in share.
    _, group = np.unique(values, return_inverse=True)
    means = np.bincount(group, found * areas) / np.bincount(group, areas)
    return np.asarray(means[group])


def _of_file(job: Job, file: str) -> dict[str, float]:
    rows = read_pairs(file, job.recipe).rows
    table: dict[str, float] = {}
    for row in rows:
        if not row.name or not math.isfinite(row.number):
            raise ReadError(file, f"{row.where}: needs a name and a number, as in bear,2")
        if table.setdefault(row.name, row.number) != row.number:
            raise ReadError(file, f"{row.where}: gives {row.name[:40]!r} another number")
    missing = [item.name for item in job.items if item.name not in table]
    if missing:
        there = ", ".join(list(table)[:6]) or "none"
        raise RecipeError(
            "arrange", f"{file} has no number for {missing[0][:40]!r}; there are {there}"
        )
    return table


@final
class AssignInOrder(RunStep):
    """Items change places so that they lie in the order asked for."""

    def run(self, state: RunState, context: RunContext) -> RunState:
        """State with places given out anew."""
        with state.job.clock.time("start"):
            return replace(state, poses=assign_in_order(state.job, state.poses, state.nominal))
