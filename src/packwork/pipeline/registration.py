"""Items of an earlier layout matched with those of a run; poses where a file has shapes only.

Matching goes by names. Drawings and cut sheets hold shapes: shape registration by moments and the
radial signature gives place (centroid), size (area) and turn, the one at which the distances of the
outline from its centroid agree best by direction (a circular cross-correlation), refined by
iterative closest points (Besl and McKay 1992; to lines, as Chen and Medioni did). So it does not
matter what a program that saved the file again has made of transforms, groups and copies.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import shapely

from packwork.arrays import FloatArray, IntArray
from packwork.geometry.bezier import FLATTENING
from packwork.geometry.outline import Outline
from packwork.pipeline.job import Job
from packwork.scene.colour import hex_colour
from packwork.scene.item import FlatArt, Item
from packwork.scene.layout import Layout
from packwork.scene.recolour import one_colour, recoloured
from packwork.scene.swatch import representative_colour


def matched(now: Sequence[str], then: Sequence[str]) -> IntArray:
    """``(n,)`` which item of then each item of now is; -1 for one that is new.

    Copies of one name are taken in turn: the first for the first.

    Examples
    --------
    >>> matched(["owl", "bear", "owl", "fox"], ["bear", "owl", "cat"]).tolist()
    [1, 0, -1, -1]
    """
    places: dict[tuple[str, int], int] = {}
    seen: Counter[str] = Counter()
    for k, name in enumerate(then):
        places[name, seen[name]] = k
        seen[name] += 1
    seen.clear()
    found = []
    for name in now:
        found.append(places.get((name, seen[name]), -1))
        seen[name] += 1
    return np.array(found, dtype=np.int64)


def match_items(job: Job, earlier: Layout) -> IntArray:
    """``(n,)`` which item of an earlier layout each is; -1 for one that is new."""
    return matched([item.name for item in job.items], [item.name for item in earlier.items])


def new_items(job: Job) -> IntArray:
    """Items that an earlier layout does not have; none if there is no such layout."""
    if job.earlier is None:
        return np.arange(0)
    return np.flatnonzero(match_items(job, job.earlier) < 0)


DIRECTIONS = 1_440
"""Directions of a signature, a quarter of a degree apart. More tell turns finer than a finish
keeps them, and take longer. Chosen."""

ALONG = 2_000
"""Points along an outline at least. Fewer leave directions without one, more take longer.
Chosen."""

AS_GOOD = 1e-3
"""How much worse than the best, as a share of the squared radius, a smaller turn may agree: a disc
is not turned for nothing. Larger leaves turns unseen. Chosen."""


SLACK = 3e-4
"""Share of its size by which an item begins smaller: a file's curves are followed anew, and what
lay a hair apart may meet. Larger gives more to grow back, smaller makes conflicts. Tried."""

STEPS = 6
"""Steps of the refinement; three are enough for all that was tried. Chosen."""

ALIKE = 2 * FLATTENING
"""Difference of two boxes, shares of an item's extent, up to which its shape in a file is the
item's own: curves of a drawing are followed more finely there. Larger takes a shape for another
one's. Derived."""

SAME_AREA = 1e-3
"""Share by which the area of a drawing may differ from that of its shape in a file. Larger takes
another drawing of that name for it, smaller refuses what was read a little otherwise. Chosen."""

ROUND = 1e-6
"""Mean squared lever, of an outline of area 1, below which it has no turn to speak of: a disc.
Chosen."""


def registered(layout: Layout, items: Sequence[Item]) -> Layout:
    """The layout with the items of a run in place of those of the same names.

    Where an item of the file is the run's own, in its units, the file's pose is the truth: a round
    item has an angle too. Of other shapes poses are found. Shapes whose names no item has are kept
    as they are.

    Parameters
    ----------
    items
        Of the run; copies of one name are taken in turn.
    """
    found = matched([item.name for item in layout.items], [item.name for item in items])
    own = [items[n] if n >= 0 else shape for n, shape in zip(found, layout.items, strict=True)]
    poses = layout.poses
    columns = {name: getattr(poses, name).copy() for name in ("x", "y", "angle", "scale")}
    for k, (item, shape) in enumerate(zip(own, layout.items, strict=True)):
        if item is shape or is_alike(item, shape):
            continue
        columns["x"][k], columns["y"][k] = layout.outlines[k].centroid
        columns["angle"][k] += turn_of(item.outline, shape.outline)
        columns["scale"][k] *= (1 - SLACK) * np.sqrt(shape.outline.area / item.outline.area)
    return replace(layout, items=tuple(own), poses=replace(poses, **columns))


def drawn_by(layout: Layout, items: Sequence[Item]) -> Layout:
    """The layout with items in place of plain shapes of the same names, in the layout's colours.

    Where a file holds poses, they are those of the items that it was made of; where it holds shapes
    alone, as cut sheets do, poses are found as by :func:`registered`.
    """
    known = {item.name: item for item in items}
    made: dict[tuple[Item, Item], Item] = {}
    found = []
    for shape in layout.items:
        item = known.get(shape.name, shape)
        key = (item, shape)
        if key not in made:
            made[key] = coloured_as(item, shape)
        found.append(made[key])
    return registered(layout, found)


def coloured_as(item: Item, shape: Item) -> Item:
    """The item in the colour of a shape that stands for it, with its name, link and halo.

    A shape of the usual colour, as all are that come from a cut sheet, tells of none.
    """
    if item is shape:
        return item
    dressed = replace(item, label=shape.label, halo=shape.halo, datum=shape.datum)
    channels = None if shape.art == FlatArt() else one_colour(shape.art)
    if channels is None or hex_colour(channels) == representative_colour(item):
        return dressed
    return recoloured(dressed, hex_colour(channels))


def is_alike(item: Item, shape: Item) -> bool:
    """Whether an item's outline is the shape's, in the same units."""
    own, other = np.array(item.outline.bounds), np.array(shape.outline.bounds)
    return bool(np.abs(own - other).max() <= ALIKE * item.coarseness * item.outline.extent)


def turn_of(before: Outline, after: Outline) -> float:
    """Turn, in radians, that brings an outline nearest to another one of its form.

    Examples
    --------
    >>> flag = Outline.from_rings([[[0, 0], [4, 0], [4, 1], [1, 1], [1, 3], [0, 3]]])
    >>> turned = flag.mapped(np.array([[0.0, -2.0, 5.0], [2.0, 0.0, 7.0]]))
    >>> round(float(np.degrees(turn_of(flag, turned))), 2)
    90.0
    """
    first, second = _along(before), _along(after)
    turn = _coarse_turn(_signature(first), _signature(second))
    return _refined(first, second, turn)


def _along(outline: Outline) -> FloatArray:
    """``(n, 2)`` points all along an outline, about its centroid, its area taken for 1."""
    dense = shapely.segmentize(outline.region, outline.region.length / ALONG)
    centred = shapely.get_coordinates(dense) - outline.centroid
    return np.asarray(centred / np.sqrt(outline.area))


def _coarse_turn(before: FloatArray, after: FloatArray) -> float:
    """Turn between two signatures, to a direction; of turns as good the smallest."""
    spectrum = np.fft.rfft(after) * np.conj(np.fft.rfft(before))
    agreement = np.fft.irfft(spectrum, DIRECTIONS)
    allowance = AS_GOOD * float(np.dot(before, before))
    is_peak = (agreement >= np.roll(agreement, 1)) & (agreement >= np.roll(agreement, -1))
    good = np.flatnonzero(is_peak & (agreement >= agreement.max() - allowance))
    turns = np.where(good > DIRECTIONS // 2, good - DIRECTIONS, good)
    return 2 * np.pi * float(turns[np.argmin(np.abs(turns))]) / DIRECTIONS


def _refined(before: FloatArray, after: FloatArray, turn: float) -> float:
    """The turn after a few steps of iterative closest points, along the normals."""
    # Takes half a second to load.
    from scipy.spatial import cKDTree

    tree = cKDTree(after)
    way = np.roll(after, -1, axis=0) - np.roll(after, 1, axis=0)
    normals = np.column_stack([way[:, 1], -way[:, 0]])
    normals /= np.maximum(np.hypot(*normals.T), 1e-12)[:, None]
    for _ in range(STEPS):
        spun = before @ np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])
        _, nearest = tree.query(spun)
        normal = normals[nearest]
        lever = normal[:, 1] * spun[:, 0] - normal[:, 0] * spun[:, 1]
        missing = ((after[nearest] - spun) * normal).sum(axis=1)
        stiffness = float(lever @ lever)
        if stiffness < ROUND * len(before):
            break
        turn += float(lever @ missing) / stiffness
    return turn


def _signature(points: FloatArray) -> FloatArray:
    """Distance of the outline from its centroid, by direction."""
    across, down = points.T
    sector = np.rint(np.arctan2(down, across) / (2 * np.pi) * DIRECTIONS).astype(np.int64)
    farthest = np.zeros(DIRECTIONS)
    np.maximum.at(farthest, sector % DIRECTIONS, np.hypot(across, down))
    empty = farthest == 0
    if empty.any():
        every = np.arange(DIRECTIONS)
        farthest = np.interp(every, every[~empty], farthest[~empty], period=DIRECTIONS)
    return np.asarray(farthest)
