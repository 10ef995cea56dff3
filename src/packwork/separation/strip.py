"""A strip of given height, as short as possible: ever shorter, then compressed."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import numpy as np

from packwork.separation.compact import StripCompaction
from packwork.separation.double_lattice import laid_on_lattice
from packwork.separation.ground import Ground
from packwork.separation.kernels.collision import X0, X1, Y1
from packwork.separation.shapes import Floats, Part, flattest
from packwork.separation.state import Problem, WorkerState

START, LONGER = 0.55, 1.1
"""Density of the first strip, and how much longer the next one is where parts do not come apart."""

PATIENCE, PATIENCE_AT_END = 200, 100
"""Passes without a lower loss after which an attempt counts as a strike."""

STRIKES = 3
PROGRESS = 0.98
"""Share of the lowest loss so far below which a pass counts as progress."""

SHRINKS = ((3, 0.01), (15, 0.004), (math.inf, 0.001))
"""By how much a strip is shortened, by the passes that the one before took."""

LABOUR = 15
"""Passes above which a layout was hard to reach: those are compacted. Of others the next is as
easily reached. Chosen."""

EXPLORED = 0.8
"""Share of the work after which strips are only compressed."""

CLOSEST, FINEST = 0.0005, 0.00001
"""Shares of its length by which a strip is compressed at first, and at last."""

DEAD_ENDS, GAIN = 30, 0.001
"""Dead ends in a row after which a search begins anew, and the share of a strip's length that
counts as gained. More sit longer where nothing is found, fewer leave what could still be shortened;
so many take most of a minute. Chosen."""

LATTICE_FROM = 6
"""Parts of one kind from which on they are laid on a lattice first. Chosen."""

LARGE_QUANTILE = 0.75
"""Parts that are exchanged to leave a dead end have hulls above that quantile of all area."""

SPREAD = 0.25
"""Reach of a new attempt down the list of failures, in deviations of its length."""


PASS_PLACES = 100
"""Places whose pricing takes about as long as all else in a worker's pass: an estimate."""


@dataclass
class WorkBound:
    """Work that a search may do: passes, places or seconds, whichever ends first."""

    passes: float = math.inf
    seconds: float = math.inf
    name: str = ""
    """Of an effort, where the bound is one."""
    places: float = math.inf
    """Places that may be priced, by all workers together."""
    begun: float = math.nan
    done: int = 0
    """Passes."""
    priced: int = 0
    best_so_far: str = "searching"
    """For people who wait."""
    margins: float = 0.0
    """What the sheet has beyond the length that is searched, told with it."""

    def start(self) -> None:
        """Count from now on."""
        self.begun, self.done, self.priced = time.perf_counter(), 0, 0

    def part(self, share: float) -> WorkBound:
        """Bound of a share of the work that is left."""
        left = self.seconds - (time.perf_counter() - self.begun)
        return WorkBound(
            max((self.passes - self.done) * share, 1.0), max(left * share, 1e-9),
            places=max((self.places - self.priced) * share, 1.0),
        )  # fmt: skip

    def add(self, part: WorkBound) -> None:
        """Count what was done within a part."""
        self.done += part.done
        self.priced += part.priced

    @property
    def share(self) -> float:
        """Share of the work that is done."""
        elapsed = time.perf_counter() - self.begun
        counted = max(self.done / self.passes, self.priced / self.places)
        return max(counted, elapsed / max(self.seconds, 1e-9))


@dataclass(frozen=True)
class Strip:
    """Poses of all parts, none of which overlaps another, and the strip's length.

    ``poses``: x, y, angle and side (-1: mirrored), NaN for those that found no room; ``lefts``: the
    left edges of the parts' boxes.
    """

    length: float
    poses: Floats
    lefts: Floats

    @property
    def left(self) -> int:
        """Number of parts that found no room."""
        return int(np.isnan(self.poses[:, 0]).sum())

    def rank(self) -> tuple[int, float]:
        """Order of strips, the best first: by what is left, then by length."""
        return self.left, self.length


class StripSearch:
    """Search over strips of one problem, by workers that start each pass from the same layout."""

    def __init__(
        self, parts: Sequence[Part], ground: Ground, *, seed: int = 0, workers: int = 2,
        work: WorkBound, stop: Callable[[], bool] = lambda: False,
    ) -> None:  # fmt: skip
        self.problem, self.ground = Problem(parts, ground), ground
        self.random = np.random.default_rng(seed)
        self.work, self.stop = work, stop
        self.best = self.shortest = self.fallback()
        length = self.first_length()
        poses = self.first_poses(length)
        self.workers = [
            WorkerState.of(self.problem, length, poses, int(word))
            for word in self.random.integers(1, 2**63, workers)
        ]
        self.pool = ThreadPoolExecutor(workers)

    def first_length(self) -> float:
        """Length of the strip on which parts are strewn at first."""
        length = self.ground.length_for(self.problem.area / START)
        return min(max(length, self.problem.widest), self.best.length)

    def fallback(self) -> Strip:
        """All parts in columns, so that there is always a strip to show."""
        return self.columns(self.ground.height)

    def columns(self, height: float) -> Strip:
        """All parts beside one another by their boxes, in columns up to a height."""
        problem = self.problem
        boxes, angles = flattest(problem.parts, height)
        poses = np.ones((len(problem), 4))
        lefts = np.zeros(len(problem))
        left = top = wide = 0.0
        for i in np.argsort(-np.ptp(boxes[problem.shape_of][:, ::2], axis=1), kind="stable"):
            x0, y0, x1, y1 = boxes[problem.shape_of[i]]
            if top + (y1 - y0) > height:
                left, top, wide = left + wide, 0.0, 0.0
            poses[i, :3] = left - x0, top - y0, angles[problem.shape_of[i]]
            lefts[i] = left
            top, wide = top + (y1 - y0), max(wide, x1 - x0)
        return Strip(left + wide, poses, lefts)

    def first_poses(self, length: float) -> Floats:
        """Poses from which the search starts: anywhere on the strip."""
        count, table = len(self.problem), self.problem.turns
        rows = self.random.integers(*table.turn_at[np.add.outer([0, 1], self.problem.shape_of)])
        x = self.random.uniform(0.0, length, count)
        y = self.random.uniform(0.0, self.ground.height_at(length), count)
        return np.column_stack([x, y, table.turns[2, rows], table.turns[3, rows]])

    @property
    def layout(self) -> WorkerState:
        """That of the first worker, which all start from."""
        return self.workers[0]

    def step(self) -> None:
        """Run one pass in each worker; all go on from the one of the lowest weighted loss."""
        priced = sum(self.pool.map(WorkerState.move, self.workers))
        best = min(range(len(self.workers)), key=lambda k: (self.workers[k].weighted, k))
        for k, worker in enumerate(self.workers):
            if k != best:
                worker.take(self.workers[best])
        for worker in self.workers:
            worker.raise_weights()
        self.work.done += 1
        self.work.priced += priced + PASS_PLACES * len(self.workers)

    def put(self, length: float, poses: Floats, *, fresh: bool = False) -> None:
        """Give all workers a length and poses; ``fresh``: and weights of 1."""
        for worker in self.workers:
            if fresh:
                worker.weights[:] = 1.0
            worker.set_length(length, poses)

    def separate(
        self, patience: int, until: float, most_strikes: int = STRIKES
    ) -> tuple[float, Floats, int]:
        """Move parts until none overlaps, or for some strikes.

        Returns the lowest loss that was met, its poses, and how many passes it took.
        """
        lowest, poses, passes, strikes = self.layout.loss, self.layout.poses, 0, 0
        while strikes < most_strikes and lowest > 0.0 and not self.is_over(until):
            begun, waited = lowest, 0
            while waited < patience and lowest > 0.0 and not self.is_over(until):
                self.step()
                passes += 1
                loss = self.layout.loss
                waited = 0 if loss < PROGRESS * lowest else waited + 1
                if loss < lowest:
                    lowest, poses = loss, self.layout.poses
            if lowest > 0.0:
                self.put(self.layout.sheet[0], poses)
            strikes = 0 if lowest < PROGRESS * begun else strikes + 1
        if lowest == 0.0:
            # Worked out anew, from the poses alone.
            self.put(self.layout.sheet[0], poses)
            lowest = self.layout.loss
        return lowest, poses, passes

    def keep(self, poses: Floats) -> Strip:
        """Remember a layout without overlaps, on a strip no longer than need be."""
        boxes = self.layout.arrays[0][:, : len(self.problem)]
        self.best = Strip(self.extent(boxes), poses, boxes[X0].copy())
        self.shortest = min(self.shortest, self.best, key=Strip.rank)
        left = self.shortest.left
        told = f"{self.ground.measure} {self.shortest.length + self.work.margins:.5g}"
        self.work.best_so_far = f"{left} parts left" if left else told
        return self.best

    def compacted(self, strip: Strip, share: float) -> Strip:
        """Move all parts together as long as a step shortens the strip by that share."""
        last = np.isfinite(strip.poses[:, 0])
        last &= strip.lefts >= self.ground.start_at(strip.length)
        compaction = StripCompaction(self.problem, strip.poses, last, strip.length)
        self.put(strip.length, compaction.run(share))
        # A step takes about as long for each part as to price a place.
        self.work.priced += compaction.steps * len(compaction.moving)
        shorter = self.extent(self.layout.arrays[0][:, : len(self.problem)]) < strip.length
        return self.keep(self.layout.poses) if shorter and self.layout.loss == 0.0 else strip

    def extent(self, boxes: Floats) -> float:
        """Length that parts with these boxes need."""
        return float(boxes[[X1, Y1][: len(self.ground.axes)]].max())

    def shorter(self, best: Strip, share: float) -> None:
        """Cut a share of the length out of the last sheet; what lies beyond the cut moves."""
        cut = best.length * share
        poses = best.poses.copy()
        for axis in self.ground.axes:
            line = self.random.uniform(self.ground.start_at(best.length), best.length)
            poses[poses[:, axis] > line, axis] -= cut
        length = self.ground.skip_back(best.length - cut, self.problem.narrowest)
        self.put(length, poses, fresh=True)

    @property
    def is_alike(self) -> bool:
        """Whether there is one kind of parts, and not few of it."""
        return len(self.problem.parts) == 1 and len(self.problem) >= LATTICE_FROM

    def lay_lattice(self) -> bool:
        """Lay parts that are all alike on their densest lattice, cropped; whether that is shorter.

        Few are laid better one by one.
        """
        if not self.is_alike:
            return False
        found = laid_on_lattice(self.problem.parts[0], self.ground.height)
        if found is None or found[0] >= self.best.length:
            return False
        self.put(*found)
        if self.layout.loss == 0.0:
            self.keep(found[1])
        return self.layout.loss == 0.0

    def lay_all(self, until: float) -> None:
        """Lay all parts without overlap, on ever longer strips; the fallback is the longest."""
        while not self.is_over(until):
            loss, poses, _ = self.separate(PATIENCE, until)
            if loss == 0.0:
                self.keep(poses)
                return
            length = min(self.layout.sheet[0] * LONGER, self.best.length)
            self.put(length, self.first_poses(length), fresh=True)

    def explore(self, until: float) -> None:
        """Shorten the strip again and again; from a dead end, go on from an earlier failure.

        Ends where that is in vain: after many dead ends, which took as much work as all gains.
        """
        failures: list[tuple[float, Floats]] = []
        begun, gained, dead_ends, worth = self.work.done, self.work.done, 0, self.best.length
        self.shorter(self.best, SHRINKS[0][1])
        while not self.is_over(until):
            loss, poses, passes = self.separate(PATIENCE, until)
            if loss == 0.0:
                failures = []
                share = next(share for most, share in SHRINKS if passes <= most)
                strip = self.keep(poses)
                if passes > LABOUR:
                    strip = self.compacted(strip, share)
                if strip.length < (1.0 - GAIN) * worth:
                    gained, dead_ends, worth = self.work.done, 0, strip.length
                self.shorter(strip, share)
                continue
            dead_ends += 1
            if dead_ends >= DEAD_ENDS and self.work.done - gained > gained - begun:
                return
            failures.append((loss, poses))
            failures.sort(key=lambda one: one[0])
            far = min(abs(self.random.normal(0.0, SPREAD)), 0.999)
            start = failures[int(far * len(failures))][1]
            self.put(self.layout.sheet[0], self.disrupted(start), fresh=True)

    def begin_anew(self, until: float) -> None:
        """Lay all parts from other places."""
        self.best = self.fallback()
        length = self.first_length()
        self.put(length, self.first_poses(length), fresh=True)
        self.lay_all(until)

    def shorten(self) -> Strip:
        """Explore, from other places again where that gains nothing; compress the shortest."""
        self.explore(EXPLORED)
        while not self.is_over(EXPLORED):
            self.begin_anew(EXPLORED)
            self.explore(EXPLORED)
        return self.compress(self.shortest)

    def disrupted(self, poses: Floats) -> Floats:
        """Exchange two large parts of different shape."""
        hulls = np.where(np.isnan(poses[:, 0]), 0.0, self.problem.hulls)
        order = np.argsort(hulls)
        above = np.cumsum(hulls[order]) >= (1.0 - LARGE_QUANTILE) * hulls.sum()
        large = self.random.permutation(order[above])
        kinds = self.problem.shape_of[large]
        others = large[kinds != kinds[0]]
        poses = poses.copy()
        first, second = large[0], (others[0] if len(others) else large[-1])
        poses[[first, second], :2] = poses[[second, first], :2]
        return poses

    def compress(self, best: Strip, until: float = 1.0) -> Strip:
        """Shorten a strip by ever less, and take back what does not succeed."""
        begun = self.work.share
        if not self.is_over(until):
            best = self.compacted(best, FINEST)
        while not self.is_over(until):
            done = (self.work.share - begun) / max(until - begun, 1e-9)
            share = CLOSEST * (FINEST / CLOSEST) ** min(done, 1.0)
            self.shorter(best, share)
            loss, poses, _ = self.separate(PATIENCE_AT_END, until)
            if loss == 0.0:
                best = self.compacted(self.keep(poses), share)
        return best

    def run(self) -> Strip:
        """Explore, compress, and give the shortest strip that was met."""
        with self.pool:
            # Not counted: kernels are compiled in the first pass of all.
            self.step()
            self.work.start()
            if not self.lay_lattice():
                self.lay_all(EXPLORED)
            return self.shorten()

    def is_over(self, until: float) -> bool:
        """Whether a share of the work is done, or nobody waits for more."""
        return self.work.share >= until or self.stop()
