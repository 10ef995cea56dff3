"""Steps of a series: what each is to show, how large, on one scale for all, and its files."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from packwork import uses, writers
from packwork.arrays import FloatArray
from packwork.batches.templates import ROW, columns_of, identity_of, path_of
from packwork.errors import RecipeError
from packwork.pipeline.job import Job
from packwork.readers.layouts.read import is_session
from packwork.readers.words.items import height_shares
from packwork.readers.words.word import Word
from packwork.scene.palette import palette_colours
from packwork.uses.charts.copies import unit_scales
from packwork.uses.charts.recipe import chart_recipe
from packwork.uses.charts.series import read_steps
from packwork.uses.words.recipe import PALETTE, words_recipe
from packwork.uses.words.use import WordsUse

IDLE: Mapping[str, tuple[Any, ...]] = {
    "sizes": ("auto", "shared"),
    "repeat": ("none",),
    "finish": ("exact",),
    **dict.fromkeys(
        (
            "smallest", "start", "stay", "photos", "time", "target_coverage", "max_items", "filler",
            "add", "items", "forces", "losses", "rules", "share",
        ),
        (),
    ),
}  # fmt: skip
"""Options that have no meaning for a series, and the values that ask for nothing."""


@dataclass(frozen=True, eq=False)
class SeriesStep:
    """One step.

    ``job``: what a layout of it alone would be made of.
    ``true``: ``(n,)`` scale of each item, on one scale for all steps.
    ``names``: ``(n,)`` what items are known by: one name in two steps is one item.
    """

    label: str
    job: Job
    true: FloatArray
    names: tuple[str, ...]

    @cached_property
    def area(self) -> float:
        """Of all items, at a scale of 1."""
        own = np.array([item.outline.area for item in self.job.items])
        return float(own @ self.true**2)


def word_steps(
    container: str, weights: Mapping[str, Mapping[str, float]], **options: Any
) -> list[SeriesStep]:
    """Steps of a cloud, from the options of ``words``.

    ``weights``: by step, then by word.

    Raises ``RecipeError`` if an option has no meaning, in a series or at all.
    Raises ``ReadError`` if the container or a font cannot be read, or a step has no word that could
    be set.

    Examples
    --------
    >>> years = {"1999": {"bear": 2, "fox": 1}, "2000": {"bear": 4}}
    >>> [round(float(step.true[0]), 6) for step in word_steps("heart", years)]
    [2.0, 4.0]
    """
    check_idle(options)
    said = {key: value for key, value in options.items() if key not in IDLE} | {"sizes": "shared"}
    if said.get("color_by") is None:
        recipe = words_recipe(container, next(iter(weights.values())), **said)
        said["color_by"] = in_turn(weights, palette_colours(recipe.palette or PALETTE))
    jobs: list[Job] = []
    for source in weights.values():
        recipe = words_recipe(container, dict(source), **said)
        jobs.append(uses.read(recipe, container=jobs[0].container if jobs else None))
    return [
        SeriesStep(label, job, _heights(job), tuple(item.name for item in job.items))
        for label, job in zip(weights, jobs, strict=True)
    ]


def chart_steps(container: str, data: object, column: str, **options: Any) -> list[SeriesStep]:
    """Steps of a unit chart, from the options of ``chart``.

    ``column``: of steps; with the option ``by_step`` so many of its numbers go together.

    Raises ``RecipeError`` if an option has no meaning, in a series or at all.
    Raises ``ReadError`` if the container, the table or a mark cannot be read.

    Examples
    --------
    >>> rows = [{"year": 1, "kg": 4}, {"year": 1, "kg": 1}, {"year": 2, "kg": 1}]
    >>> first, second = chart_steps("circle", rows, "year", size_by="kg")
    >>> float(first.true[0] / first.true[1]), bool(first.true[1] == second.true[0])
    (2.0, True)
    """
    check_idle(options)
    if options.get("by") is not None:
        raise RecipeError("by", "has no meaning in a series: its steps are the groups")
    recipe = chart_recipe(container, data, **{**options, "by": column})
    return [
        SeriesStep(one.label, one.job, unit_scales(one.job), one.names)
        for one in read_steps(recipe)
    ]


def check_idle(options: Mapping[str, Any]) -> None:
    """Refuse options that a series cannot keep.

    Raises ``RecipeError`` naming the first.
    """
    for key, idle in IDLE.items():
        if options.get(key) and options[key] not in idle:
            raise RecipeError(key, "has no meaning in a series: all of it has one scale, no more")


def in_turn(
    weights: Mapping[str, Mapping[str, float]], palette: Sequence[str]
) -> Callable[[Word], str | None]:
    """Colour of a word in all steps: those of the palette in turn, from the word seen largest.

    Examples
    --------
    >>> colour = in_turn({"1": {"bear": 2, "fox": 1}, "2": {"fox": 3}}, ["red", "blue"])
    >>> colour(Word("bear", 1.0)), colour(Word("fox", 1.0))
    ('blue', 'red')
    """
    largest: dict[str, float] = {}
    for words in weights.values():
        for word, weight in words.items():
            key = word.casefold()
            largest[key] = max(weight, largest.get(key, 0.0))
    order = sorted(largest, key=lambda key: -largest[key])
    return _Colours({key: palette[k % len(palette)] for k, key in enumerate(order) if palette})


class _Colours:
    """Colours by word; what a manifest says of it is its name."""

    __qualname__ = "series"

    def __init__(self, known: Mapping[str, str]) -> None:
        self._known = known

    def __call__(self, word: Word) -> str | None:
        return self._known.get(word.text.casefold())


def _heights(job: Job) -> FloatArray:
    """``(n,)`` scales at which heights of letters are as the weights say."""
    use = job.use
    if not isinstance(use, WordsUse) or use.read.items != job.items:
        raise RecipeError("series", "is of words alone")
    weights = np.array([word.weight for word in use.read.words])
    return height_shares(use.read.items, weights, use.options.weight_is)


def step_files(templates: Sequence[str], column: str, labels: Sequence[str]) -> list[list[Path]]:
    """Files of each step, all checked before the first is made.

    ``templates``: names with a place for the column, as ``out/{year}.svg``; ``{row}`` is a step's
    number.

    Raises ``RecipeError`` if a name lacks the column, or a step cannot be part of one, or two steps
    have one file.
    Raises ``WriteError`` if the ending of a file is none of ours.
    """
    for template in templates:
        if not is_session(template):
            writers.check_output(template)
        named = set(columns_of(template))
        if not named & {column, ROW} or not named <= {column, ROW}:
            raise RecipeError(
                "output",
                f"{template} names not each step's file; write it as out/{{{column}}}.svg",
            )
    taken: dict[str, str] = {}
    found = []
    for number, label in enumerate(labels, start=1):
        files = [path_of(one, {ROW: number, column: label}) for one in templates]
        for path in files:
            writers.check_writable(path)
            other = taken.setdefault(identity_of(path), label)
            if other != label:
                raise RecipeError("output", f"{path} is {other}'s and {label}'s; use {{row}}")
        found.append(files)
    return found
