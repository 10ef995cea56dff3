"""One run as the command line makes it: check, run, write, show.

Imported only when a run begins, since it imports the whole pipeline.
"""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import typer
from rich.console import Console

from packwork import pipeline, writers
from packwork.cli.failure import INTERRUPTED, SHORTFALL, Interrupt
from packwork.cli.show import Bar, metrics_table, notice_if_slow, seconds_line
from packwork.recipe import Recipe
from packwork.scene.layout import Layout

MOST_NAMED = 5
"""Items without a place that are named on the terminal; a report names all. Chosen."""

COMPILING = "Compiling the kernels: on the first run only, up to 20 s ..."


def run_and_write(
    recipe: Recipe,
    outputs: Sequence[Path],
    writing: writers.WriteOptions,
    report: Path | None = None,
    diagnose: Path | None = None,
    quiet: bool = False,
) -> int:
    """Run a recipe, write all that was asked for, show the measures.

    Outputs are checked before the run, so that no run is lost to a bad path.

    Returns
    -------
    int
        The exit code: 0, 1 if an item was not placed, 130 after Ctrl-C.
    """
    for path in outputs:
        writers.check_output(path)
    for side in (report, diagnose):
        if side is not None:
            writers.check_writable(side)
    console = Console(quiet=quiet, highlight=False)
    job = pipeline.read(recipe)
    with notice_if_slow(console, COMPILING):
        pipeline.warm_up()
    bar = Bar(recipe.solve_options().epochs, console)
    interrupt = Interrupt()
    with interrupt.listening():
        with bar.showing():
            run = pipeline.run(job, None if quiet else bar, interrupt)
        began = time.perf_counter()
        _write(run.layout, outputs, writing, diagnose)
        results = run.report(time.perf_counter() - began)
        if report is not None:
            writers.write_atomic(report, writers.json_bytes(results))
    _warn(run)
    _show(results, outputs, console)
    if interrupt.pressed:
        typer.echo("packwork: stopped by Ctrl-C; this is the best so far, still rough", err=True)
        return INTERRUPTED
    return SHORTFALL if run.unplaced or run.is_rough else 0


def _write(
    layout: Layout, outputs: Sequence[Path], writing: writers.WriteOptions, diagnose: Path | None
) -> None:
    """Draw all before anything is written, so that a drawing that fails leaves nothing."""
    files = [(path, writers.encoded(layout, path, writing)) for path in outputs]
    if diagnose is not None:
        files.append((diagnose, writers.diagnose_png(layout, writing.png_side_px)))
    for path, data in files:
        writers.write_atomic(path, data)


def _warn(run: pipeline.Run) -> None:
    if run.is_rough:
        exact = run.metrics.exact
        typer.echo(
            f"packwork: still rough: {100 * exact.overlap:.1f} % of the container is covered "
            f"twice, {100 * exact.exceeding:.1f} % as much lies outside; try more --effort, "
            "fewer items or --sizes free",
            err=True,
        )
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


def _show(results: Mapping[str, Any], outputs: Sequence[Path], console: Console) -> None:
    console.print(metrics_table(results["metrics"]))
    console.print(
        f"{results['placed']} of {results['items']} items placed; "
        f"{seconds_line(results['seconds'])}",
        style="dim",
        soft_wrap=True,
    )
    written = ", ".join(str(path) for path in outputs)
    console.print(f"wrote {written}", soft_wrap=True, markup=False)
