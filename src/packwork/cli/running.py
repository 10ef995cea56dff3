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
    with notice_if_slow(console, COMPILING):
        pipeline.warm_up()
    bar = Bar(recipe.solve_options().epochs, console)
    interrupt = Interrupt()
    with interrupt.listening():
        with bar.showing():
            run = pipeline.fill(recipe, observer=None if quiet else bar, stop=interrupt)
        began = time.perf_counter()
        _write(run.layout, outputs, writing, diagnose)
        results = run.report(time.perf_counter() - began)
        if report is not None:
            writers.write_atomic(report, writers.json_bytes(results))
    _warn(run)
    _show(results, outputs, console)
    if interrupt.pressed:
        return INTERRUPTED
    return SHORTFALL if run.unplaced else 0


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
    for error in run.skipped:
        typer.echo(f"packwork: left out {error}", err=True)
    for unplaced in run.unplaced:
        typer.echo(
            f"packwork: not placed: {unplaced.item} (item {unplaced.index + 1}): {unplaced.reason}",
            err=True,
        )


def _show(results: Mapping[str, Any], outputs: Sequence[Path], console: Console) -> None:
    console.print(metrics_table(results["metrics"]))
    console.print(
        f"{results['placed']} of {results['items']} items placed; "
        f"{seconds_line(results['seconds'])}",
        style="dim",
    )
    console.print("wrote " + ", ".join(str(path) for path in outputs))
