"""Items put one after another: nothing meets, all in proportion, and closely."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import shapely

from packwork.arrays import FloatArray
from packwork.forces.field import Direction
from packwork.forces.forces import FieldForce
from packwork.geometry.outline import Outline
from packwork.scene.container import Container
from packwork.scene.pose import Limits, Poses, Zone
from packwork.start.first_fit.first_fit import first_fit

BOX = Outline.from_rings([np.array([[-1.0, -1], [1, -1], [1, 1], [-1, 1]])])
BAR = Outline.from_rings([np.array([[-3.0, -0.5], [3, -0.5], [3, 0.5], [-3, 0.5]])])
HOOK = Outline.from_rings(
    [np.array([[-2.0, -2], [2, -2], [2, -1], [-1, -1], [-1, 2], [-2, 2]])]
)  # its origin lies off it
UPRIGHT = np.zeros(1)
TURNS = np.radians([0.0, 90.0, 180.0, 270.0])


def _disc(side: float = 100.0) -> Container:
    disc = shapely.Point(side / 2, side / 2).buffer(0.45 * side)
    return Container("disc", "", Outline.from_region(disc), side, side)


def _regions(outlines: list[Outline], poses: Poses) -> list[shapely.Geometry]:
    return [outline.mapped(poses.matrix(k)).region for k, outline in enumerate(outlines)]


def _fit(
    outlines: list[Outline], scales: FloatArray, angles: FloatArray = UPRIGHT, *, seed: int = 0,
    **options: object,
) -> Poses:  # fmt: skip
    rng = np.random.default_rng(seed)
    found = first_fit(_disc(), outlines, scales, [angles] * len(outlines), rng, **options)  # type: ignore[arg-type]
    assert found is not None
    return found


@pytest.mark.parametrize("angles", [UPRIGHT, TURNS])
def test_nothing_meets_nothing_sticks_out_and_all_are_in_proportion(angles: FloatArray) -> None:
    outlines = [BOX, BAR, HOOK] * 6
    scales = np.linspace(1, 2, 18)
    poses = _fit(outlines, scales, angles)
    regions = _regions(outlines, poses)
    union = shapely.union_all(regions)
    assert union.area == pytest.approx(sum(region.area for region in regions), rel=1e-9)
    assert shapely.difference(union, _disc().outline.region).area < 1e-9
    ratio = poses.scale / scales
    assert ratio == pytest.approx(np.full(18, ratio[0]))
    assert set(poses.angle) <= set(angles)
    assert union.area / _disc().outline.area > 0.4


def test_a_margin_is_kept_between_items_and_to_the_edge() -> None:
    outlines = [BOX, HOOK] * 5
    poses = _fit(outlines, np.ones(10), margin_cu=1.5)
    regions = _regions(outlines, poses)
    apart = min(a.distance(b) for i, a in enumerate(regions) for b in regions[:i])
    edge = _disc().outline.region.boundary
    assert apart >= 3.0 - 1e-6
    assert min(edge.distance(region) for region in regions) >= 1.5 - 1e-6


def test_more_angles_and_more_orders_lose_hardly_anything() -> None:
    outlines = [BAR, HOOK] * 12
    plain = _fit(outlines, np.ones(24)).scale[0]
    # On an image twice as coarse.
    assert _fit(outlines, np.ones(24), TURNS).scale[0] > plain / 1.02
    assert _fit(outlines, np.ones(24), attempts=8).scale[0] >= plain / 1.02


def test_pins_and_zones_hold() -> None:
    outlines = [BOX] * 8
    left = Outline.from_region(shapely.box(0, 0, 40, 100))
    limits = replace(
        Limits.free(8),
        x=np.array([60.0, 30.0, *[np.nan] * 6]),
        y=np.array([50.0, *[np.nan] * 7]),
        smallest=np.array([4.0, *np.zeros(7)]),
        largest=np.array([4.0, *np.full(7, np.inf)]),
        zones=(Zone(left, np.array([6, 7])),),
    )
    scales = np.array([4.0, *np.ones(7)])
    poses = _fit(outlines, scales, limits=limits)
    assert (poses.x[0], poses.y[0], poses.scale[0]) == (60.0, 50.0, 4.0)
    assert poses.x[1] == pytest.approx(30.0, abs=0.5)
    assert (poses.x[6:] < 40).all()
    regions = _regions(outlines, poses)
    assert shapely.union_all(regions[1:]).area == pytest.approx(7 * 4 * poses.scale[1] ** 2)
    # The pinned one is drawn on whole pixels, here 0.36 wide.
    assert shapely.intersection(regions[0], shapely.union_all(regions[1:])).area < 1.0


def test_seeds_differ_and_one_seed_gives_one_result() -> None:
    def run(seed: int) -> list[float]:
        rng = np.random.default_rng(seed)
        found = first_fit(_disc(), [BOX] * 9, np.linspace(1, 1.5, 9), [UPRIGHT] * 9, rng)
        assert found is not None
        return [float(value) for value in found.x]

    assert run(1) == run(1)
    assert run(1) != run(2)


def test_where_nothing_can_fit_nothing_is_found() -> None:
    thread = Outline.from_region(shapely.LineString([(5, 5), (95, 90)]).buffer(0.05))
    container = Container("thread", "", thread, 100, 100)
    rng = np.random.default_rng(0)
    assert first_fit(container, [BOX] * 3, np.ones(3), [UPRIGHT] * 3, rng) is None


def test_a_stop_ends_the_search_while_margins_are_made() -> None:
    """Those of hundreds of words take seconds."""
    asked = [0]

    def stop() -> bool:
        asked[0] += 1
        return asked[0] > 3

    angles, rng = [np.zeros(1)] * 9, np.random.default_rng(0)
    assert first_fit(_disc(), [BOX] * 9, np.ones(9), angles, rng, margin_cu=0.1, stop=stop) is None
    assert asked[0] <= 6


def test_a_stop_ends_the_search_at_once() -> None:
    rng = np.random.default_rng(0)
    angles = [UPRIGHT] * 3
    assert first_fit(_disc(), [BOX] * 3, np.ones(3), angles, rng, stop=lambda: True) is None


def test_a_field_draws_to_its_low_those_that_it_acts_on() -> None:
    outlines, scales = [BOX] * 15, np.ones(15)
    strengths = np.where(np.arange(15) < 3, 3.0, 0.0)
    to_left = FieldForce(Direction(np.pi), strengths)
    without = _fit(outlines, scales)
    drawn = _fit(outlines, scales, fields=[to_left])
    assert drawn.x[:3].mean() < without.x[:3].mean()
    assert drawn.scale[0] > without.scale[0] / 2


def test_what_is_left_over_is_no_single_void(monkeypatch: pytest.MonkeyPatch) -> None:
    outlines, scales = [BOX] * 60, np.linspace(1, 3, 60)

    def void() -> float:
        """Radius of the widest void, the median of seeds."""
        found = []
        for seed in range(3):
            union = shapely.union_all(_regions(outlines, _fit(outlines, scales, seed=seed)))
            left = shapely.difference(_disc().outline.region, union)
            found.append(float(shapely.maximum_inscribed_circle(left).length))
        return float(np.median(found))

    evened = void()
    monkeypatch.setattr("packwork.start.first_fit.first_fit.LOOSE", ())
    assert evened < void()
