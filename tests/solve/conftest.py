"""Scenes and options that every solver test shares."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from packwork.geometry.outline import Outline
from packwork.scene.pose import Poses
from packwork.solve.options import SolveOptions
from scenes import disc, poses, square, star

Scene = tuple[list[Outline], Poses]


@pytest.fixture
def quick() -> Callable[..., SolveOptions]:
    """Options of a short solve on small images; whatever a test is about goes on top."""

    def options(**changes: object) -> SolveOptions:
        short = {"levels": (32, 64), "epochs": 60}
        return SolveOptions.model_validate(short | changes)

    return options


@pytest.fixture
def crowd(rng: np.random.Generator) -> Scene:
    """Nine items of three kinds on a canvas of 100, crowded, turned, some sticking out."""
    outlines = [square(), disc(), star()] * 3
    return outlines, poses(
        rng.uniform(15, 85, 9), rng.uniform(15, 85, 9), rng.uniform(-3, 3, 9), rng.uniform(9, 16, 9)
    )
