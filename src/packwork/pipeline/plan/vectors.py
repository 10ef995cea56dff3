"""Vectors that say which items are alike, by the items that a run has."""

from __future__ import annotations

import logging
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TypeAlias

import numpy as np

from packwork.arrays import BoolArray, FloatArray
from packwork.errors import ReadError
from packwork.phrasing import enumerated, number_of
from packwork.readers.vectors import Vectors, groups_in_order, in_order, read_vectors
from packwork.recipe import Recipe
from packwork.recipe.order import parse_anchor
from packwork.scene.item import Item

_LOG = logging.getLogger("packwork")

Key: TypeAlias = tuple[str, str]
"""Name and source of an item."""


AnchorVector: TypeAlias = tuple[float | None, FloatArray]
"""Direction, degrees clockwise from the right, or None for the middle; and the vector of what is
drawn there."""


@dataclass(frozen=True, eq=False)
class ItemVectors:
    """One vector for each thing, whatever copies there are of it.

    Parameters
    ----------
    by_item
        Vectors by name and source; nothing of what has none.
    told
        What has to be told of items that have none.
    anchors
        Of what is drawn in some direction or to the middle.
    groups
        Names of groups by name and source, where the file says so; nothing of what is of none.
    """

    by_item: Mapping[Key, FloatArray]
    told: tuple[ReadError, ...] = ()
    anchors: tuple[AnchorVector, ...] = ()
    groups: Mapping[Key, str] = field(default_factory=dict)

    @classmethod
    def of_rows(
        cls,
        items: Sequence[Item],
        rows: FloatArray,
        known: BoolArray,
        told: tuple[ReadError, ...] = (),
        anchors: tuple[AnchorVector, ...] = (),
    ) -> ItemVectors:
        """Rows of items, in their order, some of which are known."""
        triples = zip(items, rows, known, strict=True)
        by_item = {key_of(item): row for item, row, is_known in triples if is_known}
        return cls(by_item, told, anchors)

    def of(self, items: Sequence[Item]) -> FloatArray:
        """``(n, d)`` vectors of items, zeros of those that have none."""
        width = len(next(iter(self.by_item.values())))
        nothing = np.zeros(width)
        return np.array([self.by_item.get(key_of(item), nothing) for item in items])

    def groups_of(self, items: Sequence[Item]) -> list[str]:
        """Names of the groups of items; empty for what is of none."""
        return [self.groups.get(key_of(item), "") for item in items]

    def joined_by(self, items: Sequence[Item], rows: FloatArray) -> ItemVectors:
        """The same with rows of some more items, each the one of its name in its group."""
        pairs = zip(items, rows, strict=True)
        return replace(
            self,
            by_item={**self.by_item, **{key_of(item): row for item, row in pairs}},
            groups={**self.groups, **{key_of(item): item.name for item in items}},
        )


def read_item_vectors(
    recipe: Recipe, file: str, items: Sequence[Item], given: Sequence[Key] | None
) -> ItemVectors:
    """Vectors of a file for the items of a run, by their names or in the order given.

    Parameters
    ----------
    given
        All that was read, in its order, which may be more than the run places; None if it has none.
    """
    things = list({key_of(item): item for item in items}.values())
    names = [(item.name, Path(item.source).name) for item in things]
    vectors = _picked(read_vectors(file, recipe), things, given)
    rows, known = in_order(vectors, names)
    without = [item.name for item, is_known in zip(things, known, strict=True) if not is_known]
    told: tuple[ReadError, ...] = ()
    if without:
        many = number_of(len(without), "item has", "items have")
        told = (ReadError(file, f"{many} no row ({enumerated(without)}) and may lie anywhere"),)
        _LOG.warning("%s", told[0])
    asked = map(parse_anchor, recipe.anchors)
    anchors = tuple((one.angle, vectors.called(one.name)) for one in asked)
    found = ItemVectors.of_rows(things, rows, known, told, anchors)
    pairs = zip(things, groups_in_order(vectors, names), strict=True)
    return replace(found, groups={key_of(item): group for item, group in pairs if group})


def _picked(vectors: Vectors, things: Sequence[Item], given: Sequence[Key] | None) -> Vectors:
    """Rows of the things that are placed, where rows have no names; else the vectors themselves."""
    if vectors.names is not None:
        return vectors
    if given is None:
        raise ReadError(
            vectors.file,
            "has rows without names, and words of a text or a session have no order of their own; "
            "give a first column of words (in Python a dict of vectors by word)",
        )
    in_order(vectors, given)
    first = {key: k for k, key in reversed(list(enumerate(given)))}
    rows = [first[key_of(thing)] for thing in things]
    groups = vectors.groups and tuple(vectors.groups[k] for k in rows)
    return replace(vectors, rows=vectors.rows[rows], groups=groups)


def key_of(item: Item) -> Key:
    """Name and source of an item."""
    return item.name, item.source
