"""Sizes that items are given: in their files, or one for all."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from packwork.arrays import FloatArray
from packwork.pipeline.casting import Cast
from packwork.pipeline.opening import nowhere
from packwork.recipe import Recipe
from packwork.scene.container import Container
from packwork.scene.item import Item
from packwork.units import DEFAULT_SIDE, CanvasSize, Unit, convert, parse_length


def given_scales(
    recipe: Recipe, items: Sequence[Item], weights: FloatArray, unit: Unit, side: float
) -> FloatArray:
    """``(n,)`` scales of items of given sizes.

    Parameters
    ----------
    unit, side
        Of the canvas, and its longer side.
    """
    size = None if recipe.pile is None else recipe.pile.size
    if size is None:
        # Items are in px, as their files say; the canvas may be in mm.
        return np.full(len(items), convert(1.0, "px", unit))
    length = parse_length(str(size), unit, side)
    return np.array([length / item.outline.extent for item in items]) * np.sqrt(weights)


def no_container(recipe: Recipe, cast: Cast) -> Container:
    """Sheet that stands for no container at all."""
    size = recipe.canvas_size
    is_share = recipe.pile is not None and str(recipe.pile.size).strip().endswith("%")
    if size is None and is_share:
        size = CanvasSize(DEFAULT_SIDE, None, "px")
    unit: Unit = "px" if size is None else size.unit
    side = DEFAULT_SIDE if size is None else size.side
    scales = given_scales(recipe, cast.items, cast.weights, unit, side)
    radii = np.array([item.outline.radius for item in cast.items])
    return nowhere(size, radii * scales)
