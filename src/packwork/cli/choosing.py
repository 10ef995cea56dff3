"""Several seeds of one run, the best of them kept, as the command line asks for it."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from packwork import pipeline, writers
from packwork.cli.failure import Interrupt
from packwork.cli.files import Choosing
from packwork.display.bar import TerminalBar
from packwork.errors import RecipeError
from packwork.progress import NOBODY
from packwork.recipe import Recipe


def check_choosing(choosing: Choosing) -> None:
    """Refuse what has no meaning for a choice.

    Raises
    ------
    RecipeError
        Before anything has been run.
    """
    if choosing.best_of == 1:
        for key, usual in Choosing().model_dump(exclude={"best_of"}).items():
            if getattr(choosing, key) != usual:
                raise RecipeError(key, "is of --best-of; say of how many, as --best-of 8")
        return
    from packwork.batches.seeds import check_metric

    check_metric(choosing.best_by)


def run_chosen(
    job: pipeline.Job,
    choosing: Choosing,
    bar: TerminalBar,
    interrupt: Interrupt,
    *,
    record: bool,
    quiet: bool,
) -> tuple[pipeline.Run, tuple[pipeline.Run, ...]]:
    """A run, or the best of several, and all that were tried then."""
    if choosing.best_of == 1:
        return pipeline.run(job, NOBODY if quiet else bar, interrupt, record), ()
    from packwork.batches.seeds import best_of

    def tell(done: int) -> None:
        bar.tell(done / choosing.best_of, f"{done} of {choosing.best_of} seeds")

    found = best_of(
        job.recipe, choosing.best_of, choosing.best_by, record, job.recipe.threads, tell, interrupt
    )
    return found.best, found.runs


def seeded(recipe: Recipe, run: pipeline.Run) -> Recipe:
    """The recipe with the seed of a run."""
    return recipe.model_copy(update={"seed": run.layout.manifest["seed"]})


def sheet_of(tried: Sequence[pipeline.Run], choosing: Choosing) -> list[tuple[Path, bytes]]:
    """The picture of all that were tried, if it is asked for, and its bytes."""
    if choosing.contact_sheet is None or not tried:
        return []
    from packwork.batches.sheet import THUMB_PX, sheet_bytes

    pictures = [writers.png_bytes(run.layout, THUMB_PX) for run in tried]
    return [(choosing.contact_sheet, sheet_bytes(pictures))]
