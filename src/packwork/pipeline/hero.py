"""Place of a hero that was given none: where the container is widest about it, before all others.

The size is given, so each angle has its own set of feasible places: the container eroded by the
item (J. Serra, "Image Analysis and Mathematical Morphology", Academic Press 1982), here of images,
by a Fourier transform. Upright comes first, then the least turn at which there is a place; of the
places the one farthest from the edge of the set, refined in exact geometry.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import shapely

from packwork.arrays import BoolArray, FloatArray
from packwork.fields.distance_transform import distance_inside
from packwork.geometry import affine
from packwork.geometry.outline import Outline
from packwork.geometry.overlay import buffered, difference
from packwork.geometry.polygon import Region
from packwork.pipeline.job import Job
from packwork.pipeline.plan.copies import ItemRules, RuleSource
from packwork.pipeline.plan.limits import pinned_scales
from packwork.raster.membership import centre_count
from packwork.recipe.rules import Pin, Rotation, Rule
from packwork.units import parse_length

RESOLUTION = 160
"""Pixels on the canvas's longer side. More find narrower places and take longer by their square.
Chosen."""

TURN = 15.0
"""Degrees between angles that are tried. Smaller finds a few more places and takes longer.
Chosen."""

MARGIN = 1e-3
"""Share of the canvas's side that is kept to the container's edge. Larger refuses what just fits,
smaller leaves nothing to the digits that are written. Chosen."""

NEARLY = 0.03
"""Share of the item outside at a place of the image from which an exact one is looked for nearby.
Larger looks in vain, smaller misses places as narrow as a pixel. Chosen."""

STEPS = (2.0, 1.0, 0.5, 0.25, 0.1)
"""Pixels that a place is moved by in turn while more of the item comes to lie inside. Chosen."""

HERO = RuleSource("hero")

_AROUND = [(math.cos(turn), math.sin(turn)) for turn in np.arange(8) * math.pi / 4]


def placed_hero(job: Job) -> Job:
    """The job, its hero pinned to the best place at its size where it was given none.

    Where all items are of the hero's kind, one of them is the hero. Words are not looked at.
    """
    heroes = [k for k, one in enumerate(job.asked) if one.sources.get("pin.size") == HERO]
    if not heroes or job.earlier is not None or job.items[heroes[0]].text is not None:
        return job
    if any(job.asked[k].is_put for k in heroes):
        return job
    asked = list(job.asked)
    for k in heroes[1:]:
        asked[k] = _plain(asked[k])
    job = replace(job, asked=tuple(asked))
    found = _place(job, heroes[0])
    if found is not None:
        x, y, angle = found
        pin = Pin(x=f"{x:.9f}", y=f"{y:.9f}", angle_deg=math.degrees(angle))
        asked[heroes[0]] = asked[heroes[0]].merged(Rule(items=("*",), pin=pin), HERO)
    return replace(job, asked=tuple(asked))


def _plain(one: ItemRules) -> ItemRules:
    """The same without what makes it the hero."""
    pin = {key: v for key, v in one.pin.items() if one.sources.get(f"pin.{key}") != HERO}
    return replace(one, pin=pin, sources={k: v for k, v in one.sources.items() if v != HERO})


def _place(job: Job, k: int) -> tuple[float, float, float] | None:
    """Middle and angle of an item whose size is given; None where it fits nowhere."""
    container, scales = job.container, pinned_scales(job)
    free = buffered(container.outline.region, -job.plan.gap - MARGIN * container.side)
    for j, one in enumerate(job.asked):
        if one.is_placed and j != k:
            free = difference(free, _about(job, j, float(np.nan_to_num(scales[j]))))
    if free.is_empty:
        return None
    shapely.prepare(free)
    px = container.side / RESOLUTION
    inside = _image(Outline.of(free), px, _shape(container.width, container.height, px))
    for angle in _angles(job.asked[k].rotation or job.plan.rotation):
        turn = affine.similarity(0.0, 0.0, angle, float(scales[k]))
        turned = job.items[k].outline.mapped(turn)
        place = _widest_place(inside, turned, px)
        if place is not None and (exact := _refined(free, turned.region, place, px)) is not None:
            return *exact, angle
    return None


def _about(job: Job, j: int, scale: float) -> Region:
    """Room of an item that is pinned to a point: a disc of its size, if that is given."""
    one, container = job.asked[j].pin, job.container
    x = parse_length(str(one["x"]), container.unit, container.width)
    y = parse_length(str(one["y"]), container.unit, container.height)
    radius = max(scale * job.items[j].outline.extent / 2, job.plan.gap, MARGIN)
    return buffered(shapely.Point(x, y), radius)


def _angles(rotation: Rotation) -> Iterator[float]:
    """Angles that an item may have, radians, the least turn first."""
    if rotation.choices is not None:
        yield from sorted(rotation.choices, key=abs)
        return
    for step in range(round(180 / TURN) + 1):
        turn = math.radians(step * TURN)
        if turn <= rotation.farthest + 1e-9:
            yield from dict.fromkeys((turn, -turn))


def _shape(width: float, height: float, px: float) -> tuple[int, int]:
    return math.ceil(height / px), math.ceil(width / px)


def _image(outline: Outline, px: float, shape: tuple[int, int]) -> BoolArray:
    return np.asarray(centre_count(outline.points / px, outline.starts, shape) > 0)


def _widest_place(inside: BoolArray, turned: Outline, px: float) -> FloatArray | None:
    """Place ``(x, y)`` of an item's middle, about which it has most room; None if it has none.

    Parameters
    ----------
    inside
        Pixels ``(rows, columns)`` of the container.
    turned
        The item at its angle and size, its middle at the origin.
    """
    left, top, right, bottom = turned.bounds
    shape = _shape(right - left, bottom - top, px)
    if shape[0] > inside.shape[0] or shape[1] > inside.shape[1]:
        return None
    shifted = turned.mapped(affine.similarity(-left, -top, 0.0, 1.0))
    item = _image(shifted, px, shape)
    # Circular: what runs over the far edges is cut off below.
    spectrum = np.fft.rfft2(~inside) * np.conj(np.fft.rfft2(item, inside.shape))
    outside = np.fft.irfft2(spectrum, inside.shape)
    rows, columns = inside.shape[0] - shape[0] + 1, inside.shape[1] - shape[1] + 1
    outside = outside[:rows, :columns] / max(int(item.sum()), 1)
    if outside.min() > NEARLY:
        return None
    depth = distance_inside(outside < 0.5 / max(int(item.sum()), 1))
    best = depth - outside if depth.any() else -outside
    row, column = np.unravel_index(int(best.argmax()), best.shape)
    return np.array([column * px - left, row * px - top])


def _refined(
    free: Region, item: Region, place: FloatArray, px: float
) -> tuple[float, float] | None:
    """A place nearby at which nothing sticks out; None if none is found."""

    def beyond(x: float, y: float) -> float:
        moved = shapely.transform(item, lambda points: points + np.array([x, y]))
        return 0.0 if free.covers(moved) else float(difference(moved, free).area)

    x, y = (float(value) for value in place)
    least = beyond(x, y)
    for step in STEPS:
        is_better = True
        while least > 0 and is_better:
            tried = [(x + step * px * a, y + step * px * b) for a, b in _AROUND]
            found = [beyond(*one) for one in tried]
            is_better = min(found) < least
            if is_better:
                least = min(found)
                x, y = tried[found.index(least)]
    return (x, y) if least == 0 else None
