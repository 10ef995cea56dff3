"""Values that users hand over in memory, wherever an option names files."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import Any

from packwork.api.frozen import checked_poses
from packwork.readers.memory.shapes import Columns
from packwork.readers.memory.values import Handed
from packwork.scene.layout import Layout
from packwork.scene.pose import Poses
from packwork.shelf import shelf_in_use

ITEMS = ("filler", "items", "mark")
"""Options that are items: what is in memory may stand for them."""

CONTAINERS = ("container", "region", "shape")
"""Options that are containers."""

PICTURES = ("picture",)
"""Options that are pictures for what they show, not for a shape."""

VECTORS = ("embeddings",)
"""Options that are rows of numbers."""


@contextmanager
def handed_over(y_up: bool | None = None, columns: Columns | None = None) -> Iterator[Handed]:
    """Names for what is handed over; readers find it by them inside the block.

    Examples
    --------
    >>> with handed_over() as handed:
    ...     handed.name_of(b"<svg/>", "items")
    'memory:drawing.svg'
    """
    with shelf_in_use() as shelf:
        yield Handed(shelf, y_up, columns)


def with_names(options: Mapping[str, Any], handed: Handed) -> dict[str, Any]:
    """Options of a verb, values in memory replaced by their names.

    Examples
    --------
    >>> with handed_over() as handed:
    ...     with_names({"filler": b"<svg/>", "seed": 3}, handed)
    {'filler': ['memory:drawing.svg'], 'seed': 3}
    """
    return {key: _named(key, value, handed) for key, value in options.items()}


def _named(key: str, value: Any, handed: Handed) -> Any:
    if value is None:
        return None
    if key == "start":
        return _named_start(value, handed)
    if key == "region" and isinstance(value, list | tuple):
        return value  # shares of the canvas
    if key in CONTAINERS or (key in ITEMS and isinstance(value, str)):
        return handed.name_of(value, key)
    if key in ITEMS:
        return handed.names_of(value, key)
    if key in PICTURES:
        return handed.picture_name_of(value, key)
    if key in VECTORS:
        return handed.vectors_name_of(value, key)
    if key == "rules" and isinstance(value, list | tuple):
        return [with_names(rule, handed) if isinstance(rule, Mapping) else rule for rule in value]
    return value


def _named_start(value: Any, handed: Handed) -> Any:
    """Name of a way to start, or of an earlier layout or poses."""
    if isinstance(value, Poses):
        checked_poses(value)
    if isinstance(value, Layout | Poses):
        return handed.shelf.put(value, "layout" if isinstance(value, Layout) else "poses")
    return os.fspath(value) if isinstance(value, os.PathLike) else value
