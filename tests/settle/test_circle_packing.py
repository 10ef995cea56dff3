"""Discs in a small circle: never over each other, near the best circle, the same for one seed."""

from __future__ import annotations

import numpy as np
import pytest

from numerics import assert_gradient
from packwork.arrays import FloatArray
from packwork.compiled import as_python
from packwork.forces.field import Distance
from packwork.forces.forces import FieldForce, Forces
from packwork.scene.pose import Poses
from packwork.settle.kernels import circle_packing as kernels
from packwork.settle.pile import Arrival, SettleOptions, pile
from packwork.settle.round_pack import packed_circles
from scenes import disc, overlap_area, placed, square, square_container


def _mixed(count: int, seed: int = 1) -> FloatArray:
    return np.asarray(np.exp(np.random.default_rng(seed).normal(0, 0.5, count)))


def _least_gap(centres: FloatArray, radii: FloatArray) -> float:
    apart = np.hypot(*(centres[:, None] - centres).transpose(2, 0, 1)) - radii[:, None] - radii
    return float(apart[np.triu_indices(len(radii), 1)].min(initial=np.inf))


def _covered(centres: FloatArray, radii: FloatArray) -> float:
    return float((radii**2).sum() / (np.hypot(*centres.T) + radii).max() ** 2)


@pytest.mark.parametrize(
    ("count", "least"), [(7, 0.777), (10, 0.68), (19, 0.80), (37, 0.80), (100, 0.80)]
)
def test_equal_discs_come_near_the_best_circle_that_is_known(count: int, least: float) -> None:
    radii = np.ones(count)
    centres = packed_circles(radii, np.random.default_rng(0))
    assert _least_gap(centres, radii) > 0
    assert _covered(centres, radii) > least


@pytest.mark.parametrize(("count", "least"), [(10, 0.73), (100, 0.83), (400, 0.84)])
def test_mixed_discs_are_no_looser(count: int, least: float) -> None:
    covered = []
    for seed in range(3):
        radii = _mixed(count, seed)
        centres = packed_circles(radii, np.random.default_rng(seed))
        assert _least_gap(centres, radii) > 0
        covered.append(_covered(centres, radii))
    assert np.median(covered) > least


@pytest.mark.parametrize("count", [1, 2, 3])
def test_few_discs(count: int) -> None:
    centres = packed_circles(_mixed(count), np.random.default_rng(0))
    assert _least_gap(centres, _mixed(count)) > 0


def test_one_seed_gives_one_pack() -> None:
    radii = _mixed(20)
    one, same, other = (packed_circles(radii, np.random.default_rng(seed)) for seed in (3, 3, 4))
    assert np.array_equal(one, same)
    assert not np.array_equal(one, other)


def test_discs_of_a_front_touch_two_and_meet_none() -> None:
    radii = _mixed(40)
    order = np.argsort(-radii)
    centres = kernels.front_chain(radii, order, 0.3, 0.2)
    assert _least_gap(centres, radii) > -1e-7
    apart = np.hypot(*(centres[:, None] - centres).transpose(2, 0, 1)) - radii[:, None] - radii
    assert ((apart < 1e-7).sum(axis=1) - 1 >= 2).sum() >= 39


def test_the_energy_has_the_slope_that_it_says() -> None:
    rng = np.random.default_rng(2)
    radii = rng.uniform(0.5, 1.5, 9)
    z = np.append(rng.uniform(-2, 2, 18), 2.5)
    pairs = as_python(kernels._near)(z, radii, 1.0)

    def value(at: FloatArray) -> float:
        return float(as_python(kernels._energy)(at, radii, pairs, 0.1, np.empty(19)))

    slope = np.empty(19)
    as_python(kernels._energy)(z, radii, pairs, 0.1, slope)
    assert_gradient(value, slope, z)


@pytest.mark.parametrize("turning", [False, True])
def test_a_round_pack_lies_in_a_smaller_circle(turning: bool) -> None:
    outlines = [square(4.0)] * 9 + [disc(4.5)] * 3
    n, middle = len(outlines), np.array([50.0, 50.0])
    turns = np.random.default_rng(0).uniform(-3, 3, n) if turning else np.zeros(n)
    poses = Poses(np.full(n, 50.0), np.full(n, 50.0), turns, np.ones(n))
    field = Distance.from_points(middle[None])
    forces = Forces([FieldForce(field, np.ones(n))], [], np.zeros(n, dtype=np.int64), 100.0)
    radii = []
    for is_round in (False, True):
        done = pile(
            square_container(), outlines, poses, forces, SettleOptions(turning=turning),
            arrival=Arrival(is_round=is_round),
        )  # fmt: skip
        assert len(done.placed) == n
        there = placed(outlines, done.poses)
        assert overlap_area(there) == 0
        radii.append(max(float(np.hypot(*(o.points - middle).T).max()) for o in there))
    assert radii[1] < 0.95 * radii[0]


def test_a_pack_for_which_the_sheet_is_too_narrow_finds_its_lowest_places() -> None:
    outlines = [disc(24.0)] * 3
    poses = Poses(np.full(3, 50.0), np.full(3, 50.0), np.zeros(3), np.ones(3))
    field = Distance.from_points(np.array([[50.0, 50.0]]))
    forces = Forces([FieldForce(field, np.ones(3))], [], np.zeros(3, dtype=np.int64), 100.0)
    done = pile(
        square_container(), outlines, poses, forces, SettleOptions(), arrival=Arrival(is_round=True)
    )
    assert 1 <= len(done.placed) < 3
    there = placed(outlines, done.poses)
    assert overlap_area([there[k] for k in done.placed]) == 0
