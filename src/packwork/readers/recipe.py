"""Recipe files (TOML) to plain options."""

from __future__ import annotations

import logging
import re
import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from packwork.errors import ReadError, RecipeError
from packwork.phrasing import enumerated
from packwork.readers.reading import read_text
from packwork.recipe_paths import files_outside, found_from, with_paths

MAX_BYTES = 1_000_000
"""Largest recipe file. Chosen."""

MOST_NESTED = 32
"""Arrays and tables in each other, or parts of a key. Larger lets the parser recurse; a recipe has
four. Chosen."""

MOST_BITS = 1_024
"""Of a whole number: what is larger is no number of reals either. Derived."""

MOST_NAMED = 8
"""Files that one notice names. Chosen."""

_LOG = logging.getLogger("packwork")

_STRINGS = re.compile(
    r'"""(?:\\.|[^\\])*?(?:"""|\Z)'
    r"|'''.*?(?:'''|\Z)"
    r'|"(?:\\[^\n]|[^"\\\n])*(?:"|$)'
    r"|'[^'\n]*(?:'|$)"
    r"|#[^\n]*",
    re.DOTALL | re.MULTILINE,
)
"""Strings and comments, an open one to its line's or the file's end: no run is tried twice."""

_BRACKETS = re.compile(r"[\[\]{}]")
_PIECES = re.compile(r"[\[\]{}=,\n]")


def read_recipe(path: str | Path, *, allow_code: bool = False) -> dict[str, Any]:
    """Options of a recipe file, paths in it taken from the file's own folder.

    A recipe may come from anywhere: code that it names is not run unless ``allow_code``.

    Bundled names and texts (``heart``, ``builtin:icons``, ``text:HELLO``) stay as they are;
    what is not there is not looked for elsewhere. Which options there are, and what they may
    be, ``make_recipe`` checks.

    Raises
    ------
    ReadError
        If the file cannot be read or is not TOML.
    RecipeError
        If it names code that may not be run.

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = Path(folder, "recipe.toml")
    ...     _ = file.write_text('container = "heart"')
    ...     read_recipe(file)
    {'container': 'heart'}
    """
    found = with_paths(read_template(path, allow_code=allow_code), found_from(Path(path).parent))
    # A recipe may come from anywhere, and what the files hold that it reads may be shown.
    elsewhere = files_outside(found, [Path(path).parent])
    if elsewhere:
        names = enumerated(elsewhere, MOST_NAMED)
        _LOG.warning("%s reads files outside its folder: %s", path, names)
    return found


def read_template(path: str | Path, *, allow_code: bool = False) -> dict[str, Any]:
    """Options of a recipe file as they stand there: names of files are not looked for yet.

    Raises
    ------
    ReadError
        If the file cannot be read or is not TOML.
    RecipeError
        If it names code that may not be run.
    """
    text = read_text(path, MAX_BYTES)
    check_nesting(path, text)
    try:
        options = tomllib.loads(text)
    except (ValueError, RecursionError) as error:
        # Beside TOML's own errors: numbers of more digits than Python takes.
        said = " ".join(str(error).split())[:200]
        raise ReadError(path, f"is not TOML ({said}); give lines such as count = 100") from None
    _check_numbers(path, options)
    if not allow_code:
        check_no_code(options)
    return options


def _check_numbers(path: str | Path, value: Any) -> None:
    if isinstance(value, dict | list):
        for one in value.values() if isinstance(value, dict) else value:
            _check_numbers(path, one)
    elif isinstance(value, int) and value.bit_length() > MOST_BITS:
        raise ReadError(path, "holds a number of more than 300 digits; give a smaller one")


def check_no_code(options: Mapping[str, Any]) -> None:
    """Refuse options that name code: losses are all that can.

    Examples
    --------
    >>> check_no_code({"losses": {"mine:calm": 1}})
    Traceback (most recent call last):
    packwork.errors.RecipeError: losses: 'mine:calm' is code, which a recipe runs only with
    --allow-code; give that if you trust whoever wrote both
    """
    losses = options.get("losses")
    for name in losses if isinstance(losses, Mapping) else ():
        if ":" in name:
            raise RecipeError(
                "losses",
                f"{name[:80]!r} is code, which a recipe runs only with --allow-code; give that if "
                "you trust whoever wrote both",
            )


def check_nesting(path: str | Path, text: str) -> None:
    """Refuse tables and arrays in each other, and keys of parts, beyond what a recipe has.

    The parser would recurse for each, or keep a table for each part of each key.

    Examples
    --------
    >>> check_nesting("r.toml", "levels = " + 40 * "[")
    Traceback (most recent call last):
    packwork.errors.ReadError: r.toml: nests more than 32 arrays or tables; a recipe needs few
    """
    plain = _STRINGS.sub("''", text)
    depth = deepest = 0
    for bracket in _BRACKETS.findall(plain):
        depth += 1 if bracket in "[{" else -1
        deepest = max(deepest, depth)
    # A key's part of a line, dots and all.
    dots = max(piece.count(".") for piece in _PIECES.split(plain))
    if max(deepest, dots) > MOST_NESTED:
        raise ReadError(path, f"nests more than {MOST_NESTED} arrays or tables; a recipe needs few")
