"""Layouts from the outlines found in a file."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
import shapely

from packwork.arrays import FloatArray
from packwork.geometry import affine
from packwork.geometry.outline import Outline
from packwork.geometry.polygon import Region
from packwork.readers.regions import MAX_POINTS
from packwork.readers.unfit import UnfitError
from packwork.scene.container import Container
from packwork.scene.item import FlatArt, Item
from packwork.scene.layout import Layout
from packwork.scene.pose import Poses
from packwork.units import Unit


@dataclass(frozen=True, eq=False)
class FoundItem:
    """One item as a file shows it.

    Parameters
    ----------
    name
        What the file calls it.
    region
        In place, canvas units.
    weight
        Share of area that was asked for it.
    """

    name: str
    region: Region
    weight: float = 1.0


@dataclass(frozen=True, kw_only=True, eq=False)
class FoundSheet:
    """What a file says of all its items together.

    Parameters
    ----------
    width, height, unit
        The canvas.
    container
        The region that was filled, canvas units.
    gap
        Smallest distance that its run promised; None if that promised nothing.
    areas_in_shares
        Whether it promised areas in the shares of the weights.
    on_trust
        What of it could not be seen and was believed, a sentence each.
    walls
        Lines that are seen of a container with openings, canvas units; None: all of its edge.
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


def assembled(sheet: FoundSheet, name: str) -> Layout:
    """Layout of what was found: every item a plain shape, unturned and as large as it is.

    Raises
    ------
    UnfitError
        If the container or an item has no area.

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
    outline = _outline(sheet.container, "the container")
    container = Container(
        name, name, outline, sheet.width, sheet.height, sheet.unit, walls=sheet.walls
    )
    outlines = [
        _outline(one.region, f"item {number} ({one.name})")
        for number, one in enumerate(sheet.items, start=1)
    ]
    centres = np.array([one.centroid for one in outlines]).reshape(-1, 2)
    items = tuple(
        _item(one.name, outline, centre)
        for one, outline, centre in zip(sheet.items, outlines, centres, strict=True)
    )
    n = len(items)
    poses = Poses(centres[:, 0].copy(), centres[:, 1].copy(), np.zeros(n), np.ones(n))
    weights = np.array([one.weight for one in sheet.items], dtype=np.float64)
    promised = (
        None if sheet.gap is None else {"gap": sheet.gap, "areas_in_shares": sheet.areas_in_shares}
    )
    said = {"promised": promised, "on_trust": list(sheet.on_trust)}
    return Layout(container, items, poses, weights, said)


def sound_weight(text: str) -> float:
    """Weight as a file states it.

    Raises
    ------
    UnfitError
        If it is no number, or a negative one.

    Examples
    --------
    >>> sound_weight("2.5")
    2.5
    """
    try:
        weight = float(text)
    except ValueError:
        weight = math.nan
    if not (math.isfinite(weight) and weight >= 0):
        raise UnfitError(f"states the weight {text[:20]!r}, which is no number from 0")
    return weight


def sound_gap(text: str) -> float:
    """Promised gap as a file states it.

    Raises
    ------
    UnfitError
        If it is a negative number or none.

    Examples
    --------
    >>> sound_gap("0")
    0.0
    """
    try:
        gap = float(text)
    except ValueError:
        gap = math.nan
    if not (math.isfinite(gap) and gap >= 0):
        raise UnfitError(f"states the gap {text[:20]!r}, which is no length")
    return gap


def _item(name: str, placed: Outline, centre: np.ndarray) -> Item:
    outline = placed.mapped(affine.similarity(-float(centre[0]), -float(centre[1]), 0.0, 1.0))
    return Item(name, name, outline, outline, FlatArt())


def _outline(region: Region, what: str) -> Outline:
    count = shapely.get_num_coordinates(region)
    if count > MAX_POINTS:
        raise UnfitError(f"{what} has {count:,} points, more than {MAX_POINTS:,}; simplify it")
    if not region.area > 0:
        raise UnfitError(f"{what} has no area")
    return Outline.from_region(region)
