"""Schedules and paces of runs."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from packwork.solve import schedule as module
from packwork.solve.options import SolveOptions
from packwork.solve.schedule import (
    EpochPace,
    TimePace,
    epochs_per_level,
    growth,
    pace_of,
    rate_factor,
    weights_at,
)


@given(
    epochs=st.integers(1, 10_000),
    shares=st.lists(st.floats(0.01, 100), min_size=1, max_size=6),
)
def test_no_epoch_is_lost_and_shares_are_kept(epochs: int, shares: list[float]) -> None:
    given_out = epochs_per_level(epochs, shares)
    assert sum(given_out) == epochs
    for count, share in zip(given_out, shares, strict=True):
        assert abs(count - epochs * share / sum(shares)) <= 1


@given(progress=st.floats(0, 1), cooling=st.floats(0.01, 1))
def test_rates_fall_from_one_to_cooling(progress: float, cooling: float) -> None:
    options = SolveOptions(cooling=cooling)
    assert cooling * (1 - 1e-12) <= rate_factor(options, progress) <= 1
    assert rate_factor(options, 0.0) == 1
    assert rate_factor(options, 1.0) == pytest.approx(cooling)


def test_penalties_grow_by_hardening() -> None:
    options = SolveOptions(losses={"overlap": 2, "containment": 3, "evenness": 1}, hardening=10)
    assert weights_at(options, 0.0) == {"overlap": 2, "containment": 3, "evenness": 1}
    last = weights_at(options.model_copy(update={"settling": 0.0}), 1.0)
    assert last == pytest.approx({"overlap": 20, "containment": 30, "evenness": 10})
    assert growth(options, 1.0) == pytest.approx(10)


def test_rewards_are_cut_only_while_settling() -> None:
    options = SolveOptions(losses={"filling": 1.0}, settling=0.25, settling_reward=0.1)
    assert [weights_at(options, p)["filling"] for p in (0.0, 0.5, 0.74, 0.76, 1.0)] == [
        1, 1, 1, 0.1, 0.1,
    ]  # fmt: skip


def test_without_settling_rewards_stay() -> None:
    options = SolveOptions(losses={"filling": 1.0}, settling=0.0)
    assert weights_at(options, 1.0) == {"filling": 1}


def test_losses_of_ones_own_harden_like_penalties() -> None:
    options = SolveOptions(losses={"mine:calm": 2.0}, hardening=10, settling=0.5)
    assert weights_at(options, 0.0) == {"mine:calm": 2.0}
    assert weights_at(options, 1.0) == pytest.approx({"mine:calm": 20.0})


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
