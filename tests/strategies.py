"""Shapes and images for property tests."""

from __future__ import annotations

import numpy as np
from hypothesis import strategies as st

from packwork.arrays import FloatArray, IntArray

SEEDS = st.integers(0, 2**32 - 1)
SHAPES = st.tuples(st.integers(1, 9), st.integers(1, 9))
"""Rows and columns of images that the slow twins can bear."""


def joined(rings: list[FloatArray]) -> tuple[FloatArray, IntArray]:
    """Rings in the renderer's form: all points, and where each ring starts."""
    starts = np.cumsum([0] + [len(ring) for ring in rings]).astype(np.int64)
    return np.concatenate(rings).astype(np.float64), starts


def generators() -> st.SearchStrategy[np.random.Generator]:
    """Seeded random generators; the seed is what a failure reports."""
    return SEEDS.map(np.random.default_rng)


@st.composite
def wild_rings(draw: st.DrawFn, low: float = -6.0, high: float = 15.0) -> FloatArray:
    """Any closed polyline, mostly self-crossing, on and off a small image."""
    coordinate = st.floats(low, high, allow_nan=False)
    points = draw(st.lists(st.tuples(coordinate, coordinate), min_size=3, max_size=8))
    return np.array(points, dtype=np.float64)


@st.composite
def lattice_rings(draw: st.DrawFn, low: int = -3, high: int = 12) -> FloatArray:
    """Closed polylines on whole coordinates: edges on grid lines, repeats, spikes."""
    coordinate = st.integers(low, high)
    points = draw(st.lists(st.tuples(coordinate, coordinate), min_size=3, max_size=8))
    return np.array(points, dtype=np.float64)


def rounded(ring: FloatArray) -> FloatArray:
    """Ring on a lattice of 2**-24: differences far below any tolerance upset GEOS."""
    return np.asarray(np.round(ring * 2.0**24) / 2.0**24)


@st.composite
def star_rings(
    draw: st.DrawFn,
    centre: tuple[float, float] = (4.0, 4.0),
    inner: float = 0.3,
    outer: float = 3.9,
) -> FloatArray:
    """Simple rings, clockwise on screen, each vertex between two circles."""
    rng = np.random.default_rng(draw(SEEDS))
    count = draw(st.integers(3, 12))
    # A gap of half a turn would turn the ring inside out.
    jitter = rng.uniform(0, 0.4 if count == 3 else 0.8, count)
    turns = 2 * np.pi * (np.arange(count) + jitter) / count
    radii = rng.uniform(inner, outer, count)
    return np.column_stack([centre[0] + radii * np.cos(turns), centre[1] + radii * np.sin(turns)])


@st.composite
def ring_sets(draw: st.DrawFn, most: int = 4) -> list[FloatArray]:
    """A few rings of every kind, some of them reversed as holes are."""
    kinds = st.one_of(wild_rings(), lattice_rings(), star_rings(), star_rings((1.0, 9.0)))
    rings = draw(st.lists(kinds, min_size=1, max_size=most))
    return [ring[::-1].copy() if draw(st.booleans()) else ring for ring in rings]


def rounded_sets(most: int = 3) -> st.SearchStrategy[list[FloatArray]]:
    """As :func:`ring_sets`, for tests that ask GEOS."""
    return ring_sets(most).map(lambda rings: [rounded(ring) for ring in rings])


def _blob(rng: np.random.Generator, centre: FloatArray, radius: float) -> FloatArray:
    count = int(rng.integers(4, 10))
    turns = 2 * np.pi * (np.arange(count) + rng.uniform(0.1, 0.9, count)) / count
    radii = radius * rng.uniform(0.4, 1.0, count)
    spokes = radii[:, None] * np.column_stack([np.cos(turns), np.sin(turns)])
    return np.asarray(centre + spokes)


def _inside(rng: np.random.Generator, side: float) -> list[FloatArray]:
    return [_blob(rng, np.full(2, side / 2), 0.45 * side)]


def _partly_off(rng: np.random.Generator, side: float) -> list[FloatArray]:
    corner = rng.choice([0.0, side / 2, side], 2)
    return [_blob(rng, corner + rng.normal(size=2), 0.6 * side)]


def _wholly_off(rng: np.random.Generator, side: float) -> list[FloatArray]:
    away = [(-2, 0.5), (3, 0.5), (0.5, -2), (0.5, 3), (-2, -2)][int(rng.integers(5))]
    return [_blob(rng, side * np.array(away), side)]


def _self_crossing(rng: np.random.Generator, side: float) -> list[FloatArray]:
    return [rng.uniform(-0.3 * side, 1.3 * side, (8, 2))]


def _tiny(rng: np.random.Generator, side: float) -> list[FloatArray]:
    return [_blob(rng, rng.uniform(0, side, 2), 0.2) for _ in range(5)]


def _huge(rng: np.random.Generator, side: float) -> list[FloatArray]:
    return [_blob(rng, rng.uniform(0, side, 2), 300 * side)]


def _holed(rng: np.random.Generator, side: float) -> list[FloatArray]:
    centre = np.full(2, side / 2)
    hole = _blob(rng, centre, 0.15 * side)[::-1]
    return [_blob(rng, centre, side), hole, _blob(rng, np.zeros(2), 0.3 * side)]


def _slanted(rng: np.random.Generator, side: float) -> list[FloatArray]:
    slant = rng.uniform(1e-3, 1e-2, 4) * side
    low, high = 0.13 * side + slant[:2], 0.83 * side + slant[2:]
    return [np.array([low, [high[0], low[1] + slant[2]], high, [low[0] + slant[3], high[1]]])]


POLYGONS = {
    "inside": _inside,
    "partly off": _partly_off,
    "wholly off": _wholly_off,
    "self-crossing": _self_crossing,
    "tiny": _tiny,
    "huge": _huge,
    "holed": _holed,
    "nearly upright": _slanted,
}
"""Seeded makers of rings round an image of a given side: one for each way to be hard."""
