"""A run's options to the recipe file (TOML) that repeats it."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from packwork.recipe_paths import seen_from, with_paths


def recipe_bytes(options: Mapping[str, Any], folder: Path) -> bytes:
    """TOML of a recipe's plain options, files named as seen from ``folder``.

    Options that are not set are left out, in tables too; TOML has no null.
    """
    import tomli_w

    kept = _without_none(with_paths(options, seen_from(folder)))
    if not kept.get("rules"):
        kept.pop("rules", None)
    return tomli_w.dumps(kept).encode()


def _without_none(value: Any) -> Any:
    if isinstance(value, Mapping):
        return {key: _without_none(one) for key, one in value.items() if one is not None}
    if isinstance(value, list | tuple):
        return [_without_none(one) for one in value if one is not None]
    return value
