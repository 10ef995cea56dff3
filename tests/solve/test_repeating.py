"""The level of a tile: its image on the torus, and its gradient against differences."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from numerics import assert_gradient, compare
from packwork.arrays import FloatArray
from packwork.geometry.lattice import Lattice
from packwork.geometry.outline import Outline
from packwork.losses.image import SLACK
from packwork.raster.coverage import coverage
from packwork.scene.container import tiled
from packwork.scene.layout import sheet
from packwork.scene.pose import Poses
from packwork.solve.level import Level, RepeatingLevel, Torus
from scenes import as_array, from_array, poses, star

WEIGHTS = {"overlap": 7.0, "filling": 1.5}
SIDE = 60


def level_of(kind: str, outlines: list[Outline]) -> tuple[RepeatingLevel, Lattice]:
    container = tiled(sheet("page", 60.0, 60.0), kind)
    lattice = container.lattice
    assert lattice is not None
    return RepeatingLevel(container, lattice, outlines, SIDE, 20.0, WEIGHTS), lattice


def value(numbers: FloatArray, lattice: Lattice, outlines: list[Outline]) -> float:
    """Losses of one cell in float64, all images drawn into it one by one."""
    where = from_array(numbers)
    shape = round(lattice.height), round(lattice.width)
    density = np.zeros(shape)
    for k, outline in enumerate(outlines):
        placed = outline.mapped(where.matrix(k))
        for shift in lattice.meeting(placed.bounds, lattice.cell):
            density += coverage(placed.points + shift, placed.starts, shape)
    excess = np.where(density > 1 + SLACK, density - 1, 0).sum()
    return float(WEIGHTS["overlap"] * excess - WEIGHTS["filling"] * np.minimum(density, 1).sum())


def scene(kind: str) -> tuple[RepeatingLevel, Lattice, list[Outline], Poses]:
    outlines = [star(1.0), star(1.0, 7), star(1.0)]
    level, lattice = level_of(kind, outlines)
    # One over each side, one over a corner, and they overlap over the edge.
    where = poses([1.3, lattice.width - 4.2, 13.1], [31.7, 29.4, 0.4], [0.3, 1.1, 2.0], 9.37)
    return level, lattice, outlines, where


@pytest.mark.parametrize("kind", ["square", "half-drop"])
def test_the_gradient_is_that_of_all_images(kind: str) -> None:
    level, lattice, outlines, where = scene(kind)
    found = level.gradient(where, WEIGHTS).copy()
    assert_gradient(
        lambda numbers: value(numbers, lattice, outlines), found, as_array(where), error=2e-2
    )


@pytest.mark.parametrize("kind", ["square", "half-drop"])
def test_a_translation_of_the_lattice_changes_nothing(kind: str) -> None:
    level, lattice, _, where = scene(kind)
    before = level.gradient(where, WEIGHTS).copy()
    moved = replace(where, x=where.x + lattice.width, y=where.y + lattice.drop - lattice.height)
    assert compare(level.gradient(moved, WEIGHTS), before).error < 1e-4


def test_a_tile_whose_items_stay_within_is_as_any_canvas() -> None:
    outlines = [star(1.0), star(1.0)]
    level, _ = level_of("square", outlines)
    where = poses([20.2, 31.4], [30.1, 33.3], [0.2, 0.9], 11.0)
    plain = Level(sheet("page", 60.0, 60.0), outlines, SIDE, WEIGHTS)
    assert compare(level.gradient(where, WEIGHTS), plain.gradient(where, WEIGHTS)).error < 1e-4


@pytest.mark.parametrize("drop", [0.0, 4.0])
def test_sums_over_translates_and_laying_out_are_transposes(drop: float) -> None:
    torus = Torus(Lattice(6.0, 8.0, drop), 1.0, 5)
    rng = np.random.default_rng(0)
    x, y = rng.random((2, *torus.shape))
    cell = np.zeros_like(y)
    cell[5:13, 5:11] = y[5:13, 5:11]
    # What a sum over translates reads in the cell is what laying the cell out gives each pixel.
    assert np.vdot(torus.summed(x), cell) == pytest.approx(np.vdot(x, torus.repeated(y)))


@pytest.mark.parametrize("margin", [0, 3, 17])
@pytest.mark.parametrize("drop", [0.0, 4.0, 7.0])
def test_an_image_repeats_and_sums_as_each_pixel_by_itself(drop: float, margin: int) -> None:
    torus = Torus(Lattice(6.0, 8.0, drop), 1.0, margin)
    rows, columns = np.indices(torus.shape) - margin
    across, x = np.divmod(columns, 6)
    pixels = np.remainder(rows - across * int(drop), 8) * 6 + x
    image = np.random.default_rng(margin).random(torus.shape).astype(np.float32)
    sums = np.bincount(pixels.reshape(-1), image.reshape(-1), 48)
    np.testing.assert_array_equal(torus.summed(image), sums.astype(np.float32)[pixels])
    cell = image[margin : margin + 8, margin : margin + 6]
    np.testing.assert_array_equal(torus.repeated(image), cell.reshape(-1)[pixels])
