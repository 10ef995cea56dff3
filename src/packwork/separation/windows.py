"""Many sheets: a window of a few after the other, so that time grows with the number of parts."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from packwork.geometry.polygon import Region
from packwork.separation.ground import Ground, ground_of
from packwork.separation.shapes import Floats, Part, placed
from packwork.separation.sheets import SheetSearch
from packwork.separation.strip import StripSearch, WorkBound

FILLED = 0.75
"""Share of sheets that the parts of a window may cover: less takes more windows, more leaves some
out, which then come again."""

AMPLE = 0.4
"""Share of the sheets that are left which parts may cover so that these are filled by first fit.
Where sheets are scarcer, parts that have room must move for others. Chosen."""

SUPPLY = 1.7
"""Area of the parts that a sheet may choose from, over its own; what has no room waits. More takes
longer, and leaves fewer small ones for others. Tried."""

WINDOW = 3
"""Sheets of a window. All but the last stay; its parts come again in the next one."""

MOST_IN_WINDOW = 300
"""Parts of a window: prices of pairs grow with its square."""

PIECE = 300
"""Parts of a piece of a strip: more take longer to come apart, fewer leave more seams. Tried."""

EMPTIEST = 0.3
"""Share of sheets that parts cover at least."""

TRIAL = 0.5
"""Share of the work that is left to parts that go together which is spent on each sheet that they
are tried on. More overlooks sheets further on, less those that are full. Chosen."""

TOGETHER, AMONG = 0.7, 0.5
"""Share of the work that parts which go together have where there are others, and the share of that
in which others are brought in among them, or they come closer. Chosen."""

FILLING = 0.2
"""Share of the work that optional parts have, where there are some."""


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
    laying = _Laying(parts, sheets, seed, workers, stop)
    every = np.repeat(np.arange(len(parts)), [part.count for part in parts])
    queue = sorted(laying.random.permutation(every).tolist(), key=lambda k: -parts[k].priority)
    optional = [kind for kind in queue if parts[kind].is_optional]
    joined = [kind for kind in queue if parts[kind].together]
    required = [kind for kind in queue if not (parts[kind].is_optional or parts[kind].together)]
    work.start()
    missing = Counter[int]()
    if joined:
        first = work.part(TOGETHER if required else 1.0)
        first.start()
        missing, required = laying.lay_together(joined, required, first)
        work.add(first)
    if not ((required or joined) and optional):
        missing += laying.lay(required + optional, work)
    else:
        first = work.part(1.0 - FILLING)
        first.start()
        missing += laying.lay(required, first)
        work.add(first)
        missing += laying.fill(optional, work) if not missing else Counter(optional)
    return sorted(laying.laid.values(), key=lambda one: one.sheet), missing


def lay_on_strip(
    parts: Sequence[Part], height: float, *, seed: int, workers: int, work: WorkBound,
    stop: Callable[[], bool],
) -> LaidSheet:  # fmt: skip
    """Lay many parts on a strip: on pieces of it that lie end to end.

    Whatever happens, all are laid.
    """
    every = np.repeat(np.arange(len(parts)), [part.count for part in parts])
    random = np.random.default_rng(seed)
    many = math.ceil(len(every) / PIECE)
    kinds, found, length = list[int](), list[Floats](), 0.0
    work.start()
    for n, chosen in enumerate(np.array_split(random.permutation(every), many)):
        counts, bound = Counter(chosen.tolist()), work.part(1.0 / (many - n))
        own = sorted(counts)
        search = StripSearch(
            [replace(parts[kind], count=counts[kind]) for kind in own], Ground(height),
            seed=int(random.integers(2**31)), workers=workers, work=bound, stop=stop,
        )  # fmt: skip
        strip = search.run()
        work.add(bound)
        kinds += np.repeat(own, [counts[kind] for kind in own]).tolist()
        found.append(strip.poses + np.array([length, 0.0, 0.0, 0.0]))
        length += strip.length
        work.best_so_far = f"{len(kinds):,} of {len(every):,} parts"
    return LaidSheet(0, tuple(kinds), np.vstack(found))


class _Laying:
    """Sheets, and what is laid on them so far."""

    def __init__(
        self, parts: Sequence[Part], sheets: Sequence[FreeSheet], seed: int, workers: int,
        stop: Callable[[], bool],
    ) -> None:  # fmt: skip
        self.sheets, self.workers, self.stop = list(sheets), workers, stop
        priorities = [part.priority for part in parts]
        # What goes together is there before others are brought in among it.
        ahead = max(priorities) - min(priorities) + 1
        self.parts = [
            replace(part, priority=part.priority + ahead) if part.together else part
            for part in parts
        ]
        self.random = np.random.default_rng(seed)
        self.areas = np.array([part.region.area for part in parts])
        self.priorities = np.array([part.priority for part in self.parts])
        self.room = np.array([sheet.area for sheet in sheets])
        self.laid = dict[int, LaidSheet]()

    def lay(self, queue: list[int], work: WorkBound) -> Counter[int]:
        """Lay all of a queue, on sheets in their order; returns what found no room.

        Where sheets are ample and have room for few parts each, one after the other is filled by
        first fit; else those of a window are searched together. Where the work is done, or all
        sheets had their turn, all that is left is laid by first fit, beside what lies there first.
        """
        at, width, searched = 0, WINDOW, list[int]()
        while queue and (searched or at < len(self.sheets)) and not self.stop():
            is_over = work.share >= 1.0 or at >= len(self.sheets)
            if is_over and searched:
                queue, _ = self._fill_sheet(queue, searched.pop(0), work)
                continue
            first = at
            if is_over or self._is_ample(queue, at):
                queue, at = self._fill_sheet(queue, at, work)
            else:
                queue, at, width = self._search_window(queue, at, width, work)
            searched += [] if is_over else range(first, at)
            work.best_so_far = f"{len(queue)} parts left"
        return Counter(queue)

    def _is_ample(self, queue: Sequence[int], at: int) -> bool:
        """Whether there is room and to spare on the sheets from one on, each for not too many."""
        whole, room = self.area(queue), self.room[at:]
        if whole <= FILLED * room[:WINDOW].sum() and len(queue) <= MOST_IN_WINDOW:
            return False
        most = MOST_IN_WINDOW * whole / len(queue)
        return bool(SUPPLY * room[0] <= most and whole <= AMPLE * room.sum())

    def _fill_sheet(self, queue: list[int], at: int, work: WorkBound) -> tuple[list[int], int]:
        """Fill a sheet by first fit; returns what is left, and the next sheet.

        One draw of parts is enough for an empty one where there is work to close them up; else
        others follow, until no kind has room.
        """
        empty, full, waiting = self.sheets[at], set[int](), list[int]()
        is_enough = at not in self.laid
        while queue and not self.stop():
            window, others = self._supply(queue, self.room[at])
            share = min(FILLED * self.room[at], self.area(window)) / self.area(queue + waiting)
            bound = work.part(min(share, 1.0))
            found, left = self._search(window, [at], bound, fills=True)
            work.add(bound)
            for one in found:
                self._keep(one)
            if not found:
                full.update(window)
            rest = [*left.elements(), *others]
            waiting += [kind for kind in rest if kind in full]
            queue = [kind for kind in rest if kind not in full]
            is_enough &= len(window) < MOST_IN_WINDOW and work.share < 1.0
            if is_enough and found and left:
                break
        is_too_small = self.sheets[at] is empty
        at += 1
        while is_too_small and at < len(self.sheets) and self.sheets[at] == empty:
            at += 1
        return waiting + queue, at

    def _search_window(
        self, queue: list[int], at: int, width: int, work: WorkBound
    ) -> tuple[list[int], int, int]:
        """Search some sheets together; what is left, the next sheet and how many to take."""
        whole, is_end = self.area(queue), at + width >= len(self.sheets)
        # On the last sheets more is tried than has room.
        taken = self._taken(queue, (1.0 if is_end else FILLED) * self.room[at : at + width].sum())
        window, queue = queue[:taken], queue[taken:]
        area = self.area(window)
        # As many as parts of that area do not fill.
        sums = np.cumsum(EMPTIEST * self.room[at:])
        chosen = range(at, at + min(int(np.searchsorted(sums, area)) + 2, len(sums)))
        is_all = not queue and not self.laid
        bound = work if is_all else work.part(1.0 if not queue else min(area / whole, 1.0))
        found, left = self._search(window, chosen, bound)
        if not is_all:
            work.add(bound)
        if not found:
            # Too large for these sheets.
            return window + queue, chosen.stop, width
        if len(found) == 1 and queue and not is_end and len(window) < MOST_IN_WINDOW:
            # Less than a sheet: with more of them.
            return window + queue, at, 2 * width
        if queue and len(found) > 1 and not is_end:
            # The last one is not full: its parts come again.
            again = found.pop()
            left += Counter(again.kinds)
            at = again.sheet
        elif not queue:
            at = chosen.stop
        for one in found:
            self._keep(one)
        return [*left.elements(), *queue], at, width

    def _supply(self, queue: Sequence[int], area: float) -> tuple[list[int], list[int]]:
        """Parts of the highest priority that a sheet may choose from, by chance, and all others."""
        order = self.random.permutation(queue)
        order = order[np.argsort(-self.priorities[order], kind="stable")]
        taken = int(np.searchsorted(np.cumsum(self.areas[order]), SUPPLY * area))
        taken = min(taken + 1, MOST_IN_WINDOW)
        return order[:taken].tolist(), order[taken:].tolist()

    def area(self, queue: Sequence[int]) -> float:
        """Area of parts, in square units."""
        return float(self.areas[list(queue)].sum())

    def lay_together(
        self, queue: Sequence[int], loose: list[int], work: WorkBound
    ) -> tuple[Counter[int], list[int]]:
        """Lay parts so that those of one name lie on one sheet, then loose ones among them.

        Returns those without room, and what is left of the loose ones. First fit decreasing, of all
        parts of a name, where those of a sheet move for more.
        """
        names = dict.fromkeys(self.parts[kind].together for kind in queue)
        sets = [[kind for kind in queue if self.parts[kind].together == name] for name in names]
        sets.sort(key=lambda one: (-self.parts[one[0]].priority, -self.area(one)))
        missing, ahead = Counter[int](), self.area(queue)
        on_sheet, found = dict[int, list[int]](), dict[int, LaidSheet]()
        trials = work.part(1.0 - AMONG)
        trials.start()
        for one in sets:
            bound = trials.part(min(self.area(one) / ahead, 1.0))
            bound.start()
            ahead -= self.area(one)
            sheet = self._sheet_for(one, on_sheet, found, bound)
            if sheet is None:
                missing += Counter(one)
            trials.done += bound.done
            work.best_so_far = f"{len(on_sheet)} sheets"
        work.add(trials)
        for n, k in enumerate(sorted(on_sheet), start=1):
            room = self.sheets[k].area - self.area(on_sheet[k])
            taken = self._taken(loose, room) if loose else 0
            bound = work.part(1.0 / (len(on_sheet) - n + 1))
            laid, left = self._search([*on_sheet[k], *loose[:taken]], [k], bound)
            work.add(bound)
            if not any(left[kind] for kind in on_sheet[k]):
                found[k] = laid[0]
                loose = [*left.elements(), *loose[taken:]]
            self._keep(found[k])
        return missing, loose

    def _sheet_for(
        self, parts: list[int], on_sheet: dict[int, list[int]], found: dict[int, LaidSheet],
        work: WorkBound,
    ) -> int | None:  # fmt: skip
        """Lay parts on the first sheet that has room for all of them; None if none has."""
        too_small = list[FreeSheet]()
        for k, sheet in enumerate(self.sheets):
            every = [*on_sheet.get(k, ()), *parts]
            if self.area(every) > sheet.area or (k not in on_sheet and sheet in too_small):
                continue
            trial = work.part(TRIAL)
            laid, left = self._search(every, [k], trial, shrinks=False)
            work.add(trial)
            if not left:
                on_sheet[k], found[k] = every, laid[0]
                return k
            if k not in on_sheet:
                too_small.append(sheet)
        return None

    def fill(self, queue: list[int], work: WorkBound) -> Counter[int]:
        """Lay what has room beside what lies on the sheets that are used."""
        used = sorted(self.laid)
        for first in range(0, len(used), WINDOW):
            if not queue or self.stop() or work.share >= 1.0:
                break
            chosen = used[first : first + WINDOW]
            window, queue = queue[:MOST_IN_WINDOW], queue[MOST_IN_WINDOW:]
            bound = work.part(WINDOW / (len(used) - first) if len(used) - first > WINDOW else 1.0)
            found, left = self._search(window, chosen, bound)
            work.add(bound)
            for one in found:
                self._keep(one)
            queue = [*left.elements(), *queue]
        return Counter(queue)

    def _search(
        self,
        window: list[int],
        chosen: Sequence[int],
        bound: WorkBound,
        *,
        shrinks: bool = True,
        fills: bool = False,
    ) -> tuple[list[LaidSheet], Counter[int]]:
        """Search of some parts on some sheets: what lies on which, and what has no room."""
        counts, sheets = Counter(window), [self.sheets[k] for k in chosen]
        kinds = sorted(counts)
        search = SheetSearch(
            [replace(self.parts[kind], count=counts[kind]) for kind in kinds],
            ground_of([one.region for one in sheets], [one.held for one in sheets]),
            seed=int(self.random.integers(2**31)), workers=self.workers, work=bound, stop=self.stop,
        )  # fmt: skip
        strip = search.fill() if fills else search.run(shrinks=shrinks)
        kind_of = np.repeat(kinds, [counts[kind] for kind in kinds])
        is_laid = ~np.isnan(strip.poses[:, 0])
        sheet_of = search.ground.bay_at(strip.lefts)
        found = list[LaidSheet]()
        for k, bay in enumerate(search.ground.bays):
            own = np.flatnonzero(is_laid & (sheet_of == k))
            if len(own):
                poses = strip.poses[own] - (*bay.offset, 0.0, 0.0)
                found.append(LaidSheet(chosen[k], tuple(kind_of[own].tolist()), poses))
        return found, Counter(kind_of[~is_laid].tolist())

    def _keep(self, one: LaidSheet) -> None:
        """Leave parts where they lie; more may come beside them."""
        sheet, before = self.sheets[one.sheet], self.laid.get(one.sheet)
        regions = tuple(
            placed(self.parts[kind].region, pose)
            for kind, pose in zip(one.kinds, one.poses, strict=True)
        )
        self.sheets[one.sheet] = FreeSheet(sheet.region, (*sheet.held, *regions))
        self.room[one.sheet] = self.sheets[one.sheet].area
        if before is not None:
            one = LaidSheet(
                one.sheet, before.kinds + one.kinds, np.vstack([before.poses, one.poses])
            )
        self.laid[one.sheet] = one

    def _taken(self, queue: Sequence[int], room: float) -> int:
        """Number of parts at the head of a queue that a window takes; all where few are left."""
        sums = np.cumsum(self.areas[list(queue)])
        if sums[-1] <= 1.5 * room and len(queue) <= MOST_IN_WINDOW:
            return len(queue)
        return min(max(int(np.searchsorted(sums, room)), 1), MOST_IN_WINDOW)
