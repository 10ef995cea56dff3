"""Limbs of containers: where they are long and thin, and bands along their edges."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from packwork.geometry.outline import Outline
from packwork.readers.builtin import builtin_container
from packwork.readers.container import read_container
from packwork.scene.container import Container
from packwork.start.limbs import edges_of, limbs_of


def container(shape: object) -> Container:
    return Container("shape", "shape", Outline.of(shape))  # type: ignore[arg-type]


LOLLIPOP = shapely.union(shapely.Point(0, 0).buffer(30), shapely.box(-4, 20, 4, 150))
"""A disc on a stick."""


def test_a_disc_has_no_limbs() -> None:
    assert limbs_of(container(shapely.Point(0, 0).buffer(9))) == []


def test_the_stick_of_a_lollipop_is_a_limb_and_its_disc_is_none() -> None:
    [limb] = limbs_of(container(LOLLIPOP))
    assert limb.axis.points[:, 1].min() > 55
    assert np.median(limb.half) == pytest.approx(4, abs=0.2)
    assert limb.axis.length == pytest.approx(118, abs=8)


def test_a_limb_begins_at_its_wider_end() -> None:
    spike = shapely.Polygon([(0, -3), (120, -12), (120, 12), (0, 3)])
    [limb] = limbs_of(container(spike))
    assert limb.half[0] > 2 * limb.half[-1]


def test_limbs_do_not_lie_in_each_other() -> None:
    cross = shapely.union(shapely.box(-60, -6, 60, 6), shapely.box(-6, -60, 6, 60))
    limbs = limbs_of(container(cross))
    assert len(limbs) >= 3
    lines = [shapely.LineString(limb.axis.points) for limb in limbs]
    for k, line in enumerate(lines):
        assert all(line.distance(other) > 2 for other in lines[k + 1 :])


def test_both_halves_of_a_loop_are_limbs() -> None:
    loop = shapely.Point(0, 0).buffer(50) - shapely.Point(0, 0).buffer(40)
    limbs = limbs_of(container(loop))
    assert sum(limb.axis.length for limb in limbs) == pytest.approx(90 * np.pi, rel=0.1)


def test_a_band_along_the_edge_of_a_disc_is_a_circle() -> None:
    [band] = edges_of(container(shapely.Point(0, 0).buffer(50)), 10.0)
    assert np.hypot(*(band.axis.points - 50).T) == pytest.approx(45, abs=0.3)
    assert band.axis.points[0] == pytest.approx([50, 95], abs=0.5)
    assert band.axis.at(band.axis.length / 4)[0] < 20


def test_bands_lie_in_the_container() -> None:
    land = builtin_container("australia")
    for band in edges_of(land, 30.0):
        discs = shapely.buffer(shapely.points(band.axis.points), 0.99 * band.half)
        assert shapely.covers(land.outline.region, discs).all()


def ring(outer: float, inner: float) -> Container:
    centre = shapely.Point(300, 300)
    return container(centre.buffer(outer, 64) - centre.buffer(inner, 64))


def test_a_ring_is_one_limb_that_closes_and_goes_both_ways_from_its_top() -> None:
    [limb] = limbs_of(ring(280, 190))
    assert limb.is_loop
    assert limb.axis.length == pytest.approx(2 * np.pi * 235, rel=0.02)
    assert np.ptp(limb.half) < 3
    x, y = limb.axis.points[:-1].mean(axis=0)
    one, other = limb.ways
    for way in (one, other):
        assert way.axis.points[0] == pytest.approx((x, y - 235), abs=3)
        assert way.axis.points[-1] == pytest.approx((x, y + 235), abs=3)
    # One to the right, the other to the left.
    assert one.axis.points[:, 0].max() == pytest.approx(x + 235, abs=3)
    assert other.axis.points[:, 0].min() == pytest.approx(x - 235, abs=3)


def test_frames_and_shapes_of_two_holes_are_no_rings() -> None:
    limbs = limbs_of(container(shapely.box(0, 0, 900, 500) - shapely.box(100, 100, 800, 400)))
    assert limbs
    assert not any(limb.is_loop for limb in limbs)
    assert not any(limb.is_loop for limb in limbs_of(read_container("text:8")))
    assert not any(limb.is_loop for limb in limbs_of(ring(280, 40)))
