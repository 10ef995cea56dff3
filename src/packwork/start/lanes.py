"""Words along limbs, in lanes: a greedy setting of lines whose number goes by the words' sizes.

A limb is one lane at first. Where the next word is to be smaller than that, the lane that ends
first is split; where lanes have become too thin, they are joined again. So words follow each other
in the order of their weights, and there is no gap but that between words.
"""

from __future__ import annotations

import heapq
import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from itertools import pairwise

import numpy as np

from packwork.arrays import FloatArray
from packwork.geometry.curves import Curve
from packwork.start.lane_sizes import LARGER
from packwork.start.limbs import Limb

FILLED = 0.85
"""Height of letters over that of their lane. Larger leaves no room between lines, smaller wastes
it. By eye."""

SPACE = 0.35
"""Room between two words of a lane, ems. Smaller lets them read as one. By eye."""

MOST_TURN = 1.9
"""Turn of the line from the first to the last letter of a word, radians, at most. More cannot be
read at a glance. By eye."""

SHARPEST = 0.5
"""Turn within a stretch as long as the lane is wide, radians, at most: there letters meet at their
feet. Derived from letters as wide as high."""

MOST_LANES = 3
"""Lanes that one is split into at once. Chosen."""

WAITING = 0.6
"""Width of a lane over what the next word wants, from which it waits to be joined with its
neighbours. Larger joins lanes that words could still use. Tried."""

TRIED = 12
"""Words that are looked through for one that fits the end of a lane. More leave less of it bare
and keep the order less. Chosen."""


SHORTEST = 0.5
"""Length of the rest of a lane, in its widths, that is given up. Chosen."""

STEP = 0.25
"""How far a lane goes on, in its widths, where no word fits, as at a sharp bend. Chosen."""

NEARLY = 0.999
"""Width of a stretch over that at which a word was set, from which it is. Chosen."""

LEVEL = 0.1
"""Cosine of the angle of words that count as upright. Chosen."""


@dataclass(frozen=True)
class WordShape:
    """A word's extent, in ems.

    Parameters
    ----------
    length
        Along the line.
    height
        Of its ink, that of a capital at least.
    """

    length: float
    height: float

    def length_round(self, round_about: float, size: float) -> float:
        """Length on a closed curve, on whose inner side letters are as far apart as set.

        ``round_about`` is the curve's length; its curvature is taken as that of a circle.
        """
        bend = math.pi * self.height * size / round_about
        return self.length * size / max(1 - bend, 0.5)


@dataclass(frozen=True, eq=False)
class WordOnLine:
    """A word on its line.

    Parameters
    ----------
    word
        Which one.
    line
        Curve through the middle of its letters, in the direction in which it is read.
    start, end
        Arc lengths at which its letters begin and end.
    size
        Of an em.
    """

    word: int
    line: Curve
    start: float
    end: float
    size: float

    def at_most(self, size: float) -> WordOnLine:
        """The same at a smaller size, round its middle."""
        share = min(size / self.size, 1.0)
        middle, half = (self.start + self.end) / 2, (self.end - self.start) / 2 * share
        return replace(self, start=middle - half, end=middle + half, size=self.size * share)


@dataclass
class _Put:
    """A word in a lane: where it begins and ends on the lane's line, and its size."""

    word: int
    start: float
    end: float
    size: float


@dataclass(eq=False)
class _Lane:
    """Part of a limb's width, from ``low`` to ``high``, shares of the half-width.

    Parameters
    ----------
    front
        How far along the limb's middle line it is filled.
    parent
        The lane that it was split from.
    parts
        Number of lanes that it is split into; ``waiting`` are those of them to be joined again.
    is_bent
        Whether it is as thin as it is since no word went round a bend in a wider one.
    """

    limb: Limb
    low: float
    high: float
    front: float
    parent: _Lane | None = None
    parts: int = 0
    put: list[_Put] = field(default_factory=list)
    waiting: list[_Lane] = field(default_factory=list)
    is_bent: bool = False

    def __post_init__(self) -> None:
        self.began = self.front
        self.line = self.limb.axis.shifted((self.low + self.high) / 2 * self.limb.half)

    def __lt__(self, other: _Lane) -> bool:
        return (self.front, self.low) < (other.front, other.low)

    def own(self, along: float) -> float:
        """Arc length of this lane's own line beside a place of the limb's."""
        return float(np.interp(along, self.limb.axis.lengths, self.line.lengths))

    def go_to(self, own: float) -> None:
        """Set the front beside a place of this lane's own line."""
        self.front = float(np.interp(own, self.line.lengths, self.limb.axis.lengths))

    def width(self, start: float, end: float) -> float:
        """Least width in a stretch of its line."""
        first, last = np.searchsorted(self.line.lengths, (start, end))
        halves = self.limb.half[max(first - 1, 0) : last + 1]
        return float((self.high - self.low) * halves.min())

    def split(self, count: int, *, is_bent: bool = False) -> list[_Lane]:
        """Lanes side by side in place of this one."""
        ends = np.linspace(self.low, self.high, count + 1).tolist()
        self.parts = count
        lanes = [_Lane(self.limb, *pair, self.front, self) for pair in pairwise(ends)]
        return [replace(lane, is_bent=is_bent) for lane in lanes]


class Lanes:
    """Words set along limbs.

    Parameters
    ----------
    shapes
        Of the words, in the order in which they are set.
    wanted
        ``(n,)`` sizes of an em that they are to have.
    least
        The least that they may have.
    gap
        Room between lanes.
    largest
        The most that they may have; None for any.

    Attributes
    ----------
    left
        Words that have found no place, in their order.
    found
        All others, then words that are set again until limbs are full.
    """

    def __init__(
        self,
        shapes: Sequence[WordShape],
        wanted: FloatArray,
        least: float,
        gap: float,
        largest: float | None = None,
    ) -> None:
        self._shapes, self._wanted, self._least, self._gap = shapes, wanted, least, gap
        self._largest = math.inf if largest is None else largest
        self._heights = np.array([shape.height for shape in shapes])
        self._lengths = np.array([shape.length for shape in shapes])
        self._longest = float(self._lengths.max())
        self.left = list(range(len(shapes)))
        self.found: list[WordOnLine] = []
        self._most = np.full(len(shapes), math.inf)
        self._turn = 0

    def fill(self, limb: Limb) -> None:
        """Set words along a limb, from its wider end to the other; of a loop both ways at once."""
        heap = [_Lane(way, -1.0, 1.0, 0.0) for way in limb.ways]
        while heap:
            for lane in self._gone_on(heapq.heappop(heap)):
                heapq.heappush(heap, lane)

    def has_room(self, limbs: Sequence[Limb]) -> bool:
        """Whether each word finds a place along these limbs; words are set until that is known."""
        for limb in limbs:
            heap = [_Lane(way, -1.0, 1.0, 0.0) for way in limb.ways]
            while heap and self.left:
                for lane in self._gone_on(heapq.heappop(heap)):
                    heapq.heappush(heap, lane)
        return not self.left

    def _gone_on(self, lane: _Lane) -> list[_Lane]:
        """Lanes to go on with once a word was put at a lane's front, or it was split or joined."""
        start = lane.own(lane.front)
        room, width = lane.line.length - start, lane.width(start, start)
        again = self._again(math.inf if lane.is_bent else width)
        first = self.left[0] if self.left else self._next_again(room)
        wanted = min(
            float(self._wanted[first]), math.inf if self.left else float(self._most[first])
        )
        fitting = self._size(width, first)
        thin = max(WAITING * wanted, self._least)
        # Words that are set again may be as small as the lightest is.
        thinnest = thin if self.left else max(float(self._most.min()), self._least)
        thin = thinnest if lane.is_bent else thin
        is_thin = lane.parent is not None and fitting < thin
        if is_thin or room < max(SHORTEST * width, self._least):
            return self._joined(lane)
        count = min(round(fitting / wanted), MOST_LANES)
        is_wide = self._size(width / 2, first) >= thinnest
        if count > 1 and self._size(width / count, first) >= max(WAITING * wanted, self._least):
            return lane.split(count)
        if not self.left and room < self._longest * fitting:
            # Of all that could end the lane, what leaves least of it bare.
            again.sort(key=lambda k: -self._shapes[k].length / self._shapes[k].height)
        # A word far smaller than its lane leaves that bare; thinner lanes have room for several.
        filled = WAITING if is_wide and not self.left else 0.0
        for word in (*self.left[:TRIED], *again):
            put = self._put(lane, start, width, word)
            if put is not None and put.size >= filled * self._size(width, word):
                self._take(word, put.size)
                lane.put.append(put)
                lane.is_bent = False
                lane.go_to(put.end + SPACE * put.size)
                return [lane]
        if is_wide:
            return lane.split(2, is_bent=not self.left)
        lane.is_bent = False
        lane.go_to(start + max(STEP * width, self._least))
        return [lane]

    def _next_again(self, room: float) -> int:
        """Word in turn that may be set again as large as it is: the lightest where none has room.

        So lanes that are thinner than it, for lighter words before it, are joined.
        """
        having_room = np.flatnonzero(self._lengths * self._most <= room)
        after = having_room[having_room >= self._turn]
        return int([*after, *having_room, len(self._lengths) - 1][0])

    def _again(self, width: float) -> list[int]:
        """Words that may be set again, in turn; those too large for a lane so wide are not."""
        sizes = FILLED * (width - self._gap) / self._heights
        small = np.flatnonzero(WAITING * self._wanted <= sizes)
        first = int(np.searchsorted(small, self._turn))
        return np.roll(small, -first).tolist() or [len(sizes) - 1]

    def _take(self, word: int, size: float) -> None:
        if word in self.left:
            self.left.remove(word)
            # Held down here, lighter ones leave their room to those that follow.
            lighter = self._wanted < self._wanted[word] * (1 - 1e-9)
            self._most[lighter] = np.minimum(self._most[lighter], LARGER * size)
            self._most[word] = min(self._most[word], size)
        else:
            self._turn = (word + 1) % len(self._shapes)

    def _size(self, width: float, word: int) -> float:
        """Size of a word in a lane of that width."""
        return min(FILLED * (width - self._gap) / self._shapes[word].height, self._largest)

    def _put(self, lane: _Lane, start: float, width: float, word: int) -> _Put | None:
        """A word from a place on; None where it does not fit."""
        shape, line = self._shapes[word], lane.line
        while True:
            size = min(self._size(width, word), float(self._most[word]))
            if size < self._least:
                return None
            length = shape.length * size
            # Where both ways round a loop begin, a space is between their first words.
            first = start + SPACE / 2 * size * (lane.limb.is_half and start == 0.0)
            turns = line.turning(first, first + length, width)
            sharp = float(np.abs(turns).max())
            # Where the line bends, feet of letters are nearer to each other than their middles.
            end = first + length / (1 - min(sharp, SHARPEST) / 3)
            if end > line.length:
                return None
            narrow = lane.width(first, end)
            if narrow >= NEARLY * width:
                break
            width = narrow
        is_plain = sharp <= SHARPEST and abs(turns.sum()) <= MOST_TURN
        return _Put(word, first, end, size) if is_plain else None

    def _joined(self, lane: _Lane) -> list[_Lane]:
        """The lane that one was split from once all its parts have come so far; none at the end."""
        parent = lane.parent
        if parent is None:
            self._settle(lane, lane.line.length)
            return []
        parent.waiting.append(lane)
        if len(parent.waiting) < parent.parts:
            return []
        parent.front = max(one.front for one in parent.waiting)
        if parent.front <= lane.began:
            parent.go_to(parent.own(parent.front) + self._least)
        for one in parent.waiting:
            self._settle(one, one.own(parent.front))
        self._settle(parent, parent.own(parent.front))
        parent.waiting, parent.parts = [], 0
        return [parent]

    def _settle(self, lane: _Lane, end: float) -> None:
        """Give the words of a lane their places for good, spread up to an end."""
        puts, lane.put = lane.put, []
        last = puts[-1].end + SPACE * puts[-1].size if puts else end
        slack = max(end - last, 0.0) if lane.parts == 0 else 0.0
        spread = [self._setting(lane, p, slack * k / len(puts)) for k, p in enumerate(puts)]
        if any(one.size < self._least for one in spread):
            spread = [self._setting(lane, put, 0.0) for put in puts]
        self.found += spread

    def _setting(self, lane: _Lane, put: _Put, shift: float) -> WordOnLine:
        start, end = put.start + shift, put.end + shift
        size = min(put.size, self._size(lane.width(start, end), put.word))
        middle, half = (start + end) / 2, (end - start) / 2 * size / put.size
        line, angle = lane.line, float(lane.line.angle(middle, half / 2))
        # Upright ones are read upwards.
        if math.cos(angle) < -LEVEL or (math.cos(angle) <= LEVEL and math.sin(angle) > 0):
            line, middle = line.reversed(), line.length - middle
        return WordOnLine(put.word, line, middle - half, middle + half, size)
