"""Set operations answer whatever they are given, and nobody else asks GEOS for them."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from shapely.errors import GEOSException
from shapely.geometry import Polygon

import packwork
from packwork.errors import ShapeError
from packwork.geometry import overlay
from packwork.geometry.outline import Outline
from packwork.geometry.overlay import difference, intersection, part_about, simplify
from strategies import generators, ring_sets

_OPERATIONS = (
    "union_all|unary_union|intersection|difference|symmetric_difference|buffer|make_valid|simplify"
)
_ASKS = re.compile(rf"\bshapely\.(?:{_OPERATIONS})\(|\w\.(?:buffer|symmetric_difference)\(")
_BUILDS = re.compile(r"\b(?:build_area|polygonize|set_precision)\(")


def test_only_one_module_asks_geos_for_set_operations() -> None:
    root = Path(packwork.__file__).parent
    asking = {
        path.relative_to(root).as_posix()
        for path in root.rglob("*.py")
        for line in path.read_text("utf-8").splitlines()
        if _ASKS.search(line) and ">>>" not in line
    }
    assert asking == {"geometry/overlay.py"}


def test_areas_are_built_of_lines_in_geometry_only() -> None:
    root = Path(packwork.__file__).parent
    building = {
        path.relative_to(root).parts[0]
        for path in root.rglob("*.py")
        if _BUILDS.search(path.read_text("utf-8"))
    }
    assert building == {"geometry"}


@given(ring_sets(), ring_sets())
@settings(deadline=None, max_examples=40)
def test_outlines_that_cross_are_answered(
    first: list[np.ndarray], second: list[np.ndarray]
) -> None:
    a, b = (Outline.from_rings(rings).region for rings in (first, second))
    both = overlay.intersection(a, b)
    assert overlay.union([a, b]).area >= both.area * (1 - 1e-9)
    assert overlay.difference(a, b).is_valid
    assert overlay.valid(overlay.buffered(a, 0.5)).is_valid


def test_what_geos_gives_up_on_is_repaired(monkeypatch: pytest.MonkeyPatch) -> None:
    bow_tie = Polygon([(0, 0), (2, 2), (2, 0), (0, 2)])
    whole = shapely.difference

    def touchy(first: Polygon, second: Polygon) -> Polygon:
        if not (np.all(shapely.is_valid(first)) and np.all(shapely.is_valid(second))):
            raise GEOSException("TopologyException: side location conflict")
        return whole(first, second)

    monkeypatch.setattr(overlay.shapely, "difference", touchy)
    assert overlay.difference(bow_tie, shapely.box(0, 0, 2, 1)).area == pytest.approx(1.0)
    many = np.array([bow_tie, shapely.box(0, 0, 2, 2)], dtype=object)
    left = overlay.difference(many, shapely.box(0, 0, 2, 1))
    assert shapely.area(left).tolist() == pytest.approx([1.0, 2.0])


def test_what_no_grid_resolves_is_one_line(monkeypatch: pytest.MonkeyPatch) -> None:
    def hopeless(first: Polygon, second: Polygon) -> Polygon:
        raise GEOSException("TopologyException: side location conflict")

    monkeypatch.setattr(overlay.shapely, "intersection", hopeless)
    with pytest.raises(ShapeError, match="simplify"):
        overlay.intersection(shapely.box(0, 0, 1, 1), shapely.box(0, 0, 1, 1))


def test_rings_that_cross_make_a_region() -> None:
    # A hole that crosses its outer ring, met first: nothing that a reader makes.
    around = np.array([[0, 0], [4, 0], [4, 4], [0, 4.0]])
    hole = np.array([[1, 1], [1, 3], [5, 3], [5, 1.0]])
    assert Outline.from_rings([hole, around]).region.is_valid


@given(generators())
@settings(deadline=None, max_examples=40)
def test_the_part_about_a_shape_serves_as_well_as_the_whole(rng: np.random.Generator) -> None:
    turns = 2 * np.pi * np.arange(400) / 400
    star = (4 + np.cos(9 * turns))[:, None] * np.column_stack([np.cos(turns), np.sin(turns)])
    whole = shapely.Polygon(star, [0.3 * star])
    shape = shapely.box(*np.sort(rng.uniform(-6, 6, (2, 2)), axis=0).ravel())
    near = part_about(whole, shape, 0.1)
    for operation in (difference, intersection):
        expected = operation(shape, whole).area
        assert operation(shape, near).area == pytest.approx(expected, abs=1e-12)


def test_a_zigzag_of_very_many_corners_is_simplified() -> None:
    # In one, GEOS calls itself once for each corner, and ends the process.
    x = np.linspace(0, 100, 200_000)
    edge = np.column_stack([x, np.arange(len(x)) % 2])
    comb = shapely.Polygon(np.vstack([edge, [[100, 50], [0, 50]]]))
    for shape in (comb, shapely.MultiPolygon([comb])):
        assert shapely.get_num_coordinates(simplify(shape, 1e-9, keeps_topology=True)) > 200_000
        plain = simplify(shape, 2.0, keeps_topology=True)
        assert shapely.get_num_coordinates(plain) < 1_000
        assert shapely.hausdorff_distance(plain, shapely.box(0, 0, 100, 50)) < 2.0
