"""Simulated annealing of a compacted layout: items turned or exchanged, kept where that gains.

S. Kirkpatrick, C. Gelatt and M. Vecchi, "Optimization by simulated annealing", Science 220
(1983), 671-680, doi:10.1126/science.220.4598.671. A trial may lose an amount drawn from an
exponential distribution of mean ``heat``, which accepts a loss L with probability
exp(-L / heat), the rule of Metropolis; the temperature falls linearly to nothing.

Ours differs: the moved items and their neighbours are compacted before a trial is judged, a trial
ends early where it has fallen far behind, and where sizes are common only gains are kept.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import islice

import numpy as np

from packwork.arrays import FloatArray
from packwork.compaction.arrangement import Arrangement
from packwork.compaction.compact import FRACTIONS, compact_all
from packwork.compaction.kernels.steps import TRAVEL, Objective
from packwork.compaction.kernels.trials import (
    Rounds,
    Trial,
    allocate_batch,
    attempt,
    choose_disjoint,
)
from packwork.compaction.objective import AREA_POWER
from packwork.finish.objective import ForceTerm
from packwork.finish.proposals import (
    EXCHANGES,
    Proposal,
    at_angles,
    destination,
    destinations,
    pools_of,
    propose,
)
from packwork.progress import Stop, never
from packwork.threads import at_once

NEIGHBOURS = 6
"""Items that may give way in a trial, beside those that are moved. More gain more in a
trial and cost more. Tried."""

ROUNDS = 5
"""Linear programmes of one trial. As above. Tried."""

TRUST = (0.05, 0.01)
"""Trust region of the first and the last of them, shares of the side of an item's share
of the container. Tried."""

ANGLE_TRUST = 0.08
"""Trust region of the round in which they grow alone, as above. Tried."""

PATIENCE, HASTE = 0.8, 0.55
"""Area that may be missing when a trial's first round begins, shares of an item's share of the
container, and how that falls with each round. Larger spends rounds on trials that end badly.
Measured."""

HEAT = 0.03
"""Mean area that a trial may lose and be kept, shares of an item's share of the container, at the
begin. Larger wanders, smaller stays in the first optimum. Tried."""

SWEEPS, SWEEP_ROUNDS = 3, 4
"""Linear programmes over all items after as many trials as there are items, or so many times in all
if that is oftener. Tried."""

AT_ONCE = 16
"""Trials made at once at most, which are looked for among twice as many, whatever the number of
threads. More keep more cores busy, and know less of each other. Chosen."""

ROOM = 0.25
"""How far an item may go in such a trial, or it is undone, shares of the side of an item's share of
the container. Larger lets fewer be made at once. Chosen."""


@dataclass(frozen=True)
class Lengths:
    """Lengths of a finish, canvas units; ``spacing``: side of an item's share of the container."""

    spacing: float
    gap: float
    hair: float


def anneal(
    arrangement: Arrangement,
    objective_at: Callable[[FloatArray], Objective],
    trials: int,
    lengths: Lengths,
    rng: np.random.Generator,
    stop: Stop = never,
    tell: Callable[[int], None] | None = None,
    force_term: ForceTerm | None = None,
    exchanges: float = EXCHANGES,
) -> int:
    """Anneal a compacted layout by turns and exchanges of items; how many trials were kept.

    The arrangement, changed in place, has no conflicts and gets none. Where all area is worth the
    same, a trial may lose a little and be kept: ever less, at last nothing. ``objective_at``:
    objective and bounds at places ``(n, 4)``; ``tell``: called with the number of each trial;
    ``exchanges``: share of trials that exchange items, with 0 each stays about where it is.
    """
    search = _Search(arrangement, objective_at, lengths, rng, force_term, exchanges)
    if not search.has_choice:
        return 0
    done = kept = 0
    every = max(min(arrangement.count, trials // SWEEPS), 1)
    while done < trials and not stop():
        # Where items repeat, trials far from each other may meet over the edge.
        parallel = AT_ONCE if arrangement.lattice is None else 1
        most = min(parallel, every - done % every, trials - done)
        heat = HEAT * lengths.spacing**2 * (1 - done / trials)
        gained = search.make_trials(most, heat)
        kept += sum(gained)
        for _ in gained:
            if tell is not None:
                tell(done)
            done += 1
        if done % every == 0:
            search.sweep(done - 1, stop)
    return kept


class _Search:
    def __init__(
        self,
        arrangement: Arrangement,
        objective_at: Callable[[FloatArray], Objective],
        lengths: Lengths,
        rng: np.random.Generator,
        force_term: ForceTerm | None,
        exchanges: float,
    ) -> None:
        self._exchanges = exchanges
        self._arrangement, self._objective_at, self._lengths = arrangement, objective_at, lengths
        self._rng, self._force_term = rng, force_term
        self._waiting: list[Proposal] = []
        self._objective = objective_at(arrangement.places)
        self._least = -np.inf
        self._is_area = self._objective.power == AREA_POWER
        together = np.geomspace(*TRUST, ROUNDS) * lengths.spacing
        missing = PATIENCE * lengths.spacing**2 * HASTE ** np.arange(ROUNDS)
        if not self._is_area:
            missing[:] = np.inf
        self._rounds = Rounds(ANGLE_TRUST * lengths.spacing, together, missing)
        self._can_turn = bool((self._objective.backmost < self._objective.foremost).any())

    @property
    def has_choice(self) -> bool:
        """Whether there is anything to be tried."""
        return self._can_turn or (self._arrangement.count > 1 and self._exchanges > 0)

    def make_trials(self, most: int, heat: float) -> list[bool]:
        """Make some trials at once, ``most`` at most; whether each was kept.

        ``heat``: mean of what each may lose, squared canvas units, where all area is worth the
        same.
        """
        # How far an item may grow depends on how large the smallest is now.
        self._objective = self._objective_at(self._arrangement.places)
        self._least = -np.inf
        if self._objective.power < 0:
            # Where the smallest counts, what all the others gain does not make up for it.
            self._least = self._arrangement.places[:, 3].min()
        if self._force_term is not None:
            return [self._is_kept_under_forces(heat, self._force_term)]
        self._waiting += islice(self._proposed(), 2 * AT_ONCE - len(self._waiting))
        trials = self._disjoint(most)
        gains = at_once(
            self._gain, [(trial, heat * one.heat * self._is_area) for one, trial in trials]
        )
        return [gain > -np.inf for gain in gains]

    def sweep(self, turn: int, stop: Stop) -> None:
        """Rounds of compaction over all items."""
        lengths = self._lengths
        for index, trust in enumerate(np.geomspace(*TRUST, SWEEP_ROUNDS) * lengths.spacing):
            self._arrangement.wrap(FRACTIONS[index])
            compact_all(
                self._arrangement, self._objective, turn + index, trust, lengths.gap,
                lengths.hair, stop,
            )  # fmt: skip

    def _proposed(self) -> Iterator[Proposal]:
        """Trials without end, of the items as they are now."""
        arrangement, force_term = self._arrangement, self._force_term
        pools = pools_of(arrangement, self._objective.power < 0, force_term is not None)
        while True:
            yield propose(
                arrangement, pools, self._can_turn, self._rng, force_term, self._exchanges
            )

    def _disjoint(self, most: int) -> list[tuple[Proposal, Trial]]:
        """The first trials that wait whose neighbourhoods do not meet; they wait no more."""
        lengths = self._lengths
        moved = np.array([(one.moved[0], *one.moved[1:], -1)[:2] for one in self._waiting])
        places = destinations(self._arrangement, moved)
        room = ROOM * lengths.spacing
        margin = lengths.gap + TRAVEL * max(*TRUST, ANGLE_TRUST) * lengths.spacing
        board = self._arrangement.board
        chosen = allocate_batch(most, NEIGHBOURS, len(board.arms))
        count = choose_disjoint(
            board, self._arrangement.radii, moved, places, NEIGHBOURS, room,
            margin, chosen,
        )  # fmt: skip
        found = []
        for k, trial in enumerate(chosen.trials[:count]):
            (begin, near, _), (end, last, _) = chosen.begins[k : k + 2]
            one = self._waiting[trial]
            put = at_angles(places[trial, : len(one.moved)], one.moved, self._objective, one.draws)
            reach = chosen.items[begin:end], chosen.near[near:last], chosen.bounds[begin:end]
            found.append((one, Trial(one.moved, put, *reach)))
        gone = set(chosen.trials[:count].tolist())
        self._waiting = [one for k, one in enumerate(self._waiting) if k not in gone]
        return found

    def _gain(self, trial: Trial, allowed: float) -> float:
        return make_trial(
            self._arrangement, self._objective, trial, self._rounds, self._lengths, allowed,
            self._least,
        )  # fmt: skip

    def _is_kept_under_forces(self, heat: float, force_term: ForceTerm) -> bool:
        """Make one trial where forces count, which act on all items; whether it was kept."""
        arrangement = self._arrangement
        self._waiting = [next(self._proposed())]
        ((one, trial),) = self._disjoint(1)
        allowed = heat * one.heat * self._is_area
        there = arrangement.places.copy()
        before, cost = there[trial.items], force_term.cost(there)
        there[one.moved] = destination(arrangement, one.moved)
        gain = self._gain(trial, allowed - (force_term.cost(there) - cost))
        if gain - (force_term.cost(arrangement.places) - cost) > -allowed:
            return True
        if gain > -np.inf:
            arrangement.put(trial.items, before)
        return False


def make_trial(
    arrangement: Arrangement,
    objective: Objective,
    trial: Trial,
    rounds: Rounds,
    lengths: Lengths,
    allowed: float = np.inf,
    least: float = -np.inf,
) -> float:
    """Make a trial; what it gained, -inf if it was undone since it lost more than ``allowed``."""
    board = arrangement.board
    return float(
        attempt(board, objective, trial, rounds, allowed, least, lengths.gap, lengths.hair)
    )
