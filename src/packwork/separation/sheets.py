"""Sheets, as few as possible and of the last one as little as possible."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Iterable, Sequence
from dataclasses import replace

import numpy as np
import shapely

from packwork.separation.double_lattice import laid_on_sheet
from packwork.separation.shapes import Floats
from packwork.separation.strip import PATIENCE_AT_END, SHRINKS, Strip, StripSearch

SPARSE, MUCH_LONGER = 0.45, 1.5
"""Density at which parts are brought in first, and how much longer the sheets are cut off where
some have no room: sheets may be narrow at an end."""

BROUGHT_IN = 0.95
"""Share of the work after which parts are no longer moved for others, but laid where these leave
room, which takes a pass for each kind and each part that has room. Chosen."""

FIRST_PATIENCE = 30
"""Passes without a lower loss after which a part goes back at first."""

FILL_PATIENCE = 10
"""Passes without a lower loss after which a sheet that is being filled is not made shorter. Tried:
of 30, fewer tries have time."""

AT_ONCE = 16
"""Parts that are laid by first fit between two looks at whether to end: some milliseconds."""


class SheetSearch(StripSearch):
    """Search over sheets: parts are brought in, and the last sheet is shortened until it is empty.

    What finds no room is not laid.
    """

    def fallback(self) -> Strip:
        """Empty sheets."""
        parts, kinds, count = self.problem.parts, self.problem.shape_of, len(self.problem)
        self.priorities = np.array([part.priority for part in parts])[kinds]
        return Strip(self.ground.end, np.full((count, 4), np.nan), np.full(count, np.inf))

    def first_poses(self, length: float) -> Floats:
        """No part is laid."""
        return self.best.poses

    def lay_lattice(self) -> bool:
        """Lay parts that are all alike on their densest lattice, a sheet after the other."""
        if not self.is_alike:
            return False
        part, poses, at = self.problem.parts[0], self.best.poses.copy(), 0
        for bay in self.ground.bays:
            if at == len(poses):
                break
            taken = tuple(
                shapely.transform(one, lambda points, x=bay.start: points - (x, 0.0))
                for one in self.ground.obstacles
                if one.bounds[0] < bay.end and one.bounds[2] > bay.start
            )
            left = replace(part, count=len(poses) - at)
            found = laid_on_sheet(left, bay.end - bay.start, self.ground.height, taken)
            poses[at : at + len(found)] = found + np.array([bay.start, 0.0, 0.0, 0.0])
            at += len(found)
        self.put(self.ground.end, poses)
        if at and self.layout.loss == 0.0:
            self.keep(poses)
        return at > 0 and self.layout.loss == 0.0

    def lay_all(self, until: float) -> None:
        """Bring all parts onto the sheets that have to be."""
        length = self.ground.length_for(self.problem.area / SPARSE)
        if self.lay_lattice():
            length = max(length, self.best.length)
        self.bring_in(min(max(length, self.problem.widest), self.ground.end), until)

    def bring_in(self, length: float, until: float) -> None:
        """Bring parts onto the sheets, the largest first: by first fit, then in batches.

        Those for which there is no room go back, and have another turn when all others had theirs.
        ``length``: where the sheets are cut off at first.
        """
        waiting = deque(self.first_fit(self.unlaid(), length, until))
        failed, patience, kinds = 0, FIRST_PATIENCE, self.problem.shape_of
        batch = math.ceil(len(waiting) / 2)
        while waiting and not self.is_over(BROUGHT_IN * until):
            if failed >= len(waiting):
                # None of them has room: on a longer stretch, or with more patience.
                if length < self.ground.end:
                    length = self.ground.skip_forward(length * MUCH_LONGER, self.problem.widest)
                    waiting = deque(self.first_fit(waiting, length, until))
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
        # What fits beside the others, or else on empty ground, is laid all the same.
        last = int(self.ground.bay_at(np.array([self.best.length]))[0])
        for bay in dict.fromkeys((self.ground.bays[last], self.ground.bays[-1])):
            if not self.stop():
                waiting = deque(self.first_fit(waiting, bay.end, math.inf))

    def unlaid(self) -> list[int]:
        """Parts that are not laid, the largest of the highest priority first."""
        order = np.lexsort((-self.problem.hulls, -self.priorities))
        return [int(k) for k in order if np.isnan(self.best.poses[k, 0])]

    def first_fit(self, parts: Iterable[int], length: float, until: float) -> list[int]:
        """Lay parts where nothing has to give way; returns those that found no such place."""
        order, layout = np.array([*parts], np.int64), self.layout
        full = np.zeros(len(self.problem.parts), np.bool_)
        self.put(length, self.best.poses, fresh=True)
        for at in range(0, len(order), AT_ONCE):
            if self.is_over(until):
                break
            self.work.priced += layout.first_fit(order[at : at + AT_ONCE], full)
        self.put(length, layout.poses)
        poses = layout.poses
        # What two parts say of each other may differ by rounding.
        poses[order[(layout.losses[order] > 0.0).any(axis=1)]] = np.nan
        self.put(length, poses)
        is_laid = ~np.isnan(poses[order, 0])
        if is_laid.any():
            self.keep(poses)
        return [int(part) for part in order[~is_laid]]

    def add(self, parts: Sequence[int], length: float) -> None:
        """Put parts anywhere among those that lie."""
        poses = self.best.poses.copy()
        poses[parts] = super().first_poses(length)[parts]
        self.put(length, poses, fresh=True)

    def run(self, *, shrinks: bool = True) -> Strip:
        """Lay all parts, then explore and compress; the fewest sheets that were met.

        ``shrinks``: whether parts that all lie are brought closer together.
        """
        with self.pool:
            self.step()
            self.work.start()
            self.lay_all(1.0)
            return self.shorten() if shrinks and not self.best.left else self.best

    def fill(self) -> Strip:
        """Lay what has room, of more than enough: the largest first, where nothing gives way.

        Then parts are moved closer together, and others take what is left, as long as there is
        work. However little there is, all are tried once.
        """
        with self.pool:
            self.step()
            self.work.start()
            end = self.ground.end
            self.lay_lattice()
            waiting = self.first_fit(self.unlaid(), end, math.inf)
            while waiting and len(waiting) < len(self.problem) and not self.is_over(1.0):
                self.close_up(1.0)
                waiting = self.first_fit(waiting, end, math.inf)
            return self.best

    def close_up(self, until: float) -> None:
        """Shorten what parts take, as long as each step succeeds."""
        passes, loss = 0, 0.0
        while loss == 0.0 and not self.is_over(until):
            share = next(share for most, share in SHRINKS if passes <= most)
            self.shorter(self.best, share)
            loss, poses, passes = self.separate(FILL_PATIENCE, until, 1)
            if loss == 0.0:
                self.keep(poses)

    def begin_anew(self, until: float) -> None:
        """Go on from the shortest: to bring all parts in again is dear."""
        del until
        self.best = self.shortest
