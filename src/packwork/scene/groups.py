"""Groups: items that keep their places to each other, as one item that is drawn as its parts."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from packwork.geometry import affine
from packwork.geometry.bezier import FLATTENING
from packwork.geometry.outline import Outline
from packwork.geometry.overlay import union
from packwork.scene.item import FlatArt, Item, Parts, PhotoArt, VectorArt, bulge_between
from packwork.scene.mapped import mirrored
from packwork.scene.notation import decimals, matrix_text, path_data, with_fresh_ids
from packwork.scene.pose import Poses

FINENESS = 1e-5
"""Step to which a part of one colour is written, as a share of its extent: finer than any print.
Chosen."""


@dataclass(frozen=True, eq=False)
class GroupOriginal:
    """A group with photographs, whose originals are opened anew each time it is printed."""

    parts: Parts

    def printed(self, px_per_unit: float) -> VectorArt:
        """The drawing with that many pixels per unit of the group."""
        return _drawn(self.parts, px_per_unit)


def grouped(parts: Parts) -> tuple[Item, float, float]:
    """An item made of others where they lie, in canvas units, and where its middle is.

    Examples
    --------
    >>> tile = Item("tile", outline=[(-1, -1), (1, -1), (1, 1), (-1, 1)], art="teal")
    >>> both = Parts((tile, tile), Poses([2.0, 6.0], [3.0, 3.0]), np.array([1.0, 2.0]))
    >>> item, x, y = grouped(both)
    >>> (x, y), item.name, item.outline.area, item.outline.bounds
    ((4.0, 3.0), '2 items', 8.0, (-3.0, -1.0, 3.0, 1.0))
    """
    placed = [one.outline.mapped(parts.poses.matrix(k)) for k, one in enumerate(parts.items)]
    middle = union(one.region for one in placed).centroid
    poses = replace(parts.poses, x=parts.poses.x - middle.x, y=parts.poses.y - middle.y)
    name = f"{len(parts.items)} items"
    return _of_parts(replace(parts, poses=poses), name), middle.x, middle.y


def parts_in_place(item: Item, pose: Poses, weight: float) -> Parts:
    """Parts of a group that lies at a pose, of one; of any other item itself."""
    parts = item.parts
    if parts is None:
        return Parts((item,), pose, np.array([weight]))
    own, turn = parts.poses, float(pose.angle[0])
    x, y = affine.apply(pose.matrix(0), np.column_stack([own.x, own.y])).T
    poses = Poses(x, y, own.angle + turn, own.scale * pose.scale[0], own.stretch)
    return Parts(parts.items, poses, parts.weights * (weight / parts.weights.sum()))


def of_each(item: Item, change: Callable[[Item], Item]) -> Item:
    """An item drawn otherwise: of a group each of its parts; outlines stay as they are."""
    parts = item.parts
    if parts is None:
        return change(item)
    changed = replace(parts, items=tuple(map(change, parts.items)))
    return replace(item, art=_art(changed), parts=changed)


def turned_over(item: Item) -> Item:
    """An item turned over, left to right about its origin; of a group all parts with it."""
    parts = item.parts
    if parts is None:
        return mirrored(item)
    poses = replace(parts.poses, x=-parts.poses.x, angle=-parts.poses.angle)
    turned = replace(parts, items=tuple(map(mirrored, parts.items)), poses=poses)
    return replace(_of_parts(turned, item.name), label=item.label, weight=item.weight)


def _of_parts(parts: Parts, name: str) -> Item:
    """The group of parts that lie in its units, about its middle."""
    matrices = [parts.poses.matrix(k) for k in range(len(parts.items))]
    outline, ink = (
        Outline.from_region(union(shape.mapped(m).region for shape, m in placed))
        for placed in (
            [(one.outline, m) for one, m in zip(parts.items, matrices, strict=True)],
            [(one.ink, m) for one, m in zip(parts.items, matrices, strict=True)],
        )
    )
    weight = float(sum(one.weight for one in parts.items))
    bulge = bulge_between(parts.items, parts.poses.scale) / (2 * FLATTENING)
    return Item(
        name, "group", outline, ink, _art(parts), weight=weight, parts=parts,
        coarseness=max(bulge / outline.extent, 1.0),
    )  # fmt: skip


def _art(parts: Parts) -> VectorArt | PhotoArt:
    drawn = _drawn(parts)
    if any(isinstance(one.art, PhotoArt) for one in parts.items):
        return PhotoArt(drawn, GroupOriginal(parts))
    return drawn


def _drawn(parts: Parts, px_per_unit: float | None = None) -> VectorArt:
    """The parts on one another; photographs by their small copies unless pixels are asked for."""
    markup = []
    for k, item in enumerate(parts.items):
        place, art = parts.poses.matrix(k), item.art
        if isinstance(art, FlatArt):
            digits = decimals(FINENESS * item.ink.extent)
            inside = (
                f'<path fill="{art.fill}" fill-rule="evenodd" d="{path_data(item.ink, digits)}"/>'
            )
        else:
            if isinstance(art, PhotoArt):
                fine = None if px_per_unit is None else px_per_unit * float(parts.poses.scale[k])
                art = art.preview if fine is None else art.original.printed(fine)
            place, inside = affine.compose(place, art.matrix), art.markup
        markup.append(f'<g transform="{matrix_text(place)}">{with_fresh_ids(inside, f"-{k}")}</g>')
    return VectorArt("".join(markup), np.eye(2, 3))
