"""No error of GEOS passes a stage without an answer."""

from __future__ import annotations

import importlib

import numpy as np
import pytest
from shapely.errors import GEOSException

import packwork as pw
from packwork.compaction.arrangement import find_conflicts
from packwork.compaction.outer_simplify import inner_simplified
from packwork.errors import ReadError
from packwork.geometry.outline import Outline
from packwork.geometry.polygon import region
from packwork.readers.builtin import builtin_container
from packwork.scene.pose import Poses


def _country(rng: np.random.Generator) -> Outline:
    """A coast of fjords, and islands in front of it: what maps look like."""
    turns = np.linspace(0, 2 * np.pi, 900, endpoint=False)
    radii = 200 + np.cumsum(rng.normal(0, 3.0, 900)) % 60
    coast = 300 + radii[:, None] * np.column_stack([np.cos(turns), np.sin(turns)])
    islands = [rng.uniform(20, 580, 2) + rng.uniform(-9, 9, (12, 2)) for _ in range(60)]
    return Outline.from_region(region([coast, *islands]))


@pytest.mark.parametrize("tolerance", [0.05, 0.5, 2.0, 6.0])
def test_simplified_containers_of_many_fjords_lie_inside(tolerance: float) -> None:
    whole = _country(np.random.default_rng(3)).region
    inside = inner_simplified(whole, tolerance)
    assert inside.is_valid
    assert whole.buffer(1e-6).covers(inside)


def test_an_error_of_geos_is_one_line_that_names_the_container(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def fails(*_: object, **__: object) -> None:
        raise GEOSException("TopologyException: side location conflict at 1 2")

    monkeypatch.setattr(importlib.import_module("packwork.pipeline.run"), "run_steps", fails)
    with pytest.raises(ReadError, match=r"^square: cannot be resolved: Topology"):
        pw.fill("square", "star", count=2, effort="draft")


def test_nothing_is_in_conflict_where_nothing_is() -> None:
    none = np.zeros(0)
    container = builtin_container("square", 9.0)
    assert find_conflicts(container, [], Poses(none, none, none, none), 0.1) == ()
