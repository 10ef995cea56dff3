"""Recipes and tables of a batch, from files and from what Python programs hold."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

from packwork.batches.plan import Template
from packwork.batches.template import columns_of
from packwork.errors import ReadError, RecipeError
from packwork.readers.recipe import read_template
from packwork.readers.tables.table import Table, read_table

MOST_RECIPES = 100_000
"""Recipe files of a folder at most. Chosen."""


def templates_of(recipe: str | Path | Mapping[str, Any], *, allow_code: bool) -> list[Template]:
    """Templates of a recipe file, of all in a folder, or of options as a dict.

    Raises
    ------
    ReadError
        If a file cannot be read, or a folder holds none.
    RecipeError
        If one names code that may not be run.
    """
    if isinstance(recipe, Mapping):
        return [Template("recipe", dict(recipe), Path.cwd())]
    if not isinstance(recipe, str | os.PathLike):
        raise RecipeError("recipe", f"is {type(recipe).__name__}; give a recipe file or a folder")
    path = Path(recipe)
    files = sorted(path.glob("*.toml")) if path.is_dir() else [path]
    if not 0 < len(files) <= MOST_RECIPES:
        raise ReadError(path, f"holds {len(files):,} recipes (.toml); 1 to {MOST_RECIPES:,} go")
    return [
        Template(file.stem, read_template(file, allow_code=allow_code), file.parent)
        for file in files
    ]


def table_of(
    source: str | Path | Sequence[Mapping[str, Any]] | Any, templates: Iterable[Any]
) -> Table:
    """Table of a file, of rows, or of a data frame; one row without columns for None.

    Parameters
    ----------
    templates
        Whose columns are read of large files in any case.

    Raises
    ------
    ReadError
        If it cannot be read or has no rows.
    """
    if source is None:
        return Table("data", (), ({},))
    needed = {column for template in templates for column in columns_of(template)}
    if isinstance(source, str | os.PathLike):
        return read_table(os.fspath(source), needed=needed)
    if hasattr(source, "to_dict") and hasattr(source, "columns"):
        # Of pandas, and of all that is like it.
        source = source.to_dict("records")
    rows = [row for row in source if isinstance(row, Mapping)] if _is_list(source) else None
    if rows is None or len(rows) < len(source):
        raise RecipeError("table", "must be a table's file, a data frame, or a list of dicts")
    return read_table([dict(row) for row in rows])


def _is_list(source: Any) -> bool:
    return isinstance(source, Sequence)
