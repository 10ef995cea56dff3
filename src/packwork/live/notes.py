"""Labels on items follow these; letters and keys beside them stay where they are."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
import shapely

from packwork.arrays import FloatArray
from packwork.geometry import affine
from packwork.readers.svg_syntax.path_data import parse_path
from packwork.scene.layout import Layout, Note
from packwork.scene.pose import Poses

SMALLER = (1.0, 0.8, 0.64, 0.5)
"""Sizes of a label that are tried on an item that was turned. Smaller ones are not read. Chosen."""

INSIDE = 1e-3
"""Share of a label's box that may reach beyond its item: rounding. Derived."""


@dataclass(frozen=True, eq=False)
class Attached:
    """A note, and the item that it is on.

    Parameters
    ----------
    note
        As it was in the layout.
    item
        Number of its item; None for what stands beside.
    pose
        x, y, angle and scale of the item when the note was put there.
    """

    note: Note
    item: int | None = None
    pose: tuple[float, float, float, float] = (0.0, 0.0, 0.0, 1.0)


def attached(layout: Layout) -> tuple[Attached, ...]:
    """Notes of a layout, those on items with the items that they are on, whose numbers are rows."""
    if not any(note.is_on_item for note in layout.notes):
        return tuple(map(Attached, layout.notes))
    tree = shapely.STRtree([outline.region for outline in layout.outlines])
    found = []
    for note in layout.notes:
        middle = shapely.Point(_box(note).mean(axis=0))
        rows = tree.query(middle, predicate="within").tolist() if note.is_on_item else []
        if rows:
            found.append(Attached(note, rows[0], _pose(layout.poses, rows[0])))
        else:
            found.append(Attached(note))
    return tuple(found)


def notes_on(
    layout: Layout, numbers: dict[int, int], notes: tuple[Attached, ...]
) -> Iterator[Note]:
    """Notes of a layout whose items may have moved; those that no longer fit are left out."""
    for one in notes:
        if one.item is None:
            yield one.note
            continue
        row = numbers.get(one.item)
        if row is None:
            continue
        pose = _pose(layout.poses, row)
        if pose == one.pose:
            yield one.note
            continue
        moved = _moved(one, pose, layout.outlines[row].region)
        if moved is not None:
            yield moved


def _moved(one: Attached, pose: tuple[float, ...], region: shapely.Geometry) -> Note | None:
    """The note at its item's new place, upright, as large as it goes; None where it does not."""
    back = affine.similarity(-one.pose[0], -one.pose[1], 0.0, 1.0)
    for share in SMALLER:
        forth = affine.similarity(pose[0], pose[1], 0.0, share * pose[3] / one.pose[3])
        matrix = affine.compose(affine.compose(forth, back), one.note.matrix)
        note = replace(one.note, matrix=matrix)
        box = shapely.box(*_box(note).ravel())
        if box.difference(region).area <= INSIDE * box.area:
            return note
    return None


def _box(note: Note) -> FloatArray:
    """``(2, 2)`` corners of a note's box, canvas units."""
    pieces = [piece.segments.reshape(-1, 2) for piece in parse_path(note.path)]
    points = affine.apply(note.matrix, np.concatenate([*pieces, np.zeros((0, 2))]))
    if len(points) == 0:
        return np.zeros((2, 2))
    return np.array([points.min(axis=0), points.max(axis=0)])


def _pose(poses: Poses, row: int) -> tuple[float, float, float, float]:
    x, y, angle, scale = (
        float(column[row]) for column in (poses.x, poses.y, poses.angle, poses.scale)
    )
    return x, y, angle, scale
