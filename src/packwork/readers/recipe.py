"""Recipe files (TOML) to plain options."""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import Any

from packwork.errors import ReadError
from packwork.readers.files import read_text
from packwork.readers.quiet.container import AROUND

MAX_BYTES = 1_000_000
"""Largest recipe file. Chosen."""


def read_recipe(path: str | Path) -> dict[str, Any]:
    """Options of a recipe file, paths in it taken from the file's own folder.

    Names that are no files there (``heart``, ``builtin:icons``, ``text:HELLO``) stay as
    they are. Which options there are, and what they may be, ``make_recipe`` checks.

    Raises
    ------
    ReadError
        If the file cannot be read or is not TOML.

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = Path(folder, "recipe.toml")
    ...     _ = file.write_text('container = "heart"')
    ...     read_recipe(file)
    {'container': 'heart'}
    """
    text = read_text(path, MAX_BYTES)
    try:
        options = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise ReadError(path, f"is not TOML ({error}); give lines such as count = 100") from None
    folder = Path(path).parent
    for key in ("container", "weights", "start", "font"):
        if isinstance(options.get(key), str):
            options[key] = _found(options[key], folder)
    for key in ("items", "keep_clear"):
        if isinstance(options.get(key), list):
            options[key] = [
                _found(entry, folder) if isinstance(entry, str) else entry for entry in options[key]
            ]
    if isinstance(options.get("words"), dict):
        _find_words(options["words"], folder)
    if isinstance(options.get("chart"), dict):
        _find_chart(options["chart"], folder)
    if isinstance(options.get("photos"), dict):
        _find_photos(options["photos"], folder)
    rules = options.get("rules")
    for rule in rules if isinstance(rules, list) else ():
        if isinstance(rule, dict) and isinstance(rule.get("region"), str):
            rule["region"] = _found(rule["region"], folder)
    return options


def _find_words(words: dict[str, Any], folder: Path) -> None:
    for key in ("source", "stopwords", "color_by"):
        if isinstance(words.get(key), str):
            words[key] = _found(words[key], folder)
    if isinstance(words.get("fonts"), list):
        words["fonts"] = [_found(f, folder) if isinstance(f, str) else f for f in words["fonts"]]


def _find_chart(chart: dict[str, Any], folder: Path) -> None:
    if isinstance(chart.get("data"), str):
        chart["data"] = _found(chart["data"], folder)
    if isinstance(chart.get("mark"), list):
        chart["mark"] = [_found(m, folder) if isinstance(m, str) else m for m in chart["mark"]]


def _find_photos(photos: dict[str, Any], folder: Path) -> None:
    if isinstance(photos.get("shape"), str):
        photos["shape"] = _found(photos["shape"], folder)
    if isinstance(photos.get("sources"), list):
        photos["sources"] = [
            _found(s, folder) if isinstance(s, str) else s for s in photos["sources"]
        ]


def _found(name: str, folder: Path) -> str:
    if name.startswith(AROUND):
        return AROUND + _found(name.removeprefix(AROUND), folder)
    try:
        return str(folder / name) if (folder / name).exists() else name
    except (OSError, ValueError):
        return name
