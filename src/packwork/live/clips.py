"""Clips: items taken from one document to be put into the same or another one."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from packwork.arrays import IntArray
from packwork.live.commands.command import Command, index_of, made, named_item, true_scale
from packwork.live.commands.items import OFFSET, Add
from packwork.live.commands.placing import Move
from packwork.live.document import Document
from packwork.live.macros import weights_in
from packwork.units import convert

if TYPE_CHECKING:
    from packwork.live.session import Session


@dataclass(frozen=True, eq=False)
class CopiedItems:
    """Some items of a document as it was when they were copied."""

    document: Document
    rows: IntArray

    def __len__(self) -> int:
        return len(self.rows)


def clipped(document: Document, numbers: tuple[int, ...]) -> CopiedItems:
    """Copy of items, called by their numbers."""
    return CopiedItems(
        document, np.array([index_of(document, number, "copy") for number in numbers])
    )


def pasted(session: Session, clip: CopiedItems, x: float | None, y: float | None) -> list[Command]:
    """Commands that bring the items of a clip, lying to each other as they did.

    Parts of a nest keep their true size, all else its share of the canvas.

    ``x``, ``y``: of the middle of them all; where they were if None, or a little beside what is
    still there.
    """
    document, source = session.document, clip.document
    here, there, poses = document.container, source.container, source.poses.subset(clip.rows)
    items = [source.items[k] for k in clip.rows]
    true = [true_scale(document, item) for item in items]
    factor = here.side / there.side if None in true else convert(1.0, there.unit, here.unit)
    is_as_large = None in true or source.kind.has_parts
    scale = poses.scale * factor if is_as_large else np.array(true, dtype=np.float64)
    place = factor * np.column_stack((poses.x, poses.y))
    if x is not None and y is not None:
        place += (x, y) - place.mean(axis=0)
    elif np.isin(source.ids[clip.rows], document.ids).any():
        place += OFFSET * here.side
    weights = weights_in(document, items)
    adds = [
        made(
            Add, asset=named_item(session.library, item), x=at[0], y=at[1],
            area=item.outline.area * size**2, angle=math.degrees(angle), weight=weight,
        )
        for item, at, size, angle, weight in zip(
            items, place.tolist(), scale.tolist(), poses.angle.tolist(), weights, strict=True
        )
    ]  # fmt: skip
    moves = [
        made(Move, item=number, x=add.x, y=add.y)
        for number, add in enumerate(adds, document.next_id)
    ]
    return [*adds, *moves]
