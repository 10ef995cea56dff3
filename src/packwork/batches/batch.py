"""A batch: a task for each row of a table, or why there is none; what is not made yet, made."""

from __future__ import annotations

import itertools
import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from packwork import writers
from packwork.batches.pool import results, worker_count
from packwork.batches.task import RowOutcome, Status, Task, failed, is_done, make, record_path
from packwork.batches.templates import RECIPE, ROW, columns_of, fill_template, identity_of, path_of
from packwork.errors import PackworkError, ReadError, RecipeError
from packwork.phrasing import enumerated
from packwork.progress import Stop, never
from packwork.readers.layouts.read import is_session
from packwork.readers.recipe import check_no_code, read_template
from packwork.readers.tables.table import Table, read_table
from packwork.recipe import make_recipe
from packwork.recipe.refusals import validated
from packwork.recipe_paths import files_outside, found_from, with_paths
from packwork.writers.options import DrawingOptions

NAMING = ("name", "title", "id")
"""Columns by which a row is called in messages, the first that is there. Chosen."""

MOST_SAID = 60
"""Characters of a row's name in messages at most. Chosen."""

MOST_ROWS = 1_000_000
"""Rows of a batch at most. Chosen."""


@dataclass(frozen=True, eq=False)
class Template:
    """A recipe with places for columns, and the name of its file without ending."""

    name: str
    options: Mapping[str, Any]
    home: Path


@dataclass(frozen=True, kw_only=True)
class BatchRequest:
    """Inputs of a batch."""

    templates: Sequence[Template]
    rows: Sequence[Mapping[str, Any]]
    columns: Sequence[str]
    outputs: Sequence[str]
    drawing: Mapping[str, Any]
    allows_code: bool = False
    notices: Sequence[str] = ()

    @property
    def known(self) -> list[str]:
        """All that may stand in braces."""
        return list(dict.fromkeys([*self.columns, RECIPE, ROW]))


def read_request(
    recipe: str | Path | Mapping[str, Any],
    table: str | Path | Sequence[Mapping[str, Any]] | Any,
    outputs: Sequence[str],
    drawing: Mapping[str, Any],
    *,
    allow_code: bool,
) -> BatchRequest:
    """Inputs of a batch, read and checked: see :func:`packwork.batch`."""
    drawing = validated(DrawingOptions, drawing).model_dump()
    writers.write_options(**drawing)
    templates = _read_templates(recipe, allow_code)
    read = _read_table(table, [one.options for one in templates])
    return BatchRequest(
        templates=templates,
        rows=read.rows,
        columns=read.columns,
        outputs=outputs,
        drawing=drawing,
        allows_code=allow_code,
        notices=read.notices,
    )


def _read_templates(recipe: str | Path | Mapping[str, Any], allow_code: bool) -> list[Template]:
    """Templates of a recipe file, of all in a folder, or of options as a dict."""
    if isinstance(recipe, Mapping):
        return [Template("recipe", dict(recipe), Path.cwd())]
    if not isinstance(recipe, str | os.PathLike):
        raise RecipeError("recipe", f"is {type(recipe).__name__}; give a recipe file or a folder")
    path = Path(recipe)
    files = sorted(path.glob("*.toml")) if path.is_dir() else [path]
    if not 0 < len(files) <= MOST_ROWS:
        raise ReadError(path, f"holds {len(files):,} recipes (.toml); 1 to {MOST_ROWS:,} go")
    return [
        Template(file.stem, read_template(file, allow_code=allow_code), file.parent)
        for file in files
    ]


def _read_table(source: Any, templates: Iterable[Any]) -> Table:
    """Table of a file, of rows, or of a data frame; one row without columns for None.

    Columns that the templates name are read of large files in any case.
    """
    if source is None:
        return Table("data", (), ({},))
    needed = {column for template in templates for column in columns_of(template)}
    if isinstance(source, str | os.PathLike):
        return read_table(os.fspath(source), needed=needed)
    if hasattr(source, "to_dict") and hasattr(source, "columns"):
        # Of pandas, and of all that is like it.
        source = source.to_dict("records")
    if not isinstance(source, Sequence) or not all(isinstance(row, Mapping) for row in source):
        raise RecipeError("table", "must be a table's file, a data frame, or a list of dicts")
    return read_table([dict(row) for row in source])


@dataclass(frozen=True)
class BatchPlan:
    """Tasks of a batch and rows of which there can be none, in the order of the rows."""

    tasks: tuple[Task, ...]
    bad: tuple[RowOutcome, ...]
    outside: tuple[str, ...] = ()


def plan_batch(request: BatchRequest) -> BatchPlan:
    """A task for each row, all checked before the first is run.

    What no row could be made of is an error: a column that is not there, one file for all rows.
    """
    _check(request)
    tasks: list[Task] = []
    bad: list[RowOutcome] = []
    taken: dict[str, int] = {}
    outside: dict[str, None] = {}
    pairs = itertools.product(request.templates, request.rows)
    for number, (template, cells) in enumerate(pairs, start=1):
        row = {ROW: number, RECIPE: template.name, **cells}
        name = _name_of(row, request)
        try:
            task = _task(request, template, row, name)
            _take(task, taken)
        except (PackworkError, ValueError) as error:
            bad.append(failed(number, name, error))
            continue
        tasks.append(task)
        outside |= dict.fromkeys(files_outside(task.options, [template.home, Path.cwd()]))
    return BatchPlan(tuple(tasks), tuple(bad), tuple(outside))


def _check(request: BatchRequest) -> None:
    count = len(request.templates) * len(request.rows)
    if not 0 < count <= MOST_ROWS:
        raise RecipeError("table", f"asks for {count:,} runs; 1 to {MOST_ROWS:,} go")
    if not request.outputs:
        raise RecipeError("output", "is missing; name the files, as -o 'out/{name}.svg'")
    for key, template in (
        *(("recipe", one.options) for one in request.templates), ("output", list(request.outputs))
    ):  # fmt: skip
        for column in columns_of(template):
            if column not in request.known:
                raise RecipeError(
                    key,
                    f"names the column {column[:40]!r}; there are {enumerated(request.known, 20)}; "
                    "braces that are meant as such are doubled",
                )
    for output in request.outputs:
        if is_session(output):
            raise RecipeError(
                "output", f"{output}: a batch writes no sessions; write .geojson, which packwork "
                "edit and studio go on from too",
            )  # fmt: skip
        writers.check_output(output)
        if count > 1 and not list(columns_of(output)):
            raise RecipeError(
                "output", f"{output} is one file for {count} rows; name a column, as {{row}}.svg"
            )


def _task(request: BatchRequest, template: Template, row: Mapping[str, Any], name: str) -> Task:
    options = with_paths(fill_template(template.options, row), found_from(template.home))
    if not request.allows_code:
        # A cell may have made code of what was none.
        check_no_code(options)
    outputs = tuple(path_of(output, row) for output in request.outputs)
    make_recipe(**options)
    for path in (*outputs, record_path(outputs)):
        writers.check_writable(path)
    return Task(
        row=row[ROW],
        name=name,
        options=options,
        outputs=outputs,
        drawing=request.drawing,
    )


def _take(task: Task, taken: dict[str, int]) -> None:
    """Note the files of a task; none may be another row's, or one of its own twice."""
    paths = (*task.outputs, record_path(task.outputs))
    names = [identity_of(path) for path in paths]
    for path, name in zip(paths, names, strict=True):
        other = task.row if names.count(name) > 1 else taken.get(name)
        if other is not None:
            raise RecipeError("output", f"{path} is row {other}'s too; name files by more columns")
    taken |= dict.fromkeys(names, task.row)


def _name_of(row: Mapping[str, Any], request: BatchRequest) -> str:
    known = {column.casefold(): column for column in reversed(request.columns)}
    first = next(iter(request.columns), RECIPE)
    column = next((known[name] for name in NAMING if name in known), first)
    return " ".join(str(row.get(column, "")).split())[:MOST_SAID] or f"row {row[ROW]}"


Told = Callable[[RowOutcome], object]


@dataclass(frozen=True)
class BatchProgress:
    """Tasks that are to be made, and outcomes of rows whose files are there as they would be."""

    to_do: tuple[Task, ...]
    kept: tuple[RowOutcome, ...]


def batch_progress(plan: BatchPlan, *, anew: bool = False) -> BatchProgress:
    """Progress of a plan before it is run."""
    to_do, kept = [], []
    for task in plan.tasks:
        found = None if anew else is_done(task.key, task.outputs)
        if found is None:
            to_do.append(task)
            continue
        status: Status = "kept" if found.get("status") == "made" else "short"
        metrics, said = dict(found.get("metrics") or {}), str(found.get("said", ""))
        kept.append(task.outcome(status, outputs=task.outputs, metrics=metrics, said=said))
    return BatchProgress(tuple(to_do), tuple(kept))


def run_batch(
    plan: BatchPlan,
    now: BatchProgress,
    workers: int | None = None,
    told: Told = lambda _: None,
    stop: Stop = never,
    scheduler: str | None = None,
    in_place: bool = False,
) -> list[RowOutcome]:
    """Outcomes of all rows, in their order; of those that were stopped too.

    By processes of this machine, one a core where ``workers`` is None, or by the workers of the
    cluster whose scheduler has that address; these write the outputs themselves ``in_place``.
    """
    found: list[RowOutcome] = [*plan.bad, *now.kept]
    made_by: Iterable[tuple[Task, RowOutcome | Exception]]
    if scheduler is None or not now.to_do:
        made_by = results(now.to_do, make, worker_count(workers, len(now.to_do)), stop)
    else:
        from packwork.batches.cluster import run_on_cluster

        made_by = run_on_cluster(now.to_do, scheduler, in_place=in_place, stop=stop)
    for task, made in made_by:
        outcome = failed(task.row, task.name, made) if isinstance(made, Exception) else made
        found.append(outcome)
        told(outcome)
    met = {one.row for one in found}
    found += [task.outcome("stopped") for task in now.to_do if task.row not in met]
    return sorted(found, key=lambda one: one.row)
