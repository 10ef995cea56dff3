"""Base of all commands, and the library of what they bring in, under names of its content."""

from __future__ import annotations

import hashlib
from abc import abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Annotated, TypeAlias, TypeVar

import numpy as np
from pydantic import Field

from packwork.errors import RecipeError
from packwork.geometry.outline import Outline
from packwork.live.document import PROPERTIES, Document
from packwork.options import Options
from packwork.recipe.refusals import validated
from packwork.scene.container import Container
from packwork.scene.item import Art, FlatArt, Item, PhotoArt, PictureArt
from packwork.start.angles_and_sizes import nearest_allowed
from packwork.units import convert

FARTHEST = 1e3
"""Coordinates at most, in sides of the canvas: farther is nowhere. Chosen."""

SHORTEST, LONGEST = 1e-6, 1e2
"""Extents of items, in sides of the canvas: beyond them nothing can be seen. Chosen."""

Number: TypeAlias = Annotated[float, Field(allow_inf_nan=False)]

ItemId: TypeAlias = Annotated[int, Field(ge=0, le=2**53)]
"""Number by which an item is called, :attr:`Document.ids`."""

ItemIds: TypeAlias = Annotated[tuple[ItemId, ...], Field(min_length=1)]


@dataclass(frozen=True)
class Library:
    """Things that commands bring into a document, by the names that they call them.

    ``items``, ``containers``: values that were read, by a name of their content.
    """

    items: dict[str, Item] = field(default_factory=dict)
    containers: dict[str, Container] = field(default_factory=dict)


_Command = TypeVar("_Command", bound="Command")


class Command(Options):
    """One edit of a document."""

    kind: str
    """What it does, as a log names it."""

    @abstractmethod
    def applied(self, document: Document, library: Library) -> Document:
        """The document after it; RecipeError where it has no meaning there."""

    @property
    def steps(self) -> tuple[Command, ...]:
        """Commands that it stands for: itself."""
        return (self,)

    @property
    def assets(self) -> tuple[str, ...]:
        """Assets that it brings in, by names in the library."""
        asset = getattr(self, "asset", None)
        return () if asset is None else (asset,)

    @property
    def keeps_angles(self) -> tuple[int, ...]:
        """Numbers of items that keep the angles it leaves them while others make room."""
        return ()

    @property
    def keeps_places(self) -> tuple[int, ...]:
        """Numbers of items that it puts where a hand wants them."""
        return ()

    def places(self, document: Document) -> tuple[int, ...]:
        """Numbers of items that lie where the hand puts them by it, in the document before it."""
        return ()


def made(command: type[_Command], **values: object) -> _Command:
    """A command of plain values; RecipeError names the value that has no meaning."""
    return validated(command, values)


def sized(document: Document, what: str) -> Document:
    """The document; RecipeError if an item is a speck, or far larger than the canvas."""
    container = document.container
    extents = np.array([item.outline.extent for item in document.items]) * document.poses.scale
    shares = extents / container.side
    bad = ~((shares > SHORTEST) & (shares < LONGEST))
    if bad.any():
        raise RecipeError(
            what,
            f"would make an item {extents[bad][0]:.3g} {container.unit} long; the canvas is "
            f"{container.side:.3g} {container.unit}, so ask for a size nearer to it",
        )
    return document


def index_of(document: Document, number: int, what: str) -> int:
    """Index of an item in the arrays."""
    found = document.index(number)
    if found is None:
        raise RecipeError(what, f"there is no item {number}; {_numbers(document)}")
    return found


def nearest_angle(document: Document, k: int, angle: float) -> float:
    """Angle nearest to the one asked for that an item may have, radians."""
    if document.kind.has_parts and document.held[k, PROPERTIES.index("angle")]:
        return float(document.poses.angle[k])
    if (allowed := document.options.rotation.choices) is None:
        return angle
    return float(nearest_allowed(np.array([angle]), None, allowed)[0])


def true_scale(document: Document, item: Item) -> float | None:
    """Scale of a part in a nest: as of the same part there, else of a drawing in px.

    None where items have no true size.
    """
    if not document.kind.has_parts:
        return None
    if item in document.items:
        return float(document.poses.scale[document.items.index(item)])
    return convert(1.0, "px", document.container.unit)


def check_may_size(document: Document, what: str) -> None:
    """Refuse to size what keeps its size, as marks of a chart and parts of true size."""
    if document.kind.refusal:
        raise RecipeError(what, document.kind.refusal)


def check_one_container(document: Document) -> None:
    """Refuse another container where each group of a chart has one of its own."""
    if document.chart_groups:
        raise RecipeError(
            "container", "each group of a chart has one of its own; draw the chart in another"
        )


def _numbers(document: Document) -> str:
    if not len(document):
        return "the layout is empty"
    return f"numbers go from {document.ids.min()} to {document.ids.max()}"


def known(values: Mapping[str, Item] | Mapping[str, Container], name: str, what: str) -> object:
    """A value of a library."""
    if name not in values:
        raise RecipeError(what, f"nothing was read under the name {name[:40]!r}")
    return values[name]


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
    properties = (item.name, item.source, item.label, item.weight, item.halo, item.datum, item.row)
    drawn = _of_art(item.art)
    inner = () if item.parts is None else item.parts.items
    within = [named_item(Library(), one).encode() for one in inner]
    parts = (repr(properties).encode(), _points(item.outline), _points(item.ink), drawn, *within)
    name = hashlib.sha256(b"\0".join(parts)).hexdigest()
    library.items.setdefault(name, item)
    return name


def named_container(library: Library, container: Container) -> str:
    """Put a container into a library; its name there, which is that of its content."""
    canvas = f"{container.width!r} {container.height!r} {container.unit}".encode()
    walls = b"".join(wall.tobytes() for wall in container.walls or ())
    behind, has = container.backdrop, f"{container.walls is None}".encode()
    drawn = b"" if behind is None else _of_art(behind.art) + behind.matrix.tobytes()
    has += f" {container.lattice}".encode()
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
