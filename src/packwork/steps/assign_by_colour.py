"""Seating: items change places until their colours fit a picture best.

An optimal assignment (D. F. Crouse, "On implementing 2D rectangular assignment algorithms", IEEE
Transactions on Aerospace and Electronic Systems 52 (2016), 1679-1696,
doi:10.1109/TAES.2016.140952) of items to the places that the levels found, by the squared distance
of an item's colour from the picture's in its place, and by how unlike its box is to the box of what
lay there. Pairs then exchange their places as long as neighbours together come nearer to the
picture, each a patch of nine colours. Afterwards the exact finish makes room for what differs.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import final

import numpy as np

from packwork.arrays import FloatArray, IntArray
from packwork.assignment.orders import GRID, order_by_colour
from packwork.assignment.quadratic import cheapest
from packwork.geometry.simplify import hull_areas
from packwork.pipeline.job import Job
from packwork.pipeline.state import RunContext, RunState, RunStep
from packwork.scene.contrast import oklabs_of_light
from packwork.scene.item import Item
from packwork.scene.pose import Poses
from packwork.scene.swatch import mean_lights, patch_of
from packwork.scene.target import TargetPicture, blurred
from packwork.steps.exchanges import shape_features, with_places_of

UNLIKE = 0.06
"""What the squared logarithm of a factor in shape weighs beside squared distances in Oklab. Larger
keeps the layout as it was, smaller finds better colours and disturbs it more. Tried."""

SMOOTH = 0.8
"""Side of the squares over which the picture is averaged at a place, over that of an item's share
of the canvas. Chosen."""

PRICE = 0.3
"""The same beside distances, where pairs exchange their places. Tried."""

BLUR, BLURS = 1.0, 3
"""Side of the squares over which a layout is averaged that is seen from afar, over that of an
item's share of the canvas, and how often. Chosen."""

FEWEST = 2
"""Items that may change places at least."""


@final
class AssignByColour(RunStep):
    """Items in those of their places in which their colours show a picture best.

    Items that keep nothing of their colours, and those of which rules ask anything, stay.
    """

    def __init__(self, target: TargetPicture) -> None:
        self._target = target

    def run(self, state: RunState, context: RunContext) -> RunState:
        """State with places given out anew."""
        job, poses = state.job, state.poses
        movable = job.seated
        if len(movable) < FEWEST:
            return state
        order = _order(job, poses.subset(movable), movable, self._target)
        return replace(state, poses=with_places_of(job, poses, movable, movable[order]))


def _order(job: Job, places: Poses, movable: IntArray, target: TargetPicture) -> IntArray:
    """Assignment of the movable items to their places."""
    items = [job.items[k] for k in movable]
    own = oklabs_of_light(mean_lights(items))
    wanted = oklabs_of_light(_light_at(target, places, len(job.items)))
    away = ((own[None] - wanted[:, None]) ** 2).sum(axis=2)
    own_shapes = shape_features(job, movable)
    unlike = ((own_shapes[None] - own_shapes[:, None]) ** 2).sum(axis=2)
    weights = (hull_areas([one.outline for one in items]) * places.scale**2)[:, None]
    order = cheapest((away + UNLIKE * unlike) * weights)
    if job.tints[movable].any():
        # What takes on a part of the picture makes up for its neighbours by that.
        return order
    return _exchanged(job, places, items, order, target, np.sqrt(PRICE) * own_shapes)


def _exchanged(
    job: Job,
    places: Poses,
    items: Sequence[Item],
    order: IntArray,
    target: TargetPicture,
    forms: FloatArray,
) -> IntArray:
    """Order of items after exchanges by what neighbours show together."""
    container, count = job.container, len(job.items)
    boxes = np.array([one.outline.bounds for one in items])
    sides = (boxes[:, 2:] - boxes[:, :2]) * places.scale[:, None]
    light = target.light
    for _ in range(BLURS):
        light = blurred(light, BLUR, count)
    # The standard deviation of so many averages over squares.
    spread = BLUR * np.sqrt(container.width * container.height / count * BLURS / 12)
    return order_by_colour(
        order,
        np.column_stack([places.x, places.y, places.angle]),
        sides,
        np.array([patch_of(one, GRID) for one in items]),
        _looked_up(light, target.px_per_cu, places),
        forms,
        float(spread),
        np.random.default_rng(job.plan.seed),
    )


def _light_at(target: TargetPicture, places: Poses, count: int) -> FloatArray:
    """``(n, 3)`` light of the picture about each place."""
    return _looked_up(blurred(target.light, SMOOTH, count), target.px_per_cu, places)


def _looked_up(light: FloatArray, px_per_cu: float, places: Poses) -> FloatArray:
    """``(n, 3)`` light of an image at the middle of each place."""
    most = np.array(light.shape[1::-1]) - 1
    at = np.column_stack([places.x, places.y]) * px_per_cu
    x, y = np.clip(at.astype(np.int64), 0, most).T
    return np.asarray(light[y, x])
