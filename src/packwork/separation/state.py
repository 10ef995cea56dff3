"""Poses of all parts and prices of their overlaps: the arrays of one worker."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt
import shapely

from packwork.separation.ground import Ground
from packwork.separation.kernels.collision import DECAY, PENALTY, POLES, SHAPE, SIDE, X
from packwork.separation.kernels.field import MARGIN
from packwork.separation.kernels.first_fit import lay_first_fit
from packwork.separation.kernels.moves import move_pass, put_all, raise_weights
from packwork.separation.shapes import DECAY_SHARE, Floats, Part, flattest, starts, tables

PIXELS = 11
"""Pixels of the image that proposes places, to the side of a square as large as the middle part's
hull. More find narrower gaps and take longer, with their cube."""

MOST_ROWS, MOST_COLUMNS = 400, 20_000
"""Rows and columns of that image at most, on a strip of which a quarter is covered."""

ROOMIER = 1.05
"""Length at least of what parts are laid on at first, over the width of the widest: on the very
width it would have to lie to a hair. Chosen."""

MOST, LEAST, FALL = 2.0, 1.2, 0.95
"""Factors of weights in a pass: of the worst pair, of the least, and of pairs that are apart."""


class Problem:
    """Parts, each with a number, on ground of a given height; all that no move changes."""

    def __init__(self, parts: Sequence[Part], ground: Ground) -> None:
        self.parts, self.ground, self.height = tuple(parts), ground, ground.height
        hulls = [part.region.convex_hull.area for part in parts]
        self.shape_of = np.repeat(np.arange(len(parts)), [part.count for part in parts])
        self.areas = np.array([part.region.area for part in parts])[self.shape_of]
        self.hulls = np.array(hulls)[self.shape_of]
        longest = ground.end if ground.bays else ground.length_for(4.0 * self.area)
        # In steps, so that other parts of the same kinds have the same spans.
        middle = math.sqrt(float(np.median(self.hulls))) / PIXELS
        middle = 2.0 ** (round(4.0 * math.log2(middle)) / 4.0)
        self.pixel = max(middle, longest / MOST_COLUMNS, ground.height_at(longest) / MOST_ROWS)
        obstacles = [Part(region=region) for region in ground.obstacles]
        self.shapes, self.turns = tables([*parts, *obstacles], self.pixel)
        widths = np.ptp(flattest(parts, ground.height)[0][:, ::2], axis=1)
        self.widest, self.narrowest = ROOMIER * float(widths.max()), float(widths.min())
        wide = [np.ptp(shapely.get_coordinates(part.region), axis=0).max() for part in parts]
        self.decays = np.array(wide)[self.shape_of] * DECAY_SHARE

    def __len__(self) -> int:
        """Number of parts that move, each of a kind as often as it is wanted."""
        return len(self.shape_of)

    @property
    def area(self) -> float:
        """Sum of all areas, in square units."""
        return float(self.areas.sum())


@dataclass
class WorkerState:
    """Poses (x, y, angle, side) of all parts, weights of pairs and losses of pairs.

    A part whose pose is NaN is not laid.
    """

    problem: Problem
    sheet: Floats
    arrays: tuple[Any, ...]
    weights: Floats
    losses: Floats
    turned: tuple[Floats, npt.NDArray[np.float32]]
    scratch: tuple[Any, ...]
    random: npt.NDArray[np.uint64]
    image: npt.NDArray[np.float32] = field(default_factory=lambda: np.zeros((0, 0), np.float32))
    scores: npt.NDArray[np.float32] = field(default_factory=lambda: np.zeros((0, 0), np.float32))

    @classmethod
    def of(cls, problem: Problem, length: float, poses: Floats, seed: int) -> WorkerState:
        """Parts at poses on a sheet of a length."""
        edges, poles, edge_at = problem.shapes
        # Obstacles have the last numbers; no move takes them up.
        obstacles = np.arange(len(problem.parts), len(edge_at) - 1)
        shape_of = np.concatenate([problem.shape_of, obstacles])
        count = len(shape_of)
        own = [edges[:, edge_at[s] : edge_at[s + 1]] for s in shape_of]
        items, index = np.zeros((SIDE + 1, count)), np.zeros((count, 4), np.int64)
        items[PENALTY], items[DECAY] = problem.hulls.max() ** 0.25, problem.decays.max()
        items[PENALTY, : len(problem)] = problem.hulls**0.25
        items[DECAY, : len(problem)] = problem.decays
        index[:, 0], index[:, 1] = starts(own)[:-1], starts(own)[1:]
        index[:, SHAPE] = shape_of
        most = np.diff(edge_at).max() + 1
        layout = cls(
            problem, np.array([length, problem.height]),
            (items, index, np.hstack(own), poles[shape_of].astype(np.float32)),
            np.ones((count, count)), np.zeros((count, count)),
            (np.empty((4, most)), np.empty((3, POLES), np.float32)),
            (np.empty((4, most)), np.empty(POLES, np.float32), np.empty(most, np.int64),
             np.empty(4), np.empty(count, np.bool_)),
            np.array([seed], np.uint64),
        )  # fmt: skip
        layout.set_length(length, poses)
        return layout

    def set_length(self, length: float, poses: Floats) -> None:
        """Make the sheet that long, with parts at these poses."""
        pixel = self.problem.pixel
        height = self.problem.ground.height_at(length)
        rows, columns = math.ceil(height / pixel), math.ceil(length / pixel)
        if self.image.shape != (rows, columns + 1 + 2 * MARGIN):
            self.image = np.zeros((rows, columns + 1 + 2 * MARGIN), np.float32)
            self.scores = np.zeros((3, columns + 2), np.float32)
        self.sheet[:] = length, height
        self.put(poses)

    def put(self, poses: Floats) -> None:
        """Lay all parts at poses, and work all losses out anew."""
        put_all(poses, self.arrays, self.problem.shapes, self.problem.turns, self.weights,
                self.losses, self.sheet, self.turned, self.scratch)  # fmt: skip

    def take(self, other: WorkerState) -> None:
        """Become a copy of another worker's layout; the random numbers stay one's own."""
        for own, theirs in zip(self.arrays, other.arrays, strict=True):
            own[:] = theirs
        self.weights[:], self.losses[:] = other.weights, other.losses

    @property
    def poses(self) -> Floats:
        """A copy of x, y, angle and side of all parts."""
        return np.array(self.arrays[0][X:, : len(self.problem)].T, order="C")

    @property
    def loss(self) -> float:
        """Sum of all losses without weights; 0 where nothing overlaps or sticks out."""
        return float((self.losses.sum() + np.trace(self.losses)) / 2)

    @property
    def weighted(self) -> float:
        """Sum of all losses with their weights."""
        both = self.losses * self.weights
        return float((both.sum() + np.trace(both)) / 2)

    def move(self) -> int:
        """Run one pass over all parts that collide; returns how many places were priced."""
        problem = self.problem
        return int(
            move_pass(len(problem), self.random, self.arrays, self.weights, self.losses,
                      problem.shapes, problem.turns, self.sheet, problem.pixel, self.image,
                      self.scores, self.turned, self.scratch)
        )  # fmt: skip

    def first_fit(self, order: npt.NDArray[np.int64], full: npt.NDArray[np.bool_]) -> int:
        """Lay parts where nothing gives way, of no kind that is ``full``, to which it adds.

        Returns how many places were priced. Losses are not worked out.
        """
        problem = self.problem
        return int(
            lay_first_fit(order, self.random, self.arrays, self.weights, problem.shapes,
                          problem.turns, self.sheet, problem.pixel, self.image, self.scores,
                          self.turned, self.scratch, full)
        )  # fmt: skip

    def raise_weights(self) -> None:
        """Make pairs that collide dearer, and the others cheaper."""
        raise_weights(self.weights, self.losses, MOST, LEAST, FALL)
