"""Runs that a page watches: what flows where, from the first moment on."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from packwork import threads, uses
from packwork.arrays import FloatArray, IntArray
from packwork.live.assets import named_container, named_item
from packwork.live.commands.command import Command, Library, made
from packwork.live.commands.container import SetContainer, SetOption
from packwork.live.commands.items import Add, Remove
from packwork.live.commands.placing import Arrange
from packwork.live.document import Document
from packwork.live.options import LiveOptions
from packwork.pipeline import run, warm_up_once
from packwork.pipeline.job import Job
from packwork.progress import Step, Stop, never
from packwork.recipe import Recipe, make_recipe
from packwork.scene.container import Container
from packwork.scene.item import Item
from packwork.scene.layout import Layout
from packwork.scene.pose import Poses

EPOCHS_BETWEEN = 3
"""Epochs between two moments that are shown. Fewer take time from the run, more jump. Chosen."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Moment:
    """What a run looks like on its way.

    Parameters
    ----------
    container
        What is filled.
    items
        All that are to be placed.
    poses
        As many as items; None before they have a place.
    progress
        From 0 to 1.
    stage
        Which part of the run this is, as steps name it.
    """

    container: Container
    items: tuple[Item, ...]
    poses: Poses | None
    progress: float
    stage: str


Shown = Callable[[Moment], object]


def poured(recipe: Recipe, shown: Shown, stop: Stop = never) -> Layout:
    """Layout of a recipe, every moment of its run shown.

    Raises
    ------
    ReadError
        If a file cannot be used.
    RecipeError
        If an option has no meaning for these files.
    """
    job = uses.read(recipe)
    return _run(job, shown, stop)[0]


def poured_again(document: Document, seed: int, shown: Shown, stop: Stop = never) -> Arrange:
    """The same items in the same container, from other first places: a command that puts them so.

    What is held stays where it is; all others lie as if it were not there until they settle.
    """
    job = uses.read(_recipe(document, seed), _weighed(document), document.container)
    layout, kept = _run(job, shown, stop)
    return arranged(document.ids[kept].tolist(), layout.poses)


def poured_into(
    document: Document,
    use: str,
    source: str,
    options: Mapping[str, Any],
    shown: Shown,
    stop: Stop = never,
) -> Layout:
    """Other items in the container of a document: a run of their own.

    Parameters
    ----------
    use
        ``items``, ``words`` or ``photos``.
    source
        Of them: a folder or a bundled name, or the file of a text or a table.
    options
        ``count``, items in all, and of words ``font`` and ``palette``; what is None the use
        decides by itself.

    Raises
    ------
    ReadError
        If nothing of them can be used.
    """
    given: dict[str, Any] = {"effort": "draft", "canvas": canvas_of(document)}
    given |= {name: value for name, value in options.items() if value is not None}
    if use == "words":
        recipe = uses.words_recipe("page", source, **given)
    elif use == "photos":
        recipe = uses.photos_recipe("page", [source], **given)
    else:
        recipe = make_recipe(container="page", items=[source], **given)
    return _run(uses.read(recipe, None, document.container), shown, stop)[0]


def in_place(document: Document, library: Library, layout: Layout) -> list[Command]:
    """Commands after which the items of a layout are there, and none of those before."""
    options = LiveOptions.of(layout.manifest)
    poses, container = layout.poses, layout.container
    kept = ("padding", "sizes", "size_ratio", "rotate")
    asked = [
        made(SetOption, name=name, value=getattr(options, name))
        for name in kept
        if getattr(options, name) != getattr(document.options, name)
    ]
    brought = [
        made(
            Add,
            asset=named_item(library, replace(item, weight=float(weight))),
            x=float(poses.x[k]),
            y=float(poses.y[k]),
            area=item.outline.area * float(poses.scale[k]) ** 2,
            angle=math.degrees(poses.angle[k]),
        )
        for k, (item, weight) in enumerate(zip(layout.items, layout.weights, strict=True))
    ]
    other = (
        []
        if container is document.container
        else [made(SetContainer, asset=named_container(library, container))]
    )
    return [*other, *brought, made(Remove, items=tuple(document.ids.tolist())), *asked]


def canvas_of(document: Document) -> str:
    """Canvas of a document, as options say it."""
    container = document.container
    return f"{container.width:.17g}x{container.height:.17g}{container.unit}"


def arranged(numbers: Sequence[int], poses: Poses) -> Arrange:
    """Command that puts items to poses, by their numbers."""
    columns = (poses.x, poses.y, np.degrees(poses.angle), poses.scale)
    asked = np.column_stack(columns).tolist()
    return made(Arrange, items=tuple(numbers), poses=[tuple(pose) for pose in asked])


def _run(job: Job, shown: Shown, stop: Stop) -> tuple[Layout, IntArray]:
    shown(_moment(job, None, 0.0, "read"))
    with threads.using(job.recipe.threads):
        warm_up_once()
        done = run(job, _Watcher(job, shown), stop)
    return done.layout, np.arange(len(job.items)) if done.kept is None else np.asarray(done.kept)


class _Watcher:
    """Shows moments of a run."""

    every = EPOCHS_BETWEEN

    def __init__(self, job: Job, shown: Shown) -> None:
        self._job, self._shown = job, shown

    def on_step(self, step: Step) -> None:
        """Show it, unless other items are there by now than were read."""
        count = len(self._job.items)
        poses = step.poses if step.ids is None and len(step.poses) == count else None
        if poses is not None:
            self._shown(_moment(self._job, poses, step.progress, step.stage))


def _moment(job: Job, poses: Poses | None, progress: float, stage: str) -> Moment:
    return Moment(
        container=job.container, items=job.items, poses=poses, progress=progress, stage=stage
    )


def _recipe(document: Document, seed: int) -> Recipe:
    """A draft with the numbers of a document."""
    options = document.options
    return make_recipe(
        container="page",
        items=["circle"],
        count=len(document),
        effort="draft",
        seed=seed,
        canvas=canvas_of(document),
        padding=f"{options.padding:.17g}{document.container.unit}",
        sizes=options.sizes,
        size_ratio=options.size_ratio,
        rotate=options.rotate,
        force=options.force,
    )


def _weighed(document: Document) -> list[Item]:
    """Items of a document, each with the weight that it has there."""
    pairs = zip(document.items, _positive(document.weights), strict=True)
    return [replace(item, weight=weight) for item, weight in pairs]


def _positive(weights: FloatArray) -> list[float]:
    """Weights, those of fillers, which ask for nothing, as small as the smallest other."""
    least = float(weights[weights > 0].min(initial=math.inf))
    positive = np.where(weights > 0, weights, least if math.isfinite(least) else 1.0)
    return [float(weight) for weight in positive]
