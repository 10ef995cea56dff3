"""Icons and drawings: the plain use, whose items' files say all about them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import final

import numpy as np

from packwork.arrays import FloatArray, IntArray
from packwork.assignment.quadratic import cheapest
from packwork.pipeline.job import Job, Use
from packwork.pipeline.plan.copies import Cast, expand_copies
from packwork.pipeline.plan.counts import items_needed, no_container
from packwork.pipeline.read import AUTO, Material, drawn_first, read_named
from packwork.pipeline.run import RunStep
from packwork.raster.coverage import coverage
from packwork.recipe import Recipe
from packwork.scene.container import Container
from packwork.scene.contrast import oklabs_of_light
from packwork.scene.item import Item, PhotoArt
from packwork.scene.swatch import mean_lights
from packwork.scene.target import TargetPicture, blurred
from packwork.steps.starts import fits_first, may_rearrange
from packwork.uses.collage import filling, jamming, placing, reporting

NO_CONTAINER = "none"
"""Name for no container at all: a pile lies anywhere, a chart's groups are bars."""


MOST_SEPARATED = 40
"""Items of one common scale for which another arrangement is sought. More gain little in long:
decision 0045. Measured."""


@dataclass(frozen=True, eq=False)
class KnownContainer:
    """The container of a run."""

    container: Container | None

    @property
    def known(self) -> Container:
        """The container."""
        if self.container is None:
            raise no_container()
        return self.container

    def of(self, cast: Cast) -> Container:
        """Container that these items are placed in."""
        del cast
        return self.known

    def needed(self, recipe: Recipe, items: Sequence[Item]) -> int:
        """Number of items at which the container's shape shows."""
        needed = items_needed(self.known, recipe.sizes, recipe.size_ratio).count
        return max(needed, len(items))


def suited_first(
    recipe: Recipe, container: Container, items: tuple[Item, ...]
) -> tuple[tuple[Item, ...], TargetPicture | None]:
    """Items in the order in which they are taken, those that show the picture best first.

    As they are where none is left out, or none keeps colours of its own; else the picture beside.
    """
    count, tint = recipe.count, recipe.tint
    are_photos = all(isinstance(item.art, PhotoArt) for item in items)
    keeps_none = tint == 1.0 or (tint is None and not are_photos)
    if recipe.picture is None or keeps_none or not isinstance(count, int) or count >= len(items):
        return items, None
    # Only what is asked for loads the picture library.
    from packwork.readers.target import read_target

    target = read_target(recipe.picture, container, recipe.read_options)
    best = best_suited(mean_lights(items), _wanted(target, container, count))
    rest = np.setdiff1d(np.arange(len(items)), best)
    return tuple(items[k] for k in (*best, *rest)), target


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


@final
class IconsUse(Use):
    """Items whose files say all about them."""

    def steps(self, job: Job) -> Sequence[RunStep]:
        """Places, levels, finish; voids if asked; measures and looks."""
        if job.plan.sizes == "shared":
            placed = jamming(job) or placing(
                job, suits_first_fit=fits_first(job), bounds=separation(job)
            )
        else:
            # First fit is not tried.
            placed = placing(job, suits_first_fit=False)
        return [*placed, *filling(job), *self.report(job)]

    def report(self, job: Job) -> Sequence[RunStep]:
        """Measures and looks."""
        return reporting(job, is_dressed=False)


def separation(job: Job) -> list[RunStep]:
    """Search for a larger common size, where items may lie anywhere; else nothing."""
    is_few = 1 < len(job.items) <= MOST_SEPARATED
    if job.plan.effort == "draft" or job.plan.has_even_lines or not (is_few and may_rearrange(job)):
        return []
    # Only what is asked for loads its kernels.
    from packwork.steps.separate import Separate

    return [Separate()]


def material_of(
    use: Use, recipe: Recipe, room: KnownContainer, given: Sequence[Item] | None
) -> Material:
    """Items and photographs that a recipe names, for a use that reads nothing else."""
    named = read_named(recipe, given)
    items, target = named.items, None
    if recipe.picture is not None:
        items, target = suited_first(recipe, room.known, items)
    if given is None and items is named.items:
        items = drawn_first(recipe, items)
    total = room.needed(recipe, items) if recipe.count == AUTO else None
    chosen = expand_copies(recipe, items, total)
    container, order = room.of(chosen), None
    if recipe.embeddings is not None and all(item.text is None for item in given or ()):
        order = named.keys
    return Material(
        use=use,
        container=container,
        cast=chosen,
        fillers=named.items,
        # Words of a layout come by weight: what a user means by their order is not known.
        given=order,
        skipped=named.skipped,
        target=target if container is room.container else None,
    )
