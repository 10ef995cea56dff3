"""The smallest square that holds all parts."""

from __future__ import annotations

import math
from dataclasses import dataclass

from packwork.separation.ground import Ground
from packwork.separation.kernels.collision import X1, Y1
from packwork.separation.shapes import Floats, boxes_of
from packwork.separation.strip import Strip, StripSearch


@dataclass(frozen=True)
class SquareGround(Ground):
    """A square of any side."""

    height: float = math.inf

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

    def extent(self, boxes: Floats) -> float:
        """Side of the square that parts with these boxes need."""
        return float(boxes[:, [X1, Y1]].max())

    def shorter(self, best: Strip, share: float) -> None:
        """Cut a share of the side out, across and down; what lies beyond the cuts moves."""
        cut, poses = best.length * share, best.poses.copy()
        for axis in (0, 1):
            line = self.random.uniform(0.0, best.length)
            poses[poses[:, axis] > line, axis] -= cut
        self.put(best.length - cut, poses, fresh=True)
