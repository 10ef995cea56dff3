"""The choice of a start, and that it is recorded."""

from __future__ import annotations

import numpy as np
import pytest

from packwork.geometry.outline import Outline
from packwork.scene.container import Container
from packwork.start.first_poses import first_poses
from packwork.start.options import StartOptions
from packwork.start.places import suitable
from scenes import box, disc, round_container


def strip() -> Container:
    return Container("strip", "strip", box(2, 45, 98, 55), 100.0, 100.0)


@pytest.mark.parametrize("px_per_cu", [0.5, 1.0, 3.0])
def test_the_choice_depends_on_the_form_and_not_on_the_pixels(px_per_cu: float) -> None:
    image = np.ones((round(12 * px_per_cu), round(120 * px_per_cu)))
    assert suitable(image, px_per_cu, np.full(9, 5.0)) == "medial-axis"
    assert suitable(image, px_per_cu, np.full(99, 1.5)) == "distance-field"


def test_a_round_container_is_never_narrow_for_items_that_fit_in_it() -> None:
    away = np.hypot(*(np.indices((80, 80)) + 0.5 - 40))
    image = np.asarray(away < 40, dtype=np.float64)
    for radius in (1.0, 5.0, 20.0):
        assert suitable(image, 1.0, np.full(4, radius)) == "distance-field"


@pytest.mark.parametrize(
    ("container", "count", "radius", "method"),
    [(strip(), 8, 4.5, "medial-axis"), (round_container(), 12, 10.0, "distance-field")],
)
def test_auto_is_the_method_that_it_names(
    container: Container, count: int, radius: float, method: str
) -> None:
    outlines: list[Outline] = [disc()] * count
    scales, angles = np.full(count, radius), np.zeros(count)

    def begin(asked: str) -> tuple[list[float], str]:
        options = StartOptions.model_validate({"method": asked})
        first = first_poses(container, outlines, scales, angles, options, np.random.default_rng(0))
        return [*first.poses.x, *first.poses.y], first.method

    assert begin("auto") == begin(method)
    assert begin("auto")[1] == method
