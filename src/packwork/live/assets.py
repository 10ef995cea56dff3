"""Assets that commands bring into a document, under names of their content."""

from __future__ import annotations

import hashlib

from packwork.geometry.outline import Outline
from packwork.live.commands.command import Library
from packwork.scene.container import Container
from packwork.scene.item import Art, FlatArt, Item, PhotoArt, PictureArt


def named_item(library: Library, item: Item) -> str:
    """Put an item into a library; its name there, which is that of its content.

    Examples
    --------
    >>> from packwork import read_items
    >>> library = Library()
    >>> star, again = (read_items("star")[0] for _ in range(2))
    >>> named_item(library, star) == named_item(library, again), len(library.items)
    (True, 1)
    """
    said = (item.name, item.source, item.label, item.weight, item.halo, item.datum, item.row)
    drawn = _of_art(item.art)
    parts = (repr(said).encode(), _points(item.outline), _points(item.ink), drawn)
    name = hashlib.sha256(b"\0".join(parts)).hexdigest()
    library.items.setdefault(name, item)
    return name


def named_container(library: Library, container: Container) -> str:
    """Put a container into a library; its name there, which is that of its content."""
    canvas = f"{container.width!r} {container.height!r} {container.unit}".encode()
    walls = b"".join(wall.tobytes() for wall in container.walls or ())
    behind, has = container.backdrop, f"{container.walls is None}".encode()
    drawn = b"" if behind is None else _of_art(behind.art) + behind.matrix.tobytes()
    parts = (container.name.encode(), canvas, _points(container.outline), walls, has, drawn)
    name = hashlib.sha256(b"\0".join(parts)).hexdigest()
    library.containers.setdefault(name, container)
    return name


def _points(outline: Outline) -> bytes:
    return outline.points.tobytes() + outline.starts.tobytes()


def _of_art(art: Art) -> bytes:
    if isinstance(art, FlatArt):
        return art.fill.encode()
    if isinstance(art, PictureArt):
        return art.png + art.matrix.tobytes()
    drawn = art.preview if isinstance(art, PhotoArt) else art
    return drawn.markup.encode() + drawn.matrix.tobytes()
