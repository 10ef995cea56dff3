"""Mosaics in sessions: the picture that a document keeps, and colours of its items that show it."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING
from weakref import WeakKeyDictionary

import numpy as np

from packwork.arrays import FloatArray, IntArray
from packwork.errors import ReadError
from packwork.readers.target import target_of
from packwork.scene.container import Container
from packwork.scene.item import Item, PhotoArt
from packwork.scene.layout import Layout, ground_in
from packwork.scene.recolour import in_own_colours
from packwork.scene.target import TargetPicture
from packwork.steps.mosaic import LEAST, SQUARE, correlation_with, in_picture, too_fine

if TYPE_CHECKING:
    from packwork.live.document import Document

MOST_PX = 640
"""Longer side of the pixels that are kept of a picture. Larger makes files larger; targets of runs
have half as many. Chosen."""


@dataclass(frozen=True, eq=False)
class Mosaic:
    """A picture that the items of a document show from afar.

    ``tint``: how far they take on its colours, 0..1; None: 0 of photographs, 1 of all else.
    """

    picture: Item
    tint: float | None = None
    _targets: WeakKeyDictionary[Container, TargetPicture] = field(
        default_factory=WeakKeyDictionary, repr=False
    )

    def target(self, container: Container) -> TargetPicture:
        """The picture as it lies on a container."""
        if container not in self._targets:
            self._targets[container] = target_of(self.picture, container)
        return self._targets[container]

    def is_seen_on(self, container: Container) -> bool:
        """Whether a container has more than one colour of it: colours are to be had there."""
        try:
            self.target(container)
        except ReadError:
            return False
        return True

    def tint_of(self, item: Item) -> float:
        """Share of the colours that an item takes on."""
        usual = 0.0 if isinstance(item.art, PhotoArt) else 1.0
        return usual if self.tint is None else self.tint


def coloured(document: Document, rows: IntArray) -> Document:
    """A document with some of its items in the colours that show its picture where they lie.

    The others keep theirs, and are made up for where they are near; groups keep theirs too,
    and so do all where the container has one colour of the picture only.
    """
    mosaic, container = document.mosaic, document.container
    rows = rows[[document.items[k].parts is None for k in rows]]
    if mosaic is None or not len(rows) or not mosaic.is_seen_on(container):
        return document
    items, tints = list(document.items), np.zeros(len(document))
    for k in rows.tolist():
        items[k] = in_own_colours(items[k])
        tints[k] = mosaic.tint_of(items[k])
    near, box = _around(document, rows)
    target, corner = _cut(mosaic.target(container), box)
    poses = document.poses.subset(near).moved(*(-corner).tolist())
    nearby = tuple(items[k] for k in near)
    layout = Layout(container, nearby, poses, document.weights[near])
    shown = in_picture(layout, target, tints[near], ground_in(document.manifest) or "white")
    for k, item in zip(near.tolist(), shown.items, strict=True):
        items[k] = item
    return replace(document, items=tuple(items))


def advice_on_picture(document: Document) -> tuple[str, ...]:
    """Advice on a mosaic whose picture few items hardly show: how many would do."""
    mosaic, container = document.mosaic, document.container
    if mosaic is None or not mosaic.is_seen_on(container):
        return ()
    target = mosaic.target(container)
    found = too_fine(target, container, len(document), "item")
    is_poor = found is not None and correlation_with(document.layout, target) < LEAST
    return (str(found),) if is_poor else ()


def _around(document: Document, rows: IntArray) -> tuple[IntArray, FloatArray]:
    """Rows of items about some of them, and their box: left and top, right and bottom."""
    reach = document.poses.scale * [item.outline.extent for item in document.items]
    places = np.column_stack([document.poses.x, document.poses.y])
    first, last = places - reach[:, None], places + reach[:, None]
    # As far as the colours of one make up for those of another.
    far = SQUARE * np.sqrt(document.container.outline.area / len(document))
    box = np.array([first[rows].min(axis=0) - far, last[rows].max(axis=0) + far])
    near = ((last > box[0]) & (first < box[1])).all(axis=1)
    return np.flatnonzero(near), box


def _cut(target: TargetPicture, box: FloatArray) -> tuple[TargetPicture, FloatArray]:
    """Part of a picture in a box of the canvas, and its corner there."""
    shape = np.array(target.light.shape[1::-1])
    first = np.clip(np.floor(box[0] * target.px_per_cu), 0, shape - 1).astype(int)
    last = np.clip(np.ceil(box[1] * target.px_per_cu), first + 1, shape).astype(int)
    light = target.light[first[1] : last[1], first[0] : last[0]]
    return TargetPicture(light, target.px_per_cu), first / target.px_per_cu
