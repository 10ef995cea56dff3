"""Whole solves on small images: determinism, modes, progress, stopping, relocation."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from packwork.geometry.outline import Outline
from packwork.progress import NOBODY, Step
from packwork.scene.container import Container
from packwork.scene.pose import Poses
from packwork.solve.options import SolveOptions
from packwork.solve.solver import Ending, solve
from scenes import (
    box,
    disc,
    overlap_area,
    placed,
    poses,
    round_container,
    share_inside,
    square,
    square_container,
    star,
    taken,
)

Options = Callable[..., SolveOptions]
Scene = tuple[list[Outline], Poses]


class Log:
    """Observer that keeps what it is told."""

    def __init__(self, every: int = 1) -> None:
        self.every = every
        self.steps: list[Step] = []

    def on_step(self, step: Step) -> None:
        self.steps.append(step)


def assert_same(got: Poses, expected: Poses) -> None:
    for name in ("x", "y", "angle", "scale", "stretch"):
        np.testing.assert_array_equal(getattr(got, name), getattr(expected, name), err_msg=name)


def test_a_solve_fills_and_stays_inside(crowd: Scene, quick: Options) -> None:
    outlines, start = crowd
    container = round_container()
    outcome = solve(container, outlines, start, start.scale, quick(epochs=200))
    before, after = placed(outlines, start), placed(outlines, outcome.poses)
    assert outcome.ending is Ending.DONE
    assert overlap_area(after) < overlap_area(before) / 2
    inside = [min(share_inside(one, container) for one in outlines) for outlines in (before, after)]
    assert inside[1] > inside[0]


def test_same_start_same_poses_bit_for_bit(crowd: Scene, quick: Options) -> None:
    outlines, start = crowd
    runs = [solve(round_container(), outlines, start, start.scale, quick()) for _ in range(2)]
    assert_same(runs[0].poses, runs[1].poses)


def test_the_start_is_left_as_it_was(crowd: Scene, quick: Options) -> None:
    outlines, start = crowd
    kept = taken(start, range(len(start)))
    solve(round_container(), outlines, start, start.scale, quick())
    assert_same(start, kept)


def test_permuting_items_permutes_the_result(
    crowd: Scene, quick: Options, rng: np.random.Generator
) -> None:
    outlines, start = crowd
    order = rng.permutation(len(start))
    options = quick(levels=(48,), epochs=25)
    straight = solve(round_container(), outlines, start, start.scale, options).poses
    turned_start = taken(start, order)
    turned = solve(
        round_container(), [outlines[k] for k in order], turned_start, turned_start.scale, options
    ).poses
    # Only the order of sums differs; contacts amplify what it rounds.
    np.testing.assert_allclose(turned.x, straight.x[order], atol=1e-4)
    np.testing.assert_allclose(turned.y, straight.y[order], atol=1e-4)


def test_shared_sizes_keep_the_shares_of_area(crowd: Scene, quick: Options) -> None:
    outlines, start = crowd
    end = solve(round_container(), outlines, start, start.scale, quick(sizes="shared")).poses
    factors = (end.scale / start.scale) ** 2
    np.testing.assert_allclose(factors / factors.mean(), 1.0, rtol=1e-9)
    assert factors[0] != pytest.approx(1.0, abs=1e-3)


def test_fixed_sizes_never_change(crowd: Scene, quick: Options) -> None:
    outlines, start = crowd
    log = Log()
    solve(round_container(), outlines, start, start.scale, quick(sizes="fixed"), log)
    for step in log.steps:
        np.testing.assert_allclose(step.poses.scale, start.scale, rtol=1e-12)


def test_free_sizes_stay_within_their_ratio(crowd: Scene, quick: Options) -> None:
    outlines, start = crowd
    nominal = start.scale * 1.1
    options = quick(size_ratio=1.25, size_rate=0.2)
    log = Log()
    solve(round_container(), outlines, start, nominal, options, log)
    ratios = np.array([step.poses.scale / nominal for step in log.steps])
    assert ratios.max() <= 1.25 * (1 + 1e-12)
    assert ratios.min() >= 0.8 * (1 - 1e-12)
    assert np.ptp(ratios[-1]) > 0


@pytest.mark.parametrize("sizes", ["free", "shared", "fixed"])
def test_stretches_stay_within_their_bounds_and_change_no_area(
    sizes: str, crowd: Scene, quick: Options
) -> None:
    outlines, start = crowd
    log = Log()
    options = quick(sizes=sizes, stretch=1.3)
    end = solve(round_container(), outlines, start, start.scale, options, log).poses
    stretches = np.array([step.poses.stretch for step in log.steps])
    assert stretches.max() <= 1.3 * (1 + 1e-12)
    assert stretches.min() >= 1 / 1.3 * (1 - 1e-12)
    assert np.ptp(stretches[-1]) > 0
    areas = [o.area * scale**2 for o, scale in zip(outlines, end.scale, strict=True)]
    np.testing.assert_allclose([o.area for o in placed(outlines, end)], areas, rtol=1e-9)


def test_a_square_is_stretched_into_a_slot_too_low_for_it(quick: Options) -> None:
    """54 x 54 into 80 x 40: only a stretch of 1.82 to 2.19 fits; a little more may stick out."""
    container = Container("slot", "", box(10, 30, 90, 70), 100, 100)
    start = poses([50.0], [50.0], 0.0, 27.0)
    options = quick(epochs=150, sizes="fixed", stretch=3.0, turn_rate=0.0)
    end = solve(container, [square()], start, start.scale, options).poses
    assert 1.82 * 0.9 < end.stretch[0] < 2.19 * 1.1
    shares = [share_inside(placed([square()], at)[0], container) for at in (start, end)]
    assert 1 - shares[1] < (1 - shares[0]) / 4


def test_no_turn_rate_keeps_the_angles(crowd: Scene, quick: Options) -> None:
    outlines, start = crowd
    end = solve(round_container(), outlines, start, start.scale, quick(turn_rate=0.0)).poses
    np.testing.assert_array_equal(end.angle, start.angle)


def test_a_turn_limit_bounds_the_angles(crowd: Scene, quick: Options) -> None:
    outlines, start = crowd
    level = replace(start, angle=0.1 * start.angle)
    log = Log()
    options = quick(turn_limit=0.35, turn_rate=0.2)
    solve(round_container(), outlines, level, level.scale, options, log)
    angles = np.array([step.poses.angle for step in log.steps])
    assert np.abs(angles).max() <= 0.35
    assert np.ptp(angles, axis=0).max() > 0


def test_stopping_keeps_the_poses_of_that_moment(crowd: Scene, quick: Options) -> None:
    outlines, start = crowd
    log = Log()
    outcome = solve(
        round_container(), outlines, start, start.scale, quick(), log, lambda: len(log.steps) >= 7
    )
    assert outcome.ending is Ending.STOPPED
    assert len(log.steps) == 7
    assert_same(outcome.poses, log.steps[-1].poses)


def test_stopping_at_once_keeps_the_start(crowd: Scene, quick: Options) -> None:
    outlines, start = crowd
    stopped = solve(round_container(), outlines, start, start.scale, quick(), stop=lambda: True)
    assert stopped.ending is Ending.STOPPED
    np.testing.assert_array_equal(stopped.poses.x, start.x)


def test_the_observer_is_told_now_and_then_and_at_the_end_of_levels(
    crowd: Scene, quick: Options
) -> None:
    outlines, start = crowd
    log = Log(every=4)
    options = quick(levels=(32, 64), epochs=20, shares=(1, 1))
    outcome = solve(round_container(), outlines, start, start.scale, options, log)
    assert [step.epoch for step in log.steps] == [1, 5, 9, 10, 13, 17, 20]
    assert [step.level for step in log.steps] == [0, 0, 0, 0, 1, 1, 1]
    assert {step.levels for step in log.steps} == {2}
    shares = [step.progress for step in log.steps]
    assert shares == sorted(shares)
    assert shares[-1] == 1
    assert {step.resolution for step in log.steps} == {32, 64}
    assert_same(outcome.poses, log.steps[-1].poses)
    assert [report.epochs for report in outcome.levels] == [10, 10]


def test_a_time_is_kept_and_shared_among_levels(crowd: Scene, quick: Options) -> None:
    outlines, start = crowd
    options = quick(levels=(32, 64), shares=(1, 1), seconds=0.6)
    outcome = solve(round_container(), outlines, start, start.scale, options)
    assert outcome.ending is Ending.DONE
    assert all(report.epochs > 0 for report in outcome.levels)


def test_no_time_keeps_the_start(crowd: Scene, quick: Options) -> None:
    outlines, start = crowd
    outcome = solve(round_container(), outlines, start, start.scale, quick(seconds=0.0))
    assert outcome.levels == []
    np.testing.assert_array_equal(outcome.poses.x, start.x)


def test_observing_changes_nothing(crowd: Scene, quick: Options) -> None:
    outlines, start = crowd
    alone, watched = (
        solve(round_container(), outlines, start, start.scale, quick(), observer)
        for observer in (NOBODY, Log())
    )
    assert_same(watched.poses, alone.poses)


@pytest.mark.parametrize(
    ("x", "y"),
    [(-45.0, 50.0), (135.0, 120.0), (50.0, -40.0), (97.0, 97.0), (3.0, 50.0)],
    ids=["left of the canvas", "off its corner", "above it", "in its corner", "at its edge"],
)
@pytest.mark.parametrize("sizes", ["free", "fixed"])
def test_an_item_outside_comes_home(x: float, y: float, sizes: str, quick: Options) -> None:
    container = round_container()
    outlines = [disc(), star()]
    start = poses([50.0, x], [50.0, y], 0.0, [14.0, 4.0])
    options = quick(sizes=sizes, epochs=200, position_rate=0.02, relocating=False)
    end = solve(container, outlines, start, start.scale, options).poses
    shares = [share_inside(placed(outlines, at)[1], container) for at in (start, end)]
    assert 1 - shares[1] < (1 - shares[0]) / 4


@pytest.mark.parametrize("sizes", ["free", "fixed", "shared"])
def test_coincident_items_part(sizes: str, quick: Options) -> None:
    outlines = [square(), square()]
    start = poses([50.0, 50.0], [50.0, 50.0], 0.3, 12.0)
    outcome = solve(
        square_container(), outlines, start, start.scale, quick(sizes=sizes, epochs=150)
    )
    ends = placed(outlines, outcome.poses)
    assert overlap_area(ends) < overlap_area(placed(outlines, start)) / 10


def trapped() -> Scene:
    """A small disc wholly inside a large square, with a void to their right."""
    return [square(), disc()], poses([30.0, 28.0], [50.0, 53.0], 0.0, [22.0, 5.0])


@pytest.mark.parametrize("sizes", ["free", "fixed"])
def test_a_trapped_item_is_relocated_to_the_void_and_logged(sizes: str, quick: Options) -> None:
    outlines, start = trapped()
    options = quick(sizes=sizes, epochs=80, position_rate=0.002, size_rate=0.001)
    outcome = solve(square_container(), outlines, start, start.scale, options)
    (relocation,) = outcome.levels[0].rescues
    assert relocation.item == 1
    assert relocation.share > 0.5
    assert (relocation.from_x, relocation.from_y) == pytest.approx((28.0, 53.0), abs=5)
    assert relocation.to_x > 55
    assert (
        overlap_area(placed(outlines, outcome.poses)) < overlap_area(placed(outlines, start)) / 10
    )


def test_without_relocation_a_trapped_item_stays(quick: Options) -> None:
    outlines, start = trapped()
    options = quick(sizes="fixed", relocating=False, position_rate=0.002)
    outcome = solve(square_container(), outlines, start, start.scale, options)
    assert not outcome.levels[0].rescues
    assert overlap_area(placed(outlines, outcome.poses)) > overlap_area(placed(outlines, start)) / 2


def test_a_trapped_item_feels_no_force_and_does_not_dance(quick: Options) -> None:
    outlines = [square(), disc(), star()]
    start = poses([30.0, 28.0, 95.0], [50.0, 53.0, 50.0], 0.0, [22.0, 5.0, 10.0])
    options = quick(levels=(128,), epochs=20, sizes="fixed", relocating=False, turn_rate=0.1)
    end = solve(square_container(), outlines, start, start.scale, options).poses
    assert abs(end.x[2] - start.x[2]) > 1
    moved = np.hypot(end.x - start.x, end.y - start.y)
    assert moved[1] < moved[2] / 5
    assert abs(end.angle[1] - start.angle[1]) < 0.1


def test_one_level_reports_its_shares(quick: Options) -> None:
    start = poses([50.0], [50.0], 0.0, 20.0)
    options = quick(levels=(100,), epochs=1, sizes="fixed")
    outcome = solve(square_container(), [square()], start, start.scale, options)
    (report,) = outcome.levels
    assert (report.resolution, report.epochs) == (100, 1)
    assert report.coverage == pytest.approx(1600 / 8100, rel=0.01)
    assert report.overlap == 0
    assert report.outside == pytest.approx(0, abs=1e-6)
