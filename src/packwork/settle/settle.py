"""Compaction down the forces' heights until nothing goes lower: at rest.

The compaction of Z. Li and V. Milenkovic (1995, see :mod:`packwork.compaction`) with a potential
as its objective; items also turn, and while steps are wide the way down sways to both sides. A
step is a linear programme over the contacts of some items.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from packwork.arrays import FloatArray, IntArray
from packwork.compaction.arrangement import Arrangement
from packwork.compaction.compact import blocks
from packwork.compaction.kernels import broad_phase, contacts, steps
from packwork.compaction.kernels.distances import Board
from packwork.compaction.kernels.steps import TRAVEL
from packwork.compaction.programmes import maximised
from packwork.forces.forces import Forces, Pull
from packwork.progress import Stop
from packwork.settle.kernels import descent

FIRST_TRUST, LAST_TRUST = 0.25, 1e-2
"""First and last bound of a move, in sides of the square of an item's mean area. A larger
first one falls faster and fails more checks; a smaller last one gains what is not seen.
Tried."""

NARROWING = 0.5
"""Factor on that bound once a round gains little. Larger takes more rounds, smaller leaves
way that was to be gained by larger steps. Tried."""

WORTHWHILE = 0.3
"""Share of the bound by which the tenth of the items that went farthest down have to go in a
round to be followed by one of the same bound. Larger leaves arches and items in the air, smaller
takes more rounds. Tried."""

REST = 3e-5
"""Mean way down of a round, as a share of the canvas, below which all is at rest at the last
bound. Derived: a thirtieth of what counts as lying lower (a thousandth of the canvas)."""

ROUND_REST = 4 * REST
"""The same where a pack is to be round, with what a smaller circle is worth. Smaller takes up to
twice as many rounds for a thousand circles, for 0.0005 of the circle at most. Tried."""

TILT = 0.5
"""Turn of the way down, rad, to one side and the other in turn, while bounds are wide: what
stands on a point slides off. Larger pushes items up each other's sides. Tried."""

SWAY = 6
"""Rounds to one side before it is the other's turn: what slides needs some. Tried."""

TILTED_TRUST = 0.03
"""Bound from which rounds are tilted. Smaller leaves less time to rest. Chosen."""

MOST_ROUNDS = 400
"""Rounds at most. Chosen."""

ROUNDNESS = 30.0
"""What a smaller circle is worth where a pack is to be round, mean heights. Larger lets items
inside lie anywhere, smaller lets some stick out. Tried."""


class Settling:
    """Items of fixed sizes on their way down; the arrangement never has a conflict.

    ``arrangement``: without conflicts; changed in place.
    ``forces``: one strength for each item of the arrangement.
    ``areas``: ``(n,)`` how much each item counts.
    ``turns``: farthest turns back and on, ``(n,)`` each, rad.
    ``gap``: least distance that the check asks for.
    ``hair``: the part of it that was not asked for.
    ``side``: longer side of the canvas.
    """

    def __init__(
        self,
        arrangement: Arrangement,
        forces: Forces,
        areas: FloatArray,
        turns: tuple[FloatArray, FloatArray],
        gap: float,
        hair: float,
        side: float,
    ) -> None:
        self.arrangement, self._forces, self.areas, self._turns = arrangement, forces, areas, turns
        self._gap, self._hair, self._side = gap, hair, side
        self.is_swaying = True
        """Whether wide rounds are tilted."""
        self.centre: FloatArray | None = None
        """Of the circle that is to become small; None for none."""
        self.active = np.arange(len(areas))
        """Items that move; all others count as not there, and have to be far away."""
        self._drops, self._narrowed = np.zeros(len(areas)), 0.0
        self._spacing = float(np.sqrt(np.mean(areas)))

    def pull(self) -> Pull:
        """Heights and slopes of the active items where they are now."""
        forces = self._forces if len(self.active) == len(self.areas) else (
            self._forces.subset(self.active)
        )  # fmt: skip
        return forces(self.arrangement.places[self.active, :2], self.areas[self.active])

    def mean_height(self) -> float:
        """Area-weighted mean height of the active items, canvas units."""
        return self._mean(self.pull())

    def _mean(self, now: Pull) -> float:
        return now.value / max(float(self.areas[self.active].sum()), 1e-300)

    def _cost(self, now: Pull, items: IntArray) -> float:
        """Mean height, and the circle that holds some items where that counts."""
        return self._mean(now) + ROUNDNESS * self.circle(items)

    def circle(self, items: IntArray | None = None) -> float:
        """Radius, canvas units, of the circle that holds items ``(m,)``; 0 if none is asked."""
        if self.centre is None:
            return 0.0
        some = self.active if items is None else items
        return float(descent.circle_about(self.arrangement.board, some, self.centre))

    def settle(
        self,
        tell: Callable[[FloatArray], None],
        stop: Stop,
        trusts: tuple[float, float] = (FIRST_TRUST, LAST_TRUST),
    ) -> int:
        """Compact all down the potential until they are at rest; how many rounds it took.

        ``tell``: called with the places ``(n, 4)``, canvas units and rad, after each round.
        ``trusts``: first and last bound of a move.
        """
        trust = trusts[0]
        for rounds in range(MOST_ROUNDS):
            if stop():
                return rounds
            gained = self.round(trust, rounds)
            tell(self.arrangement.places)
            is_last = trust <= trusts[1]
            reach = self._farthest() / (trust * self._spacing)
            rest = REST if self.centre is None else ROUND_REST
            if is_last and gained < rest * self._side and reach < WORTHWHILE:
                return rounds + 1
            if reach < WORTHWHILE:
                trust = max(trust * NARROWING, trusts[1])
        return MOST_ROUNDS

    def round(self, trust: float, turn: int) -> float:
        """One step of each block, the lowest first; the mean way down, and that of the circle.

        ``trust``: bound of a move, in sides of the square of an item's mean area.
        ``turn``: number of the round: others cut blocks elsewhere.
        """
        now = self.pull()
        before, circle, low = self._cost(now, self.active), self.circle(), self._lows(now)
        tilt = (
            TILT * (1 - 2 * (turn // SWAY % 2)) if self.is_swaying and trust > TILTED_TRUST else 0.0
        )
        found = blocks(self.arrangement.places[self.active, :2], turn)
        for block in sorted(found, key=lambda items: float(low[items].mean())):
            now = self._step(block, trust * self._spacing, tilt, now)
        self._drops = low - self._lows(now)
        self._narrowed = circle - self.circle()
        return before - self._cost(now, self.active)

    def _lows(self, now: Pull) -> FloatArray:
        return np.asarray(now.parts / self.areas[self.active])

    def _farthest(self) -> float:
        """Distance of the tenth that went farthest down in the last round, canvas units.

        Or the circle, if it came farther.
        """
        some = max(len(self._drops) // 10, 1)
        return max(float(np.sort(self._drops)[-some:].mean()), self._narrowed)

    def _step(self, block: IntArray, trust: float, tilt: float, now: Pull) -> Pull:
        """One step of some of the active items, the way down turned by ``tilt``.

        ``now``: heights and slopes before it; returns those after it.
        """
        board = self.arrangement.board
        slopes = now.slopes[block]
        if not slopes.any():
            return now
        items = self.active[block]
        cosine, sine = np.cos(tilt), np.sin(tilt)
        slopes = slopes @ np.array([[cosine, sine], [-sine, cosine]])
        before = self.arrangement.places[items].copy()
        height = self._cost(now, items)
        pairs = broad_phase.pairs_of(board.boxes, items, self._gap + TRAVEL * trust)
        if self.centre is None:
            step = downward(board, slopes, self._turns, items, pairs, trust, self._gap, self._hair)
        else:
            worth = ROUNDNESS * float(self.areas[self.active].sum())
            step = inward(
                board, slopes, self._turns, items, pairs, trust, self._gap, self._hair,
                self.centre, worth,
            )  # fmt: skip
        descent.move(board, items, step, pairs, self._gap)
        after = self.pull()
        if self._cost(after, items) > height:
            # Near a point the slope turns within a step.
            self.arrangement.put(items, before)
            return now
        return after


ACCURACY = 0.05
"""Share of the way down that a programme may miss. Smaller costs time; larger leaves items
hanging in the middle of their room. Tried."""

Turns = tuple[FloatArray, FloatArray]
"""Bounds of the turn of every solid: backmost, foremost."""


def downward(
    board: Board, slope: FloatArray, turns: Turns, items: IntArray, pairs: IntArray,
    trust: float, gap: float, hair: float,
) -> FloatArray:  # fmt: skip
    """Change of place of ``items`` that goes down most and keeps the contacts apart, nearly.

    ``slope``: ``(m, 2)`` what a move by one canvas unit costs, by x and y, a row for each item.
    """
    rows = contacts.rows_of(board, items, pairs, trust, gap, hair)
    gain, low, high = descent.gains_and_bounds(board, slope, *turns, items, trust)
    z = maximised(rows, gain, low, high, ACCURACY)
    return _step(board, items, z, low, high, trust)


def inward(
    board: Board, slope: FloatArray, turns: Turns, items: IntArray, pairs: IntArray,
    trust: float, gap: float, hair: float, centre: FloatArray, weight: float,
) -> FloatArray:  # fmt: skip
    """The same where a smaller circle about ``centre`` ``(2,)`` is worth ``weight`` a unit."""
    n = len(items)
    rows = contacts.rows_of(board, items, pairs, trust, gap, hair)
    circle = descent.circle_about(board, items, centre)
    rows = descent.with_circle(board, items, rows, centre, circle, trust)
    gain, low, high = np.zeros((3, 4 * n + 4))
    own = descent.gains_and_bounds(board, slope, *turns, items, trust)
    gain[: 4 * n], low[: 4 * n], high[: 4 * n] = own
    # What makes room for others may go anywhere.
    for c in range(2):
        low[c : 4 * n : 4], high[c : 4 * n : 4] = -1.0, 1.0
    gain[4 * n], low[4 * n] = -weight, -1.0
    z = maximised(rows, gain, low, high, ACCURACY)
    return _step(board, items, z, low, high, trust)


def _step(
    board: Board, items: IntArray, z: FloatArray, low: FloatArray, high: FloatArray, trust: float
) -> FloatArray:
    # An interior point is a little off its bounds: what may not turn would.
    within = np.minimum(np.maximum(z, low), high)
    return np.asarray(steps.step_of(board, items, within, trust))
