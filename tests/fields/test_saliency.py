"""Spectral residual: what is unlike its surroundings stands out, wherever it lies."""

from __future__ import annotations

import numpy as np
import pytest

from packwork.fields.filters import spectral_residual


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
