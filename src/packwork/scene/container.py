"""The region to fill."""

from __future__ import annotations

from dataclasses import dataclass, fields

from packwork.arrays import FloatArray
from packwork.errors import ShapeError
from packwork.geometry import affine
from packwork.geometry.outline import Outline, OutlineLike
from packwork.scene.item import PhotoArt
from packwork.units import Unit


@dataclass(frozen=True, eq=False)
class Backdrop:
    """A picture that is drawn under all items.

    Parameters
    ----------
    matrix
        2 x 3 map from its own units to canvas units.
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
        values = (name, source, shape, width, height, unit, backdrop, walls)
        for column, value in zip(fields(Container), values, strict=True):
            object.__setattr__(self, column.name, value)

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

    @property
    def side(self) -> float:
        """Longer side of the canvas, to which shares of it refer."""
        return max(self.width, self.height)
