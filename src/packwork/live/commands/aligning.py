"""Commands that line items up by edges or middles; what is held stays where it is."""

from __future__ import annotations

from abc import abstractmethod
from dataclasses import replace
from itertools import pairwise
from typing import Annotated, Literal, TypeAlias

import numpy as np
from pydantic import Field

from packwork.arrays import FloatArray, IntArray
from packwork.live.commands.command import Command, ItemId, Library, index_of
from packwork.live.document import PROPERTIES, Document

Edge: TypeAlias = Literal["left", "center", "right", "top", "middle", "bottom"]

Direction: TypeAlias = Literal["horizontal", "vertical"]


class LineUp(Command):
    """Base of those that move items along one axis, by the extents of their outlines."""

    items: tuple[ItemId, ...]

    @property
    def keeps_places(self) -> tuple[int, ...]:
        """The items."""
        return self.items

    @property
    @abstractmethod
    def axis(self) -> int:
        """0 across, 1 down."""

    @abstractmethod
    def starts(self, low: FloatArray, high: FloatArray, is_held: np.ndarray) -> FloatArray:
        """New lower ends of items along the axis, ``(n,)``."""

    def applied(self, document: Document, library: Library) -> Document:
        """The document with the items there, but those whose place is held."""
        rows = np.array([index_of(document, number, self.kind) for number in self.items])
        low, high = _extents(document, rows, self.axis)
        is_held = document.held[rows, PROPERTIES.index("place")]
        by = np.where(is_held, 0.0, self.starts(low, high, is_held) - low)
        name = "xy"[self.axis]
        column = getattr(document.poses, name).copy()
        column[rows] += by
        return document.with_poses(replace(document.poses, **{name: column}))


class Align(LineUp):
    """Bring edges or middles of items to one line: that of what is held, else of all."""

    kind: Literal["align"] = "align"
    items: Annotated[tuple[ItemId, ...], Field(min_length=2)]
    to: Edge

    @property
    def axis(self) -> int:
        """As the edge says."""
        return 0 if self.to in {"left", "center", "right"} else 1

    def starts(self, low: FloatArray, high: FloatArray, is_held: np.ndarray) -> FloatArray:
        """At the outermost edge, or about the middle."""
        leads = is_held if is_held.any() else ~is_held
        first, last = float(low[leads].min()), float(high[leads].max())
        if self.to in {"left", "top"}:
            return np.full_like(low, first)
        if self.to in {"right", "bottom"}:
            return last - (high - low)
        return (first + last) / 2.0 - (high - low) / 2.0


class Distribute(LineUp):
    """Even out the distances between items in a row or column; its ends and what is held stay."""

    kind: Literal["distribute"] = "distribute"
    items: Annotated[tuple[ItemId, ...], Field(min_length=3)]
    direction: Direction

    @property
    def axis(self) -> int:
        """As the direction says."""
        return 0 if self.direction == "horizontal" else 1

    def starts(self, low: FloatArray, high: FloatArray, is_held: np.ndarray) -> FloatArray:
        """One after another in the order of their middles, between those that stay."""
        order, starts = np.argsort(low + high, kind="stable"), low.copy()
        stays = is_held[order]
        stays[[0, -1]] = True
        for first, last in pairwise(np.flatnonzero(stays).tolist()):
            between = order[first + 1 : last]
            sizes = high[between] - low[between]
            begin, end = high[order[first]], low[order[last]]
            gap = (end - begin - sizes.sum()) / (last - first)
            starts[between] = begin + gap + np.concatenate(([0.0], np.cumsum(sizes + gap)))[:-1]
        return starts


def _extents(document: Document, rows: IntArray, axis: int) -> tuple[FloatArray, FloatArray]:
    bounds = np.array(
        [document.items[k].outline.mapped(document.poses.matrix(k)).bounds for k in rows.tolist()]
    )
    return bounds[:, axis], bounds[:, axis + 2]
