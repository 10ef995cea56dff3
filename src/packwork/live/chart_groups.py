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
    """Sentence about the first mark that is in another group's part; empty if none is."""
    found = _strays(before, now)
    return f"{now.items[found[0]].name} belongs to {_group(now, found[0])}" if found else ""


def sent_home(before: Document, now: Document) -> Document:
    """Marks that have come into another group's part where they lay before; itself if none has.

    New ones go to where a mark of their group lay.
    """
    poses = now.poses
    for k in _strays(before, now):
        rows = before.chart_groups.get(_group(now, k))
        known = before.index(int(now.ids[k]))
        if rows is not None:
            home = before.poses.subset(rows[:1] if known is None else np.array([known]))
            poses = poses.with_some(np.array([k]), replace(home, scale=poses.scale[[k]]))
    return now if poses is now.poses else now.with_poses(poses)


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
    """Region of the container, of a chart whose groups have a copy of one each that of one."""
    rooms = [part.container.outline.region for _, part in _each(document)]
    are_alike = rooms and np.allclose([room.area for room in rooms], rooms[0].area)
    return rooms[0] if are_alike else document.container.outline.region


def _each(document: Document) -> Iterator[tuple[IntArray, Document]]:
    """Rows of each group, and its marks alone in its part of the container."""
    parts, rooms = polygon_parts(document.container.outline.region), _rooms(document)
    for name, rows in document.chart_groups.items():
        others = np.setdiff1d(np.arange(len(document)), rows)
        own = shapely.MultiPolygon([parts[k] for k in rooms[name]])
        room = replace(document.container, outline=Outline.from_region(own), walls=None)
        yield rows, replace(without(document, others), container=room, notes=())


def _rooms(document: Document) -> dict[str, IntArray]:
    """Numbers of those parts of the container that are each group's, by its name.

    They follow each other as the manifest, which may hold anything, names the groups and how many
    each has; of charts whose manifest does not, they are those in which marks lie.
    """
    count = len(polygon_parts(document.container.outline.region))
    said, lies = document.manifest.get("groups"), _parts_of(document)
    names = said if isinstance(said, list | tuple) and said else ()
    parts = document.manifest.get("group_parts")
    parts = parts if isinstance(parts, list | tuple) else ()
    is_sound = len(parts) == len(names) and all(type(one) is int and one > 0 for one in parts)
    ends = np.cumsum(parts) if is_sound and sum(parts) == count else ()
    stated = {
        name: np.arange(end - number, end)
        for name, number, end in zip(names, parts, ends, strict=False)
        if isinstance(name, str)
    }
    groups = document.chart_groups.items()
    return {name: stated.get(name, np.unique(lies[rows])) for name, rows in groups}


def _strays(before: Document, now: Document) -> list[int]:
    """Rows of marks that are in another group's part."""
    if not now.chart_groups:
        return []
    rooms, lies = _rooms(before), _parts_of(now)
    return [
        int(k)
        for name, rows in now.chart_groups.items()
        if name in rooms
        for k in rows[~np.isin(lies[rows], rooms[name])]
    ]


def _group(document: Document, k: int) -> str:
    datum = document.items[k].datum
    return "" if datum is None else datum.group


def _parts_of(document: Document) -> IntArray:
    """``(n,)`` numbers of the parts of the container that items lie in, or next to."""
    tree = shapely.STRtree(polygon_parts(document.container.outline.region))
    places = shapely.points(document.poses.x, document.poses.y)
    return np.asarray(tree.nearest(places), dtype=np.int64)
