"""Fall: what forces act on goes down their heights at its size, from where a settle has left it.

Compaction down a potential (:mod:`packwork.settle.settle`) without a search for first places.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from packwork.arrays import FloatArray
from packwork.compaction.arrangement import FINE, Detail
from packwork.compaction.objective import turn_ranges
from packwork.compaction.options import HAIR
from packwork.live.document import Document
from packwork.live.neighbourhood.caches import ShapeCache
from packwork.live.neighbourhood.settle import gap_of, room_of
from packwork.progress import Stop, never
from packwork.settle.pile import SettleOptions
from packwork.settle.separate_fixed import separate_fixed
from packwork.settle.settle import FIRST_TRUST, LAST_TRUST, Settling

LOOSE = 0.7
"""Covered share up to which items that touch are parted first. Larger takes seconds where there is
no room for that, smaller leaves loose items hanging. Tried."""


def fallen(
    document: Document,
    shapes: ShapeCache,
    stop: Stop = never,
    on_fall: Callable[[Document], object] = lambda _: None,
) -> Document:
    """Document at rest under its forces; what is held in place is a wall.

    The same document where items touch and have no room to part, or if it was stopped.
    ``on_fall``: told of the items on their way.
    """
    movable = np.flatnonzero(~document.held[:, 0])
    room = room_of(document, movable, shapes) if len(movable) else None
    if room is None:
        return document
    poses, side = document.poses.subset(movable), document.container.side
    outlines = [shapes.cover(document.items[k].outline) for k in movable]
    still = np.zeros(len(movable))
    detail = Detail(outlines, room.outline, poses).covers(FINE)
    arrangement = detail.arrangement(np.column_stack([poses.x, poses.y, still, still]))
    gap, hair = gap_of(document, movable), HAIR * side
    rotation = document.options.rotation
    options = SettleOptions(
        turning=document.options.turns,
        turn_limit=rotation.limit if document.options.turns else None,
        still=tuple(document.held[movable, 1].tolist()),
    )
    turns = turn_ranges(poses.angle, options)
    is_tight = len(arrangement.conflicts(arrangement.pairs(gap), gap)) > 0
    # A settle leaves a few that touch.
    if is_tight and (is_full(document) or len(separate_fixed(arrangement, turns, gap, hair))):
        return document
    settling = Settling(
        arrangement, document.forces(movable), document.areas[movable], turns, gap, hair, side
    )

    def at(places: FloatArray) -> Document:
        x, y, turn, _ = places.T.copy()
        made = replace(poses, x=x, y=y, angle=poses.angle + turn)
        return document.with_poses(document.poses.with_some(movable, made))

    def tell(places: FloatArray) -> None:
        on_fall(at(places))

    settling.settle(tell, stop, (FIRST_TRUST, LAST_TRUST))
    return document if stop() else at(arrangement.places)


def is_full(document: Document) -> bool:
    """Whether items cover so much that touching ones find no room beside each other."""
    return float(document.areas.sum()) > LOOSE * document.container.outline.area
