"""The start in containers that are but lines."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from packwork.geometry.outline import Outline
from packwork.start.erosion import Spread, is_thread, scales_within, spread_along
from scenes import box, disc, star


def spiral(turns: int = 20, width: float = 1.0) -> Outline:
    """A line of one width, 200 across."""
    angle = np.linspace(0.0, 2 * np.pi * turns, 60 * turns)
    way = np.column_stack([np.cos(angle), np.sin(angle)]) * (100 * angle / angle[-1])[:, None]
    return Outline.from_region(shapely.LineString(way).buffer(width / 2))


def hairs(count: int = 300) -> Outline:
    left = np.arange(count) * 200.0 / count
    return Outline.from_region(shapely.MultiPolygon(list(shapely.box(left, 0, left + 0.1, 200.0))))


def discs_of(found: Spread) -> list[shapely.Polygon]:
    return [shapely.Point(x, y).buffer(found.radius) for x, y in zip(found.x, found.y, strict=True)]


@pytest.mark.parametrize("container", [spiral(), hairs()], ids=["spiral", "hairs"])
@pytest.mark.parametrize("count", [1, 40, 400])
def test_discs_lie_inside_and_apart(container: Outline, count: int) -> None:
    found = spread_along(container, count, np.random.default_rng(1))
    assert found is not None
    discs = discs_of(found)
    assert container.region.buffer(1e-6).covers(shapely.union_all(discs))
    tree = shapely.STRtree(discs)
    assert len(tree.query(discs, predicate="intersects")[0]) == count


@pytest.mark.parametrize("container", [spiral(), hairs()], ids=["spiral", "hairs"])
def test_discs_are_spread_over_all_of_it(container: Outline) -> None:
    found = spread_along(container, 40, np.random.default_rng(1))
    assert found is not None
    left, top, right, bottom = container.bounds
    share = np.column_stack([(found.x - left) / (right - left), (found.y - top) / (bottom - top)])
    quarters = np.histogram2d(*share.T, bins=2, range=[[0, 1], [0, 1]])[0]
    assert quarters.min() >= 6


def test_one_seed_gives_one_spread() -> None:
    first, second = (spread_along(spiral(), 9, np.random.default_rng(3)) for _ in range(2))
    assert first is not None
    assert second is not None
    assert np.array_equal(first.x, second.x)


def test_what_has_no_room_for_so_many_has_no_spread() -> None:
    assert spread_along(box(0, 0, 10, 1), 500, np.random.default_rng(0)) is None


def test_what_is_wide_somewhere_is_no_thread() -> None:
    radii = np.full(10, 5.0)
    assert is_thread(spiral(), radii)
    assert not is_thread(disc(50.0), radii)
    furred = shapely.union_all([hairs().region, shapely.Point(100, 100).buffer(60.0)])
    assert not is_thread(Outline.from_region(furred), radii)


@pytest.mark.parametrize("is_common", [True, False])
def test_items_of_such_scales_lie_in_the_disc(is_common: bool) -> None:
    outlines = [star(1.0), disc(0.8, 24), box(-3.0, -0.2, 3.0, 0.2)]
    nominal = np.array([1.0, 2.0, 0.5])
    scales, typical = scales_within(outlines, nominal, 0.3, is_common=is_common)
    for outline, scale in zip(outlines, scales, strict=True):
        assert np.hypot(*outline.points.T).max() * scale <= 0.3 * (1 + 1e-9)
    assert np.allclose(typical / nominal, typical[0] / nominal[0])
    if is_common:
        assert np.allclose(scales, typical)


def test_a_rough_edge_is_not_eroded_to_tell_that_it_is_no_thread(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """That took 21 s and 1.5 GB for a disc whose edge has 490,000 points."""

    def refused(*_: object, **__: object) -> None:
        pytest.fail("the outline was grown or shrunk")

    monkeypatch.setattr("packwork.start.erosion.buffered", refused)
    angle = np.linspace(0, 2 * np.pi, 40_000, endpoint=False)
    radius = 90 + 10 * np.sin(2_000 * angle)
    rough = Outline.from_rings([np.column_stack([np.cos(angle), np.sin(angle)]) * radius[:, None]])
    assert rough.area / rough.region.length < 0.3 * 20.0
    assert not is_thread(rough, np.full(10, 20.0))


@pytest.mark.parametrize("pitch", [0.25, 0.4, 1.0 / 3])
def test_close_hairs_are_no_shape(pitch: float) -> None:
    left = np.arange(0.0, 200.0, pitch)
    lines = shapely.box(left, 0, left + 0.2 * pitch, 200.0)
    assert is_thread(Outline.from_region(shapely.MultiPolygon(list(lines))), np.full(10, 5.0))
