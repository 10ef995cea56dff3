"""``--series``: a layout for each step of a table, as files, a film, a sheet of all."""

from __future__ import annotations

import contextlib
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn

import numpy as np
import typer

from packwork import threads, writers
from packwork.batches.sheet import THUMB_PX, sheet_bytes
from packwork.cli.failure import INTERRUPTED, SHORTFALL, Interrupt
from packwork.cli.files import Choosing
from packwork.cli.outputs import saving
from packwork.cli.outputs import told as told_drawing
from packwork.cli.running import compile_kernels
from packwork.cli.terminal import printable, say
from packwork.display.bar import TerminalBar
from packwork.errors import RecipeError
from packwork.inputs import check_no_input
from packwork.phrasing import number_of
from packwork.pipeline import tell_coarse
from packwork.readers.layouts.read import is_session
from packwork.readers.words.items import EM_PX
from packwork.readers.words.table import named_column, read_word_steps
from packwork.recipe.refusals import validated
from packwork.recipe.verbs import film_options
from packwork.timeline.film import filmed
from packwork.timeline.solve import Solved, report, solved
from packwork.timeline.step import chart_steps, step_files, word_steps
from packwork.writers.film.options import FilmOptions
from packwork.writers.options import DrawingOptions

if TYPE_CHECKING:
    from packwork.scene.layout import Layout
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
    outputs = _Files(asked, "words", column, list(read.weights))
    steps = word_steps(container, read.weights, background=asked["background"], **said)
    _carry_out(steps, outputs, asked, "word")


def carry_out_chart(
    container: str, data: str, asked: Mapping[str, Any], said: Mapping[str, Any]
) -> NoReturn:
    """Make and write all steps of a chart that a command line asks for, and leave."""
    _check(asked)
    steps = chart_steps(container, data, asked["series"], background=asked["background"], **said)
    outputs = _Files(asked, "chart", asked["series"], [step.label for step in steps])
    _carry_out(steps, outputs, asked, "mark")


def _carry_out(
    steps: Sequence[SeriesStep], outputs: _Files, asked: Mapping[str, Any], kind: str
) -> NoReturn:
    """Make and write steps, and leave with the exit code."""
    outputs.check_read()
    series = _made(steps, asked["quiet"])
    written = outputs.written(series)
    if not asked["quiet"]:
        typer.echo(printable(told(series, kind)))
        typer.echo(printable(f"wrote {number_of(len(written), 'file')}: {_named(written)}"))
    for step, run in zip(series.steps, series.runs, strict=True):
        for lack in (*run.broken, *(f"{one.item}: {one.reason}" for one in run.unplaced)):
            say(f"{step.label}: {lack}")
    raise typer.Exit(0 if series.is_as_asked else SHORTFALL)


def _check(asked: Mapping[str, Any]) -> None:
    for key in IDLE:
        if asked.get(key) is not None:
            raise RecipeError(key, "is of one layout; leave it out of a series")
    choosing = validated(Choosing, {key: asked[key] for key in Choosing.model_fields})
    if choosing.best_of > 1:
        raise RecipeError("best_of", "is of one layout; leave it out of a series")


class _Files:
    """Output files of a series, checked before it is made; SVGs where none is named."""

    def __init__(
        self, asked: Mapping[str, Any], verb: str, column: str, labels: Sequence[str]
    ) -> None:
        self.films: list[Path] = list(asked["film"] or ())
        self.sheet: Path | None = asked["contact_sheet"]
        self.report: Path | None = asked["report"]
        given = list(map(str, asked["output"] or ()))
        if not (given or self.films or self._sides):
            given = [f"{verb}-{{{column}}}.svg"]
        self.steps = step_files(given, column, labels)
        for path in self.films:
            writers.check_film(path)
        for path in self._sides:
            writers.check_writable(path)
        writers.check_outputs(self.every)
        if asked["no_clobber"]:
            writers.check_new(self.every)
        drawing = {key: asked[key] for key in DrawingOptions.model_fields if key in asked}
        self._drawing = writers.write_options(**drawing)
        self._asked = drawing
        filming = {key: asked[key] for key in FilmOptions.model_fields if key in asked}
        if filming.get("seconds") is None:
            filming["seconds"] = SECONDS_EACH * len(labels)
        self._filming = film_options(**filming)

    @property
    def _sides(self) -> list[Path]:
        return [path for path in (self.sheet, self.report) if path is not None]

    @property
    def every(self) -> list[Path]:
        """All files."""
        return [*(path for files in self.steps for path in files), *self.films, *self._sides]

    def _told(self, layout: Layout) -> Layout:
        """The layout, its manifest saying how it is drawn."""
        return told_drawing(layout, self._drawing.svg.background, self._asked)

    def check_read(self) -> None:
        """Refuse to write over what was read."""
        for path in self.every:
            check_no_input(path)

    def written(self, series: Solved) -> list[Path]:
        """Write all files; which they are."""
        pairs: list[tuple[Path, bytes]] = []
        for files, run in zip(self.steps, series.runs, strict=True):
            pairs += [
                (path, writers.encoded(run.layout, path, self._drawing))
                for path in files
                if not is_session(path)
            ]
        if self.films:
            svg = self._drawing.svg
            film = writers.Film(
                filmed(series), self._filming, svg.background or "white", svg.show_container
            )
            pairs += [(path, writers.film_bytes(film, path)) for path in self.films]
        if self.sheet is not None:
            small = [writers.png_bytes(run.layout, THUMB_PX) for run in series.runs]
            pairs.append((self.sheet, sheet_bytes(small, [step.label for step in series.steps])))
        if self.report is not None:
            pairs.append((self.report, writers.json_bytes(report(series))))
        with contextlib.ExitStack() as saved:
            for files, run in zip(self.steps, series.runs, strict=True):
                pairs += saved.enter_context(saving(self._told(run.layout), files))
            writers.write_all(pairs)
        for run in series.runs:
            tell_coarse(run.layout, self._drawing.dpi)
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


def told(series: Solved, kind: str) -> str:
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
