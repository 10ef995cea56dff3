"""Progress by epochs and by the clock."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from packwork.solve import schedule as module
from packwork.solve.options import SolveOptions
from packwork.solve.schedule import EpochPace, TimePace, pace_of


@given(per_level=st.lists(st.integers(0, 9), min_size=1, max_size=5).filter(any))
def test_each_level_gets_its_epochs(per_level: list[int]) -> None:
    pace = EpochPace(per_level)
    for level, epochs in enumerate(per_level):
        for _ in range(epochs):
            assert not pace.has_reached(level, 1.0)
            pace.advance()
        assert pace.has_reached(level, 1.0)
    assert pace.progress() == 1.0


def test_progress_by_epochs_runs_from_zero_to_one() -> None:
    pace, seen = EpochPace([2, 3]), []
    for _ in range(5):
        seen.append(pace.progress())
        pace.advance()
    assert seen == [0, 0.25, 0.5, 0.75, 1.0]


def test_time_is_shared_among_levels(monkeypatch: pytest.MonkeyPatch) -> None:
    now = 100.0
    monkeypatch.setattr(module.time, "perf_counter", lambda: now)
    pace = TimePace(10.0, [1, 3])
    assert pace.progress() == 0
    now = 102.5
    assert pace.progress() == 0.25
    assert pace.has_reached(0, 1.0)
    assert not pace.has_reached(1, 0.01)
    now = 106.25
    assert pace.has_reached(1, 0.5)
    now = 1_000.0
    assert pace.progress() == 1.0
    assert pace.has_reached(1, 1.0)


def test_no_time_allows_no_epoch() -> None:
    pace = TimePace(0.0, [1])
    assert pace.has_reached(0, 1.0)


def test_seconds_go_before_epochs() -> None:
    assert isinstance(pace_of(SolveOptions(epochs=5)), EpochPace)
    assert isinstance(pace_of(SolveOptions(epochs=5, seconds=1.0)), TimePace)
