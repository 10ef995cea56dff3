"""Compaction where items repeat: images move as their items do, and are not met."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings

from packwork.compaction.arrangement import Arrangement, find_conflicts
from packwork.compaction.compact import compact_all
from packwork.compaction.kernels.trials import allocate_batch, choose_disjoint
from packwork.compaction.objective import FreeSizes
from packwork.compaction.separate import relocate, separate
from packwork.finish.proposals import destinations
from packwork.geometry.lattice import Lattice
from packwork.geometry.outline import Outline
from packwork.metrics.torus import torus_metrics
from packwork.scene.container import Container
from packwork.scene.pose import Poses
from scenes import square, star
from strategies import generators

GAP, HAIR = 0.01, 0.001
LATTICES = [Lattice(10.0, 9.0), Lattice(10.0, 9.0, 4.5)]


def arranged(outlines: list[Outline], lattice: Lattice, places: np.ndarray) -> Arrangement:
    return Arrangement(outlines, Outline.box(*lattice.cell), places, lattice)


def in_place(arrangement: Arrangement) -> list[Outline]:
    rings = np.split(arrangement.board.points, arrangement.board.starts[1:-1])
    return [Outline.from_rings([ring]) for ring in rings[: arrangement.count]]


def free(count: int, limit: float = 1.0) -> FreeSizes:
    turns = np.full(count, -np.inf), np.full(count, np.inf)
    return FreeSizes(np.ones(count), turns, np.full(count, -limit), np.full(count, limit))


def test_images_lie_by_the_lattice_however_their_item_is_put() -> None:
    lattice = LATTICES[1]
    two = arranged([square(), star()], lattice, np.zeros((2, 4)))
    two.put(np.array([1]), np.array([[3.0, 4.0, 0.7, 0.2]]))
    rings = np.split(two.board.points, two.board.starts[1:-1])
    many = len(lattice.neighbours())
    for shift, image in zip(lattice.neighbours(), rings[2 + many : 2 + 2 * many], strict=True):
        assert np.allclose(image, rings[1] + shift)
    assert two.owners.tolist() == [0, 1, *[0] * many, *[1] * many, 2]


def test_an_item_does_not_meet_its_image_two_columns_on() -> None:
    lattice = Lattice(5.0, 10.0, 5.0)
    one = arranged([Outline.box(-4.6, -0.3, 4.6, 0.3)], lattice, np.zeros((1, 4)))
    objective = free(1, 9.0).objective(np.zeros(1), 0.1)
    for turn in range(30):
        compact_all(one, objective, turn, 0.5, GAP, HAIR)
    assert torus_metrics(in_place(one), lattice).min_gap >= GAP * (1 - 1e-6)


@pytest.mark.parametrize("lattice", LATTICES)
@given(generators())
@settings(deadline=None, max_examples=25)
def test_separation_and_compaction_leave_nothing_that_meets_on_the_torus(
    lattice: Lattice, rng: np.random.Generator
) -> None:
    count = int(rng.integers(1, 9))
    places = np.column_stack(
        [rng.uniform(-20, 20, (count, 2)), rng.uniform(0, 6, count), np.zeros(count)]
    )
    several = arranged([star(2.0)] * count, lattice, places)
    several.wrap(0.0)
    separate(several, GAP)
    objective = free(count).objective(several.places[:, 3], 0.1)
    for turn in range(4):
        several.wrap(0.3 * turn)
        compact_all(several, objective, turn, 0.4, GAP, HAIR)
    assert torus_metrics(in_place(several), lattice).min_gap >= GAP * (1 - 1e-6)


def test_one_item_grows_until_it_meets_its_own_images() -> None:
    one = arranged([square()], LATTICES[0], np.zeros((1, 4)))
    objective = free(1, 9.0).objective(np.zeros(1), 0.1)
    for turn in range(60):
        compact_all(one, objective, turn, 0.5, GAP, HAIR)
    # A square that may turn: upright, 9 high, it fills the cell's height.
    found = torus_metrics(in_place(one), LATTICES[0])
    assert found.is_clean
    assert found.coverage > 0.85


def test_an_item_is_relocated_to_a_void_at_the_edge() -> None:
    lattice = Lattice(12.0, 12.0)
    grid = [(x, y) for x in (3.0, 6.0, 9.0) for y in (3.0, 6.0, 9.0)]
    places = np.array([[x, y, 0.0, 0.0] for x, y in [*grid, (6.0, 6.0)]])
    ten = arranged([square(1.2)] * 10, lattice, places)
    relocate(ten, np.array([9]), GAP)
    x, y = lattice.wrapped(ten.places[9:, :2])[0]
    assert min(x, 12 - x) < 1.5 or min(y, 12 - y) < 1.5
    assert torus_metrics(in_place(ten), lattice).is_clean


@pytest.mark.parametrize("lattice", LATTICES)
@given(generators())
@settings(deadline=None, max_examples=20)
def test_conflicts_are_the_same_in_whichever_cell_items_are(
    lattice: Lattice, rng: np.random.Generator
) -> None:
    outlines = [star(), square(), star()]
    box = Outline.box(*lattice.cell)
    tile = replace(Container("tile", outline=box), lattice=lattice)
    x, y = rng.uniform(0.0, 9.0, size=(2, 3))
    poses = Poses(x, y, rng.uniform(0, 6, 3), np.ones(3))
    columns, rows = rng.integers(-3, 4, size=(2, 3))
    away = Poses(
        x + columns * lattice.width, y + columns * lattice.drop + rows * lattice.height,
        poses.angle, poses.scale,
    )  # fmt: skip
    here, there = (find_conflicts(tile, outlines, one, GAP) for one in (poses, away))
    assert [(c.item, c.other) for c in here] == [(c.item, c.other) for c in there]
    assert [c.overlap_cu2 for c in here] == pytest.approx([c.overlap_cu2 for c in there])


def test_a_trial_looks_at_all_images_of_what_it_moves() -> None:
    lattice = LATTICES[0]
    places = np.zeros((3, 4))
    places[:, :2] = [(2.0, 2.0), (7.0, 6.0), (7.0, 2.0)]
    three = arranged([square(0.2)] * 3, lattice, places)
    chosen = allocate_batch(1, 1, len(three.board.arms))
    moved = np.array([[0, 1]])
    count = choose_disjoint(
        three.board, three.radii, moved, destinations(three, moved), 1, 0.1, 0.1, chosen
    )
    near = chosen.near[: chosen.begins[1, 1]]
    assert count == 1
    assert set(np.flatnonzero(np.isin(three.owners, [0, 1]))) <= set(near)
    assert (np.diff(near) > 0).all()
