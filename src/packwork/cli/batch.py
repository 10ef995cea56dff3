"""``packwork batch``: a recipe for each row of a table, on all cores, gone on with at any time."""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer
from pydantic import Field

from packwork.cli import options as shared
from packwork.cli.failure import INTERRUPTED, SHORTFALL, Interrupt, clear_errors
from packwork.cli.options import Terminal
from packwork.cli.terminal import MOST_LINES, printable, say
from packwork.errors import RecipeError, WriteError
from packwork.options import Offer, Options, Verbs
from packwork.phrasing import enumerated, number_of
from packwork.writers.options import DrawingOptions

if TYPE_CHECKING:
    from packwork.batches.batch import BatchPlan, BatchProgress
    from packwork.batches.task import RowOutcome, Status
    from packwork.display.bar import TerminalBar

MOST_NAMED = 20
"""Rows that are named on the terminal; a report names all. Chosen."""

_STATUS_WORDS: Mapping[Status, str] = {
    "made": "made", "short": "made, but not as asked", "kept": "made already", "failed": "failed",
    "stopped": "not made",
}  # fmt: skip
"""What is said of rows by their status."""

OF_ONE_LAYOUT = ("tiles", "cut", "kiss_cut")
"""Options of drawing that batches do without."""


class BatchFiles(Options):
    """Files that are written of all rows together; None for none."""

    offers = Offer(verbs=Verbs.EVERY)

    report: Path | None = None
    """Table of all rows with their metrics (CSV or JSON)."""

    contact_sheet: Path | None = None
    """Small pictures of all rows on one (PNG)."""

    index: Path | None = None
    """Page of all rows to look through (HTML)."""

    @property
    def paths(self) -> list[Path]:
        """Those that are asked for."""
        return [p for p in (self.report, self.contact_sheet, self.index) if p is not None]

    def check(self) -> None:
        """Refuse, before anything is run, what could not be written."""
        from packwork import writers
        from packwork.batches.report import report_bytes

        writers.check_all(self.paths)
        if self.report is not None:
            report_bytes(self.report, [])

    def check_plan(self, plan: BatchPlan) -> None:
        """Refuse files that rows have too, and a sheet of what shows nothing."""
        from packwork.batches.sheet import SEEN, pictured_file
        from packwork.batches.templates import identity_of

        taken = {identity_of(path) for task in plan.tasks for path in task.outputs}
        for path in self.paths:
            if identity_of(path) in taken:
                raise WriteError(path, "is a row's file too; use another name")
        if self.contact_sheet and plan.tasks and pictured_file(plan.tasks[0].outputs) is None:
            raise RecipeError("contact_sheet", f"needs rows' files of {enumerated(SEEN, 9)}")

    def write(self, found: Sequence[RowOutcome]) -> list[Path]:
        """Write what is asked for; which files these are."""
        from packwork import writers
        from packwork.batches.report import index_bytes, report_bytes
        from packwork.batches.sheet import pictured_file, sheet_bytes

        shown = [file for one in found if (file := pictured_file(one.outputs)) is not None]
        made = []
        if self.report is not None:
            made.append((self.report, report_bytes(self.report, found)))
        if self.index is not None:
            made.append((self.index, index_bytes(self.index, found)))
        if self.contact_sheet is not None and shown:
            made.append((self.contact_sheet, sheet_bytes(shown)))
        writers.write_all(made)
        return [path for path, _ in made]


class BatchWorkers(Options):
    """Processes that make the rows, and which rows they make."""

    offers = Offer(verbs=Verbs.EVERY)

    workers: Annotated[int | None, Field(ge=1)] = None
    """Processes at once; one a core unless given."""

    scheduler: Annotated[str | None, Offer(metavar="ADDRESS")] = None
    """Scheduler of a running cluster of Dask, as tcp://10.0.0.1:8786, whose workers make the rows;
    needs packwork[cluster]."""

    in_place: bool = False
    """Workers of the cluster see the same files, and write the outputs themselves."""

    dry_run: bool = False
    """Say what would be made, and make nothing."""

    anew: bool = False
    """Make what is made already, too."""


@shared.of_models(BatchWorkers, BatchFiles, DrawingOptions, Terminal, without=OF_ONE_LAYOUT)
def batch(
    recipe: Annotated[
        Path,
        typer.Argument(
            metavar="RECIPE.toml",
            help="A recipe in which {column} stands for a cell of the table; or a folder of "
            "recipes.",
        ),
    ],
    table: Annotated[
        Path | None,
        typer.Option("--table", help="CSV, TSV, JSON or Parquet: a run for each row."),
    ] = None,
    output: Annotated[
        list[str],
        typer.Option(
            "-o",
            "--output",
            metavar="FILE",
            help="A row's file, as 'out/{name}.svg': {row} is its number, {recipe} the name of "
            "the recipe's file. May be given several times.",
        ),
    ] = [],  # noqa: B006
    allow_code: shared.AllowCode = False,
    **asked: Any,
) -> None:
    """Run a recipe for each row of a table, on all cores.

    A row that cannot be made is named, all others are; the same command goes on where it ended,
    and makes anew what has changed. Exit code 1 if a row is not as asked.

    [bold]packwork batch poster.toml --table people.csv -o 'out/{name}.svg' -o 'out/{name}.pdf'[/]

    [bold]packwork batch poster.toml --table people.csv -o 'out/{name}.png' --dry-run[/]

    [bold]packwork batch recipes/ -o 'out/{recipe}.svg' --index out/index.html[/]
    """
    with clear_errors():
        from packwork.batches.batch import batch_progress, plan_batch, read_request

        by, files = shared.part_of(BatchWorkers, asked), shared.part_of(BatchFiles, asked)
        quiet = asked["quiet"]
        drawing = {name: asked[name] for name in DrawingOptions.model_fields if name in asked}
        files.check()
        request = read_request(recipe, table, output, drawing, allow_code=allow_code)
        for notice in request.notices:
            say(notice)
        plan = plan_batch(request)
        files.check_plan(plan)
        if plan.outside:
            say(f"rows read files outside the recipe's folder: {enumerated(plan.outside, 5)}")
        now = batch_progress(plan, anew=by.anew)
        if by.dry_run:
            _say_what_would_be(plan, now, quiet)
            raise typer.Exit(SHORTFALL if plan.bad else 0)
        if by.in_place and by.scheduler is None:
            raise RecipeError("in_place", "is of --scheduler; say which, as tcp://10.0.0.1:8786")
        raise typer.Exit(_make_rows(plan, now, by, files, quiet))


class _RateBar:
    """Moves a bar: rows done and failed, how many a minute, time left."""

    def __init__(self, bar: TerminalBar, to_do: int) -> None:
        self._bar, self._to_do = bar, to_do
        self._done = self._failed = 0
        self._began = time.monotonic()

    def __call__(self, outcome: RowOutcome) -> None:
        """Count one more."""
        self._done += 1
        self._failed += outcome.status == "failed"
        rate = self._done / max(time.monotonic() - self._began, 1e-3)
        left = (self._to_do - self._done) / rate
        text = (
            f"{self._done} of {self._to_do} rows, {60 * rate:.0f} a minute, {_duration(left)} left"
        )
        self._bar.tell(
            self._done / self._to_do, text + (f", {self._failed} failed" if self._failed else "")
        )


def _duration(seconds: float) -> str:
    """Time as people say it: 40 s, 10 min."""
    return f"{seconds:.0f} s" if seconds < 120 else f"{seconds / 60:.0f} min"


def _make_rows(
    plan: BatchPlan, now: BatchProgress, by: BatchWorkers, files: BatchFiles, quiet: bool
) -> int:
    """Make what is to be made, and tell of it; the exit code."""
    from packwork import threads
    from packwork.batches.batch import run_batch
    from packwork.cli.running import compile_kernels
    from packwork.display.bar import TerminalBar

    if now.to_do and by.scheduler is None:
        with threads.using(1):
            compile_kernels(TerminalBar(None, quiet))
    bar, interrupt = TerminalBar(None, quiet), Interrupt()
    with interrupt.listening():
        with bar.showing():
            teller = _RateBar(bar, max(len(now.to_do), 1))
            found = run_batch(
                plan, now, by.workers, told=teller, stop=interrupt,
                scheduler=by.scheduler, in_place=by.in_place,
            )  # fmt: skip
        interrupt.is_over = True
        written = files.write(found)
    _say_what_came(found, written, quiet)
    if any(one.status == "stopped" for one in found):
        if by.scheduler is not None and not interrupt.pressed:
            say(f"{by.scheduler} is lost; the same command goes on with the rest")
            return SHORTFALL
        say("stopped by Ctrl-C; the same command goes on with the rest")
        return INTERRUPTED
    return 0 if all(one.is_well for one in found) else SHORTFALL


def _say_what_would_be(plan: BatchPlan, now: BatchProgress, quiet: bool) -> None:
    """Tell of a dry run."""
    if not quiet:
        for task in now.to_do[:MOST_NAMED]:
            typer.echo(printable(f"{task.row}. {task.name}: {', '.join(map(str, task.outputs))}"))
        if len(now.to_do) > MOST_NAMED:
            typer.echo(f"and {len(now.to_do) - MOST_NAMED:,} more")
        typer.echo(
            f"{number_of(len(now.to_do), 'row')} to make, {len(now.kept)} made already, "
            f"{len(plan.bad)} that cannot be"
        )
    _name_bad(plan.bad)


def _say_what_came(found: Sequence[RowOutcome], written: Sequence[Path], quiet: bool) -> None:
    """Tell what has become of the rows, and name those that are not as asked."""
    notices = Counter(notice for one in found for notice in one.notices)
    for notice, times in notices.most_common(MOST_LINES):
        say(f"{number_of(times, 'row')}: {notice}")
    if len(notices) > MOST_LINES:
        say(f"and {len(notices) - MOST_LINES} notices more")
    _name_bad([one for one in found if one.status in {"failed", "short"}])
    if not quiet:
        counts = Counter(one.status for one in found)
        said = [
            f"{counts[status]} {words}" for status, words in _STATUS_WORDS.items() if counts[status]
        ]
        typer.echo(f"{number_of(len(found), 'row')}: {', '.join(said)}")
        if written:
            typer.echo(printable(f"wrote {', '.join(map(str, written))}"))


def _name_bad(bad: Sequence[RowOutcome]) -> None:
    for one in bad[:MOST_NAMED]:
        is_made = one.status == "short"
        say(f"row {one.row} ({one.name}): {'made, but ' if is_made else ''}{one.said}")
    if len(bad) > MOST_NAMED:
        say(f"and {len(bad) - MOST_NAMED:,} rows more; --report names all")
