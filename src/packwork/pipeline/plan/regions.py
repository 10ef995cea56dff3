"""Parts of the container that rules keep items in."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import shapely

from packwork.errors import ShapeError
from packwork.geometry import polygon
from packwork.geometry.outline import Outline
from packwork.geometry.overlay import intersection
from packwork.pipeline.plan.asked import ItemRules, RuleSource
from packwork.readers.container import read_container
from packwork.readers.options import AS_DRAWN
from packwork.scene.container import Container
from packwork.scene.limits import Zone
from packwork.units import CanvasSize, parse_length


@dataclass(frozen=True, eq=False)
class Region:
    """A zone, and the option that asked for it.

    Parameters
    ----------
    zone
        The part of the container, and which items stay in it.
    """

    zone: Zone
    voice: RuleSource
    words: str


def read_regions(asked: Sequence[ItemRules], container: Container) -> tuple[Region, ...]:
    """Regions of all copies that have one, one for each that is named.

    Raises
    ------
    ReadError
        If a region's file or name cannot be used.
    RecipeError
        If a region and the container have no part in common.
    """
    members: dict[Any, list[int]] = {}
    for k, one in enumerate(asked):
        if "region" in one.values:
            members.setdefault(one.values["region"], []).append(k)
    found = []
    for given, items in members.items():
        voice = asked[items[0]].voices["region"]
        outline = _common(_region(given, container), container)
        words = given if isinstance(given, str) else ", ".join(map(_plain, given))
        if outline is None:
            raise voice.error(f"region: {words} and the container have no part in common")
        found.append(Region(Zone(outline, np.array(items)), voice, words))
    return tuple(found)


def _plain(length: str | float) -> str:
    return length if isinstance(length, str) else f"{length:g}"


def _region(given: str | tuple[str | float, ...], container: Container) -> polygon.Region:
    if isinstance(given, str):
        size = CanvasSize(container.width, container.height, container.unit)
        return read_container(given, size, reading=AS_DRAWN).outline.region
    wholes = (container.width, container.height) * 2
    left, top, width, height = (
        parse_length(str(side), container.unit, whole)
        for side, whole in zip(given, wholes, strict=True)
    )
    return shapely.box(left, top, left + width, top + height)


def _common(region: polygon.Region, container: Container) -> Outline | None:
    try:
        return Outline.from_region(intersection(region, container.outline.region))
    except ShapeError:
        return None
