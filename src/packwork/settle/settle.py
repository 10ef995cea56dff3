"""Compaction down the forces' heights until nothing goes lower: at rest.

The compaction of Z. Li and V. Milenkovic (1995, see :mod:`packwork.compaction`) with a potential
as its objective; items also turn, and while steps are wide the way down sways to both sides. A
step is a linear programme over the contacts of a few items. Such blocks move at once where they do
not touch, and items wait while nothing about them goes.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from packwork.arrays import FloatArray, IntArray
from packwork.compaction.arrangement import Arrangement
from packwork.compaction.compact import blocks, disjoint_groups, maximised
from packwork.compaction.kernels import broad_phase, contacts, steps
from packwork.compaction.kernels.distances import Board
from packwork.compaction.kernels.steps import TRAVEL
from packwork.forces.forces import Forces, Pull
from packwork.progress import Stop
from packwork.settle.kernels import descent
from packwork.threads import at_once

FIRST_TRUST, LAST_TRUST = 0.25, 1e-2
"""First and last bound of a move, in sides of the square of an item's mean area. A larger
first one falls faster and fails more checks; a smaller last one gains what is not seen.
Tried."""

NARROWING = 0.5
"""Factor on that bound once a round gains little. Larger takes more rounds, smaller leaves
way that was to be gained by larger steps. Tried."""

WORTHWHILE = 0.5
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

MOST_IN_BLOCK = 32
"""Items of one programme. Larger takes longer, an item, and comes no lower; smaller comes less far
down. Tried."""

STILL = 0.1
"""Way down, shares of a round's bound, below which an item waits until what lies about it goes, or
bounds and tilt change. Larger leaves way, smaller takes longer. Tried."""

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
        self.all_items = np.arange(len(areas))
        self._drops, self._narrowed = np.zeros(len(areas)), 0.0
        self._spacing = float(np.sqrt(np.mean(areas)))

    def mean_height(self) -> float:
        """Area-weighted mean height, canvas units."""
        return self._pull(self.all_items).value / self._mass

    @property
    def _mass(self) -> float:
        return max(float(self.areas.sum()), 1e-300)

    def _pull(self, items: IntArray) -> Pull:
        places, areas = self.arrangement.places[items, :2], self.areas[items]
        return self._forces.subset(items)(places, areas)

    def circle(self, items: IntArray) -> float:
        """Radius, canvas units, of the circle that holds some items; 0 if none is asked."""
        if self.centre is None:
            return 0.0
        return float(descent.circle_about(self.arrangement.board, items, self.centre))

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
        trust, items = trusts[0], self.all_items
        for rounds in range(MOST_ROUNDS):
            if stop():
                return rounds
            gained = self._round(trust, rounds, items)
            tell(self.arrangement.places)
            is_slow = self._farthest() < WORTHWHILE * trust * self._spacing
            rest = REST if self.centre is None else ROUND_REST
            # What a round of some gains says nothing of those that wait.
            is_of_all = len(items) == len(self.all_items)
            if is_slow and is_of_all and trust <= trusts[1] and gained < rest * self._side:
                return rounds + 1
            if is_slow and is_of_all:
                trust = max(trust * NARROWING, trusts[1])
            is_anew = is_slow or (rounds + 1) % SWAY == 0
            items = self.all_items if is_anew else self._stirred(trust)
        return MOST_ROUNDS

    def is_at_rest(self, trust: float = LAST_TRUST) -> bool:
        """Whether no item would go far in a round of such a bound; nothing moves."""
        before = self.arrangement.places.copy()
        self._round(trust, 0, self.all_items)
        self.arrangement.put(self.all_items, before)
        return bool(self._drops.max() < WORTHWHILE * trust * self._spacing)

    def _stirred(self, trust: float) -> IntArray:
        """Items that went down in the last round, and those that they might touch."""
        if self._forces.bonds:
            return self.all_items
        went = np.append(self._drops > STILL * trust * self._spacing, False)
        pairs = self.arrangement.pairs(self._gap + trust * self._spacing)
        stirred = went.copy()
        stirred[pairs[went[pairs].any(axis=1)]] = True
        return np.flatnonzero(stirred[:-1])

    def _round(self, trust: float, turn: int, items: IntArray) -> float:
        """One step of each block of some items, the lowest first; the mean way down of all.

        ``trust``: bound of a move, in sides of the square of an item's mean area.
        ``turn``: number of the round: others cut blocks elsewhere.
        """
        before, circle = self._pull(self.all_items), self.circle(self.all_items)
        low = before.parts / self.areas
        tilt = (
            TILT * (1 - 2 * (turn // SWAY % 2)) if self.is_swaying and trust > TILTED_TRUST else 0.0
        )
        found = blocks(self.arrangement.places[items, :2], turn, MOST_IN_BLOCK)
        found = sorted((items[b] for b in found), key=lambda block: float(low[block].mean()))
        # What draws together is moved one block after another.
        is_apart = not self._forces.bonds
        bound = trust * self._spacing
        reach = self._gap + 2 * TRAVEL * bound if is_apart else np.inf
        for group in disjoint_groups(found, self.arrangement.board.boxes, reach):
            at_once(self._step, [(block, bound, tilt) for block in group])
        after = self._pull(self.all_items)
        self._drops = low - after.parts / self.areas
        self._narrowed = circle - self.circle(self.all_items)
        return (before.value - after.value) / self._mass + ROUNDNESS * self._narrowed

    def _farthest(self) -> float:
        """Distance of the tenth that went farthest down in the last round, canvas units.

        Or the circle, if it came farther.
        """
        some = max(len(self._drops) // 10, 1)
        return max(float(np.sort(self._drops)[-some:].mean()), self._narrowed)

    def _step(self, items: IntArray, trust: float, tilt: float) -> None:
        """One step of some items, the way down turned by ``tilt``."""
        board = self.arrangement.board
        felt = self.all_items if self._forces.bonds else items
        now = self._pull(felt)
        slopes = now.slopes[items] if self._forces.bonds else now.slopes
        if not slopes.any():
            return
        cosine, sine = np.cos(tilt), np.sin(tilt)
        slopes = slopes @ np.array([[cosine, sine], [-sine, cosine]])
        before = self.arrangement.places[items].copy()
        worth = ROUNDNESS * self._mass
        height = now.value + worth * self.circle(items)
        pairs = broad_phase.pairs_of(board.boxes, items, self._gap + TRAVEL * trust)
        if self.centre is None:
            step = downward(board, slopes, self._turns, items, pairs, trust, self._gap, self._hair)
        else:
            step = inward(
                board, slopes, self._turns, items, pairs, trust, self._gap, self._hair,
                self.centre, worth,
            )  # fmt: skip
        descent.move(board, items, step, pairs, self._gap)
        if self._pull(felt).value + worth * self.circle(items) > height:
            # Near a point the slope turns within a step.
            self.arrangement.put(items, before)


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
