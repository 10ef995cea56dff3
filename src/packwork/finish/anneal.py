"""Simulated annealing of a compacted layout: items turned or exchanged, kept where that gains.

S. Kirkpatrick, C. Gelatt and M. Vecchi, "Optimization by simulated annealing", Science 220
(1983), 671-680, doi:10.1126/science.220.4598.671. A trial may lose an amount drawn from an
exponential distribution of mean ``heat``, which accepts a loss L with probability
exp(-L / heat), the rule of Metropolis; the temperature falls linearly to nothing.

Ours differs: the moved items and their neighbours are compacted before a trial is judged, a trial
ends early where it has fallen far behind, and where sizes are common only gains are kept.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from packwork.arrays import FloatArray, IntArray
from packwork.compaction.arrangement import Arrangement
from packwork.compaction.blocks import blocks
from packwork.compaction.compact import compact, worth
from packwork.compaction.kernels import distances, steps
from packwork.compaction.kernels.steps import Objective
from packwork.compaction.objective import AREA_POWER
from packwork.finish.pulling import Pulling
from packwork.progress import Stop, never

NEIGHBOURS = 6
"""Items that may give way in a trial, beside those that are moved. More gain more in a
trial and cost more. Tried."""

ROUNDS = 5
"""Linear programmes of one trial. As above. Tried."""

TRUST = (0.05, 0.01)
"""Trust region of the first and the last of them, shares of the side of an item's share
of the container. Tried."""

ANGLES = 5
"""Angles of which the best is tried, by how far the moved items grow alone. More find
better ones and cost more. Tried."""

ANGLE_TRUST = (0.08,)
"""Trust regions of the rounds in which they grow alone, as above. Tried."""

EXCHANGES = 0.5
"""Share of trials that exchange two items instead of turning one. Tried."""

ALIKE = 24
"""How many items nearest in size are considered for an exchange. Tried."""

WITH_FORCES = 0.5
"""Share of exchanges with the item that forces like best there, where there are forces. Tried."""

BEHIND, BEHIND_SHARE = 0.125, 0.7
"""Where the smallest is worth most: which share of the items are the smallest, and share
of the turns that are theirs. Larger shares leave no turn to their neighbours. Tried."""

LOSS = 0.1
"""Logarithm of size that moved items begin with less. Tried."""

PATIENCE, HASTE = 0.8, 0.55
"""Area that may be missing when a trial's first round begins, shares of an item's share of
the container, and how that falls with each round. Larger ones save a few trials that
begin badly and spend rounds on the many that end so. Of 984 trials, 95 % of those that
gained stayed within. Measured."""

HEAT = 0.03
"""Mean area that a trial may lose and be kept all the same, shares of an item's share of
the container, at the begin; it falls to nothing. Larger wanders, smaller stays in the
first optimum. Tried."""

SWEEPS, SWEEP_ROUNDS = 3, 4
"""Linear programmes over all items after as many trials as there are items, or so many times
in all if that is oftener: what trials free here lets others grow there. Tried."""

ROUNDING = 1e-9
"""Logarithm of size by which steps may end off their bounds. Derived."""

CUT, CHECKS = 0.06, 25
"""Further such loss at a time while they are in conflict, and how often. Chosen."""


@dataclass(frozen=True)
class Lengths:
    """Lengths of a finish, canvas units.

    Parameters
    ----------
    spacing
        Side of an item's share of the container.
    gap
        Least distance.
    hair
        The part of it that was not asked for.
    """

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
    pulling: Pulling | None = None,
) -> int:
    """Anneal a compacted layout by turns and exchanges of items; how many trials were kept.

    The arrangement has no conflicts and gets none. Where all area is worth the same, a
    trial may lose a little and be kept: ever less, at last nothing.

    Parameters
    ----------
    arrangement
        Changed in place.
    objective_at
        Objective and bounds at places ``(n, 4)``; asked again after each trial.
    trials
        How many.
    lengths
        Lengths.
    rng
        The only source of randomness.
    stop
        Asked before each trial; True ends the search.
    tell
        Called with the number of each trial, once it has been kept or undone.
    pulling
        Forces that count beside sizes; None for none.
    """
    objective = objective_at(arrangement.places)
    can_turn = bool((objective.backmost < objective.foremost).any())
    if arrangement.count < 2 and not can_turn:
        return 0
    kept = 0
    every = max(min(arrangement.count, trials // SWEEPS), 1)
    for trial in range(trials):
        if stop():
            break
        moved, places = _proposed(arrangement, objective, can_turn, rng, pulling)
        heat = HEAT * lengths.spacing**2 * (1 - trial / trials)
        kept += _kept(arrangement, objective, moved, places, lengths, heat, rng, pulling)
        if tell is not None:
            tell(trial)
        if (trial + 1) % every == 0:
            _sweep(arrangement, objective, lengths, trial)
        # How far an item may grow depends on how large the smallest is now.
        objective = objective_at(arrangement.places)
    return kept


def _proposed(
    arrangement: Arrangement,
    objective: Objective,
    can_turn: bool,
    rng: np.random.Generator,
    pulling: Pulling | None,
) -> tuple[IntArray, FloatArray]:
    """Items ``(m,)`` that a trial moves, and their places ``(m, 4)``: an exchange or a turn."""
    if arrangement.count > 1 and (not can_turn or rng.random() < EXCHANGES):
        return _exchanged(arrangement, rng, pulling)
    return _turned(arrangement, objective.power < 0, rng)


def _kept(
    arrangement: Arrangement,
    objective: Objective,
    moved: IntArray,
    places: FloatArray,
    lengths: Lengths,
    heat: float,
    rng: np.random.Generator,
    pulling: Pulling | None,
) -> bool:
    """Make one trial and let what lies about it grow; False, and undone, if that does not gain.

    Parameters
    ----------
    moved, places
        ``(m,)`` items and ``(m, 4)`` where they are put.
    heat
        Mean of what may be lost, squared canvas units, where all area is worth the same.
    """
    items = _about(arrangement, moved)
    before = arrangement.places[items]
    target = _value(arrangement, objective, items, pulling)
    if objective.power == AREA_POWER:
        target -= heat * rng.exponential()
    candidates = at_angles(places, moved, objective, rng)
    least, short = arrangement.places[:, 3].min(), _shortfall(arrangement, objective, items)
    gains = put_best(arrangement, objective, moved, candidates, lengths) and _grow(
        arrangement, objective, items, lengths, target, pulling
    )
    # Where the smallest counts, what all the others gain does not make up for it; nor
    # for an item below the size that it should have at least.
    gains &= objective.power > 0 or arrangement.places[items, 3].min() >= least
    if gains and _shortfall(arrangement, objective, items) <= short:
        return True
    arrangement.put(items, before)
    return False


def _value(
    arrangement: Arrangement, objective: Objective, items: IntArray, pulling: Pulling | None
) -> float:
    """Worth of some items together, less the cost of forces on all."""
    cost = 0.0 if pulling is None else pulling.cost(arrangement.places)
    return worth(arrangement, objective, items) - cost


def _shortfall(arrangement: Arrangement, objective: Objective, items: IntArray) -> float:
    """Sum of how far some items are below their smallest sizes, logarithms."""
    growth = arrangement.places[items, 3]
    return float(np.maximum(objective.smallest[items] - growth - ROUNDING, 0.0).sum())


def _sweep(arrangement: Arrangement, objective: Objective, lengths: Lengths, turn: int) -> None:
    """Rounds of compaction over all items."""
    for index, trust in enumerate(np.geomspace(*TRUST, SWEEP_ROUNDS) * lengths.spacing):
        for block in blocks(arrangement.places[:, :2], turn + index):
            compact(arrangement, objective, block, trust, lengths.gap, lengths.hair)


def put_best(
    arrangement: Arrangement,
    objective: Objective,
    moved: IntArray,
    candidates: FloatArray,
    lengths: Lengths,
) -> bool:
    """Put items ``(m,)`` to the best of candidate places ``(k, m, 4)``; False if none fits.

    The best is the one where they grow to the largest worth in a few rounds, all others
    standing still.
    """
    best, places = -np.inf, candidates[0]
    for candidate in candidates:
        arrangement.put(moved, candidate)
        pairs = distances.pairs_of(arrangement.board.boxes, moved, lengths.gap)
        if not steps.clear_by_shrinking(arrangement.board, moved, pairs, lengths.gap, CUT, CHECKS):
            continue
        for trust in ANGLE_TRUST:
            compact(
                arrangement, objective, moved, trust * lengths.spacing, lengths.gap, lengths.hair
            )
        found = worth(arrangement, objective, moved)
        if found > best:
            best, places = found, arrangement.places[moved]
    arrangement.put(moved, places)
    return best > -np.inf


def _grow(
    arrangement: Arrangement,
    objective: Objective,
    items: IntArray,
    lengths: Lengths,
    target: float,
    pulling: Pulling | None,
) -> bool:
    """Let ``items`` grow, while that may lead to a value above ``target``."""
    for index, trust in enumerate(np.geomspace(*TRUST, ROUNDS)):
        missing = target - _value(arrangement, objective, items, pulling)
        patience = PATIENCE * lengths.spacing**2 * HASTE**index
        if objective.power == AREA_POWER and missing > patience:
            return False
        compact(arrangement, objective, items, trust * lengths.spacing, lengths.gap, lengths.hair)
    return _value(arrangement, objective, items, pulling) > target


def _turned(
    arrangement: Arrangement, smallest_first: bool, rng: np.random.Generator
) -> tuple[IntArray, FloatArray]:
    """Trial that turns one item; mostly one of the smallest, if those come first."""
    pool = np.arange(arrangement.count)
    if smallest_first and rng.random() < BEHIND_SHARE:
        order = np.argsort(arrangement.places[:, 3], kind="stable")
        pool = order[: max(round(BEHIND * arrangement.count), 1)]
    k = rng.choice(pool, size=1)
    return k, arrangement.places[k] - np.array([0.0, 0.0, 0.0, LOSS])


def _exchanged(
    arrangement: Arrangement, rng: np.random.Generator, pulling: Pulling | None
) -> tuple[IntArray, FloatArray]:
    """Trial that exchanges two items of like size, each as large as the other was."""
    radii = arrangement.radii
    i = int(rng.integers(arrangement.count))
    alike = least_of(np.abs(np.log(radii / radii[i])), ALIKE + 1)
    alike = alike[alike != i]
    j = int(rng.choice(alike))
    if pulling is not None and rng.random() < WITH_FORCES:
        j = int(alike[np.argmax(pulling.gains(arrangement.places, i, alike))])
    pair = np.array([i, j])
    places = arrangement.places[pair[::-1]]
    places[:, 2] = arrangement.places[pair, 2]
    places[:, 3] = np.log(radii[pair[::-1]] / arrangement.board.arms[pair]) - LOSS
    return pair, places


def least_of(values: FloatArray, count: int) -> IntArray:
    """Indices of the smallest of values ``(n,)``, in order; of equal ones the first.

    Examples
    --------
    >>> least_of(np.array([3.0, 1.0, 2.0, 1.0]), 3).tolist()
    [1, 3, 2]
    """
    if count < len(values):
        among = np.flatnonzero(values <= np.partition(values, count - 1)[count - 1])
    else:
        among = np.arange(len(values))
    return among[np.argsort(values[among], kind="stable")][:count]


def at_angles(
    places: FloatArray, moved: IntArray, objective: Objective, rng: np.random.Generator
) -> FloatArray:
    """``(angles, items, 4)``: the places, turned evenly apart with random beginnings.

    Items with a turn limit take angles within it; if none may turn, there is one place.
    """
    back, on = objective.backmost[moved], objective.foremost[moved]
    if (back >= on).all():
        return places[None]
    shares = (np.arange(ANGLES)[:, None] + rng.random((ANGLES, len(places)))) / ANGLES
    candidates = np.repeat(places[None], ANGLES, axis=0)
    is_free = np.isinf(back)
    candidates[:, is_free, 2] += 2 * np.pi * shares[:, is_free]
    bound = ~is_free
    candidates[:, bound, 2] = back[bound] + (on - back)[bound] * shares[:, bound]
    return candidates


def _about(arrangement: Arrangement, moved: IntArray) -> IntArray:
    """The moved items and their neighbours, in the order of their x."""
    centres, radii = arrangement.places[:, :2], arrangement.radii
    away = np.full(arrangement.count, np.inf)
    for k in moved:
        away = np.minimum(away, np.hypot(*(centres - centres[k]).T) - radii)
    wanted = min(len(moved) * (NEIGHBOURS + 1), arrangement.count)
    items = np.union1d(np.argpartition(away, wanted - 1)[:wanted], moved)
    return items[np.argsort(centres[items, 0], kind="stable")]
