"""Series in Python: a layout for each step, all on one scale."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Unpack

from packwork import threads, writers
from packwork.api.inputs import handed_over, with_names
from packwork.api.keywords import ChartKeywords, WordsKeywords
from packwork.api.layout import Layout, public
from packwork.api.plain import with_columns
from packwork.batches.sheet import THUMB_PX, sheet_bytes
from packwork.errors import RecipeError
from packwork.pipeline import tell_coarse
from packwork.precompile import warm_up_once
from packwork.progress import Stop, never
from packwork.readers.layouts.read import is_session
from packwork.readers.memory.values import Value
from packwork.readers.tables.table import is_frame, rows_of_frame
from packwork.readers.words.table import read_word_steps, steps_of_rows
from packwork.timeline.film import filmed
from packwork.timeline.solve import Solved, report, solved
from packwork.timeline.step import SeriesStep, chart_steps, step_files, word_steps
from packwork.uses.words.recipe import weights_by_word


@dataclass(frozen=True, eq=False, repr=False)
class Series:
    """Layouts of all steps, in their order.

    Parameters
    ----------
    column
        What the steps are called by in names of files.
    layouts
        Of each; the film's is :attr:`film`.
    """

    column: str
    labels: tuple[str, ...]
    layouts: tuple[Layout, ...]
    _solved: Solved

    def __len__(self) -> int:
        return len(self.layouts)

    def __iter__(self) -> Iterator[Layout]:
        return iter(self.layouts)

    def __getitem__(self, label: str | int) -> Layout:
        """Layout of a step, by its label."""
        return self.layouts[self.labels.index(str(label))]

    def __repr__(self) -> str:
        certified = sum(run.certified for run in self._solved.runs)
        return f"<Series: {len(self)} steps, {certified} certified>"

    @property
    def report(self) -> dict[str, Any]:
        """Scale, moves and each step's report, as ``--report`` has them."""
        return report(self._solved)

    @property
    def film(self) -> Layout:
        """All words of all steps, with the way that they go; :meth:`Layout.save_film` writes it."""
        return public(filmed(self._solved))

    def save(self, path: str | Path, **drawing: Any) -> tuple[Path, ...]:
        """Write a file for each step, as ``out/{year}.svg``; which they are.

        Raises
        ------
        RecipeError, WriteError
            If a step is nothing that can be part of a file's name, or none can be written.
        """
        files = step_files([str(path)], self.column, self.labels)
        options = writers.write_options(**drawing)
        pairs = list(zip((one[0] for one in files), self.layouts, strict=True))
        if is_session(path):
            for file, layout in pairs:
                layout.save(file, **drawing)
            return tuple(file for file, _ in pairs)
        made = [(file, writers.encoded(layout, file, options)) for file, layout in pairs]
        writers.write_all(made)
        for layout in self.layouts:
            tell_coarse(layout, options.dpi)
        return tuple(file for file, _ in made)

    def save_sheet(self, path: str | Path) -> None:
        """Write a picture (PNG) of all steps, small."""
        writers.write_atomic(path, self._repr_png_())

    def _repr_png_(self) -> bytes:
        small = [writers.png_bytes(layout, THUMB_PX) for layout in self.layouts]
        return sheet_bytes(small, self.labels)


def series(
    container: Value,
    table: str | Path | Mapping[Any, Mapping[str, float]] | Any,
    by: str = "step",
    *,
    stop: Stop = never,
    **options: Unpack[WordsKeywords],
) -> Series:
    """Set words step by step: sizes true on one scale, words in their places for as long as goes.

    Parameters that :func:`words` has too mean the same here.

    Parameters
    ----------
    table
        Words and weights with a column of steps: a file (.csv, .xlsx, .json), a data frame, rows as
        dicts; or by step a dict of weights by word, such as ``to_dict()`` of a crosstab with a
        column for each step.
    by
        The column of steps.
    stop
        Asked on the way; True ends with an error, for no step is final before the last.
    options
        As for :func:`words`; ``count`` is of each step. All that is not a size, a place or a hole
        to fill goes.

    Raises
    ------
    ReadError
        If a file or a font cannot be used.
    RecipeError
        If an option has no meaning in a series, or there is no such column.
    PackworkError
        If there is no scale at which all steps fit.

    Examples
    --------
    >>> years = {1999: {"bear": 3, "fox": 2}, 2000: {"bear": 2, "owl": 2, "fox": 3}}
    >>> made = series("heart", years, seed=1)
    >>> made, made.labels
    (<Series: 2 steps, 2 certified>, ('1999', '2000'))
    >>> [round(float(layout.poses.scale.max() / layout.poses.scale.min()), 6) for layout in made]
    [1.5, 1.5]
    """
    weights = _weights(table, by)
    return _run_series(
        container, by, lambda name, asked: word_steps(name, weights, **asked), stop, options
    )


def chart_series(
    container: Value,
    data: Value | Any,
    column: str,
    *,
    stop: Stop = never,
    **options: Unpack[ChartKeywords],
) -> Series:
    """Chart a table step by step: areas true at one scale, marks of one name in their places.

    Parameters that :func:`chart` has too mean the same here.

    Parameters
    ----------
    column
        Of steps; with ``by_step`` so many of its numbers go together.
    stop
        Asked on the way; True ends with an error, for no step is final before the last.
    options
        As for :func:`chart`, without ``by``. ``label_by`` says which marks of two steps are one;
        a ``title`` may name the step, as ``"Harvest of {year}"``.

    Raises
    ------
    ReadError
        If a file or a mark cannot be used.
    RecipeError
        If an option has no meaning in a series, or there is no such column.
    PackworkError
        If there is no scale at which all steps fit.

    Examples
    --------
    >>> rows = [{"year": y, "land": land, "t": t} for y, land, t in
    ...         [(1, "Peru", 4), (1, "Fiji", 1), (2, "Peru", 3), (2, "Togo", 2)]]
    >>> made = chart_series("circle", rows, "year", size_by="t", label_by="land")
    >>> made, made.labels
    (<Series: 2 steps, 2 certified>, ('1', '2'))
    """
    table, named = with_columns(data, options)
    return _run_series(
        container,
        column,
        lambda name, asked: chart_steps(name, table, column, **asked),
        stop,
        named,
    )


def _run_series(
    container: Value,
    column: str,
    steps_of: Callable[[str, dict[str, Any]], Sequence[SeriesStep]],
    stop: Stop,
    options: Mapping[str, Any],
) -> Series:
    """Run the steps that are made of a container's name and options."""
    with handed_over() as handed:
        asked = with_names(options, handed)
        steps = steps_of(handed.name_of(container, "container"), asked)
        with threads.using(steps[0].job.recipe.threads):
            warm_up_once()
        found = solved(steps, stop=stop)
    layouts = tuple(public(run.layout) for run in found.runs)
    return Series(column, tuple(step.label for step in steps), layouts, found)


def _weights(table: Any, by: str) -> Mapping[str, Mapping[str, float]]:
    if isinstance(table, str | os.PathLike):
        return read_word_steps(os.fspath(table), by).weights
    if isinstance(table, Mapping):
        return _checked(table)
    rows = rows_of_frame(table, has_row_numbers=False) if is_frame(table) else table
    return steps_of_rows(rows, by).weights


def _checked(table: Mapping[Any, Mapping[str, float]]) -> dict[str, dict[str, float]]:
    found: dict[str, dict[str, float]] = {}
    for label, words in table.items():
        found[str(label)] = weights_by_word(words.items()) if hasattr(words, "items") else {}
        if not found[str(label)]:
            raise RecipeError("table", f"says no weights by word of the step {str(label)[:40]!r}")
    if len(found) < 2:
        raise RecipeError("table", "has fewer than two steps")
    return found
