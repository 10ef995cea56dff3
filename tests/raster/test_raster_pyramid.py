"""Image sizes, and one region at several resolutions."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from numerics import box_mean
from packwork.arrays import FloatArray
from packwork.geometry.outline import Outline
from packwork.raster.coverage import Rasteriser, image_shape, region_image
from strategies import star_rings


@pytest.mark.parametrize(
    ("width", "height", "resolution", "shape"),
    [
        (600, 300, 50, (25, 50)),
        (300, 600, 50, (50, 25)),
        (1, 1, 600, (600, 600)),
        (1000, 1, 100, (1, 100)),
        (3, 2, 100, (67, 100)),
        (0.1, 0.3, 30, (30, 10)),
    ],
)
def test_the_longer_side_has_the_resolution(
    width: float, height: float, resolution: int, shape: tuple[int, int]
) -> None:
    assert image_shape(width, height, resolution) == shape


@given(width=st.floats(1e-3, 1e6), height=st.floats(1e-3, 1e6), resolution=st.integers(1, 2_000))
def test_the_image_covers_the_canvas_and_no_spare_row(
    width: float, height: float, resolution: int
) -> None:
    rows, columns = image_shape(width, height, resolution)
    per_cu = resolution / max(width, height)
    assert max(rows, columns) == resolution
    assert rows >= height * per_cu - 1e-6 >= rows - 1 - 1e-6 or rows == 1
    assert columns >= width * per_cu - 1e-6 >= columns - 1 - 1e-6 or columns == 1


@given(ring=star_rings())
def test_levels_agree(ring: FloatArray) -> None:
    outline = Outline.from_rings([ring])
    coarse = region_image(outline, Rasteriser((4, 4), np.float64), 0.5)
    fine = region_image(outline, Rasteriser((16, 16), np.float64), 2.0)
    np.testing.assert_allclose(box_mean(fine, 4), coarse, atol=1e-9)
    assert float(fine.sum()) / 4 == pytest.approx(outline.area)
