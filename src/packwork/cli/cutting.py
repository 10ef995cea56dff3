"""``--kiss-cut``: items far enough apart for the lines that are cut round them."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from packwork import pipeline
from packwork.cli.terminal import say
from packwork.errors import RecipeError, WriteError
from packwork.recipe import Recipe
from packwork.recipe.verbs import VERBS, default_of, options_of
from packwork.units import split_length
from packwork.writers.cutting import kiss_cut

UNASKED = frozenset(
    default_of(verb, option)
    for verb in VERBS
    for option in options_of(verb)
    if option.name == "padding"
)
"""Paddings that commands have by themselves."""

HAIR = 1.001
"""Factor on twice the distance: lines that are cut do not touch. Smaller is lost in rounding."""


def with_room(recipe: Recipe, kiss: str | None) -> Recipe:
    """Recipe whose padding lets lines at a distance lie between items, if none was asked for."""
    number, unit = split_length(kiss or "") or (0.0, "")
    if number <= 0 or str(recipe.padding) not in UNASKED:
        return recipe
    padding = f"{2 * number * HAIR:.12g}{unit}"
    say(f"padding is {padding}, twice the --kiss-cut, so that no two cut lines meet")
    return recipe.model_copy(update={"padding": padding})


def check_room(job: pipeline.Job, kiss: str | None) -> None:
    """Refuse a padding between which two lines at a distance would not fit.

    Raises
    ------
    RecipeError
        Naming the padding that would do.
    """
    if kiss is None:
        return
    container = job.container
    offset = kiss_cut(kiss, container.unit, container.side)
    if job.recipe.padding_cu(container) < 2 * offset:
        raise RecipeError(
            "kiss_cut",
            f"{kiss} on either side needs a --padding of {2 * HAIR * offset:.6g} {container.unit} "
            f"or more, not {job.recipe.padding}",
        )


def check_bleed(files: Iterable[Path], bleed: str | None) -> None:
    """Refuse a bleed where no file can have one.

    Raises
    ------
    WriteError
        If none of the files is a PDF.
    """
    files = list(files)
    if bleed is not None and not any(file.suffix.lower() == ".pdf" for file in files):
        raise WriteError(files[0], "has no bleed; --bleed is for a PDF, such as -o print.pdf")
