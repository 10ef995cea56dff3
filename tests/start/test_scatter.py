"""The random start: every place of the container, and no other."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from packwork.start.places import scatter
from strategies import generators


@given(rng=generators(), count=st.integers(1, 50), px_per_cu=st.floats(0.1, 10))
def test_items_lie_in_the_container(rng: np.random.Generator, count: int, px_per_cu: float) -> None:
    image = rng.uniform(size=(7, 11))
    image[3, 5] = 1
    x, y = scatter(image, px_per_cu, count, rng)
    # The product may round onto the next pixel's edge.
    column, row = (np.floor(v * px_per_cu * (1 - 1e-12)).astype(int) for v in (x, y))
    assert len(x) == len(y) == count
    assert (image[row, column] > 0.5).all()


def test_it_is_uniform_over_the_container() -> None:
    image = np.zeros((4, 8))
    image[:, :2] = image[1:3, 6:] = 1
    x, _ = scatter(image, 1.0, 6_000, np.random.default_rng(0))
    assert abs(np.mean(x > 4) - 1 / 3) < 0.03
