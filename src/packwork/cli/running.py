"""One run as the command line makes it: check, run, write, show.

Imported only when a run begins, since it imports the whole pipeline.
"""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import typer
from rich.console import Console

from packwork import pipeline, writers
from packwork.cli.failure import INTERRUPTED, SHORTFALL, Interrupt
from packwork.cli.show import (
    Paper,
    certificate_line,
    filling_line,
    metrics_table,
    notice_if_slow,
    pile_line,
    printing,
    seconds_line,
    words_line,
)
from packwork.display.bar import TerminalBar
from packwork.errors import WriteError
from packwork.pipeline.filming import film_options
from packwork.readers.quiet.container import AROUND
from packwork.recipe import Recipe
from packwork.writers.film.options import FilmOptions

MOST_NAMED = 5
"""Items without a place that are named on the terminal; a report names all. Chosen."""

LONGEST_NAME = 255
"""Characters of a file's name, on most systems."""

COMPILING = "Compiling the kernels: once after each installation, up to 40 s ..."


@dataclass(frozen=True, kw_only=True)
class Outputs:
    """All that one run is to write.

    Parameters
    ----------
    files
        Layouts, each in the format of its ending.
    options
        How they are drawn.
    films, filming
        Films of the run, and how they are made.
    report, diagnose, recipe
        Measures (JSON), the diagnostic picture (PNG), the recipe (TOML); None for none.
    """

    files: Sequence[Path]
    options: writers.WriteOptions
    films: Sequence[Path] = ()
    filming: FilmOptions = field(default_factory=FilmOptions)
    report: Path | None = None
    diagnose: Path | None = None
    recipe: Path | None = None

    @property
    def sides(self) -> list[Path]:
        """What is written beside the layouts."""
        return [side for side in (self.report, self.diagnose, self.recipe) if side is not None]

    @property
    def every(self) -> list[Path]:
        """All files."""
        return [*self.files, *self.films, *self.sides]

    def check(self, recipe: Recipe) -> None:
        """Refuse paths that cannot be written, that collide, or that the run reads.

        Raises
        ------
        WriteError
            Before anything has been run or written.
        """
        for path in self.files:
            writers.check_output(path)
        for path in self.films:
            writers.check_film(path)
        for side in self.sides:
            writers.check_writable(side)
        writers.check_outputs(self.every)
        named = [recipe.container.removeprefix(AROUND), *recipe.items]
        if recipe.photos is not None:
            named += recipe.photos.sources
        if recipe.words is not None and isinstance(recipe.words.source, str):
            # A text itself is no file; nor could so long a name be one.
            named.append(recipe.words.source[:LONGEST_NAME])
        if recipe.chart is not None:
            named += [*recipe.chart.mark, *([d] if isinstance(d := recipe.chart.data, str) else [])]
        read = {Path(name).resolve() for name in named if "\0" not in name}
        for path in self.every:
            if path.resolve() in read:
                raise WriteError(path, "is read by this run too; write to another file")


def outputs_asked(
    files: Sequence[Path],
    *,
    report: Path | None = None,
    diagnose: Path | None = None,
    recipe: Path | None = None,
    pixels: int = 1_600,
    dpi: float | None = None,
    background: str | None = None,
    show_container: bool = False,
    flatten: bool = False,
    text: writers.TextChoice = "outlines",
    film: Sequence[Path] | None = None,
    recipes: FilmOptions | None = None,
    **filming: Any,
) -> Outputs:
    """What the flags of a command ask to be written.

    Parameters
    ----------
    files
        Layouts.
    report, diagnose, recipe
        As in :class:`Outputs`.
    pixels, dpi, background, show_container, flatten, text
        How layouts are drawn, and films but for their size.
    film
        Films; None for none.
    recipes, filming
        How films are made: as the recipe says, and as the flags do.
    """
    return Outputs(
        files=files,
        options=writers.write_options(
            pixels=pixels,
            dpi=dpi,
            background=background,
            show_container=show_container,
            flatten=flatten,
            text=text,
        ),
        films=film or (),
        filming=film_options(recipes, **filming),
        report=report,
        diagnose=diagnose,
        recipe=recipe,
    )


def run_and_write(recipe: Recipe, outputs: Outputs, quiet: bool = False) -> int:
    """Run a recipe, write all that was asked for, show the measures.

    Outputs are checked before the run, so that no run is lost to a bad path.

    Returns
    -------
    int
        The exit code: 0; 1 if an item was not placed or the result is not certified; 130 after
        Ctrl-C.
    """
    outputs.check(recipe)
    console = Paper(quiet=quiet, highlight=False)
    job = pipeline.read(recipe)
    with notice_if_slow(console, COMPILING):
        pipeline.warm_up()
    bar = TerminalBar(console)
    interrupt = Interrupt()
    with interrupt.listening():
        with bar.showing():
            run = pipeline.run(job, None if quiet else bar, interrupt, bool(outputs.films))
            was_cut_short = interrupt.pressed
            began = time.perf_counter()
            films = _filmed(run, outputs, bar, interrupt)
        was_stopped = was_cut_short or len(films) < len(outputs.films)
        results = _write(run, recipe, outputs, films, began)
        interrupt.is_over = True
        _warn(run, was_cut_short)
        written = [path for path in outputs.every if path not in outputs.films]
        written += [path for path, _ in films]
        try:
            with printing():
                _show(results, written, console, run.layout.container.unit)
        except WriteError as error:
            # The files are there; that is what was asked for.
            typer.echo(f"packwork: {error}; all files are written", err=True)
        if was_cut_short:
            worth = "certified" if run.certified else "not certified"
            typer.echo(f"packwork: stopped by Ctrl-C; this is the best so far, {worth}", err=True)
    return INTERRUPTED if was_stopped else 0 if run.is_as_asked else SHORTFALL


def _filmed(
    run: pipeline.Run, outputs: Outputs, bar: TerminalBar, interrupt: Interrupt
) -> list[tuple[Path, bytes]]:
    """Bytes of all films; none if Ctrl-C was pressed meanwhile, so that none is half a film."""
    if not outputs.films:
        return []
    options, was_pressed = outputs.options, interrupt.pressed
    film = writers.Film(
        run.layout, outputs.filming, options.png.background or "none", options.svg.show_container
    )

    def encoded(path: Path) -> bytes:
        def tell(share: float) -> None:
            bar.tell(share, f"film {path.name}")
            if interrupt.pressed and not was_pressed:
                raise KeyboardInterrupt

        return writers.film_bytes(film, path, tell)

    try:
        return [(path, encoded(path)) for path in outputs.films]
    except KeyboardInterrupt:
        interrupt.pressed = True
        typer.echo("packwork: stopped by Ctrl-C: no film was written", err=True)
        return []


def _write(
    run: pipeline.Run,
    recipe: Recipe,
    outputs: Outputs,
    films: Sequence[tuple[Path, bytes]],
    began: float,
) -> dict[str, Any]:
    """Draw all, then write all, so that what fails leaves nothing; return the report."""
    layout, options = run.layout, outputs.options
    files = [(path, writers.encoded(layout, path, options)) for path in outputs.files]
    if outputs.diagnose is not None:
        files.append((outputs.diagnose, writers.diagnose_png(layout, options.png_side_px)))
    if outputs.recipe is not None:
        kept = recipe
        if outputs.filming.model_fields_set:
            kept = recipe.model_copy(update={"film": outputs.filming})
        saved = writers.recipe_bytes(kept.plain(), outputs.recipe.parent)
        files.append((outputs.recipe, saved))
    results = run.report(time.perf_counter() - began)
    if outputs.report is not None:
        files.append((outputs.report, writers.json_bytes(results)))
    writers.write_all([*files, *films])
    return results


def _warn(run: pipeline.Run, was_cut_short: bool) -> None:
    for unplaced in run.unplaced[:MOST_NAMED]:
        typer.echo(
            f"packwork: not placed: {unplaced.item} (item {unplaced.index + 1}): {unplaced.reason}",
            err=True,
        )
    more = len(run.unplaced) - MOST_NAMED
    if more > 0:
        typer.echo(f"packwork: not placed: {more} more; --report names them all", err=True)
    share = float(run.layout.areas.sum()) / run.layout.container.outline.area
    if run.unplaced and share > 1:
        typer.echo(
            f"packwork: the items' area is {share:.1f} times the container's; "
            "use fewer, a larger --canvas or --sizes free",
            err=True,
        )
    for fault in run.broken:
        typer.echo(f"packwork: {fault}", err=True)
    if run.is_rough:
        exact = run.metrics.exact
        option = "--effort" if run.layout.manifest["recipe"]["time"] is None else "--time"
        remedy = f"try more {option}, fewer items or --sizes free"
        if was_cut_short:
            remedy = "let it run to its end"
        typer.echo(
            f"packwork: still rough: {100 * exact.overlap:.1f} % of the container is covered "
            f"twice, {100 * exact.exceeding:.1f} % as much lies outside; {remedy}",
            err=True,
        )


def _show(results: Mapping[str, Any], outputs: Sequence[Path], console: Console, unit: str) -> None:
    console.print(metrics_table(results["metrics"], unit))
    console.print(
        f"{results['placed']} of {results['items']} items placed; "
        f"{seconds_line(results['seconds'])}",
        style="dim",
        soft_wrap=True,
    )
    if results["words"] is not None and results["words"]["found"] > results["words"]["asked"]:
        console.print(words_line(results["words"]), style="dim")
    if results["beside"] is not None:
        console.print(f"{results['beside']} pairs of one kind lie side by side", style="dim")
    if results["filling"] is not None:
        console.print(filling_line(results["filling"]), style="dim")
    if results["pile"] is not None:
        console.print(pile_line(results["pile"]), style="dim")
    console.print(certificate_line(results["promised"], results["certified"]))
    written = ", ".join(str(path) for path in outputs)
    console.print(f"wrote {written}", soft_wrap=True, markup=False)
