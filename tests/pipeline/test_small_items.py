"""Items that came out too small: one line tells of them, or the run is not as asked."""

from __future__ import annotations

from dataclasses import replace
from importlib import import_module

import numpy as np
import pytest

from packwork.pipeline.job import Job
from packwork.pipeline.state import RunContext, RunState
from packwork.recipe import make_recipe
from packwork.scene.pose import Poses
from packwork.steps.finish import DWARF, dwarfs_told_apart
from packwork.steps.shortfalls import SPECK, TellShortfalls
from packwork.uses import fill, read

QUICK = {"levels": "50", "epochs": 20, "effort": "draft"}


def job_of(count: int, **options: object) -> Job:
    return read(make_recipe(container="circle", items=["star"], count=count, **QUICK, **options))


def sized(job: Job, scales: list[float]) -> RunState:
    """Items that came out at such scales, all of them below their least."""
    count = len(scales)
    poses = Poses(np.zeros(count), np.zeros(count), np.zeros(count), np.array(scales))
    state = replace(RunState.of(job), poses=poses, nominal=np.ones(count))
    return replace(state, undersized=tuple(range(count)))


def told_apart(state: RunState) -> RunState:
    least = np.ones(len(state.poses))
    real, small = dwarfs_told_apart(state.job, least, state.poses, state.undersized)
    return replace(state, undersized=real, small=small)


def test_one_line_tells_of_all_that_are_smaller_than_free_sizes_go(
    caplog: pytest.LogCaptureFixture,
) -> None:
    found = told_apart(sized(job_of(3), [0.5, 0.8, 0.999]))
    assert found.undersized == ()
    # Of several attempts that of the one that is kept is told alone.
    assert not caplog.records
    TellShortfalls().run(found, RunContext())
    assert [record.getMessage() for record in caplog.records] == [
        "2 items are smaller than --size-ratio 2 allows, star by 50 %"
    ]


def test_all_that_are_far_too_small_are_one_sentence() -> None:
    job = job_of(5)
    (found,) = TellShortfalls().run(sized(job, [0.1, 0.2, 0.1, 0.2, 0.05]), RunContext()).findings
    assert str(found) == (
        "5 items (star) came out up to 20 times smaller than the typical item, "
        "--size-ratio 2 allows less; use fewer items"
    )


def test_specks_and_sizes_that_were_asked_for_count(caplog: pytest.LogCaptureFixture) -> None:
    speck = 0.9 / DWARF
    assert told_apart(sized(job_of(2), [speck, 1.0])).undersized == (0,)
    asked = job_of(2, rules=[{"items": "star", "scale": [0.9, 1.1]}])
    assert told_apart(sized(asked, [0.9, 1.0])).undersized == (0,)
    assert not caplog.records


def test_what_nobody_can_see_is_not_as_asked() -> None:
    rules = [{"items": "circle", "weight": 1e-6}]
    options = {"sizes": "shared", "rules": rules, "count": 20, **QUICK}
    run = fill(make_recipe(container="circle", items=["star", "circle"], **options))
    assert run.certified
    assert not run.is_as_asked
    (said,) = run.broken
    assert said.startswith("10 items are too small to be seen (circle: ")
    is_speck = np.sqrt(run.layout.areas) < SPECK * run.layout.container.side
    assert is_speck.tolist() == [False, True] * 10


def test_one_line_tells_of_them_though_several_attempts_are_finished(
    caplog: pytest.LogCaptureFixture, monkeypatch: pytest.MonkeyPatch
) -> None:
    calls: list[int] = []

    def noted(*given: object) -> tuple[tuple[int, ...], str]:
        calls.append(len(given))
        return (), f"attempt {len(calls)}"

    monkeypatch.setattr(import_module("packwork.steps.finish"), "dwarfs_told_apart", noted)
    fill(make_recipe(container="circle", items=["star"], count=1, **QUICK))
    told = [r.getMessage() for r in caplog.records if r.getMessage().startswith("attempt")]
    assert len(calls) > 1
    assert len(told) == 1
