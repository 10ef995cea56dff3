"""Every force's slope is its height's derivative, and leads where its name says."""

from __future__ import annotations

import numpy as np
import pytest

from numerics import assert_gradient
from packwork.arrays import FloatArray
from packwork.forces.bonds import Alignment, Balance, Home, TogetherBond
from packwork.forces.field import Bond, Direction, Distance, Fading, Field, Inward
from packwork.forces.forces import BondForce, FieldForce, Forces
from scenes import disc, star

SIDE = 100.0
POINTS = Distance.from_points(np.array([[20.0, 30.0], [70.0, 80.0]]))
CURVE = Distance.from_line(np.array([[0.0, 50.0], [40.0, 55.0], [100.0, 20.0]]))
FIELDS: dict[str, Field] = {
    "direction": Direction(0.7),
    "points": POINTS,
    "curve": CURVE,
    "inward": Inward(star(40.0)),
    "fading": Fading(CURVE, 15.0),
}
BONDS: dict[str, Bond] = {
    "row": Alignment(1),
    "column": Alignment(0),
    "kinds together": TogetherBond(),
    "all together": TogetherBond(is_one=True),
    "home": Home(np.array([[10.0, 20.0], [80.0, 30.0]] * 5)),
    "balance about a point": Balance(np.array([30.0, 60.0])),
    "balance about an axis": Balance(np.array([np.nan, 60.0])),
}


@pytest.fixture
def centres(rng: np.random.Generator) -> FloatArray:
    return rng.uniform(0, SIDE, (12, 2))


def _forces(rng: np.random.Generator, field: Field | None, bond: Bond | None) -> Forces:
    strengths = rng.uniform(0.5, 2.0, 12)
    strengths[[3, 7]] = 0.0
    fields = [] if field is None else [FieldForce(field, strengths)]
    bonds = [] if bond is None else [BondForce(bond, strengths)]
    return Forces(fields, bonds, np.arange(12) % 3, SIDE)


@pytest.mark.parametrize("name", [*FIELDS, *BONDS])
def test_the_slope_is_the_derivative(
    name: str, centres: FloatArray, rng: np.random.Generator
) -> None:
    forces = _forces(rng, FIELDS.get(name), BONDS.get(name))
    areas = rng.uniform(1, 5, len(centres))
    pull = forces(centres, areas)
    assert_gradient(lambda points: forces(points, areas).value, pull.slopes, centres)


@pytest.mark.parametrize("name", [*FIELDS, *BONDS])
def test_items_of_no_strength_feel_nothing(
    name: str, centres: FloatArray, rng: np.random.Generator
) -> None:
    pull = _forces(rng, FIELDS.get(name), BONDS.get(name))(centres, np.ones(len(centres)))
    assert not pull.slopes[[3, 7]].any()
    assert not pull.parts[[3, 7]].any()


@pytest.mark.parametrize("name", FIELDS)
def test_no_slope_is_steeper_than_one(name: str, rng: np.random.Generator) -> None:
    _, slopes = FIELDS[name](rng.uniform(-SIDE, 2 * SIDE, (200, 2)))
    assert np.hypot(*slopes.T).max() <= 1 + 1e-12


@pytest.mark.parametrize("name", [*FIELDS, *BONDS])
def test_what_one_item_elsewhere_changes_is_foretold(
    name: str, centres: FloatArray, rng: np.random.Generator
) -> None:
    forces = _forces(rng, FIELDS.get(name), BONDS.get(name))
    areas, places = rng.uniform(1, 5, len(centres)), rng.uniform(0, SIDE, (4, 2))
    foretold = forces.cost_changes(centres, areas, places)
    before, true = forces.cost(centres, areas).value, np.empty((12, 4))
    for item, place in np.ndindex(12, 4):
        moved = centres.copy()
        moved[item] = places[place]
        true[item, place] = forces.cost(moved, areas).value - before
    np.testing.assert_allclose(foretold, true, atol=1e-9 * SIDE)


def test_where_all_is_full_the_light_give_way_to_the_heavy() -> None:
    def lifted(pulls: list[float]) -> FloatArray:
        kinds, areas = np.zeros(len(pulls), dtype=np.int64), np.ones(len(pulls))
        forces = Forces([FieldForce(POINTS, np.array(pulls))], [], kinds, SIDE)
        return forces.buoyant(areas).fields[0].strengths

    heavy, *light = lifted([3.0, 1.0, 1.0, 1.0])
    assert heavy > 1 > 0 > max(light)
    assert 0 < lifted([2.0, 2.0])[0] < 0.5
    # Those that it does not act on make room by themselves.
    assert lifted([3.0, 1.0, 0.0]).tolist() == [3.0, 1.0, 0.0]


def test_bonds_have_a_height_about_an_anchor() -> None:
    row = BondForce(BONDS["row"], np.array([2.0, 0.0]))
    forces = Forces([], [row], np.zeros(2, int), SIDE)
    points, anchor = np.array([[10.0, 50.0], [10.0, 60.0]]), np.array([90.0, 50.0])
    assert forces.heights(points, 0).tolist() == [0.0, 0.0]
    flat, off = forces.heights(points, 0, anchor)
    assert flat == 0 < off
    assert forces.heights(points, 1, anchor).tolist() == [0.0, 0.0]


def test_forces_add_up(centres: FloatArray) -> None:
    one = FieldForce(FIELDS["points"], np.ones(12))
    other = FieldForce(FIELDS["direction"], np.full(12, 2.0))
    kinds, areas = np.zeros(12, dtype=np.int64), np.ones(12)
    both = Forces([one, other], [], kinds, SIDE)(centres, areas)
    parts = [Forces([force], [], kinds, SIDE)(centres, areas) for force in (one, other)]
    np.testing.assert_allclose(both.slopes, parts[0].slopes + parts[1].slopes)


def test_some_of_the_items_feel_what_they_felt(
    centres: FloatArray, rng: np.random.Generator
) -> None:
    forces, some = _forces(rng, FIELDS["curve"], None), np.array([1, 4, 9])
    areas = rng.uniform(1, 5, 12)
    np.testing.assert_allclose(
        forces.subset(some)(centres[some], areas[some]).slopes, forces(centres, areas).slopes[some]
    )


def test_at_the_very_point_there_is_no_way_to_go() -> None:
    heights, slopes = POINTS(np.array([[20.0, 30.0]]))
    assert heights.tolist() == [0.0]
    assert slopes.tolist() == [[0.0, 0.0]]


def test_the_nearest_of_several_points_attracts() -> None:
    _, slopes = POINTS(np.array([[25.0, 30.0], [60.0, 80.0]]))
    np.testing.assert_allclose(slopes, [[1.0, 0.0], [-1.0, 0.0]])


def test_inside_the_container_nothing_draws_in() -> None:
    heights, slopes = Inward(disc(10.0))(np.array([[1.0, 2.0]]))
    assert heights.tolist() == [0.0]
    assert not slopes.any()
