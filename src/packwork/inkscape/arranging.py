"""Three ways to arrange objects of a drawing: they fill one, words do, or they lie on a sheet.

All lengths are in user units of the drawing's root, y down, but for poses.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import shapely

from packwork.api import verbs
from packwork.api.layout import Layout
from packwork.api.nesting import nest as nested
from packwork.arrays import FloatArray
from packwork.errors import ReadError
from packwork.geometry import affine
from packwork.progress import Stop
from packwork.readers.svg.objects import DrawingObject, OpenDrawing
from packwork.scene.container import Container
from packwork.scene.item import Item, VectorArt
from packwork.scene.notation import matrix_text


@dataclass(frozen=True)
class Arranged:
    """Changes of a drawing.

    ``transforms``: new ``transform`` of each object that is moved, by its id.
    ``new``: what is new, by name: SVG that stands in one group, and ``transform`` of that; in
    the order in which it is painted.
    ``remarks``: lines for the person who asked.
    """

    transforms: Mapping[str, str] = field(default_factory=dict)
    new: Sequence[tuple[str, str, str]] = ()
    remarks: Sequence[str] = ()


def fill(
    drawing: OpenDrawing, container: str, objects: Sequence[str], options: Mapping[str, Any]
) -> Arranged:
    """Objects that fill another one, each once.

    ``options``: of :func:`packwork.fill`; lengths without a unit are the drawing's.
    """
    room, corner = _container(drawing.object(container))
    items = [drawing.object(name).item() for name in objects]
    layout = verbs.fill(room, items, count=len(items), **options)
    moves = {item.name: move for item, move in _moves(layout, corner)}
    return Arranged(drawing.moved(moves), remarks=_doubts(layout.certified))


def words(
    drawing: OpenDrawing, container: str, parent: str | None, text: str, options: Mapping[str, Any]
) -> Arranged:
    """Words of a text that fill an object, as new paths.

    ``parent``: id of the group that they are put into; None: the drawing itself.
    """
    room, corner = _container(drawing.object(container))
    layout = verbs.words(room, text, **options)
    back = affine.identity() if parent is None else affine.inverse(drawing.object(parent).inner)
    return Arranged(
        new=[
            (item.name, _drawn(item).markup, matrix_text(affine.compose(back, move)))
            for item, move in _moves(layout, corner)
        ],
        remarks=_doubts(layout.certified),
    )


def nest(
    drawing: OpenDrawing,
    container: str | None,
    page: Sequence[float],
    objects: Sequence[str],
    options: Mapping[str, Any],
    stop: Stop,
) -> Arranged:
    """Objects of true size on a sheet: another object, or the page.

    ``page``: left, top, width and height.
    """
    if container is None:
        left, top, width, height = page
        room = Container("page", outline=shapely.box(left, top, left + width, top + height))
        corner = np.array([left, top])
    else:
        room, corner = _container(drawing.object(container))
    items = [(drawing.object(name).item(), 1) for name in objects]
    laid = nested(room, items, stop=stop, **options)
    moves = {item.name: move for one in laid.layouts for item, move in _moves(one, corner)}
    said = [f"found no room: {', '.join(laid.unplaced)}"] if laid.unplaced else []
    return Arranged(drawing.moved(moves), remarks=[*said, *_doubts(laid.certified)])


def _container(ground: DrawingObject) -> tuple[Container, FloatArray]:
    """Container of an object, its canvas the object's box, and where that has its corner."""
    region = ground.inside()
    return Container(ground.name, ground.name, region), np.array(region.bounds[:2])


def _doubts(is_certified: bool) -> list[str]:
    return [] if is_certified else ["not certified: some overlap or stick out"]


def _drawn(item: Item) -> VectorArt:
    if not isinstance(item.art, VectorArt):
        raise ReadError(item.name, "is no drawing")
    return item.art


def _moves(layout: Layout, corner: FloatArray) -> Iterator[tuple[Item, FloatArray]]:
    """Items, each with the map from what it was drawn in to where it is now."""
    back = affine.similarity(float(corner[0]), float(corner[1]), 0.0, 1.0)
    for k, item in enumerate(layout.items):
        place = affine.compose(back, layout.poses.matrix(k))
        yield item, affine.compose(place, _drawn(item).matrix)
