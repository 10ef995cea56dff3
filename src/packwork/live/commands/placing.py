"""Commands that put items elsewhere."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Annotated, Literal, TypeAlias

import numpy as np
from pydantic import Field

from packwork.errors import RecipeError
from packwork.live.commands.command import (
    FARTHEST,
    Command,
    ItemId,
    ItemIds,
    Library,
    Number,
    check_may_size,
    index_of,
    nearest_angle,
    sized,
)
from packwork.live.document import PROPERTIES, Document
from packwork.scene.pose import Poses

NEARLY = 1.1
"""By how much an item that was given a size may be larger or smaller than that. Chosen."""


Size: TypeAlias = Annotated[Number, Field(gt=0)]


class Move(Command):
    """Put an item's middle somewhere."""

    kind: Literal["move"] = "move"
    item: ItemId
    x: Number
    """Canvas units."""
    y: Number
    """As above, down."""

    def applied(self, document: Document, library: Library) -> Document:
        """The document with the item there."""
        k = index_of(document, self.item, "move")
        if max(abs(self.x), abs(self.y)) > FARTHEST * document.container.side:
            raise RecipeError("move", f"{self.x:g}, {self.y:g} is nowhere near the canvas")
        return _posed(document, k, x=self.x, y=self.y)

    def places(self, document: Document) -> tuple[int, ...]:
        """The item."""
        return (self.item,)

    @property
    def keeps_places(self) -> tuple[int, ...]:
        """The item."""
        return (self.item,)


class Turn(Command):
    """Turn an item to an angle."""

    kind: Literal["turn"] = "turn"
    item: ItemId
    angle: Number
    """Degrees from upright, clockwise; where only some are allowed, the nearest of these is had."""

    def applied(self, document: Document, library: Library) -> Document:
        """The document with the item turned."""
        k = index_of(document, self.item, "turn")
        angle = math.radians(math.fmod(self.angle, 360.0))
        return _posed(document, k, angle=nearest_angle(document, k, angle))


class Scale(Command):
    """Make an item larger or smaller; it then keeps about that size."""

    kind: Literal["scale"] = "scale"
    item: ItemId
    factor: Annotated[Number, Field(ge=0.01, le=100)]

    def applied(self, document: Document, library: Library) -> Document:
        """The document with the item of another size."""
        k = index_of(document, self.item, "scale")
        check_may_size(document, "scale")
        scale = float(document.poses.scale[k]) * self.factor
        smallest, largest = document.smallest.copy(), document.largest.copy()
        is_free = document.options.sizes == "free"
        smallest[k] = scale / NEARLY if is_free else scale
        largest[k] = scale * NEARLY if is_free else scale
        weights = document.weights.copy()
        if document.options.sizes == "shared":
            # Sizes stay in the shares that are asked for, so another one is asked for.
            weights[k] *= self.factor**2
        document = replace(document, smallest=smallest, largest=largest, weights=weights)
        return sized(_posed(document, k, scale=scale), "scale")

    @property
    def keeps_angles(self) -> tuple[int, ...]:
        """The item."""
        return (self.item,)


class Cover(Command):
    """Make all items larger or smaller, so that they cover that share of the container."""

    kind: Literal["cover"] = "cover"
    share: Annotated[Number, Field(gt=0, lt=1)]

    def applied(self, document: Document, library: Library) -> Document:
        """The document with all items of other sizes but those whose size is held."""
        check_may_size(document, "cover")
        free = ~document.held[:, PROPERTIES.index("size")]
        areas = document.areas
        left = self.share * document.container.outline.area - areas[~free].sum()
        if not free.any() or left <= 0:
            raise RecipeError("cover", "items whose size is held cover more already; release some")
        scale = document.poses.scale * np.where(free, np.sqrt(left / areas[free].sum()), 1.0)
        document = replace(
            document,
            poses=replace(document.poses, scale=scale),
            smallest=np.where(free, np.minimum(document.smallest, scale), document.smallest),
            # Larger they would cover more than was asked for.
            largest=np.where(free, scale, document.largest),
        )
        return sized(document, "cover")


class Exchange(Command):
    """Let two items change places; each becomes as large as the other was."""

    kind: Literal["exchange"] = "exchange"
    first: ItemId
    second: ItemId

    def applied(self, document: Document, library: Library) -> Document:
        """The document with the two exchanged."""
        i, j = (index_of(document, one, "exchange") for one in (self.first, self.second))
        if i == j:
            raise RecipeError("exchange", "takes two different items")
        poses, areas = document.poses, document.own_areas
        here, there = np.array([i, j]), np.array([j, i])
        other = poses.subset(there)
        scale = poses.scale[here]
        if document.options.sizes == "free":
            scale = other.scale * np.sqrt(areas[there] / areas[here])
        changed = replace(poses.subset(here), x=other.x, y=other.y, scale=scale)
        return sized(document.with_poses(poses.with_some(here, changed)), "exchange")

    @property
    def keeps_places(self) -> tuple[int, ...]:
        """Both."""
        return (self.first, self.second)


class Arrange(Command):
    """Put many items elsewhere at once, as another run has them; what is held stays."""

    kind: Literal["arrange"] = "arrange"
    items: ItemIds
    poses: Annotated[tuple[tuple[Number, Number, Number, Size], ...], Field(min_length=1)]
    """Of each: x and y of its middle, degrees clockwise, scale."""

    def applied(self, document: Document, library: Library) -> Document:
        """The document with the items there, sizes as free about them as before."""
        if len(self.items) != len(self.poses) or len(set(self.items)) != len(self.items):
            raise RecipeError("arrange", "give one pose for each item, and each item once")
        rows = np.array([index_of(document, number, "arrange") for number in self.items])
        asked = np.array(self.poses)
        if np.abs(asked[:, :2]).max() > FARTHEST * document.container.side:
            raise RecipeError("arrange", "a place is nowhere near the canvas")
        kept, held = document.poses.subset(rows), document.held[rows]
        made = replace(
            kept,
            x=np.where(held[:, 0], kept.x, asked[:, 0]),
            y=np.where(held[:, 0], kept.y, asked[:, 1]),
            angle=np.where(held[:, 1], kept.angle, np.radians(np.fmod(asked[:, 2], 360.0))),
            scale=np.where(held[:, 2], kept.scale, asked[:, 3]),
        )
        moved = sized(document.with_poses(document.poses.with_some(rows, made)), "arrange")
        return moved.with_ranges(moved.options)


def _posed(document: Document, k: int, **values: float) -> Document:
    poses: Poses = document.poses
    columns = {name: getattr(poses, name).copy() for name in values}
    for name, value in values.items():
        columns[name][k] = value
    return document.with_poses(replace(poses, **columns))
