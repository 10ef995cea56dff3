"""Sheets, as few as possible and of the last one as little as possible."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Iterable, Sequence

import numpy as np
import numpy.typing as npt

from packwork.separation.shapes import Floats
from packwork.separation.strip import EXPLORED, PATIENCE_AT_END, Strip, StripSearch

SPARSE, MUCH_LONGER = 0.45, 1.5
"""Density at which parts are brought in first, and how much longer the sheets are cut off where
some have no room: sheets may be narrow at an end."""

FIRST_PATIENCE = 30
"""Passes without a lower loss after which a part goes back at first."""

FILLING = 0.2
"""Share of the work that optional parts have, where there are some."""

Indices = npt.NDArray[np.int64]


class SheetSearch(StripSearch):
    """Search over sheets: parts are brought in, and the last sheet is shortened until it is empty.

    What finds no room is not laid.
    """

    def fallback(self) -> Strip:
        """Empty sheets."""
        parts, kinds, count = self.problem.parts, self.problem.shape_of, len(self.problem)
        self.priorities = np.array([part.priority for part in parts])[kinds]
        self.is_optional = np.array([part.is_optional for part in parts])[kinds]
        return Strip(self.ground.end, np.full((count, 4), np.nan), np.full(count, np.inf))

    def first_poses(self, length: float) -> Floats:
        """No part is laid."""
        return self.best.poses

    def lay_all(self, until: float) -> None:
        """Bring all parts onto the sheets that have to be."""
        problem = self.problem
        required = np.flatnonzero(~self.is_optional)
        area = float(problem.areas[required].sum())
        length = min(max(self.ground.length_for(area / SPARSE), problem.widest), self.ground.end)
        self.bring_in(required, length, self.ground.end, until)

    def bring_in(self, parts: Indices, length: float, longest: float, until: float) -> None:
        """Bring parts onto the sheets, the largest first: by first fit, then in batches.

        Those for which there is no room go back, and have another turn when all others had theirs.

        Parameters
        ----------
        length, longest
            Where the sheets are cut off at first, and at last.
        """
        order = np.lexsort((-self.problem.hulls[parts], -self.priorities[parts]))
        waiting = deque(self.first_fit(parts[order].tolist(), length))
        failed, patience, kinds = 0, FIRST_PATIENCE, self.problem.shape_of
        batch = math.ceil(len(waiting) / 2)
        while waiting and not self.is_over(until):
            if failed >= len(waiting):
                # None of them has room: on a longer stretch, or with more patience.
                if length < longest:
                    longer = self.ground.next_length(length * MUCH_LONGER, self.problem.widest)
                    length = min(longer, longest)
                    waiting = deque(self.first_fit(waiting, length))
                else:
                    patience = min(2 * patience, PATIENCE_AT_END)
                failed = 0
                continue
            chosen = [waiting.popleft() for _ in range(min(batch, len(waiting)))]
            self.add(chosen, length)
            loss, poses, _ = self.separate(patience, until, 1)
            if loss == 0.0:
                self.keep(poses)
                failed = 0
            elif batch > 1:
                waiting.extendleft(reversed(chosen))
                batch = (batch + 1) // 2
            else:
                # Where one has no room, its like have none.
                kind = kinds[chosen[0]]
                alike = [*chosen, *(k for k in waiting if kinds[k] == kind)]
                waiting = deque(k for k in waiting if kinds[k] != kind)
                waiting.extend(alike)
                failed += len(alike)
        if waiting and length < longest and not self.stop():
            # The work is done: what fits on empty ground is laid all the same.
            self.first_fit(waiting, longest)

    def first_fit(self, parts: Iterable[int], length: float) -> list[int]:
        """Lay parts where nothing has to give way; returns those that found no such place."""
        left, full = list[int](), set[int]()
        for part in parts:
            kind = int(self.problem.shape_of[part])
            if kind in full or self.stop():
                left.append(part)
                continue
            self.add([part], length)
            self.step()
            self.put(length, self.layout.poses)
            if self.layout.loss == 0.0:
                self.keep(self.layout.poses)
            else:
                full.add(kind)
                left.append(part)
        return left

    def add(self, parts: Sequence[int], length: float) -> None:
        """Put parts anywhere among those that lie."""
        poses = self.best.poses.copy()
        poses[parts] = super().first_poses(length)[parts]
        self.put(length, poses, fresh=True)

    def run(self) -> Strip:
        """Lay all parts, explore, compress, fill up with optional ones; the fewest sheets met."""
        is_optional = self.is_optional
        fills_up = bool(is_optional.any())
        with self.pool:
            self.step()
            self.work.start()
            self.lay_all(1.0)
            if np.isnan(self.best.poses[~is_optional]).any():
                return self.best
            if not is_optional.all():
                self.explore(EXPLORED - FILLING if fills_up else EXPLORED)
                self.compress(self.best, 1.0 - FILLING if fills_up else 1.0)
            if fills_up:
                optional, length = np.flatnonzero(is_optional), self.ground.end_at(self.best.length)
                self.bring_in(optional, length, length, 1.0)
            return self.best
