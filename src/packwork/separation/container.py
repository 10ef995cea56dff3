"""Parts of given size in a container that is made smaller: what raises one common scale of all.

Nothing of the parts is drawn anew for that: only what stands round the container is scaled.
The smallest square that holds all parts is found alike.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
import shapely
from shapely.geometry import box

from packwork.geometry.overlay import buffered, difference, simplify
from packwork.geometry.polygon import Region
from packwork.separation.ground import TILES, Bay, Ground, tiles
from packwork.separation.shapes import Floats, Part, boxes_of, spans_of, starts
from packwork.separation.strip import Strip, StripSearch, WorkBound

COARSENESS = 5e-4
"""Largest distance of the container's edge from the true one, over the width of a part. Larger
wastes room, smaller prices more edges. Chosen."""


@dataclass(frozen=True)
class ContainerRoom(Ground):
    """A container in its box, whose height and length stay in proportion."""

    def height_at(self, length: float) -> float:
        """Height of the box of a length."""
        return self.height * length / self.end


class ContainerSearch(StripSearch):
    """Separation in one container, from poses that are given.

    Parameters
    ----------
    container
        Region in which parts may lie, each with half the gap about it.
    poses
        ``(n, 3)`` x, y and angle of all parts, in the container's coordinates.
    """

    def __init__(
        self, parts: Sequence[Part], container: Region, poses: Floats, *, seed: int = 0,
        workers: int = 2, stop: Callable[[], bool] = lambda: False,
    ) -> None:  # fmt: skip
        off = COARSENESS * float(np.mean([np.ptp(part.region.bounds[::2]) for part in parts]))
        plain = buffered(simplify(container, off, keeps_topology=True), -off, join_style="mitre")
        self.corner = np.array([*plain.bounds[:2], 0.0])
        self._first = _on_side(poses - self.corner)
        ground = _ground_of(plain)
        super().__init__(parts, ground, seed=seed, workers=workers, work=WorkBound(), stop=stop)
        shapes, turns = self.problem.shapes, self.problem.turns
        # Obstacles have the last numbers, each one turn.
        self._edge, self._turn = int(shapes.edge_at[len(parts)]), int(turns.turn_at[len(parts)])
        self._walls = shapes.edges[:, self._edge :].copy(), shapes.poles[len(parts) :].copy()

    def fallback(self) -> Strip:
        """The parts where they were given."""
        return Strip(self.ground.end, self._first, self._first[:, 0])

    def first_poses(self, length: float) -> Floats:
        """The same."""
        del length
        return self._first

    def shrink(self, factor: float) -> None:
        """Make the container that many times smaller than it was given."""
        problem = self.problem
        edges, poles = (wall / factor for wall in self._walls)
        problem.shapes.edges[:, self._edge :] = edges
        problem.shapes.poles[len(problem.parts) :] = poles
        at = problem.shapes.edge_at[len(problem.parts) :] - self._edge
        if len(at) > 1:
            walls = np.split(edges, at[1:-1], axis=1)
            spans = [spans_of(one, problem.pixel) for one in walls]
            table, kept = problem.turns, int(problem.turns.span_at[self._turn])
            problem.turns = table._replace(
                spans=np.hstack([table.spans[:, :kept], *spans]),
                span_at=np.append(table.span_at[: self._turn], kept + starts(spans)),
            )

    def separated(
        self, poses: Floats, factor: float, passes: int, *, fresh: bool
    ) -> tuple[Floats, float]:
        """Poses of the lowest loss that was met in the container made smaller, and that loss.

        Parameters
        ----------
        poses
            ``(n, 3)`` in the container as it was given; so are those that are returned.
        factor
            How many times smaller it is made.
        passes
            How many are run at most.
        fresh
            Whether weights start at 1.
        """
        self.shrink(factor)
        self.put(self.ground.end / factor, _on_side(_scaled(poses - self.corner, 1.0 / factor)),
                 fresh=fresh)  # fmt: skip
        self.work.passes = passes
        self.work.start()
        loss, found, _ = self.separate(passes, 1.0, 1)
        return _scaled(found[:, :3], factor) + self.corner, loss


def _on_side(poses: Floats) -> Floats:
    """Poses (x, y, angle, side) of parts none of which is mirrored."""
    return np.column_stack([poses, np.ones(len(poses))])


def _scaled(poses: Floats, factor: float) -> Floats:
    return np.asarray(poses * (factor, factor, 1.0))


def _ground_of(room: Region) -> ContainerRoom:
    """Ground of one sheet, the container's box, with all that is not the container in its way."""
    x0, y0, x1, y1 = room.bounds
    wide, tall = x1 - x0, y1 - y0
    around = shapely.transform(
        difference(box(x0, y0, x1, y1), room), lambda points: points - (x0, y0)
    )
    bay = Bay(0.0, wide, room.area, (-x0, -y0))
    return ContainerRoom(tall, (bay,), tuple(tiles(around, min(wide, tall) / TILES)))


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
