"""The smallest square that holds all parts."""

from __future__ import annotations

import math
from dataclasses import dataclass

from packwork.separation.ground import Ground
from packwork.separation.shapes import boxes_of
from packwork.separation.strip import Strip, StripSearch


@dataclass(frozen=True)
class SquareGround(Ground):
    """A square of any side."""

    height: float = math.inf
    axes: tuple[int, ...] = (0, 1)
    measure: str = "side"

    def height_at(self, length: float) -> float:
        """The same as the length."""
        return length

    def length_for(self, area: float) -> float:
        """Side of the square of an area."""
        return math.sqrt(area)


GROWTH = 1.05
"""Factor between squares into which columns of parts are laid."""


class SquareSearch(StripSearch):
    """Search over squares: as over strips, but shorter on both sides at once."""

    def fallback(self) -> Strip:
        """All parts in columns, on the smallest of some squares that holds them."""
        boxes = [boxes_of(part)[1] for part in self.problem.parts]
        least = [(one[:, 2:] - one[:, :2]).max(axis=1).min() for one in boxes]
        side = max(math.sqrt(self.problem.area), *least)
        while True:
            strip = self.columns(side)
            if strip.length <= side:
                return Strip(side, strip.poses, strip.lefts)
            side *= GROWTH
