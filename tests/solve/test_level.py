"""One level's pose gradient: against differences, against itself at other resolutions."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest

from numerics import assert_gradient, compare
from packwork.arrays import FloatArray, Image
from packwork.errors import RecipeError
from packwork.forces.field import Direction
from packwork.forces.forces import FieldForce, Forces
from packwork.geometry import affine
from packwork.geometry.outline import Outline
from packwork.losses.image import containment, evenness, filling, overlap
from packwork.losses.term import ImageLoss, Term
from packwork.raster.coverage import Rasteriser, coverage, coverage_pullback, region_image
from packwork.scene.container import Container
from packwork.scene.pose import Limits, Poses, Zone
from packwork.solve.level import Level
from packwork.solve.outlines import Ensemble
from scenes import (
    as_array,
    disc,
    from_array,
    overlap_area,
    placed,
    poses,
    round_container,
    square,
    square_container,
    star,
    taken,
)

RECALL = 5.0
WEIGHTS = {"containment": RECALL, "overlap": 7.0, "filling": 1.5, "evenness": 2.0}


class DoubleTwin:
    """What a level differentiates, in float64 and from the parts: value and gradient.

    Without the recall of items whose centre is outside: none is, in these scenes.
    """

    def __init__(self, container: Container, outlines: Sequence[Outline], resolution: int) -> None:
        self.px_per_cu = resolution / container.side
        self.shape = (resolution, resolution)
        self.image = region_image(
            container.outline, Rasteriser(self.shape, np.float64), self.px_per_cu
        )
        self.ensemble = Ensemble(outlines)
        self.areas = np.array([outline.area for outline in outlines])

    def value(self, numbers: FloatArray) -> float:
        density = self._density(numbers)
        on_canvas = sum(weight * term.value for weight, term in self._terms(density)) * density.size
        area_px = float(np.sum(self.areas * np.exp(2 * numbers[:, 3]))) * self.px_per_cu**2
        beyond = RECALL * (area_px - float(density.sum()))
        return (on_canvas + beyond) / self.px_per_cu**2

    def gradient(self, numbers: FloatArray) -> FloatArray:
        density = self._density(numbers)
        adjoint = sum(weight * term.adjoint for weight, term in self._terms(density)) * density.size
        points = self.ensemble.place(from_array(numbers), self.px_per_cu)
        by_points = coverage_pullback(points, self.ensemble.ring_starts, adjoint, RECALL)
        by_pose = self.ensemble.gather(by_points, from_array(numbers), self.px_per_cu)
        return by_pose / self.px_per_cu**2

    def _density(self, numbers: FloatArray) -> Image:
        points = self.ensemble.place(from_array(numbers), self.px_per_cu)
        return coverage(points, self.ensemble.ring_starts, self.shape)

    def _terms(self, density: Image) -> list[tuple[float, Term]]:
        return [
            (WEIGHTS["containment"], containment(density, self.image)),
            (WEIGHTS["overlap"], overlap(density, self.image)),
            (WEIGHTS["filling"], filling(density, self.image)),
            (WEIGHTS["evenness"], evenness(density, self.image, len(self.areas))),
        ]


def scene(rng: np.random.Generator) -> tuple[list[Outline], Poses]:
    """Items that overlap, stick out of the container and hang off the canvas."""
    outlines = [star(), disc(), square(), star(1.2, 7)]
    x, y = [12.0, 50.0, 60.0, 87.0], [48.0, 50.0, 57.0, 60.0]
    stretches = [1.4, 1.0, 0.75, 1.6]
    return outlines, poses(x, y, rng.uniform(-3, 3, 4), [16.0, 18.0, 12.0, 21.0], stretches)


def test_gradient_equals_differences_in_double_precision(rng: np.random.Generator) -> None:
    outlines, where = scene(rng)
    twin = DoubleTwin(square_container(), outlines, 40)
    at = as_array(where)
    assert_gradient(twin.value, twin.gradient(at), at, step=2.0**-20, error=1e-5)


def test_level_agrees_with_its_double_twin(rng: np.random.Generator) -> None:
    outlines, where = scene(rng)
    twin = DoubleTwin(square_container(), outlines, 40)
    level = Level(square_container(), outlines, 40)
    met = compare(level.gradient(where, WEIGHTS, RECALL), twin.gradient(as_array(where)))
    assert met.error < 2e-3, met
    assert abs(met.bias) < 1e-3, met


def test_the_objective_is_what_the_gradient_is_of(rng: np.random.Generator) -> None:
    outlines, where = scene(rng)
    twin = DoubleTwin(square_container(), outlines, 40)
    level = Level(square_container(), outlines, 40)
    met = level.objective(where, WEIGHTS, RECALL)
    canvas = 100.0**2
    assert met.total * canvas == pytest.approx(twin.value(as_array(where)), rel=1e-4)
    assert list(met.terms) == [*WEIGHTS, "recall"]
    assert met.terms["recall"] > 0


def test_terms_of_poses_and_forces_are_in_the_objective(rng: np.random.Generator) -> None:
    outlines, where = scene(rng)
    down = FieldForce(Direction(np.pi / 2), np.ones(4))
    region = disc(20.0).mapped(affine.similarity(30.0, 40.0, 0.0, 1.0))
    limits = replace(Limits.free(4), zones=(Zone(region, np.array([0, 3])),))
    forces = Forces([down], [], np.zeros(4, int), 100.0)
    weights: dict[str | ImageLoss, float] = {"area-shares": 3.0}
    level = Level(square_container(), outlines, 40, weights, np.full(4, 16.0), limits, forces)

    def value(numbers: FloatArray) -> float:
        return level.objective(from_array(numbers), weights, RECALL, 0.5).total * 100.0**2

    at, slopes = as_array(where), level.gradient(where, weights, RECALL, 0.5)
    # Places alone: recall and forces leave out that larger items weigh more.
    along = np.zeros_like(at)
    along[:, :2] = rng.normal(size=(4, 2))
    step = 2.0**-5
    met = (value(at + step * along) - value(at - step * along)) / (2 * step)
    assert met == pytest.approx(float((along * slopes).sum()), rel=0.02)


def test_losses_of_one_name_are_told_apart() -> None:
    def loss(density: Image, container: Image) -> Term:
        return Term(1.0, np.zeros_like(density))

    def other(density: Image, container: Image) -> Term:
        return Term(2.0, np.zeros_like(density))

    other.__name__ = loss.__name__
    weights: dict[str | ImageLoss, float] = {loss: 1.0, other: 1.0}
    level = Level(square_container(), [disc()], 20, weights)
    met = level.objective(poses([50.0], [50.0], 0.0, [9.0]), weights)
    assert met.terms == {"loss": 1.0, "loss 2": 2.0}
    assert met.total == 3.0


def test_physics_does_not_change_with_the_level(rng: np.random.Generator) -> None:
    outlines = [disc(1.0, 64), star(), square()]
    angles, scales, stretches = [0.3, 1.0, 0.4], [16.0, 15.0, 14.0], [1.5, 1.2, 0.9]
    where = poses([45.0, 62.0, 20.0], [50.0, 55.0, 30.0], angles, scales, stretches)
    coarse, fine = (
        Level(round_container(), outlines, resolution).gradient(where, WEIGHTS, RECALL)
        for resolution in (200, 600)
    )
    for column in range(5):
        met = compare(coarse[:, column], fine[:, column])
        assert met.error < 0.05, (column, met)


def test_an_item_outside_is_called_straight_back() -> None:
    container = square_container()
    level = Level(container, [disc(), disc()], 50)
    gradient = level.gradient(poses([-60.0, 50.0], [50.0, 170.0], 0.0, 5.0), WEIGHTS, RECALL)
    assert gradient[0, 0] < 0 < gradient[1, 1]
    assert abs(gradient[0, 1]) < 0.1 * abs(gradient[0, 0])
    assert abs(gradient[1, 0]) < 0.1 * abs(gradient[1, 1])


def test_permuting_items_permutes_the_gradient_bit_for_bit(rng: np.random.Generator) -> None:
    outlines, where = scene(rng)
    order = [2, 0, 3, 1]
    straight = Level(square_container(), outlines, 50).gradient(where, WEIGHTS, RECALL)
    turned = Level(square_container(), [outlines[k] for k in order], 50)
    np.testing.assert_array_equal(
        turned.gradient(taken(where, order), WEIGHTS, RECALL), straight[order]
    )


def test_a_further_loss_adds_its_weighted_gradient(rng: np.random.Generator) -> None:
    outlines, where = scene(rng)
    plain = Level(square_container(), outlines, 50)
    more = Level(square_container(), outlines, 50, [*WEIGHTS, overlap])
    heavier = {**WEIGHTS, "overlap": WEIGHTS["overlap"] + 3.0}
    np.testing.assert_allclose(
        more.gradient(where, {**WEIGHTS, overlap: 3.0}, RECALL),
        plain.gradient(where, heavier, RECALL),
        rtol=1e-4,
        atol=1e-2,
    )


def test_an_unknown_loss_is_refused_by_name() -> None:
    with pytest.raises(RecipeError, match=r"losses: no loss is called 'charm'.*containment"):
        Level(square_container(), [disc()], 50, ["charm"])


def test_shares_are_what_geometry_says() -> None:
    container = square_container(side=100.0, margin=10.0)
    outlines = [square(), square()]
    where = poses([30.0, 40.0], [30.0, 30.0], 0.0, [10.0, 10.0])
    level = Level(container, outlines, 100)
    covered, twice, outside = level.shares(level.density(where))
    assert twice == pytest.approx(overlap_area(placed(outlines, where)) / 6_400, abs=1e-4)
    assert covered == pytest.approx(600 / 6_400, abs=1e-4)
    assert outside == pytest.approx(0.0, abs=1e-6)


def test_shares_count_what_sticks_out() -> None:
    level = Level(square_container(side=100.0, margin=10.0), [square()], 100)
    _, _, outside = level.shares(level.density(poses([10.0], [50.0], 0.0, 8.0)))
    assert outside == pytest.approx(8 * 16 / 6_400, abs=1e-4)
