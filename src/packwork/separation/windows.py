"""Many sheets: a window of a few after the other, so that time grows with the number of parts."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from packwork.geometry.polygon import Region
from packwork.separation.ground import ground_of
from packwork.separation.shapes import Floats, Part
from packwork.separation.sheets import SheetSearch
from packwork.separation.strip import WorkBound

FILLED = 0.75
"""Share of sheets that the parts of a window may cover: less takes more windows, more leaves some
out, which then come again."""

WINDOW = 3
"""Sheets of a window. All but the last stay; its parts come again in the next one."""

MOST_IN_WINDOW = 800
"""Parts of a window: prices of pairs grow with its square."""

EMPTIEST = 0.3
"""Share of sheets that parts cover at least."""

MOST_TURNS_MISSED = 3
"""Windows in which a part finds no room until it counts as left out."""


@dataclass(frozen=True)
class FreeSheet:
    """Region of a sheet that is free, and what lies in it already."""

    region: Region
    held: tuple[Region, ...] = ()

    @property
    def area(self) -> float:
        """Area that is left, in square units."""
        return float(self.region.area) - sum(float(one.area) for one in self.held)


@dataclass(frozen=True)
class LaidSheet:
    """Numbers of the kinds of parts that lie on a sheet, and their poses (x, y, angle, side)."""

    sheet: int
    kinds: tuple[int, ...]
    poses: Floats


def lay_on_sheets(
    parts: Sequence[Part], sheets: Sequence[FreeSheet], *, seed: int, workers: int,
    work: WorkBound, stop: Callable[[], bool],
) -> tuple[list[LaidSheet], Counter[int]]:  # fmt: skip
    """Lay parts on sheets, taken in their order; those without room are counted by kind."""
    random, areas = np.random.default_rng(seed), [part.region.area for part in parts]
    every = np.repeat(np.arange(len(parts)), [part.count for part in parts])
    queue = sorted(random.permutation(every).tolist(), key=lambda kind: -parts[kind].priority)
    optional = [kind for kind in queue if parts[kind].is_optional]
    queue = [kind for kind in queue if not parts[kind].is_optional]
    found, missing, missed = list[LaidSheet](), Counter[int](), Counter[int]()
    whole, at, width = sum(areas[kind] for kind in every), 0, WINDOW
    work.start()
    while (queue or optional) and at < len(sheets) and not stop():
        # On the last sheets more is tried than has room; of what does not, the least is left.
        is_end = at + width >= len(sheets)
        room = sum(sheet.area for sheet in sheets[at : at + width]) * (1.0 if is_end else FILLED)
        taken = _taken(queue, areas, room)
        window, queue = queue[:taken], queue[taken:]
        is_last = is_end or not queue
        if is_last:
            window, optional = window + optional, []
        area = sum(areas[kind] for kind in window)
        chosen = sheets[at : at + _enough(sheets[at:], area)]
        bound = work.part(1.0 if is_last else area / whole) if found or not is_last else work
        whole -= area
        counts = Counter(window)
        kinds = sorted(counts)
        search = SheetSearch(
            [replace(parts[kind], count=counts[kind]) for kind in kinds],
            ground_of([one.region for one in chosen], [one.held for one in chosen]),
            seed=int(random.integers(2**31)), workers=workers, work=bound, stop=stop,
        )  # fmt: skip
        laid, left = _by_sheet(search, np.repeat(kinds, [counts[kind] for kind in kinds]), at)
        if bound is not work:
            work.done += bound.done
            work.met = f"{sum(left.values()) + len(queue)} parts left"
        if is_last:
            return found + laid, missing + left + Counter(queue)
        if len(laid) == 1 and len(window) < MOST_IN_WINDOW:
            # Less than a sheet: with more of them.
            queue, width, whole = window + queue, 2 * width, whole + area
            continue
        back = list(left.elements())
        if len(laid) > 1:
            back += laid.pop().kinds
        if laid:
            found, at = found + laid, laid[-1].sheet + 1
        for kind in left.elements():
            missed[kind] += 1
            if missed[kind] > MOST_TURNS_MISSED * parts[kind].count:
                missing[kind] += 1
                back.remove(kind)
        queue = back + queue
        whole += sum(areas[kind] for kind in back)
    return found, missing + Counter(queue + optional)


def _taken(queue: Sequence[int], areas: Sequence[float], room: float) -> int:
    """Number of parts at the head of a queue that a window takes; all where few would be left."""
    sums = np.cumsum([areas[kind] for kind in queue])
    if not len(sums) or (sums[-1] <= 1.5 * room and len(queue) <= MOST_IN_WINDOW):
        return len(queue)
    return min(max(int(np.searchsorted(sums, room)), 1), MOST_IN_WINDOW)


def _enough(sheets: Sequence[FreeSheet], area: float) -> int:
    """Number of sheets that parts of an area do not fill."""
    sums = np.cumsum([EMPTIEST * sheet.area for sheet in sheets])
    return min(int(np.searchsorted(sums, area)) + 2, len(sheets))


def _by_sheet(
    search: SheetSearch, kinds: npt.NDArray[np.int64], first: int
) -> tuple[list[LaidSheet], Counter[int]]:
    strip, bays = search.run(), search.ground.bays
    is_laid = ~np.isnan(strip.poses[:, 0])
    sheet_of = search.ground.bay_at(strip.lefts)
    laid = list[LaidSheet]()
    for k, bay in enumerate(bays):
        own = np.flatnonzero(is_laid & (sheet_of == k))
        if len(own):
            poses = strip.poses[own] - (*bay.offset, 0.0, 0.0)
            laid.append(LaidSheet(first + k, tuple(kinds[own].tolist()), poses))
    return laid, Counter(kinds[~is_laid].tolist())
