"""All steps of a series, outwards from the fullest one, at the largest scale that all can have."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any, Literal, TypeAlias

import numpy as np

from packwork import pipeline, threads
from packwork.arrays import FloatArray
from packwork.errors import PackworkError
from packwork.pipeline.plan.limits import item_limits
from packwork.pipeline.result import Run
from packwork.pipeline.state import RunContext, RunState, run_steps
from packwork.progress import NOBODY, Stop, never
from packwork.scene.pose import Poses
from packwork.timeline.follow import followed, places_of
from packwork.timeline.step import SeriesStep

SLACK = 0.955
"""Scale of a series, over that of its fullest step alone. Larger leaves words no room to keep their
places, smaller leaves the container empty. Tried."""

LESS, SCALES = 0.97, 20
"""Factor between scales that are tried, and how many at most. Chosen."""

Order: TypeAlias = Literal["fullest", "first"]
"""Which step is laid out first: the one that asks for most room, and from it to both ends; or the
first, and from it on."""

Told: TypeAlias = Callable[[int], object]
"""Told how many steps lie."""


@dataclass(frozen=True, eq=False)
class Solved:
    """Layouts of all steps.

    ``size``: scale of all: items have so many times their true scales.
    """

    steps: tuple[SeriesStep, ...]
    runs: tuple[Run, ...]
    size: float

    @property
    def moves(self) -> list[FloatArray]:
        """For each pair of steps in a row, how far each word moves that both have.

        As shares of the diagonal of the container's box.
        """
        box = np.reshape(self.steps[0].job.container.outline.bounds, (2, 2))
        diagonal = float(np.hypot(*(box[1] - box[0])))
        pairs = list(zip(self.steps, self.runs, strict=True))
        return [_between(before, after) / diagonal for before, after in pairwise(pairs)]

    @property
    def is_as_asked(self) -> bool:
        """Whether all steps are."""
        return all(run.is_as_asked for run in self.runs)


def solved(
    steps: Sequence[SeriesStep],
    order: Order = "fullest",
    told: Told = lambda _: None,
    stop: Stop = never,
) -> Solved:
    """Layouts of all steps, at the largest scale found at which each is exact.

    Raises ``PackworkError`` if there is none, or it was stopped.
    """
    first = int(np.argmax([step.area for step in steps])) if order == "fullest" else 0
    with threads.using(steps[0].job.recipe.threads):
        alone = _alone(steps[first], stop)
        size = SLACK * alone[1]
        for _ in range(SCALES):
            found = _at(steps, first, alone[0], size, told, stop)
            if isinstance(found, list):
                runs = [_measured(*pair) for pair in zip(steps, found, strict=True)]
                return Solved(tuple(steps), tuple(runs), size)
            size = LESS * min(size, found)
    raise PackworkError("a series found no scale at which all steps fit; try a larger canvas")


def _alone(step: SeriesStep, stop: Stop) -> tuple[Poses, float]:
    run = pipeline.run(step.job, NOBODY, stop)
    _check(stop)
    if not run.is_as_asked:
        why = "; ".join([*run.broken, *(one.reason for one in run.unplaced)]) or "is not certified"
        raise PackworkError(f"{step.label}: {why}")
    poses = run.layout.poses
    return poses, float(np.min(poses.scale / step.true))


def _at(
    steps: Sequence[SeriesStep], first: int, alone: Poses, size: float, told: Told, stop: Stop
) -> list[Poses] | float:
    """Poses of all steps at a scale; or what one of them that fails at it has alone."""
    found: dict[int, Poses] = {}
    known = places_of(steps[first], alone)
    for number, beside in outwards(first, len(steps)):
        step = steps[number]
        before, names = (alone, step) if beside is None else (found[beside], steps[beside])
        poses = followed(step, size, before, names.names, known, stop)
        _check(stop)
        if poses is None:
            return _alone(step, stop)[1]
        found[number] = poses
        known |= places_of(step, poses)
        told(len(found))
    return [found[number] for number in range(len(steps))]


def outwards(first: int, count: int) -> Iterator[tuple[int, int | None]]:
    """Numbers of steps from one to both ends, each with the one beside it that lies already.

    Examples
    --------
    >>> list(outwards(1, 4))
    [(1, None), (2, 1), (3, 2), (0, 1)]
    """
    yield first, None
    for number in range(first + 1, count):
        yield number, number - 1
    for number in range(first - 1, -1, -1):
        yield number, number + 1


def _measured(step: SeriesStep, poses: Poses) -> Run:
    """Run of a step whose poses are known, measured and certified as any."""
    job = step.job
    limits = item_limits(job, poses.scale, poses.scale, poses.angle) if job.is_limited else None
    state = RunState.of(job)
    state = replace(
        state, poses=poses, nominal=poses.scale, method="layout", limits=limits or state.limits
    )
    return Run.of(run_steps(job.use.report(job), state, RunContext()))


def _between(before: tuple[SeriesStep, Run], after: tuple[SeriesStep, Run]) -> FloatArray:
    rows = {name: k for k, name in enumerate(before[0].names)}
    pairs = np.array(
        [(rows[name], k) for k, name in enumerate(after[0].names) if name in rows],
        dtype=np.int64,
    ).reshape(-1, 2)
    then, now = (
        before[1].layout.poses.subset(pairs[:, 0]),
        after[1].layout.poses.subset(pairs[:, 1]),
    )
    return np.hypot(now.x - then.x, now.y - then.y)


def _check(stop: Stop) -> None:
    if stop():
        raise PackworkError("stopped before all steps of the series were made")


def report(series: Solved) -> dict[str, Any]:
    """Plain values for ``--report``."""
    moves = [round(float(np.median(one)), 6) if len(one) else None for one in series.moves]
    every = np.concatenate(series.moves)
    return {
        "scale": series.size,
        "moved": {
            "median": float(np.median(every)) if len(every) else None,
            "p90": float(np.quantile(every, 0.9)) if len(every) else None,
            "medians": moves,
        },
        "certified": all(run.certified for run in series.runs),
        "steps": [
            {"step": step.label, **run.report()}
            for step, run in zip(series.steps, series.runs, strict=True)
        ],
    }
