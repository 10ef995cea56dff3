"""Sheets, as few as possible and of the last one as little as possible."""

from __future__ import annotations

from collections import deque

import numpy as np

from packwork.separation.shapes import Floats
from packwork.separation.strip import EXPLORED, LONGER, PATIENCE_AT_END, Strip, StripSearch

FIRST_BATCH = 0.1
"""Share of all parts that are brought onto the sheets at once at first."""

BATCH_PATIENCE = 30
"""Passes without a lower loss after which a batch is halved."""


class SheetSearch(StripSearch):
    """Search over sheets: parts are brought in, the last sheet is shortened until it is empty.

    What finds no room is not laid.
    """

    def fallback(self) -> Strip:
        """Empty sheets."""
        count = len(self.problem)
        return Strip(self.ground.end, np.full((count, 3), np.nan), np.full(count, np.inf))

    def first_poses(self, length: float) -> Floats:
        """No part is laid."""
        return self.best.poses

    def lay_all(self, until: float) -> None:
        """Bring parts onto the sheets, the largest first, in ever smaller batches.

        Those for which there is no room go back, and have another turn when all others had theirs.
        """
        waiting = deque(np.argsort(-self.problem.hulls, kind="stable"))
        length, batch = self.layout.sheet[0], int(np.ceil(FIRST_BATCH * len(waiting)))
        failed, patience = 0, BATCH_PATIENCE
        while waiting and not self.is_over(until):
            if failed >= len(waiting):
                # None of them has room: on a longer stretch, or with more patience.
                if length < self.ground.end:
                    length = self.ground.next_length(length * LONGER, self.problem.widest)
                else:
                    patience = min(2 * patience, PATIENCE_AT_END)
                failed = 0
            chosen = [waiting.popleft() for _ in range(min(batch, len(waiting)))]
            poses = self.best.poses.copy()
            poses[chosen] = super().first_poses(length)[chosen]
            self.put(length, poses, fresh=True)
            loss, poses, _ = self.separate(patience, until, 1)
            if loss == 0.0:
                self.keep(poses)
                failed = 0
            elif batch > 1:
                waiting.extendleft(reversed(chosen))
                batch = (batch + 1) // 2
            else:
                # Where one has no room, its like have none.
                kinds, kind = self.problem.shape_of, self.problem.shape_of[chosen[0]]
                alike = [*chosen, *(part for part in waiting if kinds[part] == kind)]
                waiting = deque(part for part in waiting if kinds[part] != kind)
                waiting.extend(alike)
                failed += len(alike)

    def run(self) -> Strip:
        """Lay all parts, explore, compress; the fewest sheets that were met."""
        with self.pool:
            self.step()
            self.work.start()
            self.lay_all(1.0)
            if not np.isnan(self.best.poses).any():
                self.explore(EXPLORED)
                self.compress(self.best)
            return self.best
