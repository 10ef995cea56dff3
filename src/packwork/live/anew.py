"""The same items in the same container, put there anew: in an order, by likeness, or by chance."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from packwork import uses
from packwork.arrays import FloatArray
from packwork.errors import RecipeError
from packwork.live.commands.command import made
from packwork.live.commands.placing import Arrange
from packwork.live.document import Document
from packwork.live.pins import pin_of
from packwork.live.running import Shown, run_shown
from packwork.pipeline.job import Job
from packwork.pipeline.plan.copies import ItemRules, RuleSource
from packwork.pipeline.plan.vectors import ItemVectors
from packwork.progress import Stop, never
from packwork.recipe import Recipe, make_recipe
from packwork.recipe.order import FROM_TEXT
from packwork.recipe.rules import Pin, Rule
from packwork.scene.item import Item
from packwork.scene.pose import Poses

BY_TEXT = FROM_TEXT
"""Stands for vectors that are made from the text of the words."""

HOLD = RuleSource("hold")
"""What asks for pins, where a message says it."""


def poured_again(
    document: Document,
    seed: int,
    shown: Shown = lambda _: None,
    stop: Stop = never,
    **asked: str | Sequence[str],
) -> Arrange:
    """The same items in the same container, from other first places: a command that puts them so.

    What is held stays where it is, and the others lie about it; where it has no room there, it
    is in nobody's way until they settle.

    Parameters
    ----------
    asked
        Where items are to lie, as recipes say it: ``arrange``, or ``embeddings`` with
        ``anchors``.

    Raises
    ------
    ReadError
        If a file cannot be used.
    RecipeError
        If that has no meaning for these items.
    """
    is_by_text = asked.get("embeddings") == BY_TEXT
    job = job_again(document, seed, {} if is_by_text else asked)
    if is_by_text:
        job = replace(job, vectors=_vectors_by_text(document, asked))
    try:
        layout, kept = run_shown(replace(job, asked=_asked(document)), shown, stop)
    except RecipeError as error:
        if error.key != HOLD.key:
            raise
        layout, kept = run_shown(job, shown, stop)
    return arranged(document.ids[kept].tolist(), layout.poses)


def job_again(document: Document, seed: int, asked: Mapping[str, Any]) -> Job:
    """A run of the items of a document in its container."""
    recipe = _recipe(document, seed, asked)
    return uses.read(recipe, _weighed(document), document.container)


def _asked(document: Document) -> tuple[ItemRules, ...]:
    """Rules that holds make for each item, as pins do."""
    rules = [pin_of(document, k) for k in range(len(document))]
    return tuple(
        ItemRules().merged(Rule(items=(item.name,), pin=Pin.model_validate(pin)), HOLD)
        if pin
        else ItemRules()
        for item, pin in zip(document.items, rules, strict=True)
    )


def _vectors_by_text(document: Document, asked: Mapping[str, Any]) -> ItemVectors:
    """Vectors of words, by the text that the run had which made the layout."""
    recipe = document.manifest.get("recipe")
    known = recipe.get("words") if isinstance(recipe, Mapping) else None
    if not isinstance(known, Mapping) or not known.get("source"):
        raise RecipeError(
            "embeddings", f"{BY_TEXT} is for words of a text; give a file of vectors here"
        )
    given = {key: value for key, value in known.items() if value is not None and key != "source"}
    words = uses.words_recipe("page", known.get("source"), **given, **asked)
    found = uses.read(words, None, document.container)
    by_word = {item.name: row for item, row in zip(found.items, _rows(found), strict=True)}
    items = document.items
    nothing = np.zeros_like(next(iter(by_word.values())))
    rows = np.array([by_word.get(item.name, nothing) for item in items])
    is_known = np.array([item.name in by_word for item in items])
    anchors = found.vectors.anchors if found.vectors is not None else ()
    return ItemVectors.of_rows(items, rows, is_known, anchors=anchors)


def _rows(job: Job) -> FloatArray:
    if job.vectors is None:
        raise AssertionError("a run by embeddings has vectors")
    return job.vectors.of(job.items)


def canvas_of(document: Document) -> str:
    """Canvas of a document, as options say it."""
    container = document.container
    return f"{container.width:.17g}x{container.height:.17g}{container.unit}"


def arranged(numbers: Sequence[int], poses: Poses) -> Arrange:
    """Command that puts items to poses, by their numbers."""
    columns = (poses.x, poses.y, np.degrees(poses.angle), poses.scale)
    asked = np.column_stack(columns).tolist()
    return made(Arrange, items=tuple(numbers), poses=[tuple(pose) for pose in asked])


def _recipe(document: Document, seed: int, asked: Mapping[str, Any]) -> Recipe:
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
        **asked,
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
