"""Box means, and saliency by the spectral residual."""

from __future__ import annotations

import numpy as np
import pytest

from packwork.arrays import Image
from packwork.errors import ShapeError
from packwork.fields.filters import box_mean, spectral_residual


def slow_box_mean(image: Image, size: int) -> Image:
    reach = size // 2
    padded = np.pad(image, reach)
    rows, columns = image.shape
    return np.array(
        [
            [padded[r : r + size, c : c + size].sum() / size**2 for c in range(columns)]
            for r in range(rows)
        ]
    )


@pytest.mark.parametrize("size", [1, 3, 5, 11, 31])
@pytest.mark.parametrize("shape", [(1, 1), (1, 9), (9, 1), (6, 8)])
def test_mean_equals_the_plain_loop(
    shape: tuple[int, int], size: int, rng: np.random.Generator
) -> None:
    image = rng.random(shape)
    np.testing.assert_allclose(box_mean(image, size), slow_box_mean(image, size), atol=1e-14)


def test_mean_is_its_own_adjoint(rng: np.random.Generator) -> None:
    x, y = rng.normal(size=(2, 7, 9))
    assert np.vdot(box_mean(x, 5), y) == pytest.approx(np.vdot(x, box_mean(y, 5)))


@pytest.mark.parametrize("size", [0, 2, -3])
def test_an_even_box_has_no_middle(size: int) -> None:
    with pytest.raises(ShapeError, match="odd size"):
        box_mean(np.ones((3, 3)), size)


def textured(shape: tuple[int, int] = (48, 64)) -> np.ndarray:
    rng = np.random.default_rng(0)
    return np.clip(rng.normal(0.5, 0.05, (*shape, 3)), 0, 1)


@pytest.mark.parametrize(("row", "column"), [(4, 50), (24, 32), (40, 5)])
def test_a_patch_stands_out_wherever_it_is(row: int, column: int) -> None:
    picture = textured()
    picture[row : row + 6, column : column + 8] = (0.9, 0.2, 0.1)
    found = spectral_residual(picture)
    peak = np.unravel_index(found.argmax(), found.shape)
    assert abs(peak[0] - (row + 2.5)) <= 4
    assert abs(peak[1] - (column + 3.5)) <= 4
    assert np.median(found) < 0.5


def test_a_slope_does_not_stand_out_at_its_edges() -> None:
    slope = np.tile(np.linspace(0.2, 0.8, 48)[:, None, None], (1, 64, 1))
    slope += np.random.default_rng(0).normal(0, 0.01, slope.shape)
    slope[20:26, 20:28] = 0.0
    found = spectral_residual(slope)
    assert found[[0, -1]].max() < 0.5 < found[18:28, 18:30].max()


def test_nothing_stands_out_of_one_colour() -> None:
    assert not spectral_residual(np.full((40, 40, 3), 0.3)).any()


def test_turning_the_picture_turns_the_map() -> None:
    picture = textured((40, 40))
    picture[5:9, 20:30] = 0.0
    turned = spectral_residual(np.rot90(picture))
    np.testing.assert_allclose(turned, np.rot90(spectral_residual(picture)), atol=1e-9)
