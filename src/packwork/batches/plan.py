"""Plan of a batch: a task for each row of a table, or the reason why there is none."""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from packwork import writers
from packwork.batches.naming import identity_of, path_of
from packwork.batches.record import record_path
from packwork.batches.task import RowOutcome, Task, failed
from packwork.batches.template import RECIPE, ROW, columns_of, filled
from packwork.errors import PackworkError, RecipeError
from packwork.phrasing import enumerated
from packwork.readers.layouts.read import is_session
from packwork.readers.recipe import check_no_code
from packwork.recipe import make_recipe
from packwork.recipe_paths import files_outside, found_from, with_paths

NAMING = ("name", "title", "id")
"""Columns by which a row is called in messages, the first that is there. Chosen."""

MOST_SAID = 60
"""Characters of a row's name in messages at most. Chosen."""

MOST_ROWS = 1_000_000
"""Rows of a batch at most. Chosen."""


@dataclass(frozen=True, eq=False)
class Template:
    """A recipe with places for columns.

    Parameters
    ----------
    name
        Of its file, without ending.
    """

    name: str
    options: Mapping[str, Any]
    home: Path


@dataclass(frozen=True, kw_only=True)
class Wanted:
    """Inputs of a batch."""

    templates: Sequence[Template]
    rows: Sequence[Mapping[str, Any]]
    columns: Sequence[str]
    outputs: Sequence[str]
    drawing: Mapping[str, Any]
    allows_code: bool = False

    @property
    def known(self) -> list[str]:
        """All that may stand in braces."""
        return list(dict.fromkeys([*self.columns, RECIPE, ROW]))


@dataclass(frozen=True)
class BatchPlan:
    """Tasks of a batch, and rows of which there can be none.

    Parameters
    ----------
    tasks, bad
        In the order of the rows.
    """

    tasks: tuple[Task, ...]
    bad: tuple[RowOutcome, ...]
    outside: tuple[str, ...] = ()


def planned(wanted: Wanted) -> BatchPlan:
    """A task for each row, all checked before the first is run.

    Raises
    ------
    RecipeError
        If no row could be made: a column that is not there, one file for all rows.
    WriteError
        If the ending of a file is none of ours.
    """
    _check(wanted)
    tasks: list[Task] = []
    bad: list[RowOutcome] = []
    taken: dict[str, int] = {}
    outside: dict[str, None] = {}
    pairs = itertools.product(wanted.templates, wanted.rows)
    for number, (template, cells) in enumerate(pairs, start=1):
        row = {ROW: number, RECIPE: template.name, **cells}
        name = _name_of(row, wanted)
        try:
            task = _task(wanted, template, row, name)
            _take(task, taken)
        except (PackworkError, ValueError) as error:
            bad.append(failed(number, name, error))
            continue
        tasks.append(task)
        outside |= dict.fromkeys(files_outside(task.options, [template.home, Path.cwd()]))
    return BatchPlan(tuple(tasks), tuple(bad), tuple(outside))


def _check(wanted: Wanted) -> None:
    count = len(wanted.templates) * len(wanted.rows)
    if not 0 < count <= MOST_ROWS:
        raise RecipeError("table", f"asks for {count:,} runs; 1 to {MOST_ROWS:,} go")
    if not wanted.outputs:
        raise RecipeError("output", "is missing; name the files, as -o 'out/{name}.svg'")
    for key, template in (
        *(("recipe", one.options) for one in wanted.templates), ("output", list(wanted.outputs))
    ):  # fmt: skip
        for column in columns_of(template):
            if column not in wanted.known:
                raise RecipeError(
                    key,
                    f"names the column {column[:40]!r}; there are {enumerated(wanted.known, 20)}; "
                    "braces that are meant as such are doubled",
                )
    for output in wanted.outputs:
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


def _task(wanted: Wanted, template: Template, row: Mapping[str, Any], name: str) -> Task:
    options = with_paths(filled(template.options, row), found_from(template.home))
    if not wanted.allows_code:
        # A cell may have made code of what was none.
        check_no_code(options)
    outputs = tuple(path_of(output, row) for output in wanted.outputs)
    make_recipe(**options)
    for path in (*outputs, record_path(outputs)):
        writers.check_writable(path)
    return Task(
        row=row[ROW],
        name=name,
        options=options,
        outputs=outputs,
        drawing=wanted.drawing,
    )


def _take(task: Task, taken: dict[str, int]) -> None:
    """Note the files of a task.

    Raises
    ------
    RecipeError
        If one of them is another row's, or one of its own twice.
    """
    paths = (*task.outputs, record_path(task.outputs))
    names = [identity_of(path) for path in paths]
    for path, name in zip(paths, names, strict=True):
        other = task.row if names.count(name) > 1 else taken.get(name)
        if other is not None:
            raise RecipeError("output", f"{path} is row {other}'s too; name files by more columns")
    taken |= dict.fromkeys(names, task.row)


def _name_of(row: Mapping[str, Any], wanted: Wanted) -> str:
    """Name of a row."""
    known = {column.casefold(): column for column in reversed(wanted.columns)}
    first = next(iter(wanted.columns), RECIPE)
    column = next((known[name] for name in NAMING if name in known), first)
    return " ".join(str(row.get(column, "")).split())[:MOST_SAID] or f"row {row[ROW]}"
