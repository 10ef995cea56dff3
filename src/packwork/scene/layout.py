"""Container, items, poses and notes: the result, and what is saved."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

import numpy as np

from packwork.arrays import FloatArray
from packwork.errors import ShapeError
from packwork.geometry import affine
from packwork.geometry.outline import Outline
from packwork.scene.container import Container, with_margin
from packwork.scene.item import Item
from packwork.scene.pose import Poses
from packwork.scene.track import Leaving, Track
from packwork.units import Unit


@dataclass(frozen=True, eq=False)
class Note:
    """One filled path; never packed, never measured.

    ``path``: SVG path data, filled by the even-odd rule.
    ``matrix``: 2 x 3 map from the path's units to canvas units.
    ``fill``: any CSS colour.
    ``says``: what it says, for readers who do not see it; may be empty.
    ``is_on_item``: whether it is a label on an item: what is under it can still be pointed at, and
    films, in which items move, are without it.
    """

    path: str
    matrix: FloatArray
    fill: str
    says: str = ""
    is_on_item: bool = False


_HEX = re.compile(r"#(?:[0-9a-f]{6}|[0-9a-f]{8})")


@dataclass(frozen=True, eq=False, repr=False)
class Layout:
    """Container + items + poses.

    Parameters
    ----------
    items
        One entry per placed item; copies repeat the same ``Item`` object.
    weights
        ``(n,)`` share of area asked for each item; all ones if none were given.
    manifest
        What the run did: version, recipe, seed, seconds and metrics per level.
    notes
        Letters and keys that are drawn beside the items.
    track
        How the items came here; None if that was not recorded.
    leaving
        Items of the layout before that this one has no more, for the same film; None if none.
    ground
        Colour on which it is to be seen: its background where no other is asked for; empty if
        any will do.
    """

    container: Container
    items: tuple[Item, ...]
    poses: Poses
    weights: FloatArray
    manifest: Mapping[str, Any] = field(default_factory=dict)
    notes: tuple[Note, ...] = ()
    track: Track | None = None
    leaving: Leaving | None = None
    ground: str = ""

    def __post_init__(self) -> None:
        if not len(self.items) == len(self.poses) == len(self.weights):
            raise ShapeError(
                f"a layout needs as many poses and weights as items ({len(self.items)}), "
                f"not {len(self.poses)} and {len(self.weights)}"
            )

    def __repr__(self) -> str:
        return f"<Layout: {len(self.items)} items in {self.container.name}>"

    @cached_property
    def outlines(self) -> tuple[Outline, ...]:
        """Each item's outline in place, canvas units."""
        return self.placed(range(len(self.items)))

    def placed(self, numbers: Iterable[int]) -> tuple[Outline, ...]:
        """Outlines of some items in place, canvas units, which are not kept."""
        return tuple(self.items[k].outline.mapped(self.poses.matrix(k)) for k in numbers)

    @cached_property
    def inks(self) -> tuple[Outline, ...]:
        """Each item's ink in place, canvas units; where it is the outline, the same object."""
        return tuple(
            outline if item.ink is item.outline else item.ink.mapped(self.poses.matrix(k))
            for k, (item, outline) in enumerate(zip(self.items, self.outlines, strict=True))
        )

    @cached_property
    def areas(self) -> FloatArray:
        """Area of each item in place, squared canvas units."""
        own = np.array([item.outline.area for item in self.items])
        return np.asarray(own * self.poses.scale**2)


def framed(layout: Layout, margins: tuple[float, float, float, float]) -> Layout:
    """Layout, and its film, on a canvas with free edges, canvas units: left, top, right, bottom."""
    left, top, *_ = margins
    place = affine.similarity(left, top, 0.0, 1.0)
    notes = (replace(one, matrix=affine.compose(place, one.matrix)) for one in layout.notes)
    leaving, track = layout.leaving, layout.track
    if leaving is not None:
        way = None if leaving.track is None else leaving.track.moved(left, top)
        leaving = replace(leaving, poses=leaving.poses.moved(left, top), track=way)
    return replace(
        layout, container=with_margin(layout.container, margins), notes=tuple(notes),
        poses=layout.poses.moved(left, top), leaving=leaving,
        track=None if track is None else track.moved(left, top),
    )  # fmt: skip


def ground_in(manifest: Mapping[str, Any]) -> str:
    """Ground that a manifest, perhaps a stranger's, names; empty if it names none.

    Examples
    --------
    >>> ground_in({"ground": "#102030"}), ground_in({"ground": "url(x)"}), ground_in({})
    ('#102030', '', '')
    """
    named = manifest.get("ground")
    return named if isinstance(named, str) and is_hex(named) else ""


def is_hex(text: str) -> bool:
    """Whether a text is ``#rrggbb`` or ``#rrggbbaa``, in small letters."""
    return _HEX.fullmatch(text) is not None


def sheet(name: str, width: float, height: float, unit: Unit = "px") -> Container:
    """Container that is all of a canvas.

    Examples
    --------
    >>> sheet("page", 200.0, 150.0, "mm").outline.bounds
    (0.0, 0.0, 200.0, 150.0)
    """
    return Container(name, name, Outline.box(0.0, 0.0, width, height), width, height, unit)


def blank(width: float = 4.0, height: float = 4.0, unit: Unit = "px") -> Layout:
    """Layout of no items on a sheet.

    Examples
    --------
    >>> blank().container.width, len(blank().items)
    (4.0, 0)
    """
    none = np.zeros(0)
    return Layout(sheet("sheet", width, height, unit), (), Poses(none, none, none, none), none)


def without_items(layout: Layout) -> Layout:
    """The same layout, its items left out.

    Examples
    --------
    >>> without_items(blank()).container.name
    'sheet'
    """
    return replace(layout, items=(), poses=blank().poses, weights=np.zeros(0))
