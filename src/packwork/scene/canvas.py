"""Containers on a canvas of the size asked for, and poses that follow them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import shapely

from packwork.geometry import affine
from packwork.geometry.outline import Outline
from packwork.geometry.polygon import Region
from packwork.scene.container import Container
from packwork.scene.pose import Poses
from packwork.units import CanvasSize


def placed_container(
    name: str,
    source: str,
    region: Region,
    canvas: tuple[float, float, float, float],
    side: float,
) -> Container:
    """Container of a region on its canvas, both scaled to ``side``.

    Parameters
    ----------
    canvas
        Left, top, width and height in the region's units.

    Examples
    --------
    >>> box = shapely.box(1, 1, 2, 2)
    >>> placed_container("a", "a", box, (0, 0, 4, 2), 8.0).outline.bounds
    (2.0, 2.0, 4.0, 4.0)
    """
    left, top, width, height = canvas
    scale = side / max(width, height)
    moved = shapely.transform(region, lambda points: (points - (left, top)) * scale)
    return Container(name, source, Outline.from_region(moved), width * scale, height * scale)


def on_canvas(container: Container, size: CanvasSize | None) -> Container:
    """Container whose canvas has the size asked for, its own canvas fitted into that.

    A sheet of other proportions leaves a free edge on two sides, as wide on both. None
    leaves the container as it is.

    Examples
    --------
    >>> from packwork.geometry.outline import Outline
    >>> from packwork.units import canvas_size
    >>> tile = Outline.from_rings([[[0, 0], [4, 0], [4, 4], [0, 4]]])
    >>> square = Container("tile", "tile", tile, 4.0, 4.0)
    >>> on_canvas(square, canvas_size("200x150mm")).outline.bounds
    (25.0, 0.0, 175.0, 150.0)
    """
    if size is None:
        return container
    if size.height is None:
        scale = size.width / container.side
        width, height = container.width * scale, container.height * scale
    else:
        width, height = size.width, size.height
        scale = min(width / container.width, height / container.height)
    x, y = (width - container.width * scale) / 2, (height - container.height * scale) / 2
    place = affine.similarity(x, y, 0.0, scale)
    behind = container.backdrop
    if behind is not None:
        behind = replace(behind, matrix=affine.compose(place, behind.matrix))
    walls = container.walls
    if walls is not None:
        walls = tuple(affine.apply(place, line) for line in walls)
    return replace(
        container, outline=container.outline.mapped(place), width=width, height=height,
        unit=size.unit, backdrop=behind, walls=walls,
    )  # fmt: skip


def brought_over(poses: Poses, old: Container, new: Container) -> Poses:
    """Poses of items in an old container, as they lie in a new one.

    The box of the old container is brought onto that of the new one, centre on centre
    and as long; on canvases of one size and unit all stays where it is.

    Examples
    --------
    >>> from packwork.geometry.outline import Outline
    >>> tile = Outline.from_rings([[[0, 0], [4, 0], [4, 4], [0, 4]]])
    >>> square = Container("tile", "tile", tile, 4.0, 4.0)
    >>> sheet = on_canvas(square, CanvasSize(200.0, 150.0, "mm"))
    >>> one = np.ones(1)
    >>> moved = brought_over(Poses(2 * one, 2 * one, one, one), square, sheet)
    >>> moved.x.tolist(), moved.y.tolist(), moved.scale.tolist()
    ([100.0], [75.0], [37.5])
    """
    if old.canvas == new.canvas:
        return poses
    scale = new.outline.extent / old.outline.extent
    before, after = (np.reshape(c.outline.bounds, (2, 2)).mean(axis=0) for c in (old, new))
    x, y = after - before * scale
    return replace(poses, x=poses.x * scale + x, y=poses.y * scale + y, scale=poses.scale * scale)
