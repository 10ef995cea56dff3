"""Pours: items that come in one by one, each to the best place to which a way leads.

Bottom-left placement of true outlines (:mod:`packwork.start.first_fit.lowest_fit`) among the places
that an item can be moved to from a source, at one angle and past all that lies there. Ways are
cheapest paths over the pixels, where height costs; who follows another closely waits at the source.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
import shapely

from packwork.arrays import FloatArray, IntArray
from packwork.geometry.affine import similarity
from packwork.geometry.outline import Outline
from packwork.progress import Stop
from packwork.raster.coverage import TOUCHED
from packwork.scene.container import Container
from packwork.scene.pose import Poses
from packwork.start.first_fit.kernels import ways
from packwork.start.first_fit.lowest_fit import Falling, FallingBoard, FreePlace
from packwork.start.first_fit.occupancy import Bits, Occupancy, Stencil
from packwork.start.first_poses import container_image

STRIDE = 0.25
"""Way of an item in one round, sides of the square of an item's mean area. Larger pours faster in
fewer, coarser steps. That of a settling's first bound."""

ROUND_EDGE = 3.0
"""Room round the canvas from which items may come in, radii of the largest. Larger takes longer;
an emitter at an edge wants two."""

LOW = 0.2
"""Price of a way at the lowest place, of 1 more at the highest. Larger lets items fly straight to
their places, smaller lets them fall first and go aside over what lies there. By eye."""


@dataclass(frozen=True, eq=False)
class Source:
    """Source of a pour's items.

    ``points``: ``(m, 2)`` places of their origins, canvas units.
    ``ranks``: ``(m,)`` places of a lower rank come first.
    ``every``: rounds between one item and the next; 0 for all at once.
    """

    points: FloatArray
    ranks: IntArray
    every: int


@dataclass(frozen=True, eq=False)
class Flight:
    """An item on its way from a source to its place.

    ``start``: round in which it comes in.
    ``points``: ``(k, 3)`` where it is in each round from then on, canvas units, and how far it is
    still turned from its last angle, rad.
    """

    item: int
    start: int
    points: FloatArray

    def at(self, rounds: IntArray) -> FloatArray:
        """``(m, 3)`` where it is in some rounds from its start on."""
        return self.points[np.minimum(rounds - self.start, len(self.points) - 1)]


@dataclass(frozen=True, eq=False)
class Poured:
    """Poses after a pour, and the flights of those that found a place, as they came in."""

    poses: Poses
    flights: Sequence[Flight]

    @property
    def items(self) -> IntArray:
        """``(m,)`` items that found a place."""
        return np.array([flight.item for flight in self.flights], dtype=np.int64)

    def rounds(self) -> Iterator[tuple[IntArray, FloatArray]]:
        """For each round the items that are in by then, and their ``(m, 3)`` points."""
        landed = max((one.start + len(one.points) for one in self.flights), default=0)
        items, points = self.items, np.zeros((len(self.flights), 3))
        starts = np.array([one.start for one in self.flights])
        flying, came = list[int](), 0
        for now in range(landed):
            in_now = int(np.searchsorted(starts, now, side="right"))
            flying, came = [*flying, *range(came, in_now)], in_now
            for k in flying:
                points[k] = self.flights[k].points[now - starts[k]]
            flying = [k for k in flying if now + 1 < starts[k] + len(self.flights[k].points)]
            yield items[:came], points[:came].copy()


def pour(
    container: Container, basin: Outline, falling: Falling, source: Source,
    rng: np.random.Generator, stop: Stop,
) -> Poured:  # fmt: skip
    """Let items in from a source, each to where it lies best of all places that it can reach.

    ``basin``: the container and more, through which items may pass.
    """
    pouring = _Pouring(container, basin, falling, source, rng)
    for item in falling.order:
        if stop():
            break
        pouring.let_in(int(item))
    return Poured(pouring.board.poses, pouring.flights)


class _Pouring:
    """State of a pour: what lies on the board, and who is on its way."""

    def __init__(
        self, container: Container, basin: Outline, falling: Falling, source: Source,
        rng: np.random.Generator,
    ) -> None:  # fmt: skip
        self._radii = np.array([one.radius for one in falling.outlines]) * falling.scales
        edge = ROUND_EDGE * float(self._radii.max())
        width, height = container.width + 2 * edge, container.height + 2 * edge
        window = shapely.box(0, 0, width, height)
        moved = similarity(edge, edge, 0.0, 1.0)
        near = Outline.from_region(basin.mapped(moved).region & window)
        room = replace(container, outline=near, width=width, height=height, walls=None)
        self.board = FallingBoard(room, falling, rng, (-edge, -edge))
        own = replace(room, outline=container.outline.mapped(moved))
        image, _ = container_image(own, self.board.resolution)
        self._within = Occupancy(image > 1 - TOUCHED, 0)
        self._corner, self._source, self._gap = edge, source, 2 * falling.margin_cu
        px_per_cu = self.board.px_per_cu
        self._columns, self._rows = np.round((source.points + edge) * px_per_cu).astype(int).T
        self._stride_px = STRIDE * falling.side * px_per_cu
        self.flights = list[Flight]()
        self._in_air = list[Flight]()

    def let_in(self, item: int) -> None:
        """Put an item to the best place that it can reach, if there is one."""
        near = self.board.rows()
        place, way = self._reached(item, near)
        if way is None and near is not None:
            place, way = self._reached(item, None)
        if place is None or way is None:
            return
        origin = self.board.origin(item, place)
        self.board.take(item, place)
        steps = np.arange(len(way) - 1, 0, -self._stride_px)[::-1].astype(int)
        poses = self.board.poses
        landed = poses.x[item], poses.y[item], poses.angle[item]
        points = way[np.append(steps, len(way) - 1)] / self.board.px_per_cu - self._corner
        turns = np.full(len(points), origin[2] - landed[2])
        on_way = np.column_stack([points, turns])
        self.flights.append(self._timed(item, np.vstack([on_way, [*landed[:2], 0.0]])))

    def _reached(
        self, item: int, rows: tuple[int, int] | None
    ) -> tuple[FreePlace | None, IntArray | None]:
        """Best place in some rows, and the way there; of rows above these, air is supposed."""
        place = self.board.best(item, rows, partial(self._keep_reached, rows))
        return place, None if place is None else self._way(item, place)

    def _keep_reached(self, rows: tuple[int, int] | None, stencil: Stencil, free: Bits) -> None:
        """Clear bits of places to which no way leads, and of those off the container."""
        top, bottom = rows or (0, len(free))
        tall = stencil.mask.shape[0]
        reached = self._seeds(stencil, free, top)
        if top > 0:
            reached[0] = free[0]
        if bottom < self.board.occupancy.shape[0]:
            reached[len(free) - tall] = free[len(free) - tall]
        ways.flood(free, reached)
        free[...] = reached
        self._within.clear(stencil.boxes, tall, free, top)

    def _seeds(self, stencil: Stencil, free: Bits, top: int = 0) -> Bits:
        """Bits of the free places at the source, of the lowest rank that has any.

        ``top``: row of the image that ``free`` begins with.
        """
        for rank in np.unique(self._source.ranks):
            of_rank = self._source.ranks == rank
            rows = self._rows[of_rank] - stencil.origin[0] - top
            columns = self._columns[of_rank] - stencil.origin[1]
            inside = (rows >= 0) & (rows < len(free)) & (columns >= 0)
            inside &= columns < self.board.occupancy.shape[1]
            rows, columns = rows[inside], columns[inside]
            seeds = np.zeros_like(free)
            bits = np.uint64(1) << (columns & 63).astype(np.uint64)
            np.bitwise_or.at(seeds, (rows, columns >> 6), bits)
            seeds &= free
            if seeds.any():
                break
        return seeds

    def _way(self, item: int, place: FreePlace) -> IntArray | None:
        """``(k, 2)`` columns and rows of an item's origin on its way to a place; None without."""
        stencil = self.board.stencil(item, place.angle)
        free = self.board.occupancy.free_places(stencil)
        seeds = self._seeds(stencil, free)
        width = free.shape[1] * 64
        is_free, is_seed = (
            np.unpackbits(bits.view(np.uint8), axis=1, bitorder="little").astype(bool)
            for bits in (free, seeds)
        )
        worth = self.board.worth(item)
        rows = np.clip(np.arange(len(free)) + stencil.origin[0], 0, len(worth) - 1)
        columns = np.clip(np.arange(width) + stencil.origin[1], 0, worth.shape[1] - 1)
        height = -worth[np.ix_(rows, columns)]
        height = (height - height.min()) / max(float(np.ptp(height)), 1e-300)
        price = np.where(is_free, LOW + height, np.inf)
        costs = np.where(is_seed, 0.0, np.inf)
        ways.spread_costs(price, costs)
        row, column = place.row, place.column
        if costs[row, column] == np.inf:
            return None
        way = [(column, row)]
        while costs[row, column] > 0:
            top, left = max(row - 1, 0), max(column - 1, 0)
            about = costs[top : row + 2, left : column + 2]
            down, across = np.unravel_index(np.argmin(about), about.shape)
            row, column = top + int(down), left + int(across)
            way.append((column, row))
        return np.asarray(np.array(way[::-1]) + np.array(stencil.origin[::-1]))

    def _timed(self, item: int, points: FloatArray) -> Flight:
        """Flight that begins as soon as it meets nobody who is on the way."""
        start = self.flights[-1].start + self._source.every if self.flights else 0
        while True:
            flight = Flight(item, start, points)
            in_air = [one for one in self._in_air if start < one.start + len(one.points) - 1]
            if not any(self._meet(flight, other) for other in in_air):
                self._in_air = [*in_air, flight]
                return flight
            start += 1

    def _meet(self, flight: Flight, other: Flight) -> bool:
        """Whether the discs round two items come too near before the earlier one has landed."""
        rounds = np.arange(flight.start, other.start + len(other.points) - 1)
        apart = np.hypot(*(flight.at(rounds) - other.at(rounds))[:, :2].T)
        least = self._radii[flight.item] + self._radii[other.item] + self._gap
        return bool((apart < least).any())
