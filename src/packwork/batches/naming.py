"""Names of a row's files: any system takes them, none leaves its folder, no two are one."""

from __future__ import annotations

import os
import re
import unicodedata
from collections.abc import Mapping
from pathlib import Path, PurePath
from typing import Any

from packwork.batches.template import columns_of, filled
from packwork.errors import RecipeError

LONGEST = 200
"""Bytes of a name at most; systems take 255, of which an ending and a random part are ours.
Chosen."""

_REFUSED = re.compile(r'[<>:"/\\|?*\x00-\x1f\x7f]')
_DEVICE = re.compile(r"(con|prn|aux|nul|com[0-9]|lpt[0-9])(\..*)?", re.IGNORECASE)


def path_of(template: str, row: Mapping[str, Any]) -> Path:
    """File of a row, its cells in the template's places.

    Raises
    ------
    RecipeError
        If a cell is nothing that can be part of a file's name.

    Examples
    --------
    >>> path_of("out/{name}.svg", {"name": "Ann"}).name
    'Ann.svg'
    >>> path_of("out/{name}.svg", {"name": "../Ann"})
    Traceback (most recent call last):
    packwork.errors.RecipeError: name: '../Ann' holds '/', which no file's name may hold; ...
    """
    for column in columns_of(template):
        _check_part(column, str(filled("{" + column + "}", row) or ""))
    path = Path(str(filled(template, row)))
    if any(_DEVICE.fullmatch(part) for part in path.parts[1 if path.anchor else 0 :]):
        raise RecipeError("output", f"{path.name!r} is a device on Windows; use another name")
    if path.name != path.name.rstrip(". ") or len(os.fsencode(path.name)) > LONGEST:
        raise RecipeError("output", f"{path.name[:60]!r} is too long, or ends in a dot or a space")
    return path


def identity_of(path: Path) -> str:
    """Key that all names of one file share on the least careful of file systems.

    Examples
    --------
    >>> identity_of(Path("out/ANN.svg")) == identity_of(Path("out/x/../Ann.svg"))
    True
    """
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
