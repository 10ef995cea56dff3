"""Round packs: items as discs, equal or not, in a small enclosing circle, from which they settle.

Front chain: W. Wang, H. Wang, G. Dai and H. Wang, "Visualization of large hierarchical data by
circle packing", CHI 2006, 517-520, doi:10.1145/1124772.1124851; ours looks at all pairs and not
at the chain's alone, begins about several centres and takes the best. Then monotonic basin
hopping: A. Grosso, A. Jamali, M. Locatelli and F. Schoen, "Solving the problem of packing equal
and unequal circles in a circular container", Journal of Global Optimization 47 (2010), 63-81,
doi:10.1007/s10898-009-9458-3; our hops move a disc of the rim into a hole, or shake some, and
local minima are those of squared overlaps under a pressure, found by L-BFGS.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from packwork.arrays import FloatArray
from packwork.geometry.outline import Outline
from packwork.progress import Stop
from packwork.settle.bottom_left import AROUND_GAP
from packwork.settle.kernels import circle_packing as kernels
from packwork.settle.settle import Settling

MOST_TRIES, ITEMS = 8, 120
"""Starts that are tried of items that are no discs, and items in all of them together at most.
Larger takes longer, in proportion; the best of eight covers a twentieth more than any. Tried."""

MOST_ITEMS = 4_000
"""Items of a round start at most: a front looks at all pairs. Chosen."""

NEARLY_DISC = 0.88
"""Share of the disc about it that an item covers to be taken for one: its first place is then
as good as any. Chosen."""


def begin_as_discs(outlines: Sequence[Outline], scales: FloatArray) -> bool:
    """Whether a round pack is closest from places of the discs about its items.

    So it is of what is nearly round, and of few items, for which several such places are tried.
    """
    radii, areas = np.array([(one.radius, one.area) for one in outlines]).T * (scales, scales**2)
    return 2 * len(radii) <= ITEMS or _are_nearly_discs(areas, radii)


def _are_nearly_discs(areas: FloatArray, radii: FloatArray) -> bool:
    return bool((areas > NEARLY_DISC * math.pi * radii**2).all())


def start_round_pack(
    settling: Settling,
    gap: float,
    trusts: tuple[float, float],
    rng: np.random.Generator,
    stop: Stop,
) -> bool:
    """Put all items, as discs, where their pack will be round; False if there is no room for it.

    Items that are no discs are settled from several such places, and put back to those from
    which they came to lie in the smallest circle.

    ``settling``: of all items, with a centre; its arrangement is changed in place.
    ``gap``: least distance of two items, and of an item and the edge.
    ``trusts``: first and last bound of a move while they are tried.
    """
    arrangement = settling.arrangement
    if arrangement.count > MOST_ITEMS:
        return False
    starts: list[FloatArray] = []
    for _ in range(_tries(settling)):
        if starts and stop():
            break
        found = _placed(settling, gap, rng)
        if found is not None:
            starts.append(found)
    if not starts:
        return False
    circles = np.zeros(len(starts))
    if len(starts) > 1:
        for k, start in enumerate(starts):
            arrangement.put(settling.all_items, start)
            settling.settle(lambda _: None, stop, trusts)
            circles[k] = settling.circle(settling.all_items)
    arrangement.put(settling.all_items, starts[int(np.argmin(circles))])
    return True


def _tries(settling: Settling) -> int:
    radii = settling.arrangement.radii
    if _are_nearly_discs(settling.areas, radii):
        return 1
    return max(min(MOST_TRIES, ITEMS // len(radii)), 1)


def _placed(settling: Settling, gap: float, rng: np.random.Generator) -> FloatArray | None:
    """Places of one such pack, turned at random; None if it sticks out of the room."""
    arrangement = settling.arrangement
    radii = arrangement.radii + AROUND_GAP * gap / 2
    turn = rng.uniform(0, 2 * math.pi)
    cosine, sine = math.cos(turn), math.sin(turn)
    centres = packed_circles(radii, rng) @ np.array([[cosine, sine], [-sine, cosine]])
    centres += settling.centre
    left, top, right, bottom = arrangement.container.bounds
    reach = (arrangement.radii + AROUND_GAP * gap)[:, None]
    if (centres - reach < (left, top)).any() or (centres + reach > (right, bottom)).any():
        return None
    places = arrangement.places.copy()
    places[:, :2] = centres
    return places


STARTS = 8
"""Fronts that are begun with, about other points of their first discs. More takes longer and finds
little that the trials do not. Tried."""

FRONTS = 4e6
"""Fronts by pairs of items at most; one is always laid. Larger gains little where there are
thousands, and takes seconds for each. Tried."""

TRIALS = 100
"""Changes that are tried then. More takes longer. Tried."""

WORK = 8e5
"""Trials by pairs of items at most; a trial looks at all pairs, again and again. Larger gains up
to 0.002 of the circle where there are many. Tried."""

TRIANGLE = 1 / math.sqrt(3)
"""How far the middle of three equal discs lies off the line of two, radii. Derived."""


def packed_circles(radii: FloatArray, rng: np.random.Generator) -> FloatArray:
    """Centres ``(n, 2)`` of discs that do not meet, about the origin, in a small circle.

    Where one is more than a thousand times as large as another, small ones may come to lie in it.
    Deterministic for one generator. The circle is near the smallest for some tens of discs, equal
    or not: there is no table of known packs behind it.

    ``radii``: of the discs, with what they are to keep free round them.

    Examples
    --------
    >>> seven = packed_circles(np.ones(7), np.random.default_rng(0))
    >>> bool(2.999 < np.hypot(*seven.T).max() + 1 < 3.001)
    True
    """
    n = len(radii)
    order = np.argsort(-radii, kind="stable")
    best, centres = np.inf, np.zeros((n, 2))
    starts = max(min(STARTS, int(FRONTS / n**2)), 1)
    for shift, aside in _origins(rng)[:starts]:
        found = kernels.front_chain(radii, order, shift * radii[order[0]], aside * radii[order[0]])
        circle = kernels.circle_of(found, radii)
        squeezed = found.copy()
        narrower = kernels.squeeze(squeezed, radii)
        if narrower < circle:
            circle, found = narrower, squeezed
        if circle < best * (1 - kernels.ROUNDING):
            best, centres = circle, found
    trials = min(TRIALS, int(WORK / n**2)) if n > 2 else 0
    draws = rng.random((trials, 2 * max(n, kernels.SAMPLES) + 3))
    kernels.hop(centres, radii, draws)
    return centres * (1 + kernels.ROUNDING)


def _origins(rng: np.random.Generator) -> list[tuple[float, float]]:
    """Middles of the pack by the first two of its discs, in radii along and off their line."""
    known = [(1.0, 0.0), (0.0, 0.0), (0.0, TRIANGLE)]
    drawn = rng.uniform((0.0, 0.0), (1.0, TRIANGLE), (STARTS - len(known), 2))
    return known + [(float(a), float(b)) for a, b in drawn]
