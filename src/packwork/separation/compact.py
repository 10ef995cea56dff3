"""Compaction of a strip: all parts moved at once, by linear programmes over their contacts.

As of items that grow (:mod:`packwork.compaction`), but what gets better is the strip's length.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
from shapely.geometry import box

from packwork.compaction.arrangement import Arrangement
from packwork.compaction.compact import maximised
from packwork.compaction.kernels.contacts import BEND, REACH, rows_of
from packwork.compaction.kernels.interior_point import Rows
from packwork.compaction.kernels.steps import TRAVEL, step_of
from packwork.geometry.outline import Outline
from packwork.separation.shapes import Floats, placed
from packwork.separation.state import Problem

FIRST_TRUST, LAST_TRUST, NARROWING = 0.1, 0.001, 0.25
"""First and last bound of a move, in sides of the square of a part's mean area, and the factor on
it where a step is not worth it. Chosen."""

HAIR = 1e-7
"""Distance that parts keep, in the same sides: those that touch count as overlapping. Chosen."""

EDGE_HAIR = 0.999
"""Share of it by which the walls lie farther out: parts may touch those. Derived."""

ACCURACY = 0.01
"""Share of a step's gain that its programme may miss. Chosen."""


class StripCompaction:
    """Parts without overlap on a strip, or on the last of several sheets, which becomes shorter.

    ``poses``: of all parts; ``moving``: of each whether it moves, or else it is not there;
    ``length``: all of the strip that they take.
    """

    def __init__(
        self, problem: Problem, poses: Floats, moving: npt.NDArray[np.bool_], length: float
    ) -> None:
        ground = problem.ground
        self.poses, self.axes = poses, ground.axes
        # Neighbours near each other: the programme's matrix is a band.
        order = np.argsort(poses[:, 0], kind="stable")
        self.moving = order[moving[order]]
        self.steps = 0
        kinds = [problem.parts[kind] for kind in problem.shape_of[self.moving]]
        self.reach = np.array([kind.reach if kind.turns is None else 0.0 for kind in kinds])
        own = [
            Outline.from_region(placed(kind.region, np.array([0.0, 0.0, *pose])))
            for kind, pose in zip(kinds, poses[self.moving, 2:], strict=True)
        ]
        start = ground.start_at(length)
        own += [Outline.from_region(one) for one in ground.obstacles if one.bounds[2] > start]
        places = np.zeros((len(own), 4))
        places[: len(kinds), :2] = poses[self.moving, :2]
        self.unit = float(np.sqrt(problem.areas.mean()))
        far = 2.0 * length
        top = far if 1 in self.axes else problem.height
        slack = EDGE_HAIR * HAIR * self.unit
        # Parts of earlier sheets are not there: without a wall these would move over them.
        walls = Outline.from_region(box(start - slack, -slack, far, top + slack))
        self.arrangement = Arrangement(own, walls, places)

    @property
    def length(self) -> float:
        """Of what the parts take now."""
        return float(
            self.arrangement.board.boxes[: len(self.moving), [2 + a for a in self.axes]].max()
        )

    def pairs(self, reach: float) -> npt.NDArray[np.int64]:
        """Polygons within reach of each other, of which the first moves."""
        pairs = self.arrangement.pairs(reach)
        return pairs[pairs[:, 0] < len(self.moving)]

    def run(self, share: float) -> Floats:
        """Shorten as long as a step shortens it by that share; returns the poses of all parts."""
        count, items = len(self.moving), np.arange(len(self.moving))
        trust, hair = FIRST_TRUST * self.unit, HAIR * self.unit
        best, length = self.arrangement.places[:count].copy(), self.length
        while trust > LAST_TRUST * self.unit:
            self.steps += 1
            self.arrangement.put(items, best + self.step(trust, hair))
            is_worth = self.length < (1.0 - share) * length
            if is_worth and not len(self.arrangement.conflicts(self.pairs(0.0), 0.5 * hair)):
                best, length = self.arrangement.places[:count].copy(), self.length
            else:
                self.arrangement.put(items, best)
                trust *= NARROWING
        poses = self.poses.copy()
        poses[self.moving, :2] = best[:, :2]
        poses[self.moving, 2] += best[:, 2]
        return poses

    def step(self, trust: float, hair: float) -> Floats:
        """Change of places, ``(n, 4)``, that shortens the strip most, nearly."""
        board, count = self.arrangement.board, len(self.moving)
        items, gap = np.arange(count), hair
        if not self.reach.any():
            # Nothing bends: that room is not needed.
            gap -= BEND * trust**2 / float(board.arms[:count].mean())
        rows = rows_of(board, items, self.pairs(hair + TRAVEL * trust), trust, gap, 0.0)
        rows = self.with_ends(rows, trust)
        gain, low, high = np.zeros((3, 4 * count + 4))
        gain[-4], low[-4] = -1.0, -2.0
        for unknown in (0, 1):
            low[unknown:-4:4], high[unknown:-4:4] = -1.0, 1.0
        arms, angles = (
            board.arms[:count] / trust,
            self.poses[self.moving, 2] + board.places[:count, 2],
        )
        free = self.reach > 0.0
        low[2:-4:4] = np.where(free, np.clip((-self.reach - angles) * arms, -1.0, 0.0), 0.0)
        high[2:-4:4] = np.where(free, np.clip((self.reach - angles) * arms, 0.0, 1.0), 0.0)
        z = np.clip(maximised(rows, gain, low, high, ACCURACY), low, high)
        return np.asarray(step_of(board, items, z, trust))

    def with_ends(self, rows: Rows, trust: float) -> Rows:
        """Rows, and those that keep parts before the end, which is one item more."""
        board, count = self.arrangement.board, len(self.moving)
        owners = np.repeat(np.arange(len(board.starts) - 1), np.diff(board.starts))
        found = [rows]
        for axis in self.axes:
            near = (owners < count) & (board.points[:, axis] > self.length - REACH * trust)
            points, first = board.points[near], owners[near]
            coefficients = np.zeros((len(first), 8))
            coefficients[:, axis], coefficients[:, 4] = 1.0, -1.0
            arm = points[:, 1 - axis] - board.places[first, 1 - axis]
            coefficients[:, 2] = (2 * axis - 1) * arm / board.arms[first]
            limits = (self.length - points[:, axis]) / trust
            found.append(Rows(first, np.full(len(first), count), coefficients, limits))
        return Rows(*(np.concatenate(some) for some in zip(*found, strict=True)))
