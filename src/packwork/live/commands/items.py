"""Commands that bring items, take them away or change what they are.

Also those that make one item of several, whose places to each other stay, and take it apart.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import Annotated, Literal, cast

import numpy as np
from pydantic import Field

from packwork.arrays import IntArray
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
    known,
    nearest_angle,
    sized,
    true_scale,
)
from packwork.live.document import PROPERTIES, Document
from packwork.live.file.records import Text
from packwork.recipe.rules import MAX_COUNT
from packwork.scene.colour import hex_colour, parse_colour
from packwork.scene.groups import grouped, of_each, parts_in_place, turned_over
from packwork.scene.item import MAX_LENGTH, Item, Label, Parts
from packwork.scene.pose import Poses
from packwork.scene.recolour import recoloured, with_own_art


class Group(Command):
    """Make one item of several: it settles, moves, turns and grows as one."""

    kind: Literal["group"] = "group"
    items: Annotated[tuple[ItemId, ...], Field(min_length=2)]

    def applied(self, document: Document, library: Library) -> Document:
        """The document with the group, the last of all; groups among the items are taken apart."""
        if document.kind.sizes is not None:
            raise RecipeError("group", "is not for charts and nests, whose items stand alone")
        rows = np.unique([index_of(document, number, "group") for number in self.items])
        parts = _joined_parts([_parts(document, k) for k in rows.tolist()])
        item, x, y = grouped(parts)
        weight, held = float(document.weights[rows].sum()), document.held[rows].all(axis=0)
        made = joined(document, item, Poses([x], [y]), weight)
        held = np.vstack([made.held[:-1], held])
        return without(replace(made, held=held), rows)


class Ungroup(Command):
    """Have the items of groups each by itself again, where they are."""

    kind: Literal["ungroup"] = "ungroup"
    items: ItemIds

    def applied(self, document: Document, library: Library) -> Document:
        """The document with their items, the last of all."""
        rows = np.unique([index_of(document, number, "ungroup") for number in self.items])
        made = document
        for k in rows.tolist():
            parts = _parts(document, k)
            if document.items[k].parts is None:
                raise RecipeError("ungroup", f"is for groups, and {document.items[k].name} is none")
            for place, (item, weight) in enumerate(zip(parts.items, parts.weights, strict=True)):
                pose = parts.poses.subset(np.array([place]))
                made = joined(made, item, pose, float(weight))
                held = np.vstack([made.held[:-1], document.held[k]])
                made = replace(made, held=held)
        return without(made, rows)


def _parts(document: Document, k: int) -> Parts:
    pose = document.poses.subset(np.array([k]))
    return parts_in_place(document.items[k], pose, float(document.weights[k]))


def _joined_parts(several: list[Parts]) -> Parts:
    poses = several[0].poses
    for one in several[1:]:
        poses = poses.followed_by(one.poses)
    items = tuple(item for one in several for item in one.items)
    return Parts(items, poses, np.concatenate([one.weights for one in several]))


OFFSET = 0.02
"""How far beside its original a copy is put, as a share of the canvas. Chosen."""


class Add(Command):
    """Bring one item more."""

    kind: Literal["add"] = "add"
    asset: str
    """Name of the item in the library."""
    x: Number
    """Where its middle is put, canvas units."""
    y: Number
    """As above, down."""
    area: Annotated[Number, Field(gt=0)]
    """How large it begins, squared canvas units."""
    angle: Number = 0.0
    """Degrees, clockwise."""
    weight: Annotated[Number, Field(ge=0)] | None = None
    """In the document's unit of weights; None for the item's own."""

    def applied(self, document: Document, library: Library) -> Document:
        """The document with the item, the last of all."""
        item = cast(Item, known(library.items, self.asset, "add"))
        if max(abs(self.x), abs(self.y)) > FARTHEST * document.container.side:
            raise RecipeError("add", f"{self.x:g}, {self.y:g} is nowhere near the canvas")
        scale = math.sqrt(self.area / item.outline.area)
        pose = Poses([self.x], [self.y], math.radians(self.angle), scale)
        weight = item.weight if self.weight is None else self.weight
        return sized(joined(document, item, pose, weight), "add")


class Duplicate(Command):
    """Bring a copy of an item, a little beside it or just where it is."""

    kind: Literal["duplicate"] = "duplicate"
    item: ItemId
    beside: Annotated[Number, Field(ge=0, le=1)] = OFFSET
    """How far beside it, right and down, as a share of the canvas."""

    def applied(self, document: Document, library: Library) -> Document:
        """The document with the copy, the last of all."""
        k = index_of(document, self.item, "duplicate")
        pose, beside = document.poses.subset(np.array([k])), self.beside * document.container.side
        pose = replace(pose, x=pose.x + beside, y=pose.y + beside)
        return joined(document, document.items[k], pose, float(document.weights[k]))

    def places(self, document: Document) -> tuple[int, ...]:
        """The copy that is left in its place; one beside it makes way for what it is a copy of."""
        return (self.item,) if self.beside else (document.next_id,)


class Remove(Command):
    """Take items away."""

    kind: Literal["remove"] = "remove"
    items: ItemIds

    def applied(self, document: Document, library: Library) -> Document:
        """The document without them; the others keep their numbers."""
        gone = [index_of(document, number, "remove") for number in self.items]
        if len(np.unique(gone)) == len(document):
            raise RecipeError("remove", "nothing would be left; keep one item at least")
        return without(document, np.array(gone))


class Replace(Command):
    """Put another item in an item's place, as large as it was; its number stays."""

    kind: Literal["replace"] = "replace"
    item: ItemId
    asset: str
    """Name of the new one in the library."""

    def applied(self, document: Document, library: Library) -> Document:
        """The document with the other item."""
        k = index_of(document, self.item, "replace")
        new = cast(Item, known(library.items, self.asset, "replace"))
        factor = math.sqrt(document.items[k].outline.area / new.outline.area)
        if (true := true_scale(document, new)) is not None:
            factor = true / float(document.poses.scale[k])
        return sized(_with_item(document.scaled(k, factor), k, new), "replace")


class Weigh(Command):
    """Give items another weight; they grow or shrink accordingly."""

    kind: Literal["weigh"] = "weigh"
    items: ItemIds
    weight: Annotated[Number, Field(gt=0)]

    def applied(self, document: Document, library: Library) -> Document:
        """The document with other weights and sizes."""
        check_may_size(document, "weigh")
        rows = [index_of(document, number, "weigh") for number in self.items]
        weights = document.weights.copy()
        before = np.where(weights[rows] > 0, weights[rows], 1.0)
        factor = np.sqrt(self.weight / before)
        weights[rows] = self.weight
        return sized(replace(document.scaled(rows, factor), weights=weights), "weigh")


class Rename(Command):
    """Give an item another name, in files and tooltips too."""

    kind: Literal["rename"] = "rename"
    item: ItemId
    name: Annotated[Text, Field(min_length=1, max_length=MAX_LENGTH)]

    def applied(self, document: Document, library: Library) -> Document:
        """The document with the name."""
        k = index_of(document, self.item, "rename")
        item = document.items[k]
        label = Label(self.name, item.label.link, item.label.title)
        return _with_item(document, k, replace(item, name=self.name, label=label))


class Recolour(Command):
    """Give items one colour."""

    kind: Literal["recolour"] = "recolour"
    items: ItemIds
    colour: str
    """Any CSS colour."""

    def applied(self, document: Document, library: Library) -> Document:
        """The document with the colour."""
        colour = hex_colour(parse_colour("recolor", self.colour))
        made: dict[Item, Item] = {}

        def put(item: Item) -> Item:
            return with_own_art(recoloured(item, colour), item)

        for number in self.items:
            k = index_of(document, number, "recolour")
            item = document.items[k]
            if item not in made:
                made[item] = of_each(item, put)
            document = _with_item(document, k, made[item])
        return document


class Flip(Command):
    """Turn items over, each about its middle."""

    kind: Literal["flip"] = "flip"
    items: ItemIds
    direction: Literal["horizontal", "vertical"] = "horizontal"
    """Which way they are seen mirrored; horizontal changes left and right."""

    def applied(self, document: Document, library: Library) -> Document:
        """The document with the items turned over, the parts of a nest noted as such."""
        made: dict[Item, Item] = {}
        half = 0.0 if self.direction == "horizontal" else math.pi
        angle = document.poses.angle.copy()
        for number in self.items:
            k = index_of(document, number, "flip")
            item = document.items[k]
            if item not in made:
                made[item] = turned_over(item)
            angle[k] = nearest_angle(document, k, math.remainder(half - angle[k], math.tau))
            document = _with_item(document, k, made[item])
        manifest = document.kind.turned_over(document.manifest, self.items)
        poses = replace(document.poses, angle=angle)
        return replace(document, poses=poses, manifest=manifest)

    @property
    def keeps_angles(self) -> tuple[int, ...]:
        """The items."""
        return self.items


_COLUMNS = ("ids", "weights", "smallest", "largest", "held")


def without(document: Document, rows: IntArray) -> Document:
    """The document without the items of some rows."""
    left = np.setdiff1d(np.arange(len(document)), rows)
    return replace(
        document,
        items=tuple(document.items[k] for k in left),
        poses=document.poses.subset(left),
        **{name: getattr(document, name)[left] for name in _COLUMNS},
    )


def joined(document: Document, item: Item, pose: Poses, weight: float) -> Document:
    """The document with one item more, at a pose of one."""
    if len(document) >= MAX_COUNT:
        raise RecipeError("add", f"{MAX_COUNT} items are the most; remove one first")
    joined = replace(
        document,
        items=(*document.items, item),
        ids=np.append(document.ids, document.next_id),
        poses=document.poses.followed_by(pose),
        weights=np.append(document.weights, weight),
        smallest=np.append(document.smallest, pose.scale),
        largest=np.append(document.largest, pose.scale),
        held=np.vstack([document.held, np.zeros((1, len(PROPERTIES)), dtype=bool)]),
        next_id=document.next_id + 1,
    )
    return _ranged(joined, np.array([len(document)]))


def _ranged(document: Document, rows: IntArray) -> Document:
    """The document with sizes of some items as free as those of any other."""
    found = document.with_ranges(document.options)
    smallest, largest = document.smallest.copy(), document.largest.copy()
    smallest[rows], largest[rows] = found.smallest[rows], found.largest[rows]
    return replace(document, smallest=smallest, largest=largest)


def _with_item(document: Document, k: int, item: Item) -> Document:
    items: Sequence[Item] = document.items
    return replace(document, items=(*items[:k], item, *items[k + 1 :]))
