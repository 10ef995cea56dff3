"""The region to fill, and its canvas."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields, replace

import numpy as np
import shapely

from packwork.arrays import FloatArray
from packwork.errors import RecipeError, ShapeError
from packwork.geometry import affine
from packwork.geometry.lattice import Lattice
from packwork.geometry.outline import Outline, OutlineLike
from packwork.geometry.overlay import intersection
from packwork.geometry.polygon import Region
from packwork.scene.item import PhotoArt
from packwork.scene.pose import Poses
from packwork.units import CanvasSize, Unit

_WHOLE = 1e-9
"""Share of a canvas that a container of all of it may leave: rounding."""


@dataclass(frozen=True, eq=False)
class Backdrop:
    """A picture that is drawn under all items.

    ``matrix``: 2 x 3 map from its own units to canvas units.
    """

    art: PhotoArt
    matrix: FloatArray


@dataclass(frozen=True, eq=False, init=False)
class Container:
    """The region to fill, on its canvas.

    A Shapely polygon or a ring of points is an outline.

    Parameters
    ----------
    name
        What people call it: the file's stem or the built-in's name.
    source
        Where it came from, as the user gave it.
    outline
        Holes and several parts allowed; canvas units, y down.
    width, height
        The canvas, in canvas units; its top left corner is the origin. Unless given, the
        outline's box, the outline moved there.
    unit
        What one canvas unit is; px are 96 to the inch.
    backdrop
        The picture whose quiet part this is, if it is one's.
    walls
        Lines that are drawn of it, each ``(n, 2)``, where it has openings; None: its outline.
    lattice
        By which all repeats where it is a tile, whose outline is then no wall but the cell.
    file
        The map or drawing that it was read from, whose regions or shapes name parts of it.
    pen
        ``#rrggbb`` and width, canvas units, of its line as its file draws it; None: drawn only
        where that is asked for.

    Raises
    ------
    ShapeError
        If the outline has no area, or the canvas no size.

    Examples
    --------
    >>> room = Container("room", outline=[(1, 1), (5, 1), (5, 4)], unit="cm")
    >>> room.width, room.height, room.outline.bounds
    (4.0, 3.0, (0.0, 0.0, 4.0, 3.0))
    """

    name: str
    source: str
    outline: Outline
    width: float
    height: float
    unit: Unit
    backdrop: Backdrop | None
    walls: tuple[FloatArray, ...] | None
    lattice: Lattice | None
    file: bytes | None
    pen: tuple[str, float] | None

    def __init__(
        self,
        name: str = "container",
        source: str = "",
        outline: OutlineLike | None = None,
        width: float | None = None,
        height: float | None = None,
        unit: Unit = "px",
        backdrop: Backdrop | None = None,
        walls: tuple[FloatArray, ...] | None = None,
        lattice: Lattice | None = None,
        file: bytes | None = None,
        pen: tuple[str, float] | None = None,
    ) -> None:
        if outline is None:
            raise ShapeError("a container needs an outline, such as a Shapely polygon")
        shape = Outline.of(outline)
        left, top, right, bottom = shape.bounds
        if width is None and height is None:
            shape = shape.mapped(affine.similarity(-left, -top, 0.0, 1.0))
            right, bottom = right - left, bottom - top
        width = right if width is None else width
        height = bottom if height is None else height
        if not (width > 0 and height > 0):
            raise ShapeError(f"a canvas needs a positive size, not {width:g} x {height:g}")
        values = (name, source, shape, width, height, unit, backdrop, walls, lattice, file, pen)
        for column, value in zip(fields(Container), values, strict=True):
            object.__setattr__(self, column.name, value)

    def __repr__(self) -> str:
        return f"<Container: {self.name}, {self.width:.4g} x {self.height:.4g} {self.unit}>"

    @property
    def canvas(self) -> dict[str, float | str]:
        """The canvas as files state it.

        Examples
        --------
        >>> tile = Outline.from_rings([[[0, 0], [4, 0], [4, 4]]])
        >>> Container("tile", "tile", tile, 4.0, 3.0, "mm").canvas
        {'width': 4.0, 'height': 3.0, 'unit': 'mm'}
        """
        return {"width": float(self.width), "height": float(self.height), "unit": self.unit}

    def check_edge(self, key: str, what: str) -> None:
        """Refuse what needs an edge where a tile goes on over it.

        Examples
        --------
        >>> page = Container("page", outline=Outline.box(0.0, 0.0, 6.0, 4.0))
        >>> tiled(page, "square").check_edge("cut", "lines for a cutter")
        Traceback (most recent call last):
        packwork.errors.RecipeError: cut: a tile goes on over its edge: it has no lines for a cutter
        """
        if self.lattice is not None:
            raise RecipeError(key, f"a tile goes on over its edge: it has no {what}")

    @property
    def sheet(self) -> Container:
        """The whole canvas where it repeats, as one that does not; any other as it is.

        Examples
        --------
        >>> page = Container("page", outline=Outline.box(0.0, 0.0, 6.0, 4.0))
        >>> tiled(page, "half-drop").sheet.outline.bounds
        (0.0, 0.0, 6.0, 4.0)
        """
        if self.lattice is None:
            return self
        return replace(self, outline=Outline.box(0.0, 0.0, self.width, self.height), lattice=None)

    def brought_in(self, poses: Poses) -> Poses:
        """Poses as items lie on the canvas: of what repeats, in its cell.

        Examples
        --------
        >>> page = Container("page", outline=Outline.box(0.0, 0.0, 6.0, 4.0))
        >>> tiled(page, "square").brought_in(Poses([7.0], [-1.0])).x
        array([1.])
        """
        if self.lattice is None:
            return poses
        x, y = self.lattice.wrapped(np.column_stack([poses.x, poses.y])).T.copy()
        is_there = bool((x == poses.x).all() and (y == poses.y).all())
        return poses if is_there else replace(poses, x=x, y=y)

    @property
    def side(self) -> float:
        """Longer side of the canvas, to which shares of it refer."""
        return max(self.width, self.height)


def placed_container(
    name: str,
    source: str,
    region: Region,
    canvas: tuple[float, float, float, float],
    side: float,
) -> Container:
    """Container of a region on its canvas, both scaled to ``side``.

    ``canvas``: left, top, width and height in the region's units.

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
    return _mapped(container, affine.similarity(x, y, 0.0, scale), width, height, size.unit)


def with_margin(container: Container, margins: tuple[float, float, float, float]) -> Container:
    """Container on a canvas with free edges, canvas units: left, top, right, bottom.

    Examples
    --------
    >>> from packwork.geometry.outline import Outline
    >>> tile = Container("tile", "tile", Outline.box(0.0, 0.0, 4.0, 3.0), 4.0, 3.0)
    >>> wide = with_margin(tile, (1.0, 1.0, 1.0, 1.0))
    >>> wide.width, wide.height, wide.outline.bounds
    (6.0, 5.0, (1.0, 1.0, 5.0, 4.0))
    """
    left, top, right, bottom = margins
    width, height = left + container.width + right, top + container.height + bottom
    place = affine.similarity(left, top, 0.0, 1.0)
    return _mapped(container, place, width, height, container.unit)


def inside_margin(container: Container, margin: float) -> Container:
    """Container that leaves a free edge on its canvas, canvas units; a ShapeError if none is left.

    A whole sheet and what is round a picture are cut off there; any other shape that reaches
    into the margin becomes smaller about the middle of the canvas.

    Examples
    --------
    >>> from packwork.geometry.outline import Outline
    >>> tile = Container("tile", "tile", Outline.box(0.0, 0.0, 4.0, 3.0), 4.0, 3.0)
    >>> inside_margin(tile, 1.0).outline.bounds
    (1.0, 1.0, 3.0, 2.0)
    """
    size = np.array([container.width, container.height])
    if 2 * margin >= size.min():
        raise ShapeError("leaves nothing of the sheet")
    box = shapely.box(margin, margin, *(size - margin))
    outline = container.outline
    if container.backdrop is not None or outline.area >= (1 - _WHOLE) * size.prod():
        return replace(container, outline=Outline.from_region(intersection(outline.region, box)))
    bounds = np.reshape(outline.bounds, (2, 2))
    scale = float(min(1.0, *((size / 2 - margin) / np.abs(bounds - size / 2).max(axis=0))))
    x, y = (size / 2 * (1 - scale)).tolist()
    place = affine.similarity(x, y, 0.0, scale)
    return _mapped(container, place, container.width, container.height, container.unit)


def tiled(container: Container, kind: str) -> Container:
    """Canvas that repeats without a seam: its outline is one cell, of which it holds one or two.

    A hexagonal lattice needs a canvas as high as its width over the root of three; of px, whole
    ones. A ``ShapeError`` if the container is more than a canvas.

    Examples
    --------
    >>> page = Container("page", "page", Outline.box(0.0, 0.0, 6.0, 4.0), 6.0, 4.0)
    >>> tiled(page, "half-drop").lattice
    Lattice(width=3.0, height=4.0, drop=2.0)
    >>> tiled(page, "hexagon").height
    3.0
    """
    width, height = container.width, container.height
    if container.outline.bounds != (0.0, 0.0, width, height) or (
        container.outline.area < width * height * (1 - _ROUNDING)
    ):
        raise ShapeError(
            f"a tile has no walls, but {container.name} has a shape; use page or square"
        )
    if kind == "hexagon":
        height = width / math.sqrt(3.0)
        height = round(height) if container.unit == "px" else height
    return repeating(replace(container, height=float(height)), kind)


def repeating(container: Container, kind: str) -> Container:
    """A canvas and its cell, as it repeats: ``square`` or in columns of half a drop."""
    lattice = Lattice.of_canvas(container.width, container.height, kind)
    return replace(container, outline=Outline.box(*lattice.cell), lattice=lattice)


_ROUNDING = 1e-9
"""Share of a canvas that its outline may lack. Derived."""


def _mapped(
    container: Container, place: FloatArray, width: float, height: float, unit: Unit
) -> Container:
    behind = container.backdrop
    if behind is not None:
        behind = replace(behind, matrix=affine.compose(place, behind.matrix))
    walls = container.walls
    if walls is not None:
        walls = tuple(affine.apply(place, line) for line in walls)
    pen = container.pen
    if pen is not None:
        pen = pen[0], pen[1] * float(np.hypot(*place[:, 0]))
    return replace(
        container, outline=container.outline.mapped(place), width=width, height=height,
        unit=unit, backdrop=behind, walls=walls, lattice=None, pen=pen,
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
