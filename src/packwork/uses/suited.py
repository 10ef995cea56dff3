"""Items that suit a picture's colours, where there are more of them than places.

An optimal assignment of items to places spread over the picture, as for seats on the road
(:mod:`packwork.steps.seating`); some items are left over.
"""

from __future__ import annotations

import numpy as np

from packwork.arrays import FloatArray, IntArray
from packwork.assignment.local_search import cheapest
from packwork.raster.coverage import coverage
from packwork.readers.target import read_target
from packwork.recipe import Recipe
from packwork.scene.container import Container
from packwork.scene.contrast import oklabs_of_light
from packwork.scene.item import Item, PhotoArt
from packwork.scene.swatch import mean_lights
from packwork.scene.target import TargetPicture, blurred


def suited_first(recipe: Recipe, container: Container, items: tuple[Item, ...]) -> tuple[Item, ...]:
    """Items in the order in which they are taken: those that show the picture best come first.

    As they are where none is left out, or none keeps colours of its own.
    """
    count, tint = recipe.count, recipe.tint
    are_photos = all(isinstance(item.art, PhotoArt) for item in items)
    keeps_none = tint == 1.0 or (tint is None and not are_photos)
    if recipe.picture is None or keeps_none or not isinstance(count, int) or count >= len(items):
        return items
    target = read_target(recipe.picture, container, recipe.read_options)
    best = best_suited(mean_lights(items), _wanted(target, container, count))
    rest = np.setdiff1d(np.arange(len(items)), best)
    return tuple(items[k] for k in (*best, *rest))


def best_suited(lights: FloatArray, wanted: FloatArray) -> IntArray:
    """``(m,)`` ascending indices of the items by which wanted colours are met best, one by each.

    Parameters
    ----------
    lights
        ``(n, 3)`` light of items.
    wanted
        ``(m, 3)`` light, no more than items.

    Examples
    --------
    >>> lights = np.array([[1.0, 0, 0], [0, 0, 1.0], [0.9, 0, 0], [0, 1.0, 0]])
    >>> best_suited(lights, np.array([[1.0, 0, 0], [0.9, 0, 0]])).tolist()
    [0, 2]
    """
    own, asked = oklabs_of_light(lights), oklabs_of_light(wanted)
    away = ((own[None] - asked[:, None]) ** 2).sum(axis=2)
    return np.sort(cheapest(away))


def _wanted(target: TargetPicture, container: Container, count: int) -> FloatArray:
    """``(count, 3)`` light of the picture at places all over the container."""
    outline = container.outline
    shape = target.light.shape[:2]
    inside = coverage(outline.points * target.px_per_cu, outline.starts, shape) > 0.5
    light = blurred(target.light, 1.0, count)[inside]
    return np.asarray(light[np.linspace(0, len(light) - 1, count).astype(int)])
