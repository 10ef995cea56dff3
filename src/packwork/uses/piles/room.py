"""Container of a pile: closed, open, or none at all."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from packwork.arrays import FloatArray
from packwork.pipeline.plan.copies import Cast
from packwork.pipeline.plan.counts import MOST
from packwork.pipeline.plan.limits import given_scales
from packwork.pipeline.read import read_room
from packwork.readers.svg.curve import walled_container
from packwork.recipe import AUTO, Recipe
from packwork.recipe.piles import PileOptions
from packwork.scene.container import Container, on_canvas
from packwork.scene.item import Item
from packwork.units import DEFAULT_SIDE, CanvasSize, Unit, length_asked
from packwork.uses.icons import NO_CONTAINER, KnownContainer
from packwork.uses.piles.opening import nowhere

WIDER = 4
"""Times that a sheet is made wider for its padding, which may be a share of it. More comes nearer
to where both agree, but makes specks of items whose padding no sheet has room for. Tried."""


@dataclass(frozen=True, eq=False)
class PileRoom(KnownContainer):
    """Room of a pile.

    Parameters
    ----------
    size
        Of the canvas; None leaves it to the items where there is no container.
    mouths
        ``(m, 2, 2)`` ends of its openings where it is drawn open; None if not.
    padding
        Gap that is asked for, of which a sheet without a container has room.
    """

    size: CanvasSize | None
    options: PileOptions
    mouths: FloatArray | None = None
    padding: str | float = "0"

    @classmethod
    def of_recipe(cls, recipe: Recipe, options: PileOptions, given: Container | None) -> PileRoom:
        """The container of a recipe, or the one that was given in its place."""
        size = recipe.canvas_size
        if given is None and recipe.container == NO_CONTAINER:
            padding = "0" if recipe.padding == AUTO else recipe.padding
            return cls(None, size, options, padding=padding)
        if given is None and Path(recipe.container).suffix.lower() in {".svg", ".svgz"}:
            walled = walled_container(
                recipe.container, None if size is None else size.side, recipe.read_options
            )
            if walled is not None:
                placed = on_canvas(walled[0], size)
                mouths = _brought_along(walled[1], walled[0], placed)
                return cls(placed, size, options, mouths)
        return cls(read_room(recipe, given), size, options)

    def of(self, cast: Cast) -> Container:
        """The container, or the sheet that stands for none at all."""
        return self.container or self._sheet(cast)

    def needed(self, recipe: Recipe, items: Sequence[Item]) -> int:
        """Number of items that heap up about two thirds high."""
        del recipe
        return heap_needed(self.known, self.options, items)

    def _sheet(self, cast: Cast) -> Container:
        size = self.size
        is_share = str(self.options.size).strip().endswith("%")
        if size is None and is_share:
            size = CanvasSize(DEFAULT_SIDE, None, "px")
        unit: Unit = "px" if size is None else size.unit
        side = DEFAULT_SIDE if size is None else size.side
        scales = given_scales(cast.items, cast.weights, unit, side, self.options.size)
        radii = np.array([item.outline.radius for item in cast.items])
        found = nowhere(size, radii * scales)
        for _ in range(WIDER):
            gap = length_asked("padding", self.padding, found.unit, found.side)
            found = nowhere(size, radii * scales + gap / 2)
        return found


def _brought_along(points: FloatArray, before: Container, after: Container) -> FloatArray:
    """Points of a container that has been put on another canvas."""
    scale = after.outline.extent / before.outline.extent
    old, new = (np.array(c.outline.bounds[:2]) for c in (before, after))
    return np.asarray(new + (points - old) * scale)


HEAP = 0.4
"""Area of a pile's items over the container's: it stands about two thirds high. Chosen."""


def heap_needed(container: Container, asked: PileOptions, items: Sequence[Item]) -> int:
    """Items of given sizes that heap up about two thirds high."""
    weights = np.ones(len(items))
    scales = given_scales(items, weights, container.unit, container.side, asked.size)
    own = np.array([item.outline.area for item in items]) * scales**2
    return int(np.clip(HEAP * container.outline.area / own.mean(), 1, MOST))
