"""A run's options to the recipe file (TOML) that repeats it."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

_AROUND = "around:"
"""Before a picture whose quiet part is the container."""


def recipe_bytes(options: Mapping[str, Any], folder: Path) -> bytes:
    """TOML of a recipe's plain options, files named as seen from ``folder``.

    Options that are not set are left out; TOML has no null.

    Examples
    --------
    >>> print(recipe_bytes({"container": "heart", "count": None}, Path(".")).decode(), end="")
    container = "heart"
    """
    import tomli_w

    kept = {key: value for key, value in options.items() if value is not None}
    for key in ("container", "weights", "start", "font"):
        if isinstance(kept.get(key), str):
            kept[key] = _seen_from(folder, kept[key])
    for key in ("items", "keep_clear"):
        if key in kept:
            kept[key] = [_seen_from(folder, name) for name in kept[key]]
    if "words" in kept:
        kept["words"] = _words_seen_from(folder, kept["words"])
    if "chart" in kept:
        kept["chart"] = _chart_seen_from(folder, kept["chart"])
    if "photos" in kept:
        kept["photos"] = _photos_seen_from(folder, kept["photos"])
    rules = [
        {**rule, "region": _seen_from(folder, rule["region"])}
        if isinstance(rule.get("region"), str)
        else rule
        for rule in kept.pop("rules", ())
    ]
    return tomli_w.dumps({**kept, "rules": rules} if rules else kept).encode()


def _words_seen_from(folder: Path, words: Mapping[str, Any]) -> dict[str, Any]:
    seen = {key: value for key, value in words.items() if value is not None}
    for key in ("source", "stopwords", "color_by"):
        if isinstance(seen.get(key), str):
            seen[key] = _seen_from(folder, seen[key])
    return {**seen, "fonts": [_seen_from(folder, font) for font in seen.get("fonts", ())]}


def _chart_seen_from(folder: Path, chart: Mapping[str, Any]) -> dict[str, Any]:
    seen = {key: value for key, value in chart.items() if value is not None}
    if isinstance(seen["data"], str):
        seen["data"] = _seen_from(folder, seen["data"])
    else:
        rows = seen["data"]
        seen["data"] = [{k: cell for k, cell in row.items() if cell is not None} for row in rows]
    return {**seen, "mark": [_seen_from(folder, mark) for mark in seen.get("mark", ())]}


def _photos_seen_from(folder: Path, photos: Mapping[str, Any]) -> dict[str, Any]:
    seen = {key: value for key, value in photos.items() if value is not None}
    if "shape" in seen:
        seen["shape"] = _seen_from(folder, seen["shape"])
    return {**seen, "sources": [_seen_from(folder, source) for source in seen["sources"]]}


def _seen_from(folder: Path, name: str) -> str:
    """A file's path relative to ``folder`` where that is possible, else absolute."""
    if name.startswith(_AROUND):
        return _AROUND + _seen_from(folder, name.removeprefix(_AROUND))
    path = Path(name)
    try:
        if not path.exists():
            return name
    except (OSError, ValueError):  # a text that can be no name
        return name
    try:
        return path.resolve().relative_to(folder.resolve()).as_posix()
    except ValueError:
        return path.resolve().as_posix()
