"""``--series``: a layout for each step of a table, as files, a film, a sheet of all."""

from __future__ import annotations

import contextlib
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn

import numpy as np
import typer

from packwork import threads, writers
from packwork.batches.sheet import THUMB_PX, sheet_bytes
from packwork.cli.failure import INTERRUPTED, SHORTFALL, Interrupt
from packwork.cli.options import Choosing, part_of
from packwork.cli.outputs import Outputs, outputs_asked, saving
from packwork.cli.running import compile_kernels
from packwork.cli.terminal import printable, say
from packwork.display.bar import TerminalBar
from packwork.errors import RecipeError
from packwork.phrasing import number_of
from packwork.pipeline import tell_coarse
from packwork.readers.layouts.read import is_session
from packwork.readers.words.shaping import EM_PX
from packwork.readers.words.table import named_column, read_word_steps
from packwork.sources import check_no_input
from packwork.timeline.film import filmed
from packwork.timeline.solve import Solved, report, solved
from packwork.timeline.step import chart_steps, step_files, word_steps

if TYPE_CHECKING:
    from packwork.timeline.step import SeriesStep

SECONDS_EACH = 1.5
"""Length of a film for each step, where none is asked for. Chosen by eye."""

IDLE = ("diagnose", "save_recipe", "show_saliency")
"""What is written of one layout only."""


def carry_out_words(
    container: str, source: str | None, asked: Mapping[str, Any], said: Mapping[str, Any]
) -> NoReturn:
    """Make and write all steps of a cloud that a command line asks for, and leave.

    ``asked`` are all options of the command by name, ``said`` those of the recipe.
    """
    if source is not None:
        raise RecipeError("series", f"is in place of SOURCE; leave {source[:40]!r} out")
    _check(asked)
    file, column = named_column(asked["series"])
    read = read_word_steps(file, column)
    for notice in read.notices:
        say(f"{file}: {notice}")
    outputs = _files(asked, "words", column, list(read.weights))
    steps = word_steps(container, read.weights, background=asked["background"], **said)
    _carry_out(steps, *outputs, asked["quiet"], "word")


def carry_out_chart(
    container: str, data: str, asked: Mapping[str, Any], said: Mapping[str, Any]
) -> NoReturn:
    """Make and write all steps of a chart that a command line asks for, and leave."""
    _check(asked)
    steps = chart_steps(container, data, asked["series"], background=asked["background"], **said)
    outputs = _files(asked, "chart", asked["series"], [step.label for step in steps])
    _carry_out(steps, *outputs, asked["quiet"], "mark")


def _carry_out(
    steps: Sequence[SeriesStep],
    outputs: Outputs,
    files: Sequence[Sequence[Path]],
    quiet: bool,
    kind: str,
) -> NoReturn:
    """Make and write steps, and leave with the exit code."""
    for path in outputs.every:
        check_no_input(path)
    series = _made(steps, quiet)
    written = _write(series, outputs, files)
    if not quiet:
        typer.echo(printable(summary(series, kind)))
        typer.echo(printable(f"wrote {number_of(len(written), 'file')}: {_named(written)}"))
    for step, run in zip(series.steps, series.runs, strict=True):
        for lack in (*run.broken, *(f"{one.item}: {one.reason}" for one in run.unplaced)):
            say(f"{step.label}: {lack}")
    raise typer.Exit(0 if series.is_as_asked else SHORTFALL)


def _check(asked: Mapping[str, Any]) -> None:
    for key in IDLE:
        if asked.get(key) is not None:
            raise RecipeError(key, "is of one layout; leave it out of a series")
    choosing = part_of(Choosing, asked)
    if choosing.best_of > 1:
        raise RecipeError("best_of", "is of one layout; leave it out of a series")


def _files(
    asked: Mapping[str, Any], verb: str, column: str, labels: Sequence[str]
) -> tuple[Outputs, list[list[Path]]]:
    """Outputs of a series, checked before it is made, and those of each step among them."""
    if asked.get("seconds") is None:
        asked = {**asked, "seconds": SECONDS_EACH * len(labels)}
    outputs = outputs_asked(asked, Path(f"{verb}-{{{column}}}.svg"))
    steps = step_files(list(map(str, outputs.files)), column, labels)
    outputs = replace(outputs, files=[path for files in steps for path in files])
    outputs.check_paths()
    return outputs, steps


def _write(series: Solved, outputs: Outputs, steps: Sequence[Sequence[Path]]) -> list[Path]:
    """Write all files; which they are."""
    options, sheet = outputs.options, outputs.choosing.contact_sheet
    pairs = [
        (path, writers.encoded(run.layout, path, options))
        for files, run in zip(steps, series.runs, strict=True)
        for path in files
        if not is_session(path)
    ]
    if outputs.films:
        background = options.svg.background or "white"
        film = writers.Film(filmed(series), outputs.filming, background, options.svg.show_container)
        pairs += [(path, writers.film_bytes(film, path)) for path in outputs.films]
    if sheet is not None:
        small = [writers.png_bytes(run.layout, THUMB_PX) for run in series.runs]
        pairs.append((sheet, sheet_bytes(small, [step.label for step in series.steps])))
    if outputs.report is not None:
        pairs.append((outputs.report, writers.json_bytes(report(series))))
    with contextlib.ExitStack() as saved:
        for files, run in zip(steps, series.runs, strict=True):
            pairs += saved.enter_context(saving(outputs.with_drawing(run.layout), files))
        writers.write_all(pairs)
    for run in series.runs:
        tell_coarse(run.layout, options.dpi)
    return [path for path, _ in pairs]


def _made(steps: Sequence[SeriesStep], quiet: bool) -> Solved:
    """The series, with a bar; Ctrl-C leaves nothing, for no step is final before the last."""
    with threads.using(steps[0].job.recipe.threads):
        compile_kernels(TerminalBar(None, quiet))
    bar, interrupt = TerminalBar(None, quiet), Interrupt()

    def tell(done: int) -> None:
        bar.tell(done / len(steps), f"{done} of {len(steps)} steps")

    with interrupt.listening(), bar.showing():
        try:
            series = solved(steps, told=tell, stop=interrupt)
        except Exception:
            if interrupt.pressed:
                say("stopped by Ctrl-C; nothing is written")
                raise typer.Exit(INTERRUPTED) from None
            raise
        interrupt.is_over = True
    return series


def summary(series: Solved, kind: str) -> str:
    """Summary of a series in one line; ``kind`` is what its items are called."""
    certified = sum(run.certified for run in series.runs)
    many = len(series.runs)
    of = "all certified" if certified == many else f"{certified} certified"
    parts = [f"{many} steps", of]
    if kind == "word":
        largest = max(float(run.layout.poses.scale.max()) for run in series.runs) * EM_PX
        parts.append(f"the largest letters {largest:.3g} {series.steps[0].job.container.unit}")
    moves = np.concatenate(series.moves)
    still = f"; a {kind} moves by {100 * np.median(moves):.1f} % of the diagonal (median)"
    return ", ".join(parts) + (still if len(moves) else "")


def _named(written: Sequence[Path]) -> str:
    few = [str(path) for path in written[:3]]
    return ", ".join(few) + (f" … {written[-1]}" if len(written) > 3 else "")
