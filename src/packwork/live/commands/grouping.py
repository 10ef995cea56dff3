"""Commands that make one item of several, whose places to each other stay, and take it apart."""

from __future__ import annotations

from dataclasses import replace
from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from packwork.errors import RecipeError
from packwork.live.commands.command import Command, ItemId, ItemIds, Library, index_of
from packwork.live.commands.items import joined, without
from packwork.live.document import Document
from packwork.scene.groups import grouped, parts_in_place
from packwork.scene.item import Parts
from packwork.scene.pose import Poses


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
