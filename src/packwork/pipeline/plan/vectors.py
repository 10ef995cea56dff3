"""Vectors that say which items are alike, by the items that a run has."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TypeAlias

import numpy as np

from packwork.arrays import BoolArray, FloatArray
from packwork.errors import ReadError
from packwork.phrasing import enumerated, number_of
from packwork.readers.vectors import in_order, read_vectors
from packwork.recipe import Recipe
from packwork.recipe.meaning import parse_anchor
from packwork.scene.item import Item

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
    """

    by_item: Mapping[Key, FloatArray]
    told: tuple[ReadError, ...] = ()
    anchors: tuple[AnchorVector, ...] = ()

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
        by_item = {_key(item): row for item, row, is_known in triples if is_known}
        return cls(by_item, told, anchors)

    def of(self, items: Sequence[Item]) -> FloatArray:
        """``(n, d)`` vectors of items, zeros of those that have none."""
        width = len(next(iter(self.by_item.values())))
        nothing = np.zeros(width)
        return np.array([self.by_item.get(_key(item), nothing) for item in items])


def read_item_vectors(recipe: Recipe, file: str, items: Sequence[Item]) -> ItemVectors:
    """Vectors of a file for the items of a run, by their names or in their order.

    Raises
    ------
    ReadError
        If it cannot be read, or has no row for each.
    """
    things = list({_key(item): item for item in items}.values())
    names = [(item.name, Path(item.source).name) for item in things]
    vectors = read_vectors(file, recipe)
    rows, known = in_order(vectors, names)
    without = [item.name for item, is_known in zip(things, known, strict=True) if not is_known]
    told: tuple[ReadError, ...] = ()
    if without:
        many = number_of(len(without), "item has", "items have")
        told = (ReadError(file, f"{many} no row ({enumerated(without)}) and may lie anywhere"),)
    asked = map(parse_anchor, recipe.anchors)
    anchors = tuple((one.angle, vectors.called(one.name)) for one in asked)
    return ItemVectors.of_rows(things, rows, known, told, anchors)


def _key(item: Item) -> Key:
    return item.name, item.source
