"""Piles: exact, at rest, and only what fits."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
import shapely
from shapely import affinity

from packwork import threads
from packwork.arrays import FloatArray
from packwork.forces.field import Direction, Distance, Field
from packwork.forces.forces import FieldForce, Forces
from packwork.geometry.outline import Outline
from packwork.progress import Step
from packwork.scene.container import Container
from packwork.scene.pose import Poses
from packwork.settle.pile import Arrival, Piled, SettleOptions, pile
from scenes import box, disc, square, square_container, star

SIDE = 100.0
DOWN = Direction(np.pi / 2)
LOWER = 1e-3
"""Share of the canvas by which items must not be able to come lower."""


def _some(count: int) -> list[Outline]:
    kinds = [star(6.0), disc(5.0), square(4.0), box(-7.0, -2.0, 7.0, 2.0)]
    return [kinds[k % len(kinds)] for k in range(count)]


def _heaped(
    outlines: list[Outline],
    field: Field = DOWN,
    container: Container | None = None,
    basin: Outline | None = None,
    poses: Poses | None = None,
    options: SettleOptions | None = None,
    seed: int = 5,
) -> Piled:
    n = len(outlines)
    if poses is None:
        turns = np.random.default_rng(seed).uniform(-3, 3, n)
        poses = Poses(np.full(n, 50.0), np.full(n, 50.0), turns, np.ones(n))
        placed = False
    else:
        placed = True
    forces = Forces([FieldForce(field, np.ones(n))], [], np.zeros(n, dtype=np.int64), SIDE)
    return pile(
        container or square_container(),
        outlines,
        poses,
        forces,
        options or SettleOptions(),
        basin,
        Arrival(known=np.arange(n if placed else 0)),
    )


def _regions(outlines: list[Outline], poses: Poses) -> list[shapely.Polygon]:
    return [o.mapped(poses.matrix(k)).region for k, o in enumerate(outlines)]


def _assert_exact(regions: list[shapely.Polygon], container: Container, gap: float = 0.0) -> None:
    for k, region in enumerate(regions):
        assert shapely.contains_properly(container.outline.region, region)
        for other in regions[:k]:
            assert shapely.distance(region, other) >= max(gap, 1e-4)


def _mean_depth(regions: list[shapely.Polygon]) -> float:
    areas = np.array([r.area for r in regions])
    return float(np.average([r.centroid.y for r in regions], weights=areas))


def _shaken(
    regions: list[shapely.Polygon], container: Container, rng: np.random.Generator
) -> list[shapely.Polygon]:
    """Small moves and turns at random, each kept if it is exact and leads down.

    The judge of rest: plain geometry, nothing of the pile.
    """
    now = list(regions)
    for step in 2.0 ** -np.arange(1, 8):
        for k in rng.permutation(np.repeat(np.arange(len(now)), 6)):
            dx, dy = rng.normal(0, step, 2)
            turned = affinity.rotate(now[k], rng.normal(0, 5 * step), origin=now[k].centroid)
            moved = affinity.translate(turned, dx, abs(dy))
            if not shapely.contains_properly(container.outline.region, moved):
                continue
            if all(not moved.intersects(o) for j, o in enumerate(now) if j != k):
                now[k] = moved
    return now


def test_a_pile_is_exact_and_at_rest() -> None:
    outlines = [o.mapped(np.array([[0.5, 0, 0], [0, 0.5, 0]])) for o in _some(20)]
    lower = []
    for seed in range(3):
        done = _heaped(outlines, seed=seed)
        regions = _regions(outlines, done.poses)
        _assert_exact(regions, square_container())
        assert len(done.placed) == 20
        shaken = _shaken(regions, square_container(), np.random.default_rng(seed))
        lower.append(_mean_depth(shaken) - _mean_depth(regions))
    # Now and then one that hangs between others is shaken loose.
    assert np.median(lower) < LOWER * SIDE


def test_the_judge_sees_what_is_not_at_rest() -> None:
    outlines = _some(16)
    done = _heaped(outlines)
    lifted = [affinity.translate(r, 0, -3.0) for r in _regions(outlines, done.poses)]
    shaken = _shaken(lifted, square_container(), np.random.default_rng(1))
    assert _mean_depth(shaken) - _mean_depth(lifted) > LOWER * SIDE


@pytest.mark.parametrize("seed", range(3))
def test_the_same_seed_gives_the_same_pile_on_any_number_of_cores(
    seed: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("packwork.settle.settle.MOST_IN_BLOCK", 4)
    found = []
    for count in (1, 3):
        with threads.using(count):
            found.append(_heaped(_some(16), seed=seed).poses)
    assert found[0].x.tolist() == found[1].x.tolist()


def test_blocks_that_do_not_touch_go_down_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    sizes = []

    def heard(call: Callable[..., None], arguments: list[tuple[object, ...]]) -> list[None]:
        sizes.append(len(arguments))
        return threads.at_once(call, arguments)

    monkeypatch.setattr("packwork.settle.settle.MOST_IN_BLOCK", 2)
    monkeypatch.setattr("packwork.settle.settle.at_once", heard)
    _heaped([disc(3.0)] * 12)
    assert max(sizes) > 1


def test_sizes_and_still_angles_stay() -> None:
    done = _heaped(_some(8), options=SettleOptions(turning=False))
    assert done.poses.scale.tolist() == [1.0] * 8
    turns = np.random.default_rng(5).uniform(-3, 3, 8)
    np.testing.assert_allclose(done.poses.angle, turns)


def test_a_gap_is_kept() -> None:
    outlines = _some(8)
    done = _heaped(outlines, options=SettleOptions(gap_cu=1.0))
    _assert_exact(_regions(outlines, done.poses), square_container(), 1.0)


def test_a_point_draws_a_round_pack_together() -> None:
    outlines = [disc(4.0)] * 19
    done = _heaped(outlines, Distance.from_points(np.array([[50.0, 50.0]])))
    away = np.hypot(done.poses.x - 50, done.poses.y - 50)
    # Nineteen equal discs lie in a hexagon of two rings about one.
    assert away.max() < 4 * 4.0 * 1.02
    _assert_exact(_regions(outlines, done.poses), square_container())


def test_what_does_not_fit_is_left_out() -> None:
    outlines = [square(20.0)] * 9
    done = _heaped(outlines, options=SettleOptions(turning=False))
    assert 1 <= len(done.placed) < 9
    placed = [r for k, r in enumerate(_regions(outlines, done.poses)) if k in done.placed]
    _assert_exact(placed, square_container())


def test_items_come_in_from_above_and_what_sticks_out_is_left_out() -> None:
    bin_ = Container("bin", "bin", box(30, 40, 70, 100), 100.0, 100.0)
    done = _heaped([disc(7.0)] * 24, container=bin_, basin=box(30, -400, 70, 100))
    assert 0 < len(done.placed) < 24
    regions = _regions([disc(7.0)] * 24, done.poses)
    _assert_exact([regions[k] for k in done.placed], bin_)


def _crowded() -> tuple[list[Outline], Poses]:
    rng = np.random.default_rng(2)
    outlines = _some(12)
    x, y = np.meshgrid(np.linspace(20, 80, 4), np.linspace(25, 80, 3))
    places = rng.uniform(-3, 3, (2, 12)) + np.stack([x.ravel(), y.ravel()])
    return outlines, Poses(*places, rng.uniform(-3, 3, 12), np.ones(12))


def test_a_given_start_is_eased_apart() -> None:
    outlines, start = _crowded()
    start = Poses(start.x * 0.6 + 20, start.y * 0.6 + 20, start.angle, start.scale)
    done = _heaped(outlines, poses=start)
    assert len(done.placed) == 12
    _assert_exact(_regions(outlines, done.poses), square_container())


def test_every_round_is_told() -> None:
    seen: list[FloatArray] = []

    class Watcher:
        every = 1

        def on_step(self, step: Step) -> None:
            assert step.is_finish
            seen.append(step.poses.y.copy())

    outlines, start = _crowded()
    forces = Forces([FieldForce(DOWN, np.ones(12))], [], np.zeros(12, dtype=np.int64), SIDE)
    done = pile(
        square_container(), outlines, start, forces, SettleOptions(), None,
        Arrival(known=np.arange(12)), Watcher(),
    )  # fmt: skip
    assert len(seen) == done.rounds
    np.testing.assert_allclose(seen[-1], done.poses.y)
    # No jump: from round to round nobody moves farther than a step may be.
    assert max(np.abs(np.diff(seen, axis=0)).max(axis=1)) < 5.0


def test_a_stop_ends_a_pile_that_is_exact() -> None:
    outlines = _some(8)
    forces = Forces([FieldForce(DOWN, np.ones(8))], [], np.zeros(8, dtype=np.int64), SIDE)
    poses = Poses(np.full(8, 50.0), np.full(8, 50.0), np.zeros(8), np.ones(8))
    done = pile(square_container(), outlines, poses, forces, SettleOptions(), stop=lambda: True)
    assert done.rounds == 0
    _assert_exact(_regions(outlines, done.poses), square_container())


@pytest.mark.parametrize("count", [0, 1])
def test_few_items(count: int) -> None:
    done = _heaped(_some(count))
    assert len(done.placed) == count
