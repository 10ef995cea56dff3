"""Parts in a container that shrinks about them; angles within a limit; spans against a twin."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt
import pytest
import shapely
import shapely.affinity

from packwork.separation.container import ContainerSearch
from packwork.separation.ground import Ground
from packwork.separation.shapes import Part, edges_of, spans_of
from packwork.separation.strip import StripSearch, WorkBound

pytestmark = pytest.mark.compiled

L_SHAPE = shapely.Polygon([(-2, -3), (2, -3), (2, -1), (0, -1), (0, 3), (-2, 3)])
DISC = shapely.Point(20, 30).buffer(12, quad_segs=16)


def laid(region: shapely.Polygon, pose: npt.NDArray[np.float64]) -> shapely.Polygon:
    x, y, angle = pose
    turned = shapely.affinity.rotate(region, angle, (0, 0), use_radians=True)
    return shapely.affinity.translate(turned, x, y)


@pytest.mark.parametrize("room", [DISC, shapely.box(8, 18, 32, 42)])
@pytest.mark.parametrize("factor", [1.0, 1.2])
def test_parts_come_apart_inside_the_container_made_smaller(
    room: shapely.Polygon, factor: float
) -> None:
    rng = np.random.default_rng(0)
    poses = np.column_stack([rng.uniform(10, 30, 9), rng.uniform(20, 40, 9), np.zeros(9)])
    parts = [Part(region=L_SHAPE, count=9, turns=None)]
    search = ContainerSearch(parts, room, poses)
    with search.pool:
        found, loss = search.separated(poses, factor, 200, fresh=True)
    assert loss == 0.0
    # Larger parts in the container as it was are the same as a smaller container.
    large = shapely.affinity.scale(L_SHAPE, factor, factor, origin=(0, 0))
    regions = [laid(large, pose) for pose in found]
    for k, region in enumerate(regions):
        assert room.buffer(1e-9).covers(region)
        assert all(region.intersection(other).area < 1e-9 for other in regions[:k])


def test_a_part_turns_no_farther_than_its_reach() -> None:
    parts = [Part(region=L_SHAPE, count=8, turns=None, reach=0.3)]
    strip = StripSearch(parts, Ground(14.0), work=WorkBound(passes=60)).run()
    assert np.abs(strip.poses[:, 2]).max() <= 0.3
    assert len(np.unique(strip.poses[:, 2])) > 1


@pytest.mark.parametrize("pixel", [0.3, 1.7, 50.0])
def test_spans_are_those_of_the_slow_way(pixel: float) -> None:
    for angle in np.linspace(0.0, math.pi, 7):
        turned = shapely.affinity.rotate(
            L_SHAPE.union(shapely.box(4, -2, 5, 2)), angle, (0, 0), use_radians=True
        )
        np.testing.assert_array_equal(
            spans_of(edges_of(turned), pixel), slow_spans(edges_of(turned), pixel)
        )


def slow_spans(edges: npt.NDArray[np.float64], pixel: float) -> npt.NDArray[np.int64]:
    ax, ay, bx, by = edges
    found = []
    for row in range(math.ceil(edges[1].min() / pixel), math.floor(edges[1].max() / pixel) + 1):
        y = row * pixel
        met = (ay > y) != (by > y)
        cuts = np.sort(ax[met] + (y - ay[met]) / (by[met] - ay[met]) * (bx[met] - ax[met]))
        for start, end in zip(cuts[::2], cuts[1::2], strict=True):
            first = round(float(start) / pixel)
            found.append((row, first, max(round(float(end) / pixel), first + 1)))
    if not found:
        first = round(float(edges[0].min()) / pixel)
        found.append((0, first, max(round(float(edges[0].max()) / pixel), first + 1)))
    return np.array(found, dtype=np.int64).T
