"""From an almost clean layout to one in which nothing meets: separation, compaction, annealing."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from packwork.arrays import FloatArray
from packwork.compaction.arrangement import (
    COARSE,
    COARSE_OF_GAP,
    FINE,
    FINE_OF_GAP,
    Conflict,
    Detail,
    find_conflicts,
)
from packwork.compaction.compact import FRACTIONS, compact_all
from packwork.compaction.kernels.steps import MOST_GROWTH, Objective
from packwork.compaction.objective import LAGGARD, SharedSize, turn_ranges
from packwork.compaction.options import HAIR
from packwork.compaction.separate import relocate, relocate_stuck, separate, separate_evenly
from packwork.finish import bottlenecks
from packwork.finish.anneal import Lengths, anneal
from packwork.finish.objective import force_term_of, sizing_of
from packwork.finish.options import FinishOptions
from packwork.finish.proposals import EXCHANGES
from packwork.forces.forces import NO_FORCES, Forces
from packwork.geometry.outline import Outline
from packwork.progress import NOBODY, Observer, Step, Stop, never
from packwork.scene.container import Container
from packwork.scene.pose import Poses

FIRST_TRUST, LAST_TRUST = 0.08, 0.003
"""Trust region of the first and the last round, shares of the side of an item's share of the
container. A larger first one lets items pass each other and fails more checks, a smaller last one
gains nothing. Tried."""

SPARSE = 16.0
"""Side of an item's share of the container, in radii of the usual item, above which steps go by the
items; 1 to 3 is usual. Larger looks at edges that no item comes near, smaller lets small items move
little. Chosen."""

REFINING_TRUST = 0.03
"""The same of the first round where a clean layout is refined. Larger moves what lies well,
smaller gains less. Tried."""

COMMON_COARSE = 1.5e-3
"""The first tolerance where sizes are common, of which a coarse one takes too much. Tried."""

COARSE_SHARE = 0.6
"""Share of the rounds that work on coarse outlines. Tried."""

ANNEAL_SPREAD = 0.03
"""Logarithm of size within which trials weigh the smaller items more, where sizes are
common. Tried."""

EASY_POINTS = 70.0
"""Points of the mean outline up to which all trials are made; of richer ones fewer. Tried."""

COMMON_ROUNDS = 3
"""Times as many rounds where sizes are common and the layout is not clean yet: growth must get
round from loose to tight places. Tried."""

LEVELLING_TRUST = (0.0006, 0.01)
"""Smallest and largest trust region, as above, of the last rounds where sizes are shared,
in which all come down to the smallest. Larger than a full layout grants moves nothing. Tried."""

LEVELLING_ROOM = 1.5
"""Trust region of such a round over what the largest item has to come down. Larger moves items for
nothing, smaller leaves them too large. Chosen."""

RESCUES = 3
"""Times that items which stay behind are moved to voids. Chosen."""

BACK = (0.0, 0.0, 1e-4, 1e-3, 0.003, 0.01, 0.03, 0.1, 0.3)
"""Logarithms of size given back in turn until one common size has no conflict. Chosen."""

TOLD = 10
"""How often observers are told of trials, for each trial of an item. More take longer. Chosen."""


@dataclass(frozen=True, eq=False)
class Finished:
    """Result of a finish.

    ``clean``: whether nothing is nearer than was asked for; ``undersized``: items that found no
    room at the size that they should have at least; ``rounds``: linear programmes for each item.
    """

    poses: Poses
    clean: bool
    conflicts: tuple[Conflict, ...]
    undersized: tuple[int, ...]
    rounds: int


def finish(
    container: Container,
    outlines: Sequence[Outline],
    poses: Poses,
    options: FinishOptions,
    observer: Observer = NOBODY,
    stop: Stop = never,
    is_enough: Stop = never,
    forces: Forces = NO_FORCES,
) -> Finished:
    """Poses near those of an almost clean layout at which nothing meets, grown into the room left.

    ``outlines``: one per item, item units, origin where the poses have it; ``is_enough``: asked
    before each trial, True ends the trials, so that the last rounds have time; ``forces``: weighed
    against area as in the levels. Deterministic for one seed of the options.

    >>> box = Outline.from_rings([np.array([[-1.0, -1], [1, -1], [1, 1], [-1, 1]])])
    >>> wall = box.mapped(np.array([[2.0, 0, 5], [0, 1.0, 5]]))
    >>> two = Poses(np.array([4.2, 5.8]), np.full(2, 5.0), np.zeros(2), np.ones(2))
    >>> done = finish(Container("", "", wall, 10, 10), [box] * 2, two, FinishOptions())
    >>> done.clean, bool(done.poses.scale.min() > 0.99)
    (True, True)
    """
    if len(outlines) == 0:
        return Finished(poses, True, (), (), 0)
    run = _Finish(container, outlines, poses, options, observer, stop, is_enough, forces)
    if options.refining:
        run.refine()
        if options.covered:
            run.anneal()
        run.level()
    elif run.begin():
        run.coarse()
        run.anneal()
        run.fine()
        run.level()
    found, gap, undersized, rounds = run.result(), run.gap, run.undersized, run.rounds
    if run.is_clear_at(found):
        # Covers hold the outlines: these need not be looked at.
        return Finished(found, True, (), undersized, rounds)
    # Its polygons are done with; those among which conflicts are looked for take more than they.
    del run
    conflicts = find_conflicts(container, outlines, found, gap)
    return Finished(found, not conflicts, conflicts, undersized, rounds)


class _Finish:
    def __init__(
        self,
        container: Container,
        outlines: Sequence[Outline],
        poses: Poses,
        options: FinishOptions,
        observer: Observer,
        stop: Stop,
        is_enough: Stop,
        forces: Forces,
    ) -> None:
        self._poses, self._options, self._observer, self._stop = poses, options, observer, stop
        self._is_enough = is_enough
        self._area = container.outline.area
        self.hair = HAIR * container.side
        self.gap = options.gap_cu + self.hair
        self.rounds = 0
        self._is_trying = False
        is_short = options.sizes == "free" or options.refining
        self._planned = options.rounds * (1 if is_short else COMMON_ROUNDS)
        self._share = float(np.sqrt(self._area / len(poses)))
        own = np.array([outline.area for outline in outlines])
        self._sizing = sizing_of(poses, own * poses.scale**2, options)
        self._force_term = force_term_of(forces, self._sizing)
        self._is_shared = isinstance(self._sizing, SharedSize)
        exact = Detail(outlines, container.outline, poses, container.lattice)
        tolerance = COARSE if options.sizes == "free" else COMMON_COARSE
        tolerance = exact.tolerance(tolerance, COARSE_OF_GAP * options.gap_cu)
        is_exact = options.sizes == "fixed" or options.refining
        # To be stopped asks for no covers: nothing will grow into what they would waste.
        fine = exact.tolerance(FINE, FINE_OF_GAP * options.gap_cu)
        self._fine = exact if options.covered else exact.covers(fine, stop)
        self._coarse = self._fine if is_exact else self._fine.covers(tolerance, stop)
        is_small = options.refining and not options.loosened
        self._first_trust = REFINING_TRUST if is_small else FIRST_TRUST
        zero = np.zeros(len(poses))
        self.arrangement = self._coarse.arrangement(np.column_stack([poses.x, poses.y, zero, zero]))

    def begin(self) -> bool:
        """Take conflicts apart; False if many stay in one however small they are made."""
        loose = partial(separate, hopeless_at=self._options.hopeless)
        separated = separate_evenly if self._is_shared else loose
        separated(self.arrangement, self.gap, hurries=self._stop)
        return self._options.sizes == "fixed" or relocate_stuck(
            self.arrangement, self.gap, self._stop
        )

    def coarse(self) -> None:
        """Grow, on coarse outlines; move those that stay behind."""
        count = round(COARSE_SHARE * self._planned)
        self._compact(range(count))
        for _ in range(RESCUES):
            laggards = self._sizing.laggards(self.arrangement.places[:, 3])
            if len(laggards) == 0 or self._stop():
                break
            before = self.arrangement.places.copy()
            relocate(self.arrangement, laggards, self.gap)
            separate(self.arrangement, self.gap, hurries=self._stop)
            self._compact(range(count // 2, count))
            if self._is_shared and self.arrangement.places[:, 3].min() < before[:, 3].min():
                self.arrangement.put(np.arange(len(before)), before)
                break
        if self._is_shared and self._options.relieving:
            self._relieve(range(count // 2, count))

    def _relieve(self, rounds: range) -> None:
        """Relocate bottlenecks to voids, as long as that lets all grow."""
        left = bottlenecks.TRIES // self.arrangement.count
        while left > 0 and not self._stop():
            found = bottlenecks.bottlenecks(self.arrangement, self._spacing)[:left]
            left -= len(found)
            if not any(self._helps(int(k), rounds) for k in found):
                return

    @property
    def undersized(self) -> tuple[int, ...]:
        """Items that are smaller than they should be."""
        return self._sizing.undersized(self.arrangement.places[:, 3])

    @property
    def _spacing(self) -> float:
        """Side of an item's share of the container; less where items are far smaller than that."""
        return min(self._share, SPARSE * float(np.median(self.arrangement.radii)))

    @property
    def _lengths(self) -> Lengths:
        return Lengths(self._spacing, self.gap, self.hair)

    def _helps(self, item: int, rounds: range) -> bool:
        """Whether all can grow once an item has moved to a void; else undone."""
        arrangement, all_items = self.arrangement, np.arange(self.arrangement.count)
        before = arrangement.places.copy()
        least = before[:, 3].min()
        objective = self._objective(before, LAGGARD)
        rng = np.random.default_rng(item)
        fits = bottlenecks.relocate_bottleneck(arrangement, item, objective, self._lengths, rng)
        if fits and arrangement.places[item, 3] > least - bottlenecks.NEARLY:
            self._is_trying = True
            self._compact(rounds[: bottlenecks.PROBE])
            if arrangement.places[:, 3].min() >= least + bottlenecks.PROMISING:
                self._compact(rounds[bottlenecks.PROBE :])
            self._is_trying = False
            if arrangement.places[:, 3].min() >= least + bottlenecks.RELIEF:
                return True
        arrangement.put(all_items, before)
        return False

    def refine(self) -> None:
        """Grow from a clean layout, on fine outlines and in small steps."""
        separate(self.arrangement, self.gap, self._options.hopeless, self._stop)
        self._compact(range(self._planned))

    def anneal(self) -> None:
        """Turn and exchange items where that gains."""
        rng = np.random.default_rng(self._options.seed)
        objective_at = partial(self._objective, spread=ANNEAL_SPREAD)
        count = self.arrangement.count
        points_each = float(self.arrangement.board.starts[count]) / count
        trials = round(self._options.trials * min(1.0, EASY_POINTS / points_each))
        every = max(self.arrangement.count // TOLD, 1)

        def tell(trial: int) -> None:
            if trial % every == 0:
                self._tell(COARSE_SHARE)

        anneal(
            self.arrangement, objective_at, trials, self._lengths, rng, self._is_enough, tell,
            self._force_term, EXCHANGES if self._options.exchanging else 0.0,
        )  # fmt: skip

    def fine(self) -> None:
        """Grow into what the coarse outlines left."""
        self.arrangement = self._fine.arrangement(self.arrangement.places)
        separate(self.arrangement, self.gap, hurries=self._stop)
        self._compact(range(round(COARSE_SHARE * self._planned), self._planned))

    def _compact(self, rounds: range) -> None:
        for index in rounds:
            if self._stop() or self._sizing.is_done(self.arrangement.places[:, 3]):
                return
            done = index / max(self._planned - 1, 1)
            trust = self._spacing * self._first_trust * (LAST_TRUST / self._first_trust) ** done
            self._round(trust)
            self.rounds += 1
            self._tell(done)

    def _round(self, trust: float) -> None:
        arrangement = self.arrangement
        spread = min(trust / float(np.median(arrangement.radii)), MOST_GROWTH)
        self._blocks(self._objective(arrangement.places, spread), trust)

    def _objective(self, places: FloatArray, spread: float) -> Objective:
        objective = self._sizing.objective(places[:, 3], spread)
        if self._force_term is None:
            return objective
        return self._force_term.with_push(objective, self.arrangement)

    def _blocks(self, objective: Objective, trust: float) -> None:
        self.arrangement.wrap(FRACTIONS[self.rounds % len(FRACTIONS)])
        compact_all(self.arrangement, objective, self.rounds, trust, self.gap, self.hair)

    def result(self) -> Poses:
        """Poses as they are now, at one common factor where that was asked for."""
        growth = self.arrangement.places[:, 3]
        if self._options.sizes == "fixed":
            growth = np.zeros(len(self._poses))
        elif self._options.sizes == "shared":
            growth = np.full(len(self._poses), growth.min())
        x, y, turn, _ = self.arrangement.places.T
        # An interior point is a little off its bounds; the hair of the gap is far wider.
        turn = np.clip(turn, *turn_ranges(self._poses.angle, self._options))
        angle, scale = self._poses.angle + turn, self._poses.scale * np.exp(growth)
        return replace(self._poses, x=x.copy(), y=y.copy(), angle=angle, scale=scale)

    def is_clear_at(self, poses: Poses) -> bool:
        """Whether the outlines that were worked on keep the gap in such poses, a last result."""
        turn, growth = poses.angle - self._poses.angle, np.log(poses.scale / self._poses.scale)
        arrangement = self.arrangement
        arrangement.put(np.arange(len(poses)), np.column_stack([poses.x, poses.y, turn, growth]))
        return len(arrangement.conflicts(arrangement.pairs(self.gap), self.gap)) == 0

    def level(self) -> None:
        """Bring shared sizes to one common factor without a conflict."""
        if not isinstance(self._sizing, SharedSize):
            return
        for back in BACK:
            self._come_down(self._sizing, back)
            if self._put_at_one_size():
                return

    def _come_down(self, sizing: SharedSize, back: float) -> None:
        for _ in range(COMMON_ROUNDS * self._options.rounds):
            spread = np.ptp(self.arrangement.places[:, 3])
            self._level_round(sizing, back)
            self._tell(1.0)
            if np.ptp(self.arrangement.places[:, 3]) >= spread:
                break

    def _level_round(self, sizing: SharedSize, back: float) -> None:
        growth = self.arrangement.places[:, 3]
        objective = sizing.levelling(growth, back)
        # As small a trust region as lets the largest item come down at once.
        farthest = float((np.abs(growth - objective.largest) * self.arrangement.radii).max())
        trust = np.clip(LEVELLING_ROOM * farthest / self._spacing, *LEVELLING_TRUST)
        self._blocks(objective, float(trust) * self._spacing)

    def _put_at_one_size(self) -> bool:
        """Make all as small as the smallest; False, and undone, if that makes a conflict."""
        arrangement, all_items = self.arrangement, np.arange(self.arrangement.count)
        before = arrangement.places.copy()
        level = before.copy()
        level[:, 3] = before[:, 3].min()
        arrangement.put(all_items, level)
        if len(arrangement.conflicts(arrangement.pairs(self.gap), self.gap)) == 0:
            return True
        arrangement.put(all_items, before)
        return False

    def _tell(self, done: float) -> None:
        # What is only tried may be undone, and is not told.
        if self._is_trying:
            return
        growth = self.arrangement.places[:, 3]
        covered = float((self._sizing.areas * np.exp(2 * growth)).sum() / self._area)
        x, y, turn, _ = self.arrangement.places.T
        poses = replace(
            self._poses, x=x.copy(), y=y.copy(), angle=self._poses.angle + turn,
            scale=self._poses.scale * np.exp(growth),
        )  # fmt: skip
        shares = (covered, 0.0, 0.0)
        self._observer.on_step(Step(0, 1, 0, self.rounds, done, poses, lambda: shares))
