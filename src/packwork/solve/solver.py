"""From first poses to good ones: levels, Adam, the herder between levels."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass, field
from enum import Enum

import numpy as np

from packwork.arrays import FloatArray
from packwork.geometry.outline import Outline
from packwork.progress import Observer, Step, Stop, never
from packwork.scene.container import Container
from packwork.scene.pose import Poses
from packwork.solve.detail import seen_at
from packwork.solve.herd import Rescue, herd
from packwork.solve.level import Level
from packwork.solve.motion import Motion
from packwork.solve.options import SolveOptions
from packwork.solve.schedule import epochs_per_level, rate_factor, weights_at


class Ending(Enum):
    """Why a run ended."""

    DONE = "all epochs were run"
    STOPPED = "the run was stopped before its last epoch"


@dataclass(frozen=True)
class LevelReport:
    """What one level did: its size, time, shares at its end and rescues after it."""

    resolution: int
    epochs: int
    seconds: float
    coverage: float
    overlap: float
    outside: float
    rescues: tuple[Rescue, ...] = ()


@dataclass(frozen=True, eq=False)
class Outcome:
    """Result of a solve."""

    poses: Poses
    ending: Ending
    levels: list[LevelReport] = field(default_factory=list)


def solve(
    container: Container,
    outlines: Sequence[Outline],
    start: Poses,
    nominal: FloatArray,
    options: SolveOptions,
    observer: Observer | None = None,
    stop: Stop = never,
) -> Outcome:
    """Move, turn and size items so that they fill the container and do not overlap.

    Wang and Lu 2025, section 3. Deterministic: no randomness, fixed order of sums.

    Parameters
    ----------
    container
        The region to fill.
    outlines
        One per item, item units, origin at its centroid.
    start
        First poses.
    nominal
        ``(n,)`` scales that weights ask for: the middle of the range in mode free, the
        proportions in mode shared.
    options
        Levels, epochs, modes, steps.
    observer
        Told of progress.
    stop
        Asked before every epoch; True ends the run.
    """
    run = _Run(container, outlines, start, nominal, options, observer, stop)
    shares = epochs_per_level(options.epochs, options.shares or [1.0] * len(options.levels))
    reports = []
    for index, epochs in enumerate(shares):
        reports.append(run.level(index, epochs))
        if run.is_stopped:
            return Outcome(run.motion.poses, Ending.STOPPED, reports)
    return Outcome(run.motion.poses, Ending.DONE, reports)


class _Run:
    """State of one solve between its epochs."""

    def __init__(
        self,
        container: Container,
        outlines: Sequence[Outline],
        start: Poses,
        nominal: FloatArray,
        options: SolveOptions,
        observer: Observer | None,
        stop: Stop,
    ) -> None:
        self.motion = Motion(start, nominal, container.side, options)
        self.is_stopped = False
        self._container, self._outlines, self._nominal = container, outlines, nominal
        self._areas = np.array([o.area for o in outlines])
        self._options, self._observer, self._stop = options, observer, stop
        self._done = 0

    def level(self, index: int, epochs: int) -> LevelReport:
        """Run one level, and the herder when it is due."""
        began = time.perf_counter()
        resolution = self._options.levels[index]
        px_per_cu = resolution / self._container.side
        scales, margin = self.motion.poses.scale, self._options.margin
        seen = seen_at(self._outlines, scales, px_per_cu, margin)
        level = Level(self._container, seen, resolution, self._options.losses)
        is_last = index == len(self._options.levels) - 1
        herding = epochs // 2 if is_last else epochs
        rescues: list[Rescue] = []
        before = self._done
        for epoch in range(1, epochs + 1):
            if self._stop():
                self.is_stopped = True
                break
            self._epoch(level)
            if epoch == herding and self._options.herd:
                rescues = self._herd(level)
            self._tell(level, index, epoch, epochs)
        shares = level.shares(level.density(self.motion.poses))
        done = self._done - before
        seconds = time.perf_counter() - began
        return LevelReport(resolution, done, seconds, *shares, rescues=tuple(rescues))

    def _epoch(self, level: Level) -> None:
        progress = self._done / max(self._options.epochs - 1, 1)
        gradient = level.gradient(self.motion.poses, weights_at(self._options, progress))
        self.motion.follow(gradient, rate_factor(self._options, progress))
        self._done += 1

    def _herd(self, level: Level) -> list[Rescue]:
        poses = self.motion.poses
        bounds = scale_bounds(self._nominal, poses.scale, self._options)
        moved, rescues = herd(level, poses, self._areas, *bounds)
        self.motion.replace(moved, [rescue.item for rescue in rescues])
        return rescues

    def _tell(self, level: Level, index: int, epoch: int, epochs: int) -> None:
        observer = self._observer
        if observer is None or ((epoch - 1) % observer.every and epoch != epochs):
            return
        poses = self.motion.poses
        observer.on_step(
            Step(
                index, len(self._options.levels), level.resolution, self._done,
                self._options.epochs, poses, *level.shares(level.density(poses)),
            )
        )  # fmt: skip


def scale_bounds(
    nominal: FloatArray, scale: FloatArray, options: SolveOptions
) -> tuple[FloatArray, FloatArray]:
    """Smallest and largest scale of each item, ``(n,)`` each."""
    if options.sizes == "free":
        return nominal / options.size_ratio, nominal * options.size_ratio
    return scale, scale
