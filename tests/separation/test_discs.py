"""Jammed packings of discs: clear of each other and of the edge, the same for the same seed."""

from __future__ import annotations

import math

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from packwork.arrays import FloatArray
from packwork.geometry.outline import Outline
from packwork.readers.builtin import builtin_container
from packwork.separation.discs import DiscPacking, DiscSearch, wall_of
from packwork.separation.kernels import discs as kernels

RING = Outline.of(shapely.Point(50, 50).buffer(50).difference(shapely.Point(50, 50).buffer(30)))
TWO = Outline.of(shapely.MultiPolygon([shapely.box(0, 0, 60, 90), shapely.box(65, 0, 100, 40)]))
SLOT = Outline.of(shapely.Polygon([(0, 0), (100, 0), (100, 20), (52, 21), (50, 80), (48, 21)]))
CONTAINERS = {
    "star": builtin_container("star", 100.0).outline,
    "heart": builtin_container("heart", 100.0).outline,
    "ring": RING,
    "two": TWO,
    "slot": SLOT,
}
QUICK = 1.0
compiled = pytest.mark.compiled


def sizes(count: int, seed: int = 0) -> FloatArray:
    return np.exp(np.random.default_rng(seed).normal(0, 0.5, count))


def packed(
    container: Outline, radii: FloatArray, gap: float = 0.0, seed: int = 0, work: float = QUICK
) -> DiscPacking:
    return DiscSearch(container, radii, gap, seed, work).run()


def clearances(container: Outline, found: DiscPacking, radii: FloatArray) -> tuple[float, float]:
    """Least distance of two discs, and of a disc and the edge, negative for those outside."""
    reach = found.scale * radii
    apart = np.hypot(*(found.centres[:, None] - found.centres[None]).T) - reach - reach[:, None]
    np.fill_diagonal(apart, np.inf)
    points = shapely.points(found.centres)
    far = shapely.distance(container.region.boundary, points)
    inside = shapely.contains(container.region, points)
    return float(apart.min()), float((np.where(inside, far, -far) - reach).min())


@pytest.mark.parametrize("name", CONTAINERS)
@pytest.mark.parametrize("gap", [0.0, 0.4])
@compiled
def test_discs_keep_the_gap_from_each_other_and_from_the_edge(name: str, gap: float) -> None:
    container, radii = CONTAINERS[name], sizes(60)
    found = packed(container, radii, gap)
    least = min(clearances(container, found, radii))
    assert gap - 1e-9 <= least <= gap + 1e-6


def test_few_discs_keep_clear_without_a_compiler_too() -> None:
    radii = sizes(4)
    found = packed(TWO, radii, 0.5)
    assert min(clearances(TWO, found, radii)) >= 0.5 - 1e-9


@settings(max_examples=12, deadline=None)
@given(st.integers(0, 10**6), st.integers(1, 40), st.sampled_from(sorted(CONTAINERS)))
@compiled
def test_no_discs_meet_whatever_they_are(seed: int, count: int, name: str) -> None:
    container, radii = CONTAINERS[name], sizes(count, seed) ** 2
    found = packed(container, radii, 0.1, seed)
    assert found.scale > 0
    assert min(clearances(container, found, radii)) >= 0.1 - 1e-9


@compiled
def test_one_seed_gives_one_packing() -> None:
    radii = sizes(50)
    first, again, other = (packed(RING, radii, 0.0, seed, 5e5) for seed in (1, 1, 2))
    assert first.scale == again.scale
    assert (first.centres == again.centres).all()
    assert (first.centres != other.centres).all()


@compiled
def test_many_discs_of_mixed_sizes_cover_what_jammed_ones_of_fixed_places_cannot() -> None:
    """Random jammed packings of such discs cover .85."""
    square, radii = Outline.box(0, 0, 100, 100), sizes(800)
    found = [packed(square, radii, seed=seed) for seed in range(3)]
    covered = [math.pi * float(np.square(one.scale * radii).sum()) / square.area for one in found]
    assert np.median(covered) > 0.87


@compiled
def test_discs_on_small_islands_hold_no_others_back() -> None:
    """Random places put several onto some islands that have room for one, or for none."""
    islands = [shapely.box(110, 8 * row, 110 + 0.6 * row, 8 * row + 4) for row in range(1, 12)]
    container = Outline.of(shapely.MultiPolygon([shapely.box(0, 0, 100, 100), *islands]))
    radii = sizes(150)
    for seed in range(4):
        found = packed(container, radii, 0.4, seed)
        assert math.pi * np.square(found.scale * radii).sum() > 0.68 * container.area


@compiled
def test_large_discs_are_strewn_among_small_ones() -> None:
    radii = np.sort(sizes(800))
    found = packed(Outline.box(0, 0, 100, 100), radii)
    side = np.abs(found.centres - 50).max(axis=1)
    inner = side < 50 * math.sqrt(0.5)
    shares = [inner[part].mean() for part in np.array_split(np.arange(800), 4)]
    assert all(0.3 < share < 0.7 for share in shares)


@compiled
def test_more_work_packs_no_worse() -> None:
    radii = sizes(40)
    quick, long = (packed(RING, radii, work=work).scale for work in (5e5, 2e6))
    assert long >= quick


@compiled
def test_what_is_stopped_at_once_is_clear_too() -> None:
    radii = sizes(60)
    found = DiscSearch(TWO, radii, 0.2, 0, 1e9, stop=lambda: True).run()
    assert found.scale > 0
    assert min(clearances(TWO, found, radii)) >= 0.2 - 1e-9


@compiled
def test_it_tells_how_far_it_is_and_where_discs_are() -> None:
    told: list[float] = []

    def tell(share: float, centres: FloatArray, scale: float) -> None:
        assert centres.shape == (30, 2)
        assert scale > 0
        told.append(share)

    DiscSearch(RING, sizes(30), 0.0, 0, 2e5, tell).run()
    assert told == sorted(told)
    assert 0 < told[0] < told[-1] <= 1


@compiled
def test_near_pairs_are_those_that_a_search_of_all_finds() -> None:
    rng = np.random.default_rng(3)
    discs, radii, skin = rng.uniform(0, 20, (120, 2)), rng.lognormal(-0.5, 0.8, 120), 0.3
    found = np.empty((5_000, 2), np.int64)
    count = kernels.near_pairs(discs, radii, skin, found)
    apart = np.hypot(*(discs[:, None] - discs[None]).T) - radii - radii[:, None]
    expected = {(i, j) for i, j in np.argwhere(apart < skin).tolist() if i < j}
    assert {(min(pair), max(pair)) for pair in found[:count].tolist()} == expected
    assert count == len(expected)


@pytest.mark.parametrize("name", CONTAINERS)
@compiled
def test_distances_of_the_edge_are_exact(name: str) -> None:
    """The largest scale of one disc at a point is its distance from the edge."""
    container = CONTAINERS[name]
    wall = wall_of(container, 100)
    left, top, right, bottom = container.bounds
    drawn = np.random.default_rng(0).uniform((left, top), (right, bottom), (300, 2))
    for point in drawn:
        here = shapely.Point(point)
        far = container.region.boundary.distance(here)
        expected = far if container.region.contains(here) else -far
        scale = kernels.clear_scales(point[None], np.ones(1), 0.0, 0.0, wall, 200.0)[0]
        assert scale == pytest.approx(expected, abs=1e-9)


@compiled
def test_the_slope_of_the_energy_is_its_derivative() -> None:
    rng = np.random.default_rng(1)
    discs, own, wall = rng.uniform(0, 100, (60, 2)), sizes(60), wall_of(RING, 60)

    def energy(scale: float) -> tuple[float, float]:
        return kernels.excess(discs, scale * own, own, 0.0, wall)

    step, (_, slope) = 1e-5, energy(6.0)
    found = (energy(6.0 + step)[0] - energy(6.0 - step)[0]) / (2 * step)
    assert slope == pytest.approx(found, rel=1e-5)


@compiled
def test_a_descent_lowers_the_energy_and_keeps_all_radii() -> None:
    rng = np.random.default_rng(1)
    discs, radii, wall = rng.uniform(20, 80, (60, 2)), 6 * sizes(60), wall_of(TWO, 60)
    before, _ = kernels.excess(discs, radii, radii, 0.0, wall)
    owners, first = np.arange(60), radii.copy()
    kernels.relax(discs, radii, owners, 0.0, wall, 200, 10, 0.0)
    after, _ = kernels.excess(discs, radii, radii, 0.0, wall)
    assert after < before / 2
    assert (radii == first[owners]).all()
    assert sorted(owners) == list(range(60))


@compiled
def test_discs_that_are_alike_lie_in_a_lattice() -> None:
    """Random jammed packings of equal discs cover .84."""
    found = [packed(Outline.box(0, 0, 100, 90), np.ones(600), seed=seed) for seed in range(3)]
    assert np.median([math.pi * 600 * one.scale**2 / 9_000 for one in found]) > 0.85
