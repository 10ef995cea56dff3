"""Layouts from the outlines found in a file."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, TypeAlias

import numpy as np
import shapely

from packwork.arrays import FloatArray
from packwork.geometry import affine
from packwork.geometry.outline import Outline
from packwork.geometry.overlay import valid
from packwork.geometry.polygon import Region
from packwork.geometry.rectangles import exact_boxes
from packwork.readers.reading import UnfitError
from packwork.readers.regions import MAX_POINTS
from packwork.readers.svg_syntax.coordinates import MAX_COORDINATE
from packwork.scene.container import Backdrop, Container, repeating
from packwork.scene.item import FlatArt, Item, PhotoArt
from packwork.scene.layout import Layout, Note, ground_in
from packwork.scene.pose import Poses
from packwork.units import Unit

STRAIGHT = 1e-9
"""Share by which sides of what was square may differ from being upright on each other, and of one
length, and count as that. Larger: what another program skews a little is unskewed. Derived:
rounding of a file's digits."""


_EXACTLY = 1e-14
"""Share by which a pose may differ from its map and be exactly that. Derived: rounding of sines."""


@dataclass(frozen=True, eq=False)
class FoundItem:
    """An item as a file shows it: a region in canvas units, or an item and a 2 x 3 map to them.

    ``is_straight``: whether neither it nor the container has curves.
    """

    name: str
    shape: Region | Item
    weight: float = 1.0
    place: FloatArray | None = None
    is_straight: bool = False


@dataclass(frozen=True, kw_only=True, eq=False)
class FoundSheet:
    """Sheet of a file, and what it states of all items together.

    ``gap`` and ``areas_in_shares`` are what its run promised; ``on_trust`` are sentences about
    what could not be seen and was believed; ``walls`` the lines that are seen of a container
    with openings, canvas units, None for all of its edge; ``tile`` how it repeats; ``said`` what
    else the file says, as a manifest has it.
    """

    width: float
    height: float
    unit: Unit
    container: Region
    gap: float | None = None
    areas_in_shares: bool = False
    items: Sequence[FoundItem] = field(default_factory=tuple)
    on_trust: tuple[str, ...] = ()
    walls: tuple[FloatArray, ...] | None = None
    pen: tuple[str, float] | None = None
    backdrop: Backdrop | None = None
    tile: str | None = None
    notes: tuple[Note, ...] = ()
    said: Mapping[str, Any] = field(default_factory=dict)


def assembled(sheet: FoundSheet, name: str) -> Layout:
    """Layout of what was found; what is a plain shape is unturned and as large as it is.

    Examples
    --------
    >>> import shapely
    >>> tile = FoundItem("tile", shapely.box(1, 1, 3, 2))
    >>> sheet = FoundSheet(
    ...     width=9, height=9, unit="mm", container=shapely.box(0, 0, 9, 9), gap=0.5, items=[tile]
    ... )
    >>> layout = assembled(sheet, "sheet.dxf")
    >>> layout.poses.x.tolist(), layout.outlines[0].bounds, layout.manifest["promised"]["gap"]
    ([2.0], (1.0, 1.0, 3.0, 2.0), 0.5)
    """
    outline = sound_outline(sheet.container, "the container")
    container = Container(
        name, name, outline, sheet.width, sheet.height, sheet.unit, sheet.backdrop, sheet.walls,
        pen=sheet.pen,
    )  # fmt: skip
    if sheet.tile is not None:
        container = repeating(container, sheet.tile)
    placed = [
        _placed(one, f"item {number} ({one.name})")
        for number, one in enumerate(sheet.items, start=1)
    ]
    rows = np.array([pose for _, pose in placed], dtype=np.float64).reshape(-1, 5)
    weights = np.array([one.weight for one in sheet.items], dtype=np.float64)
    promised = (
        None if sheet.gap is None else {"gap": sheet.gap, "areas_in_shares": sheet.areas_in_shares}
    )
    said = {**sheet.said, "promised": promised, "on_trust": list(sheet.on_trust)}
    return Layout(
        container, tuple(item for item, _ in placed), Poses(*rows.T.copy()), weights, said,
        sheet.notes, ground=ground_in(said),
    )  # fmt: skip


def sound_weight(text: str) -> float:
    """Weight as a file states it.

    Examples
    --------
    >>> sound_weight("2.5")
    2.5
    """
    return _sound_number(text, "weight", f"no number from 0 to {MAX_COORDINATE:g}")


def sound_gap(text: str) -> float:
    """Promised gap as a file states it.

    Examples
    --------
    >>> sound_gap("0")
    0.0
    """
    return _sound_number(text, "gap", "no length")


def _sound_number(text: str, what: str, instead: str) -> float:
    try:
        number = float(text)
    except ValueError:
        number = math.nan
    if not 0 <= number <= MAX_COORDINATE:
        raise UnfitError(f"states the {what} {text[:20]!r}, which is {instead}")
    return number


def sound_outline(region: Region, what: str) -> Outline:
    """Outline of a region, if it has an area and no more points than can be followed.

    Examples
    --------
    >>> sound_outline(shapely.box(0, 0, 2, 1), "item 1").area
    2.0
    """
    count = shapely.get_num_coordinates(region)
    if count > MAX_POINTS:
        raise UnfitError(f"{what} has {count:,} points, more than {MAX_POINTS:,}; simplify it")
    if not region.area > 0:
        raise UnfitError(f"{what} has no area")
    return Outline.from_region(region)


Pose: TypeAlias = tuple[float, float, float, float, float]


def _placed(found: FoundItem, what: str) -> tuple[Item, Pose]:
    """An item and its pose: x, y, angle, scale and stretch."""
    if not isinstance(found.shape, Item):
        outline = sound_outline(found.shape, what)
        x, y = (float(value) for value in outline.centroid)
        own = outline.mapped(affine.similarity(-x, -y, 0.0, 1.0))
        item = Item(found.name, found.name, own, own, FlatArt())
        return as_exact(item, is_straight=found.is_straight), (x, y, 0.0, 1.0, 1.0)
    place = affine.identity() if found.place is None else found.place
    pose = _pose_of(place)
    if pose is not None:
        off = np.abs(affine.similarity(*pose[:4]) - place).max() / pose[3]
        is_straight = found.is_straight and pose[4] == 1.0 and off <= _EXACTLY
        return as_exact(found.shape, is_straight=is_straight), pose
    # Mirrored or skewed, as no pose is: the item itself is.
    bent = place.copy()
    bent[:, 2] = 0.0
    return _bent(found.shape, bent, what), (float(place[0, 2]), float(place[1, 2]), 0.0, 1.0, 1.0)


def as_exact(item: Item, *, is_straight: bool) -> Item:
    """The item as one without curves, if it is a rectangle of straight lines."""
    if not is_straight or exact_boxes([item.outline]) is None:
        return item
    return replace(item, coarseness=0.0)


def _pose_of(place: FloatArray) -> Pose | None:
    """Pose that is the same as a map; None for one that mirrors or skews.

    Examples
    --------
    >>> _pose_of(affine.similarity(1.0, 2.0, 0.5, 3.0))
    (1.0, 2.0, 0.5, 3.0, 1.0)
    """
    first, second = place[:, 0], place[:, 1]
    wide, high = float(np.hypot(*first)), float(np.hypot(*second))
    across = float(first[0] * second[1] - first[1] * second[0])
    if not across > 0 or abs(float(first @ second)) > STRAIGHT * wide * high:
        return None
    stretch = wide / high
    stretch = 1.0 if abs(stretch - 1.0) < STRAIGHT else stretch
    scale = wide if stretch == 1.0 else math.sqrt(wide * high)
    angle = math.atan2(first[1], first[0])
    return float(place[0, 2]), float(place[1, 2]), angle, scale, stretch


def _bent(item: Item, matrix: FloatArray, what: str) -> Item:
    """The item in other units, of a map without a shift."""
    outline, ink = (
        sound_outline(valid(one.mapped(matrix).region), what) for one in (item.outline, item.ink)
    )
    art = item.art
    if isinstance(art, PhotoArt):
        art = art.preview
    if not isinstance(art, FlatArt):
        art = replace(art, matrix=affine.compose(matrix, art.matrix))
    return replace(item, outline=outline, ink=ink, art=art)
