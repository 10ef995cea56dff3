"""The region to fill."""

from __future__ import annotations

from dataclasses import dataclass

from packwork.geometry.outline import Outline


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
    """

    name: str
    source: str
    outline: Outline
    width: float
    height: float

    @property
    def side(self) -> float:
        """Longer side of the canvas: what shares of the canvas refer to."""
        return max(self.width, self.height)
