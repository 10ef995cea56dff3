"""Image-space optimisation: from first poses to good ones by levels, Adam and relocations.

Wang and Lu, "Image-Space Collage and Packing with Differentiable Rendering", SIGGRAPH 2025,
doi:10.1145/3721238.3730690, arXiv:2406.04008. Ours renders the sum of coverages, with exact
gradients on boundaries, works through a pyramid of outlines beside that of images, and relocates
what is trapped.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass, field
from enum import Enum

import numpy as np

from packwork.arrays import FloatArray
from packwork.forces.forces import NO_FORCES, Forces
from packwork.geometry.outline import Outline
from packwork.progress import NOBODY, ObjectiveTerms, Observer, Step, Stop, never
from packwork.scene.container import Container
from packwork.scene.pose import NO_LIMITS, Limits, Poses
from packwork.solve.exchange import exchange
from packwork.solve.level import Level, RepeatingLevel
from packwork.solve.motion import Motion
from packwork.solve.options import ImageLossFunction, SolveOptions
from packwork.solve.outlines import simplify_for_level
from packwork.solve.relocate_trapped import Relocation, relocate_trapped
from packwork.solve.schedule import force_factor, growth, pace_of, rate_factor, weights_at

EXCHANGES = (0.15, 0.3, 0.45)
"""When, as shares of the run, items leave the side of their kind, or a part of the container with
too many of their sort. Later ones leave less time to settle. Tried."""

FORCED_EXCHANGES = tuple(np.arange(0.05, 0.61, 0.05).round(2).tolist())
"""The same where forces act: in a crowd there is no other way past each other. Chosen."""

SHRINKING = 0.3
"""Logarithm of size by which shared sizes may fall below those of the start where forces act: all
that press on one point would else shrink into it. Larger covers less. Tried."""


class Ending(Enum):
    """Why a run ended."""

    DONE = "all epochs were run"
    STOPPED = "the run was stopped before its last epoch"


@dataclass(frozen=True)
class LevelReport:
    """Report of one level: its size, time, shares at its end and relocations after it."""

    resolution: int
    epochs: int
    seconds: float
    coverage: float
    overlap: float
    outside: float
    rescues: tuple[Relocation, ...] = ()


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
    observer: Observer = NOBODY,
    stop: Stop = never,
    limits: Limits = NO_LIMITS,
    forces: Forces = NO_FORCES,
) -> Outcome:
    """Move, turn and size items so that they fill the container and do not overlap.

    Wang and Lu 2025, section 3. Deterministic: no randomness, fixed order of sums. ``outlines``:
    one per item, item units, origin at its centroid; ``nominal``: ``(n,)`` scales that weights ask
    for.
    """
    run = _Solve(container, outlines, start, nominal, options, observer, stop, limits, forces)
    reports: list[LevelReport] = []
    for index in range(len(options.levels)):
        if stop():
            # What a level sees of many outlines takes seconds to make.
            return Outcome(run.motion.poses, Ending.STOPPED, reports)
        if not run.pace.has_reached(index, 1.0):
            reports.append(run.level(index))
        if run.is_stopped:
            return Outcome(run.motion.poses, Ending.STOPPED, reports)
    return Outcome(run.motion.poses, Ending.DONE, reports)


class _Solve:
    def __init__(
        self,
        container: Container,
        outlines: Sequence[Outline],
        start: Poses,
        nominal: FloatArray,
        options: SolveOptions,
        observer: Observer,
        stop: Stop,
        limits: Limits,
        forces: Forces,
    ) -> None:
        self._forces = forces
        self.motion = Motion(start, nominal, container.side, options, limits)
        if forces.acts:
            self.motion.floor = np.log(start.scale / nominal) - SHRINKING
        self.pace = pace_of(options)
        self.is_stopped = False
        self._container, self._outlines, self._nominal = container, outlines, nominal
        self._areas = np.array([o.area for o in outlines])
        self._options, self._observer, self._stop = options, observer, stop
        self._limits = limits.widened(options.margin)
        self._done = 0
        self._exchanges = list(FORCED_EXCHANGES if forces.acts else EXCHANGES)
        if not options.exchanging:
            self._exchanges.clear()

    def level(self, index: int) -> LevelReport:
        """Run one level, and relocations when they are due."""
        began, before = time.perf_counter(), self._done
        resolution = self._options.levels[index]
        px_per_cu = resolution / self._container.side
        seen = simplify_for_level(
            self._outlines, self.motion.poses, px_per_cu, self._options.margin
        )
        level = self._at(resolution, seen)
        is_last = index == len(self._options.levels) - 1
        relocations: list[Relocation] | None = None if self._options.relocating else []
        while not self.pace.has_reached(index, 1.0):
            if self._stop():
                self.is_stopped = True
                break
            self._epoch(level)
            if self._exchanges and self.pace.progress() >= self._exchanges[0]:
                self._exchanges.pop(0)
                self._exchange()
            if relocations is None and self.pace.has_reached(index, 0.5 if is_last else 1.0):
                relocations = self._relocate(level)
            self._tell(level, index)
        shares = level.shares(level.density(self.motion.poses))
        seconds = time.perf_counter() - began
        return LevelReport(
            resolution, self._done - before, seconds, *shares, rescues=tuple(relocations or ())
        )

    def _at(self, resolution: int, seen: Sequence[Outline]) -> Level:
        container, losses = self._container, self._options.losses
        if container.lattice is None:
            return Level(
                container, seen, resolution, losses, self._nominal, self._limits, self._forces
            )
        radii = np.array([outline.radius for outline in seen]) * self.motion.poses.scale
        return RepeatingLevel(
            container, container.lattice, seen, resolution, float(radii.max()), losses,
            self._nominal, self._limits,
        )  # fmt: skip

    def _epoch(self, level: Level) -> None:
        progress = self.pace.progress()
        gradient = level.gradient(self.motion.poses, *self._weights(progress))
        self.motion.follow(gradient, rate_factor(self._options, progress))
        self.pace.advance()
        self._done += 1

    def _weights(
        self, progress: float
    ) -> tuple[dict[str | ImageLossFunction, float], float, float]:
        """Weights of losses, recall and forces at ``progress`` (0..1) through the run."""
        options = self._options
        # On the torus nothing is outside, to be called back.
        is_bounded = self._container.lattice is None
        recall = options.recall * growth(options, progress) if is_bounded else 0.0
        return weights_at(options, progress), recall, force_factor(progress)

    def _relocate(self, level: Level) -> list[Relocation]:
        poses = self.motion.poses
        bounds = scale_bounds(self._nominal, poses.scale, self._options, self._limits)
        moved, relocations = relocate_trapped(level, poses, self._areas, *bounds, self._limits)
        self.motion.replace(moved, [relocation.item for relocation in relocations])
        if self._forces.acts and relocations:
            # The largest void may be where forces would not have them.
            self._exchange()
        return relocations

    def _exchange(self) -> None:
        poses = self.motion.poses
        bounds = scale_bounds(self._nominal, poses.scale, self._options, self._limits)
        region = self._container.outline
        changed, items = exchange(
            region, self._outlines, poses, self._limits, *bounds,
            np.random.default_rng(self._done), self._forces,
        )  # fmt: skip
        if items:
            self.motion.replace(changed, items)

    def _tell(self, level: Level, index: int) -> None:
        observer = self._observer
        is_end = self.pace.has_reached(index, 1.0)
        if (self._done - 1) % observer.every and not is_end:
            return
        poses, progress = self.motion.poses, self.pace.progress()

        def priced() -> ObjectiveTerms:
            return level.objective(poses, *self._weights(progress))

        observer.on_step(
            Step(
                index, len(self._options.levels), level.resolution, self._done,
                progress, poses, lambda: level.shares(level.density(poses)),
                is_last=is_end, priced=priced,
            )
        )  # fmt: skip


def scale_bounds(
    nominal: FloatArray, scale: FloatArray, options: SolveOptions, limits: Limits = NO_LIMITS
) -> tuple[FloatArray, FloatArray]:
    """Smallest and largest scale of each item, ``(n,)`` each."""
    if options.sizes == "free" and limits.binds:
        return limits.smallest, limits.largest
    if options.sizes == "free":
        return nominal / options.size_ratio, nominal * options.size_ratio
    return scale, scale
