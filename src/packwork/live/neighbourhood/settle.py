"""Settle: what a gesture has touched is finished exactly, all else stays where it is.

The exact finish (see :mod:`packwork.finish`) of a neighbourhood, in the room that the items about
it leave. What was just put somewhere stays there if it can. Where that fails, the neighbourhood
is widened by a ring of neighbours, three times at most.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import shapely

from packwork.arrays import BoolArray, FloatArray, IntArray
from packwork.errors import ShapeError
from packwork.finish.finish import finish
from packwork.finish.options import FinishOptions
from packwork.geometry.lattice import Lattice, moved
from packwork.geometry.outline import Outline
from packwork.geometry.overlay import (
    difference,
    intersection,
    polygon_parts,
    union,
    union_of_layout,
    valid,
)
from packwork.geometry.polygon import Region
from packwork.live.document import Document
from packwork.live.neighbourhood.caches import ShapeCache
from packwork.live.neighbourhood.contacts import RINGS, ContactGraph
from packwork.options import SizeMode
from packwork.progress import Stop, never
from packwork.scene.container import Container
from packwork.scene.item import bulge_between
from packwork.scene.pose import Poses

ROUNDS = 12
"""Linear programmes of each item of a neighbourhood. Over 160 gestures with 20 of them as much was
covered in the mean, and a settle took a fifth longer. Measured."""

POLISH_ROUNDS = 2
"""The same before trials: the items have been finished already. Chosen."""

DWARF = 2.0
"""How many times smaller than its range an item may have become before a wider neighbourhood is
asked to make room. Larger leaves specks, smaller widens for what is not seen. Chosen."""

ABOUT = 2.0
"""How far the room reaches beyond the boxes of what moves, in sides of the square that has the
usual item's area. Larger costs time, smaller lets nothing out. Chosen."""


def settle(
    document: Document,
    touched: IntArray,
    given: IntArray,
    contacts: ContactGraph,
    shapes: ShapeCache,
    stop: Stop = never,
) -> tuple[Poses, bool]:
    """Finish what a gesture has touched, and no more; poses, and whether nothing is in conflict.

    Parameters
    ----------
    touched
        ``(m,)`` indices of items that have moved, turned, grown, or are new.
    given
        ``(g,)`` those among them that lie as the hand has left them, and are to stay so.
    contacts
        Neighbours, at the present poses.
    """
    is_still = document.held[:, 0].copy()
    first = touched
    found = document.poses, False
    for ring in range(RINGS + 1):
        # What the hand has left stays for as long as that may be; it gives way in the end.
        still = is_still.copy()
        if ring < RINGS:
            still[given] = True
        movable = first[~still[first]]
        found = _finished(document, movable, shapes, stop)
        if found[1] or stop():
            break
        first = contacts.beside(first)
    return found


def sizes_are_common(document: Document) -> bool:
    """Whether all items may become smaller alike, for sizes are in shares and nothing is held."""
    return document.options.sizes == "shared" and not document.held[:, [0, 2]].any()


def made_smaller(document: Document, shapes: ShapeCache, stop: Stop) -> tuple[Poses, bool]:
    """All items finished in one, as much smaller as that takes: sizes stay in proportion."""
    everything = np.arange(len(document))
    return _finished(document, everything, shapes, stop, sizes="shared")


def polish(
    document: Document,
    items: IntArray,
    trials: int,
    seed: int,
    shapes: ShapeCache,
    stop: Stop = never,
) -> tuple[Poses, bool]:
    """Try turns of items ``(m,)`` in conflict with nothing; those that gain are kept."""
    return _finished(document, items[~document.held[items, 0]], shapes, stop, trials, seed)


def _finished(
    document: Document,
    movable: IntArray,
    shapes: ShapeCache,
    stop: Stop,
    trials: int = 0,
    seed: int = 0,
    sizes: SizeMode | None = None,
) -> tuple[Poses, bool]:
    if len(movable) == 0:
        return document.poses, True
    some = document.poses.subset(movable)
    outlines = [shapes.cover(document.items[k].outline) for k in movable]
    room = room_of(document, movable, shapes)
    if room is None:
        return document.poses, False
    options = _options(document, movable, trials, seed)
    if sizes is not None:
        options = options.model_copy(update={"sizes": sizes})
    result = finish(room, outlines, some, options, stop=stop, is_enough=stop)
    held = document.held[movable]
    made = replace(
        result.poses,
        angle=np.where(held[:, 1], some.angle, result.poses.angle),
        scale=np.where(held[:, 2], some.scale, result.poses.scale),
    )
    dwarfs = (result.poses.scale * DWARF < document.smallest[movable]) & (sizes is None)
    is_clean = result.clean and not bool(dwarfs.any())
    return document.container.brought_in(document.poses.with_some(movable, made)), is_clean


def room_of(document: Document, movable: IntArray, shapes: ShapeCache) -> Container | None:
    """The container about some items, less all that stands there; None where that is nothing."""
    if document.container.lattice is not None:
        return _room_on_torus(document, movable, shapes, document.container.lattice)
    boxes = np.array([outline.bounds for outline in _placed(document, movable, shapes)])
    reach = _reach(document, movable)
    region = valid(document.container.outline.region)
    wide = boxes + reach * np.array([-1.0, -1.0, 1.0, 1.0])
    window = union(list(shapely.box(*wide.T)))
    if not window.intersects(region):
        # Everything that moves lies beside the container, and may be brought to any place in it.
        wide = np.array([region.bounds])
        window = shapely.box(*region.bounds)
    others = np.setdiff1d(np.arange(len(document)), movable)
    near = others[_may_meet(document, others, wide)]
    walls = [outline.region for outline in _placed(document, near, shapes)]
    whole = intersection(region, window)
    left = difference(whole, union_of_layout(walls)) if walls else whole
    return _bounded(document.container, left, boxes)


def _reach(document: Document, movable: IntArray) -> float:
    """Distance from some items up to which there is room for them, canvas units."""
    typical = float(np.sqrt(np.median(document.areas)))
    return ABOUT * typical + 2 * gap_of(document, movable)


def _room_on_torus(
    document: Document, movable: IntArray, shapes: ShapeCache, lattice: Lattice
) -> Container | None:
    """The plane about some items of a cell, less the images of all that stands there."""
    others = np.setdiff1d(np.arange(len(document)), movable)
    if not len(others):
        return document.container
    home = document.with_poses(document.container.brought_in(document.poses))
    boxes = np.array([outline.bounds for outline in _placed(home, movable, shapes)])
    wide = boxes + _reach(home, movable) * np.array([-1.0, -1.0, 1.0, 1.0])
    window = union(list(shapely.box(*wide.T)))
    shapely.prepare(window)
    walls = []
    for outline in _placed(home, others, shapes):
        images = (moved(outline.region, s) for s in lattice.meeting(outline.bounds, window.bounds))
        walls += [image for image in images if window.intersects(image)]
    left = difference(window, union_of_layout(walls)) if walls else window
    return _bounded(home.container, left, boxes)


def _bounded(container: Container, left: Region, boxes: FloatArray) -> Container | None:
    """A container of those parts of what is left that boxes ``(b, 4)`` meet; None of nothing."""
    parts = [part for part in polygon_parts(left) if _is_used(part, boxes)] or polygon_parts(left)
    try:
        outline = Outline.from_region(shapely.MultiPolygon(parts))
    except ShapeError:
        return None
    return replace(container, outline=outline)


def _may_meet(document: Document, items: IntArray, boxes: FloatArray) -> BoolArray:
    """Mask of the items that may reach into boxes ``(b, 4)``, by discs about them."""
    poses = document.poses.subset(items)
    longest = np.array([document.items[k].outline.extent for k in items])
    radii = longest * poses.scale * np.sqrt(np.maximum(poses.stretch, 1 / poses.stretch))
    left, top, right, bottom = boxes.T[:, :, None]
    across = np.maximum(left - poses.x, poses.x - right)
    along = np.maximum(top - poses.y, poses.y - bottom)
    return np.asarray((np.maximum(across, along) <= radii).any(axis=0))


def _is_used(part: shapely.Polygon, boxes: np.ndarray) -> bool:
    """Whether a part of the room may hold anything: others would only be looked at for nothing."""
    left, top, right, bottom = part.bounds
    meets = (boxes[:, 0] <= right) & (left <= boxes[:, 2]) & (boxes[:, 1] <= bottom)
    return bool((meets & (top <= boxes[:, 3])).any())


def _placed(document: Document, items: IntArray, shapes: ShapeCache) -> list[Outline]:
    covers = [shapes.cover(document.items[k].outline) for k in items]
    return [c.mapped(document.poses.matrix(int(k))) for c, k in zip(covers, items, strict=True)]


def gap_of(document: Document, items: IntArray) -> float:
    """Gap between outlines that leaves the one asked for between curves, canvas units."""
    of_items = bulge_between([document.items[k] for k in items], document.largest[items])
    return document.options.padding + of_items


def _options(document: Document, movable: IntArray, trials: int, seed: int) -> FinishOptions:
    options, scale = document.options, document.poses.scale[movable]
    held = document.held[movable]
    smallest = np.where(held[:, 2], scale, document.smallest[movable])
    largest = np.where(held[:, 2], scale, document.largest[movable])
    turns = options.turns
    return FinishOptions(
        gap_cu=gap_of(document, movable),
        sizes="free" if options.sizes == "free" else "fixed",
        smallest=tuple(smallest.tolist()),
        largest=tuple(np.maximum(largest, scale).tolist()),
        turning=turns,
        turn_limit=options.rotation.limit if turns else None,
        still=tuple(held[:, 1].tolist()),
        rounds=POLISH_ROUNDS if trials else ROUNDS,
        covered=True,
        refining=True,
        loosened=trials == 0,
        staying=True,
        trials=trials,
        exchanging=False,
        seed=seed,
    )
