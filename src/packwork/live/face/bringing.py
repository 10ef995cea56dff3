"""Items and containers that people bring to a page: bundled ones, words, and files they give."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from packwork.errors import ReadError
from packwork.fonts import installed_families
from packwork.geometry.outline import Outline
from packwork.readers.builtin import (
    NAMES,
    builtin_container,
    builtin_item,
    container_names,
    icon_names,
)
from packwork.readers.container import read_container
from packwork.readers.items import ItemsRead, read_items
from packwork.scene.container import Container
from packwork.scene.item import Item
from packwork.scene.palette import PALETTES


@dataclass(frozen=True)
class BuiltIn:
    """Something bundled, as it is offered.

    Parameters
    ----------
    outline
        Of a container on a square of 100; None of items.
    """

    name: str
    item: Item | None = None
    outline: Outline | None = None


def offered_containers() -> tuple[BuiltIn, ...]:
    """Bundled containers, drawings first.

    Examples
    --------
    >>> "heart" in {one.name for one in offered_containers()}
    True
    """
    names = sorted(_plain(container_names()), key=lambda name: (name in NAMES, name))
    return tuple(BuiltIn(name, outline=builtin_container(name, 100.0).outline) for name in names)


def offered_items() -> tuple[BuiltIn, ...]:
    """Bundled icons, then plain shapes.

    Examples
    --------
    >>> offered_items()[0].name
    'anchor'
    """
    names = [*icon_names(), *(name for name in _plain(NAMES) if name not in icon_names())]
    return tuple(BuiltIn(name, item=builtin_item(name)) for name in names)


def _plain(names: Sequence[str]) -> list[str]:
    """Names without those that are one of many sizes."""
    return [name for name in names if ":" not in name]


def items_of(sources: Sequence[str]) -> ItemsRead:
    """Items of bundled names and of folders of files that were given.

    Raises
    ------
    ReadError
        If nothing of them is an item.
    """
    return read_items(sources)


def offered_fonts() -> tuple[str, ...]:
    """Families that words can be set in, as the machine has them.

    Examples
    --------
    >>> "inter display" in offered_fonts()
    True
    """
    return tuple(sorted(installed_families()))


def offered_palettes() -> dict[str, tuple[str, ...]]:
    """Colours that words can have, by the names of the palettes."""
    return dict(PALETTES)


def container_of(source: str, canvas: str | None, font: str | None = None) -> Container:
    """Container of a bundled name, ``text:WORD`` or a file that was given.

    Raises
    ------
    ReadError
        If it cannot be used.
    """
    return read_container(source, canvas, font=font)


def only_file(folder: Path) -> Path:
    """The one file of a folder.

    Raises
    ------
    ReadError
        If there are several.
    """
    files = sorted(folder.iterdir())
    if len(files) != 1:
        raise ReadError("container", f"is one file, not {len(files)}; drop one")
    return files[0]
