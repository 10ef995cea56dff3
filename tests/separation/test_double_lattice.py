"""Double lattices: clear of overlap whatever the part, as dense as is known, and a nest's start."""

from __future__ import annotations

import math

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from packwork.separation.container import SquareGround, SquareSearch
from packwork.separation.double_lattice import (
    DoubleLattice,
    densest_lattices,
    laid_on_lattice,
    laid_on_sheet,
)
from packwork.separation.ground import Ground
from packwork.separation.shapes import Floats, Part, placed
from packwork.separation.sheets import SheetSearch
from packwork.separation.strip import StripSearch, WorkBound
from packwork.separation.windows import FreeSheet, lay_on_sheets

pytestmark = pytest.mark.compiled

TREE = shapely.Polygon(
    [(0, 0.8), (0.2, 0.4), (0.1, 0.4), (0.35, 0), (0.08, 0), (0.08, -0.2), (-0.08, -0.2),
     (-0.08, 0), (-0.35, 0), (-0.1, 0.4), (-0.2, 0.4)]
)  # fmt: skip
ANGLE = shapely.Polygon([(-2, -3), (2, -3), (2, -1), (0, -1), (0, 3), (-2, 3)])
CLAMP = shapely.Polygon([(0, 0), (4, 0), (4, 3), (3, 3), (3, 1), (1, 1), (1, 3), (0, 3)])
DOTS = shapely.unary_union([shapely.box(x, y, x + 0.2, y + 0.2) for x in (0, 4) for y in (0, 4)])
HALF_TURNS = (0.0, math.pi)


def regular(corners: int) -> shapely.Polygon:
    turns = np.arange(corners) * (2.0 * math.pi / corners)
    return shapely.Polygon(np.column_stack([np.cos(turns), np.sin(turns)]))


def overlap(regions: list[shapely.Polygon]) -> float:
    shapes = np.array(regions)
    first, second = shapely.STRtree(shapes).query(shapes)
    pairs = first < second
    shared = shapely.area(shapely.intersection(shapes[first[pairs]], shapes[second[pairs]]))
    return float(shared.max(initial=0.0))


def laid(region: shapely.Polygon, lattice: DoubleLattice, angle: float) -> list[shapely.Polygon]:
    """All parts of a lattice that may meet those about the origin."""
    reach = 2.5 * float(np.hypot(*np.ptp(shapely.get_coordinates(region), axis=0)))
    own, twins = lattice.places(angle, reach)
    poses = [(x, y, angle, 1.0) for x, y in own]
    poses += [(x, y, angle + math.pi, 1.0) for x, y in twins]
    return [placed(region, np.array(pose)) for pose in poses]


@settings(max_examples=25, deadline=None)
@given(
    radii=st.lists(st.floats(0.2, 2.5), min_size=3, max_size=12),
    angle=st.floats(0.0, math.pi), has_twin=st.booleans(),
)  # fmt: skip
def test_parts_of_a_lattice_never_overlap(radii: list[float], angle: float, has_twin: bool) -> None:
    turns = np.arange(len(radii)) * (2.0 * math.pi / len(radii))
    region = shapely.Polygon(np.column_stack([np.cos(turns), np.sin(turns)]) * np.c_[radii])
    lattice = densest_lattices(region, has_twin=has_twin)[0]
    assert overlap(laid(region, lattice, angle)) <= 1e-9 * region.area
    assert lattice.area >= region.area
    if has_twin:
        assert lattice.area <= densest_lattices(region, has_twin=False)[0].area


@pytest.mark.parametrize("region", [DOTS, CLAMP, ANGLE, TREE], ids=["dots", "clamp", "L", "tree"])
def test_nor_do_parts_with_pockets_or_of_pieces(region: shapely.Polygon) -> None:
    lattice = densest_lattices(region, has_twin=True)[0]
    assert overlap(laid(region, lattice, 0.4)) <= 1e-9 * region.area


@pytest.mark.parametrize(
    ("region", "density"),
    [(regular(3), 1.0), (regular(4), 1.0), (regular(5), 0.9213), (regular(7), 0.8926),
     (regular(8), 0.9061), (ANGLE, 1.0), (CLAMP, 0.8888)],
)  # fmt: skip
def test_lattices_are_as_dense_as_is_known(region: shapely.Polygon, density: float) -> None:
    found = region.area / densest_lattices(region, has_twin=True)[0].area
    assert found >= density - 0.002


def regions_of(part: Part, poses: Floats) -> list[shapely.Polygon]:
    return [placed(part.region, pose) for pose in poses]


@pytest.mark.parametrize(
    ("turns", "height"), [(None, 3.0), (HALF_TURNS, 3.0), ((0.3,), 2.0), (None, math.inf)]
)
def test_what_is_cropped_lies_on_the_strip_at_allowed_angles(
    turns: tuple[float, ...] | None, height: float
) -> None:
    part = Part(region=TREE, count=25, turns=turns)
    found = laid_on_lattice(part, height)
    assert found is not None
    length, poses = found
    regions = regions_of(part, poses)
    assert len(regions) == 25
    assert overlap(regions) <= 1e-9
    x0, y0, x1, y1 = shapely.total_bounds(np.array(regions))
    assert min(x0, y0) >= -1e-9
    assert max(x1, y1 if math.isinf(height) else 0.0) <= length + 1e-9
    assert y1 <= height + 1e-9
    assert turns is None or set(poses[:, 2]) <= set(turns)


HIDE = shapely.Point(3, 3).buffer(3) - shapely.Point(3.4, 3.3).buffer(0.6)


@settings(max_examples=10, deadline=None)
@given(
    wide=st.floats(1.2, 5.0), tall=st.floats(1.2, 4.0), count=st.integers(6, 40),
    x=st.floats(0.0, 5.0), turns=st.sampled_from([HALF_TURNS, (0.3,), (0.0, math.pi / 2)]),
)  # fmt: skip
def test_what_lies_on_a_sheet_is_inside_and_clear_of_what_is_there(
    wide: float, tall: float, count: int, x: float, turns: tuple[float, ...]
) -> None:
    held = shapely.Point(x, 1.0).buffer(0.5)
    poses = laid_on_sheet(Part(region=TREE, count=count, turns=turns), wide, tall, (held,))
    regions = regions_of(Part(region=TREE), poses)
    assert len(regions) <= count
    assert overlap([*regions, held]) <= 1e-9
    assert all(shapely.box(-1e-9, -1e-9, wide + 1e-9, tall + 1e-9).covers(one) for one in regions)
    assert set(poses[:, 2]) <= set(turns)


@pytest.mark.parametrize("sheet", [shapely.box(0, 0, 5, 3), HIDE], ids=["plate", "hide"])
def test_sheets_hold_sixty_parts_on_less_than_without_a_lattice(
    sheet: shapely.Polygon, monkeypatch: pytest.MonkeyPatch
) -> None:
    part = Part(region=TREE, count=60, turns=HALF_TURNS)

    def taken() -> tuple[int, float]:
        laid, left = lay_on_sheets(
            [part], [FreeSheet(sheet)] * 6, seed=0, workers=1, work=WorkBound(places=60_000),
            stop=lambda: False,
        )  # fmt: skip
        assert not left
        for one in laid:
            regions = regions_of(part, one.poses)
            assert overlap(regions) <= 1e-9
            assert all(sheet.buffer(1e-6).covers(region) for region in regions)
        last = regions_of(part, laid[-1].poses)
        return len(laid), max(region.bounds[2] for region in last)

    with_lattice = taken()
    monkeypatch.setattr(SheetSearch, "lay_lattice", lambda _: False)
    assert with_lattice < taken()


def test_a_strip_lower_than_the_part_has_no_lattice() -> None:
    assert laid_on_lattice(Part(region=TREE, count=9), 0.5) is None


@pytest.mark.parametrize(
    ("region", "turns", "height"),
    [(TREE, None, 3.0), (CLAMP, HALF_TURNS, 20.0), (regular(5), None, math.inf)],
    ids=["tree", "clamp", "square"],
)
def test_sixty_parts_take_less_than_without_a_lattice(
    region: shapely.Polygon, turns: tuple[float, ...] | None, height: float,
    monkeypatch: pytest.MonkeyPatch,
) -> None:  # fmt: skip
    kind, ground = StripSearch, Ground(height)
    if math.isinf(height):
        kind, ground = SquareSearch, SquareGround()
    part = Part(region=region, count=60, turns=turns)

    def length() -> float:
        strip = kind([part], ground, workers=1, work=WorkBound(places=30_000)).run()
        assert overlap(regions_of(part, strip.poses)) <= 1e-9 * region.area
        return strip.length

    with_lattice = length()
    monkeypatch.setattr(StripSearch, "lay_lattice", lambda _: False)
    assert with_lattice < length()
