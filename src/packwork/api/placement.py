"""One placed item, as a layout lists them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

from packwork.geometry.outline import Outline
from packwork.scene.item import Item


class Pose(NamedTuple):
    """Pose of one item: canvas units and radians, as in :class:`packwork.Poses`."""

    x: float
    y: float
    angle: float
    scale: float
    stretch: float


@dataclass(frozen=True, eq=False)
class Placement:
    """One placed item.

    Parameters
    ----------
    outline
        Its outline there, canvas units.
    weight
        Share of area that was asked for it.
    """

    item: Item
    pose: Pose
    outline: Outline
    weight: float

    @property
    def name(self) -> str:
        """Name of the item, as people read it."""
        return self.item.name

    @property
    def area(self) -> float:
        """Area in place, squared canvas units."""
        return self.outline.area

    def __repr__(self) -> str:
        return f"<Placement: {self.name} at ({self.pose.x:.1f}, {self.pose.y:.1f})>"
