"""The region to fill."""

from __future__ import annotations

from dataclasses import dataclass

from packwork.arrays import FloatArray
from packwork.geometry.outline import Outline
from packwork.scene.item import PhotoArt
from packwork.units import Unit


@dataclass(frozen=True, eq=False)
class Backdrop:
    """A picture that is drawn under all items.

    Parameters
    ----------
    art
        The picture.
    matrix
        2 x 3 map from its own units to canvas units.
    """

    art: PhotoArt
    matrix: FloatArray


@dataclass(frozen=True, eq=False)
class Container:
    """The region to fill, on its canvas.

    Parameters
    ----------
    name
        What people call it: the file's stem or the built-in's name.
    source
        Where it came from, as the user gave it.
    outline
        Holes and several parts allowed; canvas units, y down.
    width, height
        The canvas, in canvas units; its top left corner is the origin.
    unit
        What one canvas unit is; px are 96 to the inch.
    backdrop
        The picture whose quiet part this is, if it is one's.
    walls
        Lines that are drawn of it, each ``(n, 2)``, where it has openings; None: its outline.
    """

    name: str
    source: str
    outline: Outline
    width: float
    height: float
    unit: Unit = "px"
    backdrop: Backdrop | None = None
    walls: tuple[FloatArray, ...] | None = None

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
