"""Charts in groups: marks stay in the part of the container that is their group's."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
import shapely

from packwork.arrays import IntArray
from packwork.geometry.outline import Outline
from packwork.geometry.overlay import polygon_parts
from packwork.geometry.polygon import Region
from packwork.live.commands.command import Library
from packwork.live.commands.items import without
from packwork.live.commands.placing import Arrange
from packwork.live.document import Document
from packwork.scene.pose import Poses

if TYPE_CHECKING:
    from packwork.live.relayout import Moment


def stray(before: Document, now: Document) -> str:
    """Sentence about the first mark that has come into another group's part; empty if none has."""
    if not now.chart_groups:
        return ""
    was, lies = _parts_of(before), _parts_of(now)
    for name, rows in now.chart_groups.items():
        for k in rows[~np.isin(lies[rows], was[rows])][:1]:
            return f"{now.items[k].name} belongs to {name}"
    return ""


def poured_by_group(
    document: Document,
    pour: Callable[[Document, Callable[[Moment], object]], Arrange],
    shown: Callable[[Moment], object],
) -> Poses:
    """Poses of all marks, those of each group poured by themselves in its part."""
    poses = document.poses

    def show(moment: Moment) -> None:
        there = poses
        if moment.poses is not None:
            there = poses.with_some(rows[moment.rows], moment.poses)
        shown(replace(moment, container=document.container, items=document.items, poses=there))

    for rows, part in _each(document):
        poses = poses.with_some(rows, pour(part, show).applied(part, Library()).poses)
    return poses


def region_of_one(document: Document) -> Region:
    """Region of the container, of a chart in groups that of one of them."""
    return next((part.container.outline.region for _, part in _each(document)),
                document.container.outline.region)  # fmt: skip


def _each(document: Document) -> Iterator[tuple[IntArray, Document]]:
    """Rows of each group, and its marks alone in its part of the container."""
    parts, lies = polygon_parts(document.container.outline.region), _parts_of(document)
    for rows in document.chart_groups.values():
        others = np.setdiff1d(np.arange(len(document)), rows)
        own = shapely.MultiPolygon([parts[k] for k in np.unique(lies[rows])])
        room = replace(document.container, outline=Outline.from_region(own), walls=None)
        yield rows, replace(without(document, others), container=room, notes=())


def _parts_of(document: Document) -> IntArray:
    """``(n,)`` numbers of the parts of the container that items lie in, or next to."""
    tree = shapely.STRtree(polygon_parts(document.container.outline.region))
    places = shapely.points(document.poses.x, document.poses.y)
    return np.asarray(tree.nearest(places), dtype=np.int64)
