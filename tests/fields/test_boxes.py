"""Box means against the plain double loop, and as their own adjoint."""

from __future__ import annotations

import numpy as np
import pytest

from packwork.arrays import Image
from packwork.errors import ShapeError
from packwork.fields.filters import box_mean


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
