"""Sizes that give way in the order of weights: each item as large as it finds a place.

Greedy placement as in tag clouds (Viegas, Wattenberg and Feinberg 2009, "Participatory
visualization with Wordle", IEEE TVCG 15, 1137-1144, doi:10.1109/TVCG.2009.171), whose words keep
their sizes; that sizes shrink until there is a place is the way of the ``wordcloud`` package.
Ours looks at all places at once, on rows of bits, and takes the best: large items where the
container is wide, all others where they touch most of what is there already.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Hashable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import accumulate, islice

import numpy as np

from packwork.arrays import IntArray
from packwork.geometry.outline import Outline
from packwork.progress import Stop, never
from packwork.scene.container import Container
from packwork.scene.pose import Poses
from packwork.start.first_fit.greedy_board import BoardPlace, Candidate, GreedyBoard, PoseRow

STEP = 1.01
"""Factor between sizes tried, which are sought by halves. Larger leaves room: with 1.04 a word of
77 pixels became one of 72. Tried."""

LEAST_SHARE = 1e-3
"""Size, as a share of the first one's, below which an item is left out unless asked. Chosen."""

TOUCHING = 0.5
"""Share of the items, the first, that are put where they touch most; all others go where there is
most room. Larger leaves limbs of the container bare, smaller fills less. Tried."""

LEADING, JAMMED = 10, 0.6
"""Items that are put a second time, the first of them smaller, where one of them was left so small
a share of the size that it might have had: what follows is never larger again. Chosen."""

LARGEST = (1.4, 1.3, 1.2, 1.1, 1.0)
"""Sizes of the first item, over a balanced one, that are tried in turn where it is bounded by
nothing, until the next ones all find a place. Larger leave no room for the second. Tried."""

FOR_ALL = 3.0
"""How many times the size at which all items that are left would find a place the first of those
that are held down may have, falling to 1 with the last. Larger leaves out more of the last where
there is little room, smaller leaves room bare where there is much and makes sizes alike. Tried."""

AMPLE = 1.5
"""Such size, as a multiple of the least, from which on items are held down. Smaller places hundreds
of specks in place of words that fill. Tried."""

AHEAD, NEARLY = 24, 0.8
"""Items of one rank that are looked at for one that stands beside no other of its kind, and its
size over that of the first, at least. More take longer, smaller ones make all later ones small."""

SMALLER, PLAINLY = (0.85, 0.7), 0.25
"""Sizes of the first item that are tried then in turn, over the largest that it found a place at,
and by how much the mean logarithm of sizes has to grow: less makes a shape emptier that few long
words fill well. Larger sizes leave some clouds half empty, smaller ones no word that stands out. By
eye."""


@dataclass(frozen=True, eq=False)
class Graded:
    """Items that found a place: ``placed`` ``(m,)`` which of the candidates they are, in order."""

    placed: IntArray
    poses: Poses

    @classmethod
    def of(cls, placed: Sequence[int], rows: Sequence[PoseRow]) -> Graded:
        """The same of a row for each pose."""
        x, y, angle, scale = np.array(rows).reshape(-1, 4).T
        return cls(np.array(placed, dtype=np.int64), Poses(x, y, angle, scale))


def graded_fit(
    container: Container,
    candidates: Iterable[Candidate],
    count: int,
    rng: np.random.Generator,
    *,
    smallest: float = 0.0,
    grid: float = 0.0,
    drop: float = 0.0,
    margin_cu: float = 0.0,
    patience: int | None = None,
    lengths: Sequence[float] = (),
    is_first_bounded: bool = True,
    regained: float = 0.0,
    side_px: int | None = None,
    stop: Stop = never,
) -> Graded:
    """Poses at which nothing overlaps, each item at most so much larger than the one before.

    ``candidates``: the heaviest first; taken one by one, as long as there is room.
    ``count``: about how many there are: the more, the finer the image.
    ``smallest``: scale below which an item is left out; 0 for ``LEAST_SHARE`` of the first one's.
    ``grid``: scales are whole multiples of it; 0 for any.
    ``drop``: by how much, at least, scales that are tried differ.
    ``margin_cu``: room that every item keeps from others and from the edge, canvas units.
    ``patience``: how many items in a row may find no place before the rest is left out; None for
    any.
    ``lengths``: of all candidates, in any unit, such as their letters: where all can be as large as
    the smallest, those after the first ones are held down so that the last find a place too.
    ``is_first_bounded``: whether the first one's scale is what it is to have; else it is the
    largest of some with which the next ones find places.
    ``regained``: how much of what an item lacks at its size those after it have again, where they
    find places: 0, no more than it; 1, all that their own steps leave them, but never more than the
    one before. A share of the logarithm.
    ``side_px``: pixels of the image's longer side; by the number of candidates where it is not
    given.

    Examples
    --------
    >>> tile = Outline.from_rings([np.array([[-1.0, -1], [1, -1], [1, 1], [-1, 1]])])
    >>> wall = tile.mapped(np.array([[50.0, 0, 50], [0, 50.0, 50]]))
    >>> container = Container("", "", wall, 100.0, 100.0)
    >>> tiles = [Candidate(tile, step) for step in (24.0, 1.0, 1.0, 1.0, 1.0)]
    >>> found = graded_fit(container, tiles, 5, np.random.default_rng(0), grid=1.0)
    >>> found.placed.tolist(), found.poses.scale.tolist()
    ([0, 1, 2, 3, 4], [24.0, 12.0, 12.0, 12.0, 12.0])
    """
    board = GreedyBoard(container, count, rng, margin_cu, side_px)
    reserve = Reserve(lengths, 2 * margin_cu)
    empty = GreedyPlacement(board, count, smallest, grid, drop, reserve, regained)
    source = iter(candidates)
    leading = list(islice(source, LEADING))
    if leading and not is_first_bounded:
        leading[0] = replace(leading[0], step=_balanced(empty, leading[:2], smallest))
    descent = _opened(empty, leading, is_first_bounded, patience, stop)
    descent.put_all(source, patience, stop)
    return Graded.of(descent.placed, descent.rows)


class GreedyPlacement:
    """Items that found a place so far, and the size that the next may have."""

    def __init__(
        self,
        board: GreedyBoard,
        count: int,
        smallest: float,
        grid: float,
        drop: float,
        reserve: Reserve,
        regained: float,
    ) -> None:
        self._board, self._count, self._reserve = board, count, reserve
        self._smallest, self.grid, self._drop = smallest, grid, drop
        self._regained = regained
        self.placed, self.rows = list[int](), list[PoseRow]()
        self._number = self._missed = 0
        self._most = 0.0
        self._is_held = True
        # Sizes from which on a kind has no place but beside a copy: others only take room.
        self._met = dict[Hashable, float]()
        self.least_share = 1.0
        """Smallest size over the one that an item might have had."""

    def emptied(self) -> GreedyPlacement:
        """The same before anything was put."""
        return GreedyPlacement(
            self._board.emptied(), self._count, self._smallest, self.grid, self._drop,
            self._reserve.emptied(), self._regained,
        )  # fmt: skip

    def put_all(self, candidates: Iterable[Candidate], patience: int | None, stop: Stop) -> None:
        """Put one after another, until too many in a row find no place.

        Of copies in a row, one comes before its turn where the next would stand beside another of
        its kind.
        """
        coming = enumerate(candidates, self._number)
        waiting = deque(islice(coming, 1))
        while waiting:
            if (self.rows and stop()) or (patience is not None and self._missed > patience):
                return
            self._put(waiting, coming)
            self._number += 1
            if not waiting:
                waiting.extend(islice(coming, 1))

    def _put(
        self,
        waiting: deque[tuple[int, Candidate]],
        coming: Iterator[tuple[int, Candidate]],
    ) -> None:
        # Steps go on through items that find no place.
        first = waiting[0][1]
        asked = _on_grid(self._most * first.step, self.grid)
        self._most = min(self._most, asked) if self._number else first.step
        least = self._smallest or LEAST_SHARE * (self.rows[0][3] if self.rows else self._most)
        self._board.is_loose = self._number >= TOUCHING * self._count
        held = self._held(least)
        most = min(self._most, self.rows[-1][3]) if self.rows else self._most
        downwards = sizes_down(most, max(least, self.grid), self.grid, self._drop)
        sizes = [size for size in downwards if size <= held]
        turn, place = self._next(waiting, coming, sizes)
        # Its step is taken, though another may come before it.
        waiting[0] = waiting[0][0], replace(first, step=1.0)
        number, candidate = waiting[turn]
        del waiting[turn]
        if self._number < LEADING:
            self._reserve.add(candidate.outline)
        if place is None:
            self._missed += 1
            return
        self._missed = 0
        self._board.put(place)
        size = place.pose[3]
        if self.rows:
            self.least_share = min(self.least_share, size / sizes[0])
        if size < sizes[0]:
            self._most = self._again(size, sizes[0])
        self.placed.append(number)
        self.rows.append(place.pose)

    def _next(
        self,
        waiting: deque[tuple[int, Candidate]],
        coming: Iterator[tuple[int, Candidate]],
        sizes: Sequence[float],
    ) -> tuple[int, BoardPlace | None]:
        """Next of those that wait, and its place; of some that wait for this, more come.

        The first, unless it would stand beside another of its kind and one of equal rank would not.
        """
        first = self._board.find(waiting[0][1], sizes)
        if first is None or not first.is_beside:
            return 0, first
        self._met[waiting[0][1].kind] = first.pose[3]
        near = [size for size in sizes if size >= NEARLY * first.pose[3]]
        for turn in range(1, AHEAD):
            if turn == len(waiting):
                waiting.extend(islice(coming, 1))
            if turn == len(waiting) or waiting[turn][1].step != 1.0:
                break
            candidate = waiting[turn][1]
            if self._met.get(candidate.kind, math.inf) <= sizes[0]:
                continue
            place = self._board.find(candidate, near)
            if place is not None and not place.is_beside:
                return turn, place
            self._met[candidate.kind] = place.pose[3] if place else near[-1]
        return 0, first

    def _again(self, size: float, wanted: float) -> float:
        """Scale that items after one may have again that lacks some of what was wanted."""
        more: float = size * ((wanted / size) ** self._regained - 1)
        return size + (round(more / self._drop) * self._drop if self._drop else more)

    def _held(self, least: float) -> float:
        """Scale that the next item may have at most so that all after it find a place."""
        lowest = self.rows[-1][3] if self.rows else math.inf
        if self._number < LEADING or not self._is_held:
            return lowest
        for_all = self._reserve.common_size(self._number, self._board.left)
        if self._number == LEADING:
            self._is_held = AMPLE * least <= for_all < math.inf
            if not self._is_held:
                return lowest
        times = 1 + (FOR_ALL - 1) * (1 - self._number / self._count)
        return min(lowest, max(times * for_all, least))

    def is_beyond(self, other: GreedyPlacement) -> bool:
        """Whether no fewer items are placed, and plainly larger ones."""
        mine, its = (dict(zip(one.placed, one.rows, strict=True)) for one in (self, other))
        gains = [math.log(mine[k][3] / its[k][3]) for k in mine.keys() & its.keys()]
        return len(mine) >= len(its) and math.fsum(gains) > PLAINLY * len(gains)


def _opened(
    empty: GreedyPlacement,
    leading: Sequence[Candidate],
    is_first_bounded: bool,
    patience: int | None,
    stop: Stop,
) -> GreedyPlacement:
    """The first items in place; with the first one smaller if they jam, where that is better.

    One that finds a place only where it is small holds all later ones down.
    """
    if leading and not is_first_bounded:
        return _largest_opened(empty, leading, patience, stop)
    best = empty
    best.put_all(leading, patience, stop)
    if best.least_share >= JAMMED or not best.rows or best.placed[0] != 0:
        return best
    for share in SMALLER:
        first = replace(leading[0], step=_on_grid(share * best.rows[0][3], empty.grid))
        other = empty.emptied()
        other.put_all([first, *leading[1:]], patience, stop)
        if other.is_beyond(best):
            return other
    return best


def _balanced(empty: GreedyPlacement, two: Sequence[Candidate], least: float) -> float:
    """Scale of the first item: the harmonic mean of those of the first two alone."""
    alone = empty.emptied()
    alone.put_all(two, None, never)
    sizes = [row[3] for row in alone.rows]
    if not sizes:
        return two[0].step
    mean = len(sizes) / math.fsum(1 / size for size in sizes)
    return max(math.floor(mean / empty.grid + 1e-9) * empty.grid if empty.grid else mean, least)


def _largest_opened(
    empty: GreedyPlacement, leading: Sequence[Candidate], patience: int | None, stop: Stop
) -> GreedyPlacement:
    """The first items in place, the first one as large as most of them find one."""
    best: GreedyPlacement | None = None
    for times in LARGEST:
        first = replace(leading[0], step=_on_grid(times * leading[0].step, empty.grid))
        other = empty.emptied()
        other.put_all([first, *leading[1:]], patience, stop)
        if best is None or len(other.placed) > len(best.placed):
            best = other
        if len(best.placed) == len(leading):
            break
    assert best is not None  # noqa: S101 - the first try
    return best


def sizes_down(most: float, least: float, grid: float = 0.0, drop: float = 0.0) -> list[float]:
    """Sizes tried from the largest to the least, on a grid if there is one; none below the least.

    Examples
    --------
    >>> sizes_down(9.0, 6.0, 1.0), [round(size, 3) for size in sizes_down(1.0, 0.98)]
    ([9.0, 8.0, 7.0, 6.0], [1.0, 0.99, 0.98, 0.98])
    """
    found = []
    while most >= least:
        found.append(most)
        lower = min(most / STEP, most - drop)
        most = min(math.floor(lower / grid + 1e-9) * grid, most - grid) if grid else lower
    if found and found[-1] > least * (1 + 1e-9):
        found.append(least)
    return found


def _on_grid(size: float, grid: float) -> float:
    """Nearest multiple of the grid; the size itself without one."""
    return round(size / grid) * grid if grid else size


DENSE = 0.9
"""Share of the free room that boxes of small items are taken to fill. Larger leaves more of the
last items out, smaller makes all smaller than they need to be. Tried."""


class Reserve:
    """Room that items which are still to come need, by the lengths of all; none asks for none.

    ``apart_cu``: room between two of them, canvas units.

    Examples
    --------
    >>> reserve = Reserve([3.0] * 5, 0.0)
    >>> reserve.add(Outline.box(0.0, 0.0, 6.0, 2.0))
    >>> reserve.common_size(1, 4 * 12.0 / DENSE)
    1.0
    """

    def __init__(self, lengths: Sequence[float], apart_cu: float) -> None:
        self._lengths, self._apart = [float(length) for length in lengths], apart_cu
        # Of all from one on.
        self._to_come = [*accumulate(self._lengths[::-1])][::-1]
        self._boxes = list[tuple[float, float]]()

    def emptied(self) -> Reserve:
        """The same before any item was seen."""
        return Reserve(self._lengths, self._apart)

    def add(self, outline: Outline) -> None:
        """See the next item."""
        left, top, right, bottom = outline.bounds
        self._boxes.append((right - left, bottom - top))

    def common_size(self, number: int, room: float) -> float:
        """Scale at which all items from one on have room, side by side; infinite if unknown."""
        count = len(self._lengths) - number
        if count <= 0:
            return math.inf
        known = sum(self._lengths[: len(self._boxes)])
        wide = sum(width for width, _ in self._boxes) / max(known, 1.0) * self._to_come[number]
        high = sum(height for _, height in self._boxes) / len(self._boxes)
        # (w s + a) (h s + a), summed, is the room.
        square, sides = wide * high, wide + high * count
        linear, rest = self._apart * sides, count * self._apart**2 - DENSE * room
        if rest >= 0:
            return 0.0
        return (math.sqrt(linear**2 - 4 * square * rest) - linear) / (2 * square)
