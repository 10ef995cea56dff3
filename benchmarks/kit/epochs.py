"""One epoch of the solver against a running sum; what several benchmarks share."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from itertools import cycle, islice

import numpy as np

from benchmarks.kit import frozen
from benchmarks.kit.measuring import Timing, running_sum, timed
from packwork.geometry.outline import Outline
from packwork.scene.container import Container
from packwork.scene.pose import Poses
from packwork.solve.level import Level
from packwork.solve.motion import Motion
from packwork.solve.options import SolveOptions
from packwork.solve.outlines import simplify_at_scales
from packwork.start.angles_and_sizes import nominal_scales
from packwork.start.first_poses import first_poses
from packwork.start.options import StartOptions

EDGES = 6_000
RESOLUTION = 600
RECALL = 5.0
BLOCKS = 15


@dataclass(frozen=True)
class EpochTiming:
    """An epoch, the running sum taken in turn with it, and the ratios of the two."""

    epoch: Timing
    running_sum: Timing
    ratio: Timing


def spread_out(outlines: list[Outline], container: Container) -> Poses:
    """Items of equal area, covering 0.7 of the container, placed by the start."""
    areas = np.array([o.area for o in outlines])
    scales = nominal_scales(areas, np.ones(len(outlines)), 0.7 * container.outline.area)
    rng = np.random.default_rng(0)
    angles = rng.uniform(-np.pi, np.pi, len(outlines))
    return first_poses(container, outlines, scales, angles, StartOptions(), rng).poses


def frozen_edges() -> int:
    """Edges of the 100 outlines that epochs are timed on."""
    return sum(len(o.points) for o in frozen.outlines_of(EDGES))


def timed_epochs(settings: Mapping[str, Mapping[str, float]]) -> dict[str, EpochTiming]:
    """One epoch, poses to poses, with each set of weights: 100 icons, 6,000 edges, 600 px."""
    calls = {name: epoch_of(weights) for name, weights in settings.items()}
    container = frozen.round_container()
    summing = running_sum((RESOLUTION, round(RESOLUTION * container.width / container.side)))
    taken: dict[str, list[tuple[float, float]]] = {name: [] for name in calls}
    for _ in range(BLOCKS):
        for name, epoch in calls.items():
            # In blocks, as epochs follow each other in a run; blocks in turn, as machines drift.
            one = timed(epoch, seconds=0.15).median
            taken[name].append((one, timed(summing, seconds=0.1).median))
    return {name: _timing(pairs) for name, pairs in taken.items()}


def epoch_of(
    weights: Mapping[str, float], count: int = frozen.COUNT, resolution: int = RESOLUTION
) -> Callable[[], None]:
    """One epoch, poses to poses, of so many icons in the round container.

    At ``RESOLUTION`` the outlines are as the frozen set's, elsewhere as coarse as pixels ask.
    """
    container = frozen.round_container()
    outlines = list(islice(cycle(frozen.outlines_of(EDGES)), count))
    poses = spread_out(outlines, container)
    if resolution != RESOLUTION:
        outlines = simplify_at_scales(outlines, poses.scale, resolution / container.side)
    level = Level(container, outlines, resolution, weights)
    motion = Motion(poses, poses.scale, container.side, SolveOptions())

    def epoch() -> None:
        motion.follow(level.gradient(motion.poses, weights, RECALL), 1e-4)

    return epoch


def _timing(pairs: list[tuple[float, float]]) -> EpochTiming:
    epochs, sums = zip(*pairs, strict=True)
    ratios = np.array(epochs) / np.array(sums)
    return EpochTiming(Timing.of(epochs), Timing.of(sums), Timing.of(ratios))
