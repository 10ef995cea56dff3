"""Limbs of containers: where they are long and thin, and bands along their edges."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from packwork.geometry.outline import Outline
from packwork.readers.builtin import builtin_container
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
