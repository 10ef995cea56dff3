"""Parts of a nest taken apart by separation: those that overlap, or all laid anew."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np
import shapely

from packwork.arrays import BoolArray, FloatArray, IntArray
from packwork.errors import RecipeError
from packwork.geometry.affine import similarity
from packwork.geometry.overlay import buffered, difference, intersection, polygon_parts
from packwork.geometry.polygon import Region
from packwork.live.certificate import Certificate
from packwork.live.commands.command import made
from packwork.live.commands.placing import Arrange
from packwork.live.document import PROPERTIES, Document
from packwork.metrics.certificate import HAIR
from packwork.progress import Stop, never
from packwork.scene.item import Item
from packwork.scene.layout import Layout
from packwork.scene.pose import Poses
from packwork.separation.container import ContainerSearch
from packwork.separation.shapes import Part, spare
from packwork.separation.strip import WorkBound
from packwork.uses.nest_request import angles_of
from packwork.uses.nested import Sheet, SheetPart
from packwork.uses.nesting import nest

PASSES = 200
"""Passes after which parts that still overlap are left so. More find room where it is scarce, and
keep whoever waits. Chosen."""

SECONDS = 6.0
"""Time to lay all anew. Longer lays denser, shorter answers sooner. Chosen."""


REACHES = (1.0, 2.0)
"""How far about parts that overlap room is looked for first, in sides of a square as large as the
largest of them. Larger leaves fewer layouts to be laid anew, smaller keeps parts nearer. Tried."""


def taken_apart(
    now: Document, base: Document, by_hand: set[int], certificate: Certificate, stop: Stop
) -> Document | None:
    """Parts of true size apart, from where all others lay before they gave way; None if they stay.

    Those that the hand has put somewhere stay there if they can, and so do others that nothing
    overlaps then.
    """
    _, rows, theirs = np.intersect1d(now.ids, base.ids, return_indices=True)
    back = ~np.isin(now.ids[rows], list(by_hand))
    poses = now.poses.with_some(rows[back], base.poses.subset(theirs[back]))
    wrong = certificate.violations(now.with_poses(poses))
    if not wrong:
        return now.with_poses(poses)
    placed = np.isin(now.ids, list(by_hand))
    met = [k for one in wrong for k in (one.item, one.other) if k is not None]
    clear = ~np.isin(now.ids, met)
    for start, still, near in ways_apart(now, poses, placed, clear):
        found = separated(now.with_poses(start), still, stop, near)
        if found is not None and not certificate.in_the_way(now.with_poses(found)):
            return now.with_poses(found)
        if stop():
            break
    return None


def ways_apart(
    now: Document, poses: Poses, placed: BoolArray, clear: BoolArray
) -> Iterator[tuple[Poses, BoolArray, Region | None]]:
    """Places to begin at, parts that stay, and where room is looked for: what moves least first.

    Parameters
    ----------
    poses
        As all others lay before the hand came.
    placed, clear
        ``(n,)`` what the hand has put somewhere, and what overlaps nothing in those poses.
    """
    before = now.with_poses(poses)
    met = [_region(before, k) for k in np.flatnonzero(~clear).tolist()]
    bounds, side = shapely.total_bounds(met), math.sqrt(max(region.area for region in met))
    near = [shapely.box(*(bounds + np.array([-1, -1, 1, 1]) * side * far)) for far in REACHES]
    yield from ((poses, placed | clear, one) for one in near)
    yield poses, placed, near[0]
    yield poses, placed | clear, None
    yield poses, placed, None
    yield now.poses, placed, None
    yield poses, np.zeros_like(placed), None


def separated(
    document: Document, still: BoolArray, stop: Stop = never, near: Region | None = None
) -> Poses | None:
    """Poses in which no part of a nest overlaps another; None where none were found.

    Only parts that overlap move, to wherever there is room.

    Parameters
    ----------
    still
        ``(n,)`` parts that stay, beside those that are held.
    near
        What lies in it alone may move, and stays in it; None for all.
    """
    container, poses = document.container, document.poses
    if near is not None:
        inside = [near.covers(_region(document, k)) for k in range(len(document))]
        still = still | ~np.array(inside)
    least = document.options.padding + 2.0 * HAIR * container.side
    fixed = still | document.held[:, PROPERTIES.index("place")]
    walls = [spare(_region(document, k), least) for k in np.flatnonzero(fixed).tolist()]
    room = buffered(container.outline.region, -least / 2.0, join_style="mitre")
    if near is not None:
        room = intersection(room, near)
    for wall in walls:
        room = difference(room, wall)
    alike = _alike(document, ~fixed)
    if not alike or not polygon_parts(room):
        return None
    rows = np.array([k for many in alike.values() for k in many])
    parts = [
        Part(region=spare(_scaled(item, scale), least), count=len(many), turns=turns)
        for (item, scale, turns), many in alike.items()
    ]
    places = np.column_stack((poses.x, poses.y, poses.angle))[rows]
    search = ContainerSearch(parts, room, places, stop=stop)
    with search.pool:
        found, loss = search.separated(places, 1.0, PASSES, fresh=True)
    if loss > 0.0:
        return None
    x, y, angle = found.T.copy()
    return poses.with_some(rows, replace(poses.subset(rows), x=x, y=y, angle=angle))


def nested_again(
    document: Document,
    seed: int,
    on_share: Callable[[float], object] = lambda _: None,
    stop: Stop = never,
    *,
    work: WorkBound | None = None,
) -> Arrange:
    """Command that lays the parts of a nest anew; what is held and what has no room stays.

    ``on_share``: told after each pass what share of the work is done.
    """
    container, work = document.container, work or WorkBound(seconds=SECONDS)
    held = document.held[:, PROPERTIES.index("place")]
    alike = _alike(document, ~held)
    if not alike:
        raise RecipeError("nest", "all parts are held; release some")
    # Items of their own, by which parts are known again.
    own = {replace(key[0]): (key, iter(rows)) for key, rows in alike.items()}
    parts = [
        SheetPart(item=item, count=len(alike[key]), scale=key[1], angles=key[2])
        for item, (key, _) in own.items()
    ]
    sheet = Sheet(
        height=container.height, length=container.width, unit=container.unit, name=container.name,
        count=1, outline=container.outline, held=_layout(document, np.flatnonzero(held)),
    )  # fmt: skip

    def is_over() -> bool:
        on_share(work.share)
        return stop()

    gap = document.options.padding
    found = nest(parts, [sheet], gap=gap, seed=seed, work=work, stop=is_over).sheets
    numbers, places = list[int](), list[FloatArray]()
    for item, pose in _laid(found[0].layout) if found else ():
        if item in own:
            numbers.append(int(document.ids[next(own[item][1])]))
            places.append(pose)
    if not numbers:
        raise RecipeError("nest", "nothing was laid in that time; try it again")
    return made(Arrange, items=tuple(numbers), poses=[tuple(pose.tolist()) for pose in places])


_Kind = tuple[Item, float, tuple[float, ...] | None]


def _alike(document: Document, movable: BoolArray) -> dict[_Kind, list[int]]:
    """Rows of parts that are the same, as large, and may have the same angles."""
    allowed = angles_of(document.options.rotate)
    turned = document.held[:, PROPERTIES.index("angle")]
    found = dict[_Kind, list[int]]()
    for k in np.flatnonzero(movable).tolist():
        turns = (float(document.poses.angle[k]),) if turned[k] else allowed
        found.setdefault((document.items[k], float(document.poses.scale[k]), turns), []).append(k)
    return found


def _scaled(item: Item, scale: float) -> shapely.MultiPolygon:
    return item.outline.mapped(similarity(0.0, 0.0, 0.0, scale)).region


def _region(document: Document, k: int) -> shapely.MultiPolygon:
    return document.items[k].outline.mapped(document.poses.matrix(k)).region


def _layout(document: Document, rows: IntArray) -> Layout | None:
    if not len(rows):
        return None
    items = tuple(document.items[k] for k in rows)
    return Layout(document.container, items, document.poses.subset(rows), document.weights[rows])


def _laid(layout: Layout) -> list[tuple[Item, FloatArray]]:
    """Items with x, y, degrees and scale."""
    poses = layout.poses
    columns = np.column_stack((poses.x, poses.y, np.degrees(poses.angle), poses.scale))
    return list(zip(layout.items, columns, strict=True))
