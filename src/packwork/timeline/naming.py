"""Files of a series' steps."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from packwork import writers
from packwork.batches.naming import identity_of, path_of
from packwork.batches.template import ROW, columns_of
from packwork.errors import RecipeError
from packwork.readers.layouts.read import is_session


def step_files(templates: Sequence[str], column: str, labels: Sequence[str]) -> list[list[Path]]:
    """Files of each step, all checked before the first is made.

    Parameters
    ----------
    templates
        Names with a place for the column, as ``out/{year}.svg``; ``{row}`` is a step's number.

    Raises
    ------
    RecipeError
        If a name lacks the column, or a step cannot be part of one, or two steps have one file.
    WriteError
        If the ending of a file is none of ours.
    """
    for template in templates:
        if not is_session(template):
            writers.check_output(template)
        named = set(columns_of(template))
        if not named & {column, ROW} or not named <= {column, ROW}:
            raise RecipeError(
                "output",
                f"{template} names not each step's file; write it as out/{{{column}}}.svg",
            )
    taken: dict[str, str] = {}
    found = []
    for number, label in enumerate(labels, start=1):
        files = [path_of(one, {ROW: number, column: label}) for one in templates]
        for path in files:
            writers.check_writable(path)
            other = taken.setdefault(identity_of(path), label)
            if other != label:
                raise RecipeError("output", f"{path} is {other}'s and {label}'s; use {{row}}")
        found.append(files)
    return found
