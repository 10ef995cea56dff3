"""Values in memory that stand wherever an option names files, items and containers."""

from __future__ import annotations

import logging
import os
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Literal

from packwork.api.parts import checked_poses
from packwork.api.plain import plain_colours, plain_seed, plain_texts
from packwork.errors import PackworkError
from packwork.phrasing import in_python
from packwork.readers import items as item_reader
from packwork.readers.container import read_container as _read_container
from packwork.readers.memory.shapes import Columns
from packwork.readers.memory.values import Handed, Value
from packwork.recipe.reading import ReadingOptions
from packwork.recipe.refusals import validated
from packwork.scene.container import Container
from packwork.scene.item import Item
from packwork.scene.layout import Layout
from packwork.scene.pose import Poses
from packwork.sources import memory_in_use

ITEMS = ("filler", "items", "mark")
"""Options that are items: what is in memory may stand for them."""

CONTAINERS = ("container", "region", "shape")
"""Options that are containers."""

PICTURES = ("picture",)
"""Options that are pictures for what they show, not for a shape."""

VECTORS = ("embeddings",)
"""Options that are rows of numbers."""


TYPED = ("hero", "force", "anchors")
"""Options that are texts of several parts, or values that hold these."""

COLOURS = ("palette", "color")
"""Options that are colours; those of marks may also be named by a column."""


@contextmanager
def handed_over(y_up: bool | None = None, columns: Columns | None = None) -> Iterator[Handed]:
    """Names for what is handed over; readers find it by them inside the block.

    What is said there names options as Python does: ``size_ratio``, not ``--size-ratio``.
    """
    log, told = logging.getLogger("packwork"), _InPython()
    log.addFilter(told)
    try:
        with memory_in_use() as memory:
            yield Handed(memory, y_up, columns)
    except PackworkError as error:
        said = getattr(error, "problem", str(error))
        error.args = (str(error).replace(said, in_python(said)),)
        error.__dict__.update(problem=in_python(said))
        raise
    finally:
        log.removeFilter(told)


class _InPython(logging.Filter):
    """Filter that lets all pass, in Python's names of options."""

    def filter(self, record: logging.LogRecord) -> bool:
        record.msg, record.args = in_python(record.getMessage()), ()
        return True


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
    if key == "seed":
        return plain_seed(value)
    if value is None:
        return None
    if key in TYPED:
        return plain_texts(value)
    if key in COLOURS:
        return plain_colours(value)
    if key == "start":
        return _named_start(value, handed)
    if key == "canvas" and isinstance(value, list | tuple):
        return "x".join(map(str, value))
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
        return handed.memory.put(value, "layout" if isinstance(value, Layout) else "poses")
    return os.fspath(value) if isinstance(value, os.PathLike) else value


def read_items(
    sources: Value | Iterable[Value],
    *,
    name_by: str | None = None,
    weight_by: str | None = None,
    y_up: bool | None = None,
    holes: Literal["fill", "keep"] = "fill",
    strict: bool = False,
    keep_page: bool | None = None,
    alpha_threshold: float = 0.5,
) -> list[Item]:
    """Items from SVGs, pictures, folders of them, globs, built-in names or values in memory.

    Parameters that :func:`fill` has too mean the same here.

    Unusable files in a folder are left out with a warning in the log.

    Parameters
    ----------
    sources
        One or several, or a dict of them by name; values in memory as for :func:`fill`.
    name_by, weight_by
        Columns of a frame, or properties of GeoJSON, that say what each item is called and what
        share of area it asks for. None: those called name and weight, where there are such.
    holes
        ``"keep"`` lets small items sit in the holes of large ones.
    strict
        Refuse a folder with an unusable file.

    Raises
    ------
    ReadError
        If a file that is named cannot be used, or nothing usable is found.

    Examples
    --------
    >>> [item.name for item in read_items(["circle", "star"])]
    ['circle', 'star']
    >>> import shapely
    >>> lake = {"type": "Feature", "properties": {"lake": "Como", "km2": 146}}
    >>> (item,) = read_items(
    ...     {**lake, "geometry": shapely.box(0, 0, 4, 1)}, name_by="lake", weight_by="km2"
    ... )
    >>> item.name, item.weight, item.outline.bounds
    ('Como', 146.0, (-2.0, -0.5, 2.0, 0.5))
    """
    asked = {"keep_page": keep_page, "alpha_threshold": alpha_threshold}
    how = validated(ReadingOptions, asked).read_options
    with handed_over(y_up, Columns(name_by, weight_by)) as handed:
        named = handed.names_of(sources, "sources")
        return list(item_reader.read_items(named, holes=holes, strict=strict, reading=how).items)


def read_container(
    source: Value,
    *,
    canvas: str | float | None = None,
    font: str | Path | None = None,
    y_up: bool | None = None,
    trim: bool | None = None,
    close_gaps: str = "auto",
    alpha_threshold: float = 0.5,
) -> Container:
    """Container from a mask, an SVG, ``text:WORD``, a built-in name or a value in memory.

    ``source`` is what :func:`fill` takes as ``container``; what both take means the same.

    Parameters
    ----------
    canvas
        Its longer side (``600``, ``"200mm"``, ``"8in"``) or a sheet (``"200x150mm"``,
        ``"A4"``). None: an SVG in mm, cm, in or pt keeps its size, any other is 600 px.
    font
        Font file or installed family for ``text:WORD``; the bundled one if None.

    Raises
    ------
    ReadError
        If it cannot be used.
    RecipeError
        If the canvas has no meaning.

    Examples
    --------
    >>> read_container("circle").width
    600.0
    >>> import shapely
    >>> tile = read_container(shapely.box(7.1, 46.2, 7.5, 46.4), canvas="200mm", y_up=True)
    >>> round(tile.width), round(tile.height), tile.unit
    (200, 100, 'mm')
    """
    asked = {"trim": trim, "close_gaps": close_gaps, "alpha_threshold": alpha_threshold}
    how = validated(ReadingOptions, asked).read_options
    with handed_over(y_up) as handed:
        name = handed.name_of(source, "container")
        return _read_container(name, canvas, font, reading=how)
