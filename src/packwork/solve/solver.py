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
from packwork.solve.adam import Adam
from packwork.solve.herd import Rescue, herd
from packwork.solve.level import Level
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


class _Motion:
    """Poses being changed step by step, within their bounds."""

    def __init__(self, poses: Poses, nominal: FloatArray, side: float, options: SolveOptions):
        self._options = options
        self._side = side
        n = len(poses)
        self.x, self.y = poses.x.copy(), poses.y.copy()
        self.angle = poses.angle.copy()
        self._nominal = np.log(nominal)
        self._growth = np.log(poses.scale) - self._nominal
        self._moves, self._turns = Adam((n, 2)), Adam((n, 1))
        self._sizes = Adam((1 if options.sizes == "shared" else n, 1))

    @property
    def poses(self) -> Poses:
        return Poses(
            self.x.copy(), self.y.copy(), self.angle.copy(), np.exp(self._nominal + self._growth)
        )

    def follow(self, gradient: FloatArray, factor: float) -> None:
        """One step against the pose gradient, at ``factor`` of the full rates."""
        options = self._options
        move = self._moves.step(gradient[:, :2], options.position_rate * self._side * factor)
        self.x += move[:, 0]
        self.y += move[:, 1]
        if options.turn_rate > 0:
            self.angle += self._turns.step(gradient[:, 2:3], options.turn_rate * factor)[:, 0]
            if options.turn_limit is not None:
                np.clip(self.angle, -options.turn_limit, options.turn_limit, out=self.angle)
        self._resize(gradient[:, 3:4], options.size_rate * factor)

    def _resize(self, gradient: FloatArray, rate: float) -> None:
        if self._options.sizes == "free":
            bound = np.log(self._options.size_ratio)
            self._growth += self._sizes.step(gradient, rate)[:, 0]
            np.clip(self._growth, -bound, bound, out=self._growth)
        elif self._options.sizes == "shared":
            total = gradient.sum(axis=0, keepdims=True)
            self._growth += self._sizes.step(total, rate)[0, 0]

    def replace(self, poses: Poses, items: list[int]) -> None:
        """Take over poses in which ``items`` were moved by force."""
        self.x, self.y, self.angle = poses.x.copy(), poses.y.copy(), poses.angle.copy()
        self._growth = np.log(poses.scale) - self._nominal
        self._moves.forget(items)
        self._turns.forget(items)
        if self._options.sizes == "free":
            self._sizes.forget(items)


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
    motion = _Motion(start, nominal, container.side, options)
    areas = np.array([o.area for o in outlines])
    shares = epochs_per_level(options.epochs, len(options.levels))
    reports: list[LevelReport] = []
    done = 0
    for index, (resolution, epochs) in enumerate(zip(options.levels, shares, strict=True)):
        began = time.perf_counter()
        level = Level(container, outlines, motion.poses.scale, resolution, options.losses)
        for epoch in range(epochs):
            if stop():
                return Outcome(motion.poses, Ending.STOPPED, reports)
            progress = done / max(options.epochs - 1, 1)
            gradient = level.gradient(motion.poses, weights_at(options, progress))
            motion.follow(gradient, rate_factor(options, progress))
            done += 1
            if observer is not None and (epoch % observer.every == 0 or epoch == epochs - 1):
                observer.on_step(_step(level, index, options, done, motion.poses))
        rescues: list[Rescue] = []
        if options.herd and index < len(options.levels) - 1:
            smallest, largest = scale_bounds(nominal, motion.poses.scale, options)
            poses, rescues = herd(level, motion.poses, areas, smallest, largest)
            motion.replace(poses, [r.item for r in rescues])
        reports.append(_report(level, epochs, began, motion.poses, rescues))
    return Outcome(motion.poses, Ending.DONE, reports)


def scale_bounds(
    nominal: FloatArray, scale: FloatArray, options: SolveOptions
) -> tuple[FloatArray, FloatArray]:
    """Smallest and largest scale of each item, ``(n,)`` each."""
    if options.sizes == "free":
        return nominal / options.size_ratio, nominal * options.size_ratio
    return scale, scale


def _step(level: Level, index: int, options: SolveOptions, done: int, poses: Poses) -> Step:
    coverage, overlap, outside = level.shares(level.density(poses))
    return Step(
        index, len(options.levels), level.resolution, done, options.epochs, poses,
        coverage, overlap, outside,
    )  # fmt: skip


def _report(
    level: Level, epochs: int, began: float, poses: Poses, rescues: list[Rescue]
) -> LevelReport:
    seconds = time.perf_counter() - began
    shares = level.shares(level.density(poses))
    return LevelReport(level.resolution, epochs, seconds, *shares, rescues=tuple(rescues))
