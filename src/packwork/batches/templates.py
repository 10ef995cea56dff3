"""Templates: a recipe, or a file's name, in which ``{column}`` stands for a cell of a row."""

from __future__ import annotations

import os
import re
import unicodedata
from collections.abc import Iterator, Mapping
from datetime import date, datetime
from pathlib import Path, PurePath
from typing import Any

from packwork.errors import RecipeError

ROW = "row"
"""Stands for the number of a row, from 1, unless a column is called so."""

RECIPE = "recipe"
"""Stands for the name of the recipe's file, unless a column is called so."""

_PLACE = re.compile(r"\{\{|\}\}|\{([^{}]*)\}")


def columns_of(template: Any) -> Iterator[str]:
    """Names of the columns that a template's texts, tables and arrays name."""
    if isinstance(template, Mapping):
        for key, value in template.items():
            yield from columns_of(key)
            yield from columns_of(value)
    elif isinstance(template, list | tuple):
        for value in template:
            yield from columns_of(value)
    elif isinstance(template, str):
        yield from (found[1] for found in _PLACE.finditer(template) if found[1] is not None)


def fill_template(template: Any, row: Mapping[str, Any]) -> Any:
    """A template with the cells of a row.

    What is a column and nothing else is the cell as it is, a number where it is one; an empty one
    leaves its option out. ``{{`` and ``}}`` stand for braces.

    Examples
    --------
    >>> template = {"container": "text:{name}", "count": "{n}", "seed": "{s}"}
    >>> fill_template(template, {"name": "Ann", "n": 9})
    {'container': 'text:Ann', 'count': 9}
    """
    if isinstance(template, Mapping):
        pairs = ((key, fill_template(value, row)) for key, value in template.items())
        return {fill_template(key, row): value for key, value in pairs if value is not None}
    if isinstance(template, list | tuple):
        found = [fill_template(value, row) for value in template]
        return [value for value in found if value is not None]
    if not isinstance(template, str):
        return template
    whole = _PLACE.fullmatch(template)
    if whole and whole[1] is not None:
        return _plain(row.get(whole[1]))
    return _PLACE.sub(lambda found: _said(found, row), template)


def _said(found: re.Match[str], row: Mapping[str, Any]) -> str:
    if found[1] is None:
        return found[0][0]
    cell = _plain(row.get(found[1]))
    if cell is None:
        raise RecipeError(found[1], "is empty in this row; fill it in, or leave the row out")
    return str(cell)


def _plain(cell: Any) -> Any:
    """A cell as recipes have values; None if it is empty."""
    if hasattr(cell, "item") and not isinstance(cell, str):
        cell = cell.item()
    if isinstance(cell, str):
        return str(cell).strip() or None
    if isinstance(cell, float):
        if cell != cell:
            return None
        return int(cell) if cell.is_integer() and abs(cell) < 2**53 else cell
    if isinstance(cell, date | datetime):
        return cell.isoformat()
    return cell


LONGEST = 200
"""Bytes of a name at most; systems take 255, of which an ending and a random part are ours.
Chosen."""

_REFUSED = re.compile(r'[<>:"/\\|?*\x00-\x1f\x7f]')
_DEVICE = re.compile(r"(con|prn|aux|nul|com[0-9]|lpt[0-9])(\..*)?", re.IGNORECASE)


def path_of(template: str, row: Mapping[str, Any]) -> Path:
    """File of a row, its cells in the template's places.

    Any system takes it, and no cell leaves the template's folder.

    Examples
    --------
    >>> path_of("out/{name}.svg", {"name": "../Ann"})
    Traceback (most recent call last):
    packwork.errors.RecipeError: name: '../Ann' holds '/', which no file's name may hold; ...
    """
    for column in columns_of(template):
        _check_part(column, str(fill_template("{" + column + "}", row) or ""))
    path = Path(str(fill_template(template, row)))
    if any(_DEVICE.fullmatch(part) for part in path.parts[1 if path.anchor else 0 :]):
        raise RecipeError("output", f"{path.name!r} is a device on Windows; use another name")
    if path.name != path.name.rstrip(". ") or len(os.fsencode(path.name)) > LONGEST:
        raise RecipeError("output", f"{path.name[:60]!r} is too long, or ends in a dot or a space")
    return path


def identity_of(path: Path) -> str:
    """Key that all names of one file share on the least careful of file systems."""
    return unicodedata.normalize("NFC", os.path.abspath(path)).casefold()  # noqa: PTH100


def _check_part(column: str, cell: str) -> None:
    met = _REFUSED.search(cell)
    if met:
        raise RecipeError(
            column,
            f"{cell[:40]!r} holds {met[0]!r}, which no file's name may hold; name files by another "
            "column, or by {row}",
        )
    if cell in {os.curdir, os.pardir} or (PurePath(cell).name != cell and cell):
        raise RecipeError(column, f"{cell[:40]!r} is no part of a file's name")
