"""Round packs: items as discs in a small circle, from which they settle best."""

from __future__ import annotations

import math

import numpy as np

from packwork.arrays import FloatArray
from packwork.progress import Stop
from packwork.settle.circle_packing import packed_circles
from packwork.settle.settle import Settling

MOST_TRIES, ITEMS = 8, 120
"""Starts that are tried of items that are no discs, and items in all of them together at most.
Larger takes longer, in proportion; the best of eight covers a twentieth more than any. Tried."""

MOST_ITEMS = 4_000
"""Items of a round start at most: a front looks at all pairs. Chosen."""

NEARLY_DISC = 0.88
"""Share of the disc about it that an item covers to be taken for one: its first place is then
as good as any. Chosen."""

AROUND_GAP = 1 + 1e-3
"""Factor on the gap, so that what touches passes the check. Chosen."""


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

    Parameters
    ----------
    settling
        Of all items, with a centre; its arrangement is changed in place.
    gap
        Least distance of two items, and of an item and the edge.
    trusts
        First and last bound of a move while they are tried.
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
            arrangement.put(settling.active, start)
            settling.settle(lambda _: None, stop, trusts)
            circles[k] = settling.circle()
    arrangement.put(settling.active, starts[int(np.argmin(circles))])
    return True


def _tries(settling: Settling) -> int:
    discs = math.pi * settling.arrangement.radii**2
    if (settling.areas > NEARLY_DISC * discs).all():
        return 1
    return max(min(MOST_TRIES, ITEMS // len(discs)), 1)


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
