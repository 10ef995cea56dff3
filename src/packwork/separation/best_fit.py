"""Rectangles by best fit: the lowest gap of a sheet takes what fits it best.

After Burke, Kendall and Whitwell, "A new placement heuristic for the orthogonal stock-cutting
problem" (2004). Places are sums of sides, so that tilings come out without a gap; ours runs along
x, goes on to further sheets, and tries other preferences at random until nothing is left bare.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from packwork.geometry.rectangles import ROUNDING

MOST_LOOKS = 1_000_000
"""Comparisons of a rectangle with a gap, in all tries: .7 s. More find rarer tilings. Tried. A try
counts as 200 at least: few parts come out in few ways, which 5,000 tries find."""

MOST_IN_A_TRY = 8_000_000
"""The same in one try, as estimated: 1,400 kinds of one part each reach it. Measured."""


@dataclass(frozen=True)
class Placed:
    """One placed rectangle: its kind, which of its two orientations, and its left top corner."""

    kind: int
    turn: int
    x: float
    y: float


@dataclass(frozen=True)
class Fitted:
    """Rectangles by sheet, how many of each kind found no room, used length of the last sheet."""

    sheets: tuple[tuple[Placed, ...], ...]
    left: tuple[int, ...]
    length: float

    @property
    def rank(self) -> tuple[int, int, float]:
        """Order, the best first."""
        return sum(self.left), len(self.sheets), self.length


def best_fit(
    sizes: Sequence[Sequence[tuple[float, float]]], counts: Sequence[int],
    sheet: tuple[float, float], most_sheets: float, seed: int,
    stop: Callable[[], bool] = lambda: False,
) -> tuple[Fitted, bool]:  # fmt: skip
    """Lay rectangles on equal sheets; and whether they cannot lie on less.

    Parameters
    ----------
    sizes
        (length, height) of each kind as it may lie, one or two of them.
    sheet
        Length, which may be infinite, and height.
    stop
        Asked after each try whether to end with the best so far.

    Examples
    --------
    >>> found, is_least = best_fit([[(2.0, 1.0), (1.0, 2.0)]], [6], (4.0, 3.0), math.inf, 0)
    >>> found.length, len(found.sheets[0]), is_least
    (4.0, 6, True)
    """
    random = np.random.default_rng(seed)
    area = sum(w * h * count for ((w, h), *_), count in zip(sizes, counts, strict=True))
    length, height = sheet
    many = 1 if math.isinf(length) else max(math.ceil(area / (length * height) * (1 - ROUNDING)), 1)
    taken = 0.0 if many == 1 else (many - 1) * length
    least = (0, many, (area / height - taken) * (1.0 + 1e-9))
    looks = _looks(sizes, counts)
    best = Fitted((), tuple(counts), 0.0)
    for number in range(max(MOST_LOOKS // max(looks, 200), 1)):
        # By height, then by area and by length, then any preference between.
        across, noise = (1.0, 0.0, 0.5)[number % 3], 0.0 if number < 3 else random.uniform(0.0, 0.5)
        if number >= 3:
            across = random.uniform()
        likes = random.uniform(0.0, 1.0, len(sizes)) * noise
        found = _Pass(sizes, counts, sheet, across, likes.tolist()).run(most_sheets)
        best = min(best, found, key=lambda one: one.rank)
        if best.rank <= least or stop():
            break
    return best, best.rank <= least


def is_too_much(sizes: Sequence[Sequence[tuple[float, float]]], counts: Sequence[int]) -> bool:
    """Whether one try with so many kinds, of so many each, takes too long.

    >>> is_too_much([[(2.0, 1.0)]], [100_000]), is_too_much([[(2.0, 1.0)]] * 4_000, [1] * 4_000)
    (False, True)
    """
    return _looks(sizes, counts) > MOST_IN_A_TRY


def _looks(sizes: Sequence[Sequence[tuple[float, float]]], counts: Sequence[int]) -> int:
    return sum(counts) * 2 * sum(len(one) for one in sizes)


class _Pass:
    """One try: a skyline of gaps (x, y from, y to) by y, and what is left of each kind."""

    def __init__(
        self, sizes: Sequence[Sequence[tuple[float, float]]], counts: Sequence[int],
        sheet: tuple[float, float], across: float, likes: Sequence[float],
    ) -> None:  # fmt: skip
        self._left = list(counts)
        self._length, self._height = sheet
        self._slack = ROUNDING * max(self._height, min(self._length, 1e9 * self._height))
        longest = max(max(one) for kind in sizes for one in kind)
        # The order of what fits: by its share of the gap, and by its length.
        self._options = [
            (kind, turn, w, h, likes[kind] + (1.0 - across) * w / longest)
            for kind, options in enumerate(sizes) for turn, (w, h) in enumerate(options)
        ]  # fmt: skip
        self._across = across

    def run(self, most_sheets: float) -> Fitted:
        """Lay what has room on as many sheets as there may be."""
        sheets: list[tuple[Placed, ...]] = []
        length = 0.0
        while any(self._left) and len(sheets) < most_sheets:
            placed, used = self._sheet()
            if not placed:
                break
            sheets.append(placed)
            length = used
        return Fitted(tuple(sheets), tuple(self._left), length)

    def _sheet(self) -> tuple[tuple[Placed, ...], float]:
        sky, placed, used = [(0.0, 0.0, self._height)], list[Placed](), 0.0
        while sky:
            k = min(range(len(sky)), key=lambda k: sky[k])
            x, y0, y1 = sky[k]
            found = self._fitting(y1 - y0, x)
            above = sky[k - 1][0] if k else math.inf
            below = sky[k + 1][0] if k + 1 < len(sky) else math.inf
            if found is None:
                if len(sky) == 1:
                    break
                # What lies in no gap is bare.
                sky[k] = (min(above, below), y0, y1)
            else:
                kind, turn, w, h, _ = found
                self._left[kind] -= 1
                used = max(used, x + w)
                at_top = above >= below or h > y1 - y0 - self._slack
                y = y0 if at_top else y1 - h
                placed.append(Placed(kind, turn, x, y))
                sky[k : k + 1] = (
                    [(x + w, y0, y0 + h), (x, y0 + h, y1)] if at_top
                    else [(x, y0, y1 - h), (x + w, y1 - h, y1)]
                )  # fmt: skip
            sky = self._joined(sky)
        return tuple(placed), used

    def _fitting(self, gap: float, x: float) -> tuple[int, int, float, float, float] | None:
        room, most = gap + self._slack, self._length + self._slack - x
        best, found = -math.inf, None
        for option in self._options:
            kind, _, w, h, liked = option
            if self._left[kind] and h <= room and w <= most:
                # One that fills the gap leaves none beside it.
                score = self._across * h / gap + liked + (1.0 if h >= gap - self._slack else 0.0)
                if score > best:
                    best, found = score, option
        return found

    def _joined(self, sky: list[tuple[float, float, float]]) -> list[tuple[float, float, float]]:
        """The skyline without gaps of no height, and with equally deep neighbours as one."""
        found: list[tuple[float, float, float]] = []
        for x, y0, y1 in sky:
            if y1 - y0 <= self._slack:
                if found:
                    found[-1] = (*found[-1][:2], y1)
            elif found and abs(found[-1][0] - x) <= self._slack:
                found[-1] = (max(found[-1][0], x), found[-1][1], y1)
            else:
                found.append((x, y0, y1))
        return found
