"""A finish is repeated where one size for all came out small, and only there."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from packwork.finish.finish import Finished
from packwork.pipeline import again, read, words_recipe
from packwork.pipeline.beginning import Beginning, begin
from packwork.pipeline.job import Job
from packwork.scene.pose import Poses


@pytest.fixture(scope="module")
def job() -> Job:
    return read(words_recipe("circle", {"ox": 2.0, "bee": 1.0}))


@pytest.fixture(scope="module")
def start(job: Job) -> Beginning:
    return begin(job, job.container, [item.outline for item in job.items])


def finishes(monkeypatch: pytest.MonkeyPatch, factors: list[float], clean: bool = True) -> list:
    """Let each finish multiply all sizes by the next factor; what it was called with."""
    calls: list[Poses] = []

    def fake(job, start, poses, observer, stop) -> Finished:
        factor = factors[len(calls)]
        calls.append(poses)
        return Finished(replace(poses, scale=poses.scale * factor), clean, (), (), 1, 0.0)

    monkeypatch.setattr(again, "finished", fake)
    return calls


@pytest.mark.parametrize(
    ("factors", "calls", "left"),
    [
        ([0.97], 1, 0.97),
        ([0.5, 1.8, 1.2], 3, 1.08),
        ([0.5, 1.01, 2.0], 2, 0.505),
        ([0.5, 0.9, 2.0], 2, 0.5),
        ([0.1, 1.1, 1.1, 1.1, 9.0], 4, 0.1331),
    ],
)
def test_it_ends_when_it_went_well_or_gains_no_more(
    job: Job, start: Beginning, monkeypatch: pytest.MonkeyPatch, factors, calls, left
) -> None:
    met = finishes(monkeypatch, factors)
    found = again.finished_well(job, start, start.poses, None, lambda: False)
    assert len(met) == calls
    assert found.poses.scale / start.poses.scale == pytest.approx(np.full(2, left))


def test_it_is_not_repeated_when_stopped_unclean_free_or_timed(
    job: Job, start: Beginning, monkeypatch: pytest.MonkeyPatch
) -> None:
    free = replace(job, recipe=job.recipe.model_copy(update={"sizes": "free"}))
    timed = replace(job, recipe=job.recipe.model_copy(update={"time": 5.0}))
    runs = ((job, True, True), (job, False, False), (free, False, True), (timed, False, True))
    for run, stopped, clean in runs:
        met = finishes(monkeypatch, [0.5, 2.0], clean)
        again.finished_well(run, start, start.poses, None, lambda stopped=stopped: stopped)
        assert len(met) == 1
