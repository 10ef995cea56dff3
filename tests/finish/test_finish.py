from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from importlib import import_module

import numpy as np
import pytest
import shapely
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from pydantic import ValidationError

from packwork.compaction.options import HAIR
from packwork.finish.finish import Finished, finish
from packwork.finish.options import FinishOptions
from packwork.geometry.outline import Outline
from packwork.metrics.exact import ExactMetrics, exact_metrics
from packwork.progress import Step
from packwork.scene.container import Container
from packwork.scene.pose import Poses
from scenes import box, disc, placed, poses, round_container, square, square_container, star
from strategies import generators

SHAPES = [star(1.0), square(0.8), disc(0.8, 24), box(-1.5, -0.2, 1.5, 0.2), star(1.0, 3)]
FAST = FinishOptions(rounds=8, trials=20)


def exact(container: Container, outlines: Sequence[Outline], done: Finished) -> ExactMetrics:
    """The result, measured by code that shares nothing with the finish."""
    return exact_metrics(placed(outlines, done.poses), container.outline)


def assert_clean(
    container: Container, outlines: Sequence[Outline], done: Finished, gap: float = 0.0
) -> None:
    found = exact(container, outlines, done)
    assert done.clean
    assert done.conflicts == ()
    assert found.overlap_area == 0
    assert found.outside_area == 0
    assert found.min_gap >= gap + HAIR * container.side * (1 - 1e-6)


def crowd(rng: np.random.Generator, count: int, side: float) -> tuple[list[Outline], Poses]:
    """Items thrown into a square, some over each other and some outside."""
    outlines = [SHAPES[k] for k in rng.integers(len(SHAPES), size=count)]
    scale = 0.35 * side / np.sqrt(count) * rng.uniform(0.5, 1.0, count)
    x, y = rng.uniform(0.1 * side, 0.9 * side, (2, count))
    return outlines, poses(x, y, rng.uniform(-4, 4, count), scale)


def with_holes(side: float) -> Container:
    """Two parts, one of them with a hole."""
    left = shapely.box(0.05, 0.05, 0.6, 0.95) - shapely.box(0.25, 0.4, 0.4, 0.6)
    whole = shapely.union_all([left, shapely.box(0.65, 0.05, 0.95, 0.95)])
    grown = shapely.transform(whole, lambda points: points * side)
    return Container("holes", "", Outline.from_region(grown), side, side)


CONTAINERS = [round_container(), square_container(), with_holes(100.0)]


@given(generators(), st.sampled_from(CONTAINERS), st.sampled_from(["free", "shared"]))
@settings(deadline=None, max_examples=20, suppress_health_check=list(HealthCheck))
def test_whatever_comes_in_nothing_meets_afterwards(
    rng: np.random.Generator, container: Container, sizes: str
) -> None:
    outlines, start = crowd(rng, int(rng.integers(1, 12)), container.side)
    options = FAST.model_copy(update={"sizes": sizes, "gap_cu": float(rng.choice([0.0, 0.5]))})
    done = finish(container, outlines, start, options)
    assert_clean(container, outlines, done, options.gap_cu)


@given(generators(), st.sampled_from(CONTAINERS))
@settings(deadline=None, max_examples=25, suppress_health_check=list(HealthCheck))
def test_fixed_sizes_stay_and_what_does_not_fit_is_named(
    rng: np.random.Generator, container: Container
) -> None:
    outlines, start = crowd(rng, int(rng.integers(1, 12)), container.side)
    done = finish(container, outlines, start, FAST.model_copy(update={"sizes": "fixed"}))
    assert (done.poses.scale == start.scale).all()
    found = exact(container, outlines, done)
    assert done.clean == (not done.conflicts)
    if done.clean:
        assert_clean(container, outlines, done)
    else:
        named = sum(o.overlap_cu2 for o in done.conflicts)
        assert named >= (found.overlap_area + found.outside_area) * (1 - 1e-9)


def test_items_grow_into_the_room_that_is_left() -> None:
    container = square_container()
    start = poses([30.0, 70.0, 30.0, 70.0], [30.0, 30.0, 70.0, 70.0], 0.1, 15.0)
    done = finish(container, [square()] * 4, start, FinishOptions(largest=(99.0,) * 4))
    assert_clean(container, [square()] * 4, done)
    assert exact(container, [square()] * 4, done).coverage > 0.97


def test_free_sizes_stay_within_their_bounds() -> None:
    rng = np.random.default_rng(0)
    outlines, start = crowd(rng, 9, 100.0)
    small, large = start.scale * 0.8, start.scale * 1.1
    options = FAST.model_copy(update={"smallest": tuple(small), "largest": tuple(large)})
    done = finish(square_container(), outlines, start, options)
    assert (done.poses.scale <= large * (1 + 1e-9)).all()
    below = np.flatnonzero(done.poses.scale < small * (1 - 1e-5))
    assert below.tolist() == list(done.undersized)


def test_an_item_that_has_no_room_at_its_smallest_size_is_named() -> None:
    start = poses([50.0, 50.0], [50.0, 50.0], 0.0, 40.0)
    done = finish(
        square_container(), [square()] * 2, start, FAST.model_copy(update={"smallest": (39.0,) * 2})
    )
    assert_clean(square_container(), [square()] * 2, done)
    assert len(done.undersized) >= 1


def test_shared_sizes_keep_their_proportions_exactly() -> None:
    rng = np.random.default_rng(1)
    outlines, start = crowd(rng, 12, 100.0)
    done = finish(round_container(), outlines, start, FAST.model_copy(update={"sizes": "shared"}))
    assert np.ptp(done.poses.scale / start.scale) < 1e-12
    assert_clean(round_container(), outlines, done)


def test_fixed_sizes_make_room_by_moving() -> None:
    container = square_container()
    start = poses([30.0, 68.0, 30.0, 70.0], [30.0, 30.0, 68.0, 66.0], 0.0, 20.0)
    done = finish(container, [square()] * 4, start, FinishOptions(sizes="fixed"))
    assert_clean(container, [square()] * 4, done)
    assert (done.poses.scale == 20.0).all()


def test_what_is_clean_already_and_fixed_does_not_move() -> None:
    start = poses([30.0, 70.0], [30.0, 70.0], 0.3, 10.0)
    done = finish(square_container(), [square()] * 2, start, FinishOptions(sizes="fixed"))
    assert (done.poses.x == start.x).all()
    assert (done.poses.angle == start.angle).all()


def test_items_that_may_not_turn_do_not() -> None:
    outlines, start = crowd(np.random.default_rng(2), 9, 100.0)
    done = finish(round_container(), outlines, start, FAST.model_copy(update={"turning": False}))
    assert done.poses.angle == pytest.approx(start.angle, abs=1e-6)


def test_turn_limits_hold() -> None:
    outlines, start = crowd(np.random.default_rng(3), 9, 100.0)
    start = replace(start, angle=np.linspace(-0.2, 0.2, 9))
    done = finish(round_container(), outlines, start, FAST.model_copy(update={"turn_limit": 0.2}))
    assert np.abs(done.poses.angle).max() <= 0.2 + 1e-6
    assert np.ptp(done.poses.angle - start.angle) > 1e-3


def test_the_gap_asked_for_is_kept_to_items_and_edge() -> None:
    outlines, start = crowd(np.random.default_rng(4), 9, 100.0)
    done = finish(round_container(), outlines, start, FAST.model_copy(update={"gap_cu": 2.0}))
    assert_clean(round_container(), outlines, done, 2.0)


def test_stretched_items_are_taken_as_they_are() -> None:
    outlines, start = crowd(np.random.default_rng(5), 9, 100.0)
    start = replace(start, stretch=np.linspace(0.4, 2.5, 9))
    done = finish(square_container(), outlines, start, FAST)
    assert (done.poses.stretch == start.stretch).all()
    assert_clean(square_container(), outlines, done)


def test_one_seed_gives_one_result() -> None:
    outlines, start = crowd(np.random.default_rng(6), 9, 100.0)
    one = finish(square_container(), outlines, start, FAST)
    other = finish(square_container(), outlines, start, FAST)
    assert (one.poses.x == other.poses.x).all()
    assert (one.poses.scale == other.poses.scale).all()


def test_trials_only_gain() -> None:
    outlines, start = crowd(np.random.default_rng(7), 9, 100.0)
    areas = np.array([o.area for o in outlines])
    covered = [
        (areas * finish(square_container(), outlines, start, options).poses.scale ** 2).sum()
        for options in (FinishOptions(trials=0), FinishOptions(trials=200))
    ]
    assert covered[1] > covered[0]


def test_trials_let_a_common_size_grow() -> None:
    gains = []
    for seed in (7, 8):
        outlines, start = crowd(np.random.default_rng(seed), 9, 100.0)
        without, including = (
            finish(square_container(), outlines, start, FinishOptions(sizes="shared", trials=n))
            for n in (0, 80)
        )
        gains.append(including.poses.scale[0] / without.poses.scale[0])
        assert np.ptp(including.poses.scale / start.scale) < 1e-12
        assert_clean(square_container(), outlines, including)
    assert np.mean(gains) > 1


def test_trials_end_when_it_is_enough() -> None:
    outlines, start = crowd(np.random.default_rng(7), 9, 100.0)
    options = FinishOptions(trials=1_000)
    ended = finish(square_container(), outlines, start, options, is_enough=lambda: True)
    without = finish(square_container(), outlines, start, FinishOptions(trials=0))
    assert (ended.poses.x == without.poses.x).all()
    assert ended.rounds == without.rounds > 0


def test_a_stopped_finish_is_clean_all_the_same() -> None:
    outlines, start = crowd(np.random.default_rng(8), 9, 100.0)
    for sizes in ("free", "shared"):
        options = FAST.model_copy(update={"sizes": sizes})
        done = finish(square_container(), outlines, start, options, stop=lambda: True)
        assert done.rounds == 0
        assert_clean(square_container(), outlines, done)


def test_an_observer_is_told_of_each_round_and_trial() -> None:
    class Log:
        every = 1

        def __init__(self) -> None:
            self.steps: list[Step] = []

        def on_step(self, step: Step) -> None:
            self.steps.append(step)

    log = Log()
    outlines, start = crowd(np.random.default_rng(9), 6, 100.0)
    done = finish(square_container(), outlines, start, FAST, observer=log)
    assert len(log.steps) == done.rounds + FAST.trials
    assert log.steps[-1].coverage > log.steps[0].coverage
    assert log.steps[0].overlap == 0


def test_no_items_are_clean() -> None:
    done = finish(square_container(), [], poses([], []), FinishOptions())
    assert done.clean
    assert len(done.poses) == 0


def test_many_items_go_in_blocks() -> None:
    rng = np.random.default_rng(10)
    outlines, start = crowd(rng, 300, 100.0)
    done = finish(square_container(), outlines, start, FinishOptions(rounds=4))
    assert_clean(square_container(), outlines, done)


@pytest.mark.parametrize(
    "wrong", [{"gap_cu": -1.0}, {"sizes": "huge"}, {"rounds": 0}, {"colour": "red"}]
)
def test_options_without_meaning_are_refused(wrong: dict[str, object]) -> None:
    with pytest.raises(ValidationError):
        FinishOptions(**wrong)


def test_steps_go_by_items_that_are_far_smaller_than_their_shares(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Else each looks at all edges of a spiral that lie within a share of the whole."""
    trusts: list[float] = []

    def noted(*given: object) -> None:
        trusts.append(float(str(given[3])))

    monkeypatch.setattr(import_module("packwork.finish.finish"), "compact_all", noted)
    container = square_container(100.0)
    for scale in (0.01, 10.0):
        start = poses([20, 20, 80, 80], [20, 80, 20, 80], scale=scale)
        finish(container, [square()] * 4, start, FAST)
        assert max(trusts) <= 2.5 * scale
        trusts.clear()
