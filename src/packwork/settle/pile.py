"""Piles: items of given sizes placed, separated and settled, exact all the way."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from typing import final

import numpy as np
import shapely

from packwork.arrays import FloatArray, IntArray
from packwork.compaction.arrangement import Arrangement, Detail, find_conflicts
from packwork.compaction.objective import turn_ranges
from packwork.compaction.options import HAIR, MoveOptions
from packwork.forces.field import Distance
from packwork.forces.forces import Forces
from packwork.geometry.outline import Outline
from packwork.geometry.overlay import prepared
from packwork.progress import NOBODY, Observer, Step, Stop, never
from packwork.scene.container import Container
from packwork.scene.pose import Poses
from packwork.settle.bottom_left import HeightOf, bottom_left
from packwork.settle.round_pack import start_round_pack
from packwork.settle.separate_fixed import separate_fixed
from packwork.settle.settle import FIRST_TRUST, LAST_TRUST, Settling

COARSE, FINE = 0.01, 1e-3
"""Tolerances of the outlines that are settled first and last, shares of an item's extent. Larger
ones have fewer vertices and leave more bare. Tried."""

ROUGH_TRUST = 0.06
"""Bound of a move, as the settling has it, down to which outlines are coarse. Larger takes
longer, smaller leaves more way to the fine ones. Tried."""

USUAL_ROUNDS = 60
"""Rounds at which the progress told is a half. Chosen."""

ARRIVALS = 60
"""Steps at most in which items are told that have come one after another. Chosen."""

GRID = 65
"""Points along each side of the room among which bonds look for their middle. Chosen."""

TRIES = 3
"""Times that items which found no room are tried again once the others lie closer. Chosen."""


@dataclass(frozen=True, eq=False)
class Piled:
    """Result of a pile.

    ``poses``: of all items; those without room stay where they were.
    ``placed``: items that lie in the container, without a conflict.
    ``mean_height``: area-weighted mean height of the placed ones, canvas units.
    """

    poses: Poses
    placed: IntArray
    rounds: int
    mean_height: float


@dataclass(frozen=True, eq=False, kw_only=True)
class Arrival:
    """Arrival of a pile's items at their first places.

    ``known``: ``(m,)`` items that begin where their poses have them, not quite clear of each other.
    ``keeps``: whether those stay there as well as they can; they have come in their order if not.
    ``ranks``: ``(n,)`` items of a lower rank get their places first, and so lie lower; empty for
    one rank.
    ``shuffle``: logarithm of size within which items without a place come in random order and not
    the largest first. Larger leaves more gaps, 0 puts copies of one thing side by side.
    ``about``: ``(m, 2)`` points that all begin near to; None for their lowest places.
    ``rounds``: the items that are there, and ``(m, 3)`` where their origins are and how far they
    are turned from their poses, in each round of their way there; None for items that are there one
    after another.
    ``is_round``: whether the pack is to lie in a small circle, where forces draw all items to one
    point alike.
    """

    known: IntArray = field(default_factory=lambda: np.arange(0))
    keeps: bool = True
    ranks: IntArray = field(default_factory=lambda: np.arange(0))
    shuffle: float = 0.0
    about: FloatArray | None = None
    rounds: Iterable[tuple[IntArray, FloatArray]] | None = None
    is_round: bool = False

    def centre(self, forces: Forces) -> FloatArray | None:
        """``(2,)`` of the circle that a round pack lies in; None for other piles."""
        is_given = len(self.known) > 0 and self.keeps
        is_free = self.about is None and self.rounds is None and not is_given
        return forces.common_point() if self.is_round and is_free else None


LOWEST = Arrival()
"""All items at their lowest places, the largest first."""


def pile(
    container: Container,
    outlines: Sequence[Outline],
    poses: Poses,
    forces: Forces,
    options: SettleOptions,
    basin: Outline | None = None,
    arrival: Arrival = LOWEST,
    observer: Observer = NOBODY,
    stop: Stop = never,
) -> Piled:
    """Poses in which items of the given sizes are at rest and nothing meets.

    Deterministic for one seed of the options.

    ``container``: what items have to be in at the end.
    ``outlines``: one per item, item units.
    ``poses``: sizes and angles, and where those are that have a place.
    ``basin``: the container and more, such as the room above an open one, through which items may
    pass; the container itself if None.

    Examples
    --------
    >>> from packwork.forces.field import Direction
    >>> from packwork.forces.forces import FieldForce
    >>> box = Outline.from_rings([np.array([[-1.0, -1], [1, -1], [1, 1], [-1, 1]])])
    >>> wall = box.mapped(np.array([[5.0, 0, 5], [0, 5.0, 5]]))
    >>> two = Poses(np.full(2, 5.0), np.full(2, 5.0), np.zeros(2), np.ones(2))
    >>> down = Forces([FieldForce(Direction(np.pi / 2), np.ones(2))], [], np.zeros(2, int), 10.0)
    >>> done = pile(Container("", "", wall, 10, 10), [box] * 2, two, down, SettleOptions())
    >>> len(done.placed), done.poses.y.round(2).tolist()
    (2, [9.0, 9.0])
    """
    if len(outlines) == 0:
        return Piled(poses, np.arange(0), 0, 0.0)
    run = _Pile(container, outlines, poses, forces, options, arrival, observer, stop)
    room = container.outline if basin is None else basin
    if arrival.about is None:
        run.gather(room)
    else:
        run.begin_about(room, arrival.about)
    run.settle(room, run.first_trust)
    if basin is not None and run.leave_out_what_sticks_out():
        run.settle(container.outline, ROUGH_TRUST)
    for _ in range(TRIES):
        if not run.try_again(container.outline):
            break
        run.settle(container.outline, run.first_trust)
    run.round_off(container.outline)
    return run.result()


class _Pile:
    """State of a pile: poses of all items, and which of them have a place."""

    def __init__(
        self,
        container: Container,
        outlines: Sequence[Outline],
        poses: Poses,
        forces: Forces,
        options: SettleOptions,
        arrival: Arrival,
        observer: Observer,
        stop: Stop,
    ) -> None:
        self._arrival, self._centre = arrival, arrival.centre(forces)
        self._container, self._outlines, self._options = container, outlines, options
        self._forces, self._observer, self._stop = forces, observer, stop
        self._poses = poses
        self._items = np.arange(len(poses))
        self._areas = np.array([outline.area for outline in outlines]) * poses.scale**2
        self._hair = HAIR * container.side
        self._gap = options.gap_cu + self._hair
        self._rounds = self._told = 0
        self._is_given = False
        self._keeps_round = True
        self._details: dict[tuple[Outline, float], Detail] = {}
        self._height = 0.0
        one_rank = np.zeros(len(poses), dtype=np.int64)
        self._ranks = arrival.ranks if len(arrival.ranks) else one_rank
        strengths = [f.strengths for f in forces.fields] + [b.strengths for b in forces.bonds]
        columns = np.column_stack([np.zeros(len(poses)), *strengths])
        _, self._kinds = np.unique(columns, axis=0, return_inverse=True)
        self._kinds = self._kinds.ravel()

    def gather(self, room: Outline) -> None:
        """Give all items a first place without conflicts; those that are known keep theirs."""
        all_items, known = self._items, self._arrival.known
        standing = known
        self._is_given = len(known) > 0 and self._arrival.keeps
        if len(known):
            near = self._arrangement(room, COARSE, known)
            turns = turn_ranges(self._poses.angle[known], self._options)
            lost = separate_fixed(near, turns, self._gap, self._hair)
            self._take_over(near, known)
            standing = np.delete(known, lost)
            if not self._is_given:
                self._tell_arrivals(standing)
        arrangement = self._arrangement(room, COARSE, all_items)
        lifted = np.setdiff1d(all_items, standing)
        sizes = self._order_sizes(arrangement)
        lifted = lifted[np.lexsort((-sizes[lifted], self._ranks[lifted]))]
        if len(known) == 0 and self._gather_round(arrangement):
            left = np.arange(0)
        else:
            heights = self._heights(arrangement)
            left = self._bottom_left(arrangement, lifted, standing, heights)
        self._take_over(arrangement, all_items)
        self._items = np.setdiff1d(all_items, left)
        self._keeps_round = len(left) == 0

    def _tell_arrivals(self, standing: IntArray) -> None:
        """Tell of items that come to where they stand: on their ways, or there one by one."""
        if self._arrival.rounds is None:
            many = len(standing)
            for come in np.linspace(1, many, min(many, ARRIVALS), dtype=int):
                self._tell(standing[:come], self._places(standing[:come]))
            return
        for items, points in self._arrival.rounds:
            self._rounds += 1
            places = self._places(items)
            places[:, :3] = points
            self._tell(items, places)

    def round_off(self, room: Outline) -> None:
        """Settle into a small circle those that at first did not all find room."""
        if self._centre is not None and not self._keeps_round:
            self._keeps_round = True
            self.settle(room, self.first_trust)

    def _gather_round(self, arrangement: Arrangement) -> bool:
        if self._centre is None:
            return False
        rng = np.random.default_rng(self._options.seed)
        settling = self._settling(arrangement, self._items)
        return start_round_pack(settling, self._gap, (FIRST_TRUST, ROUGH_TRUST), rng, self._stop)

    @property
    def first_trust(self) -> float:
        """First bound of a move: a narrow one where items were given places."""
        return ROUGH_TRUST if self._is_given else FIRST_TRUST

    def begin_about(self, room: Outline, points: FloatArray) -> None:
        """Give all items first places as near to some points as there is room."""
        arrangement = self._arrangement(room, COARSE, self._items)
        queue = np.random.default_rng(self._options.seed).permutation(self._items)
        near = Distance.from_points(points)
        left = self._bottom_left(arrangement, queue, np.arange(0), lambda at, _: near(at)[0])
        self._take_over(arrangement, self._items)
        self._items = np.setdiff1d(self._items, left)

    def _settling(self, arrangement: Arrangement, items: IntArray) -> Settling:
        settling = Settling(
            arrangement,
            self._forces.subset(items),
            self._areas[items],
            turn_ranges(self._poses.angle[items], self._options),
            self._gap,
            self._hair,
            self._container.side,
        )
        settling.centre = self._centre if self._keeps_round else None
        return settling

    def settle(self, room: Outline, first_trust: float) -> None:
        """Let the placed ones go down to rest, on coarse outlines, then on fine ones."""
        for tolerance, trusts in (
            (COARSE, (first_trust, ROUGH_TRUST)),
            (FINE, (ROUGH_TRUST, LAST_TRUST)),
        ):
            if trusts[0] < trusts[1] or len(self._items) == 0:
                continue
            arrangement = self._arrangement(room, tolerance, self._items)
            settling = self._settling(arrangement, self._items)
            # Those that were given a place keep it as well as they can.
            settling.is_swaying = not self._is_given
            tell = partial(self._tell, self._items)
            self._rounds += settling.settle(tell, self._stop, trusts)
            self._height = settling.mean_height()
            self._take_over(arrangement, self._items)

    def leave_out_what_sticks_out(self) -> bool:
        """Take away what is not in the container; whether there was any."""
        outlines = [self._outlines[int(k)] for k in self._items]
        poses = self._poses.subset(self._items)
        found = find_conflicts(self._container, outlines, poses, self._gap)
        out = np.array([o.item for o in found if o.other is None], dtype=np.int64)
        self._items = np.delete(self._items, out)
        return len(out) > 0

    def try_again(self, room: Outline) -> bool:
        """Look for room for those that have none; whether there is some."""
        left = np.setdiff1d(np.arange(len(self._poses)), self._items)
        if len(left) == 0 or self._stop():
            return False
        arrangement = self._arrangement(room, FINE, np.arange(len(self._poses)))
        left = left[np.argsort(arrangement.radii[left], kind="stable")]
        still = self._bottom_left(arrangement, left, self._items, self._heights(arrangement))
        new = np.setdiff1d(left, still)
        self._take_over(arrangement, np.arange(len(self._poses)))
        self._items = np.union1d(self._items, new)
        return len(new) > 0

    def result(self) -> Piled:
        """Poses, and which items have a place, as they are now."""
        return Piled(self._poses, self._items, self._rounds, self._height)

    def _bottom_left(
        self, arrangement: Arrangement, items: IntArray, standing: IntArray, heights: HeightOf
    ) -> IntArray:
        def tell(placed: IntArray) -> None:
            self._tell(placed, arrangement.places[placed])

        return bottom_left(
            arrangement, items, standing, heights, self._kinds, self._gap, tell, self._stop
        )

    def _heights(self, arrangement: Arrangement) -> HeightOf:
        anchors = self._anchors(arrangement)

        def heights(points: FloatArray, item: int) -> FloatArray:
            return self._forces.heights(points, item, anchors[self._kinds[item]])

        return heights

    def _anchors(self, arrangement: Arrangement) -> dict[int, FloatArray]:
        """Lowest place of each kind of items, were there no others."""
        left, top, right, bottom = arrangement.container.bounds
        middle = np.array([(left + right) / 2, (top + bottom) / 2])
        if not self._forces.bonds:
            return dict.fromkeys(range(len(self._kinds)), middle)
        across, down = np.meshgrid(*np.linspace((left, top), (right, bottom), GRID).T)
        points = np.column_stack([across.ravel(), down.ravel()])
        points = points[shapely.contains_xy(prepared(arrangement.container.region), *points.T)]
        found = {}
        for kind, item in zip(*np.unique(self._kinds, return_index=True), strict=True):
            heights = self._forces.heights(points, int(item))
            is_flat = len(points) == 0 or np.ptp(heights) == 0
            found[int(kind)] = middle if is_flat else points[np.argmin(heights)]
        return found

    def _order_sizes(self, arrangement: Arrangement) -> FloatArray:
        rng = np.random.default_rng(self._options.seed)
        spread = rng.uniform(-self._arrival.shuffle, self._arrival.shuffle, arrangement.count)
        return np.asarray(arrangement.radii * np.exp(spread))

    def _arrangement(self, room: Outline, tolerance: float, items: IntArray) -> Arrangement:
        if (room, tolerance) not in self._details:
            detail = Detail(self._outlines, room, self._poses).covers(FINE)
            self._details[room, FINE] = detail
            if tolerance > FINE:
                self._details[room, tolerance] = detail.covers(tolerance)
        detail = self._details[room, tolerance].subset(items, self._poses)
        return detail.arrangement(self._places(items))

    def _places(self, items: IntArray) -> FloatArray:
        x, y, zero = self._poses.x[items], self._poses.y[items], np.zeros(len(items))
        return np.column_stack([x, y, zero, zero])

    def _take_over(self, arrangement: Arrangement, items: IntArray) -> None:
        self._poses = _moved(self._poses, items, arrangement.places)

    def _tell(self, items: IntArray, places: FloatArray) -> None:
        """Tell of the items that are there: those that wait lie anywhere."""
        covered = float(self._areas[items].sum() / self._container.outline.area)
        now = _moved(self._poses, items, places).subset(items)
        self._told += 1
        # The number of rounds is not known: the bar comes ever nearer to its end.
        progress = self._told / (self._told + USUAL_ROUNDS)
        shares = (covered, 0.0, 0.0)
        step = Step(0, 1, 0, self._told, progress, now, lambda: shares, True, ids=items)
        self._observer.on_step(replace(step, stage="pile"))


def _moved(poses: Poses, items: IntArray, places: FloatArray) -> Poses:
    x, y, turn, _ = places.T
    some = poses.subset(items)
    return poses.with_some(items, replace(some, x=x, y=y, angle=some.angle + turn))


@final
class SettleOptions(MoveOptions):
    """Gap, turns and seed of one pile."""
