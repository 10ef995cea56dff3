"""Fall: what forces act on goes down their heights at its size, from where a settle has left it.

Compaction down a potential (:mod:`packwork.settle.settle`) without a search for first places.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from packwork.arrays import FloatArray, IntArray
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
    loose: IntArray,
    shapes: ShapeCache,
    stop: Stop = never,
    on_fall: Callable[[Document], object] = lambda _: None,
) -> Document:
    """Document at rest under its forces; what is held in place is a wall.

    The same document where items touch and have no room to part, or if it was stopped.

    Parameters
    ----------
    loose
        ``(m,)`` rows of what falls first, all others as walls: beside many at rest, which keep
        the steps of all short, it would stay in the air.
    on_fall
        Told of the items on their way.
    """
    movable = np.flatnonzero(~document.held[:, 0])
    first = np.intersect1d(movable, loose)
    now, is_falling = document, len(first) < len(movable)
    while is_falling and not stop():
        before, now = now, _fallen(now, first, shapes, stop, on_fall)
        way = np.hypot(now.poses.x - before.poses.x, now.poses.y - before.poses.y)
        # What went less than its own size did not end where the room about it does.
        is_falling = bool((way > np.sqrt(now.areas)).any())
    now = _fallen(now, movable, shapes, stop, on_fall)
    return document if stop() else now


def _fallen(
    document: Document,
    movable: IntArray,
    shapes: ShapeCache,
    stop: Stop,
    on_fall: Callable[[Document], object],
) -> Document:
    """The document with some of its items at rest, all others as walls."""
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

    if settling.is_at_rest():
        # Another way down may lead to another rest: a gesture elsewhere would move a heap.
        return document

    def at(places: FloatArray) -> Document:
        x, y, turn, _ = places.T.copy()
        made = replace(poses, x=x, y=y, angle=poses.angle + turn)
        return document.with_poses(document.poses.with_some(movable, made))

    def tell(places: FloatArray) -> None:
        on_fall(at(places))

    settling.settle(tell, stop, (FIRST_TRUST, LAST_TRUST))
    return at(arrangement.places)


def is_full(document: Document) -> bool:
    """Whether items cover so much that touching ones find no room beside each other."""
    return float(document.areas.sum()) > LOOSE * document.container.outline.area
