"""Parts of fixed size on a strip: valid whatever they are, and the same for the same work."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
import numpy.typing as npt
import pytest
import shapely
import shapely.affinity

from packwork.separation.container import SquareGround, SquareSearch
from packwork.separation.ground import Ground
from packwork.separation.kernels.field import MARGIN, draw_others, score_row
from packwork.separation.kernels.moves import put_all
from packwork.separation.shapes import Part, poles_of, rings_of, spare
from packwork.separation.state import Problem, WorkerState
from packwork.separation.strip import Strip, StripSearch, WorkBound

pytestmark = pytest.mark.compiled

QUARTERS = tuple(k * math.pi / 2 for k in range(4))
L_SHAPE = shapely.Polygon([(-2, -3), (2, -3), (2, -1), (0, -1), (0, 3), (-2, 3)])
RING = (
    shapely.Point(0, 0)
    .buffer(4, quad_segs=6)
    .difference(shapely.Point(0, 0).buffer(3, quad_segs=6))
)
DOTS = shapely.unary_union([shapely.box(x, y, x + 0.2, y + 0.2) for x in (0, 4) for y in (0, 4)])
TRIANGLE = shapely.Polygon([(-1.5, -1), (1.5, -1), (0, 2)])
NEEDLE = shapely.box(-3, -0.05, 3, 0.05)


def star(rng: np.random.Generator, corners: int) -> shapely.Polygon:
    """A simple polygon about the origin, with reflex corners."""
    angles = np.sort(rng.uniform(0, 2 * math.pi, corners))
    if np.diff(angles, append=angles[0] + 2 * math.pi).max() > 0.9 * math.pi:
        angles = np.linspace(0, 2 * math.pi, corners, endpoint=False)
    radii = rng.uniform(0.4, 2.5, corners)
    return shapely.Polygon(np.column_stack([radii * np.cos(angles), radii * np.sin(angles)]))


def placed(problem: Problem, poses: npt.NDArray[np.float64]) -> list[shapely.Polygon]:
    return [
        shapely.affinity.affine_transform(
            problem.parts[s].region,
            [side * math.cos(a), -math.sin(a), side * math.sin(a), math.cos(a), x, y],
        )
        for s, (x, y, a, side) in zip(problem.shape_of, poses, strict=True)
    ]


def overlap(polygons: Sequence[shapely.Polygon]) -> float:
    return max(
        (a.intersection(b).area for k, a in enumerate(polygons) for b in polygons[:k]), default=0.0
    )


def search(
    parts: Sequence[Part], height: float, passes: int, seed: int = 0
) -> tuple[Problem, Strip]:
    one = StripSearch(parts, Ground(height), seed=seed, work=WorkBound(passes=passes))
    return one.problem, one.run()


@pytest.mark.parametrize("seed", range(4))
def test_no_part_overlaps_or_sticks_out_and_none_is_lost(seed: int) -> None:
    rng = np.random.default_rng(seed)
    allowed = (None, (0.0,), (0.0, math.pi), QUARTERS)
    parts = [
        Part(region=star(rng, int(rng.integers(3, 12))), count=int(rng.integers(1, 4)),
             turns=allowed[rng.integers(4)], mirrors=bool(rng.integers(2)))
        for _ in range(6)
    ]  # fmt: skip
    parts += [Part(region=RING, turns=None), Part(region=NEEDLE, count=2, turns=QUARTERS)]
    problem, strip = search(parts, 12.0, 60, seed)
    polygons = placed(problem, strip.poses)
    assert len(polygons) == sum(part.count for part in parts) == len(problem)
    assert overlap(polygons) <= 1e-9 * problem.area
    x0, y0, x1, y1 = shapely.total_bounds(np.array(polygons))
    assert min(x0, y0) > -1e-9
    assert x1 < strip.length + 1e-9
    assert y1 < 12.0 + 1e-9
    for s, angle in zip(problem.shape_of, strip.poses[:, 2], strict=True):
        turns = parts[s].turns
        assert turns is None or angle in turns
    for s, side in zip(problem.shape_of, strip.poses[:, 3], strict=True):
        assert side == 1 or (side == -1 and parts[s].mirrors)


def test_the_same_work_gives_the_same_strip_and_more_of_it_no_longer_one() -> None:
    parts = [
        Part(region=L_SHAPE, count=6, turns=QUARTERS),
        Part(region=TRIANGLE, count=5, turns=None),
    ]
    first, again = (search(parts, 10.0, 80, seed=3)[1] for _ in range(2))
    np.testing.assert_array_equal(first.poses, again.poses)
    few, many = (
        sum(search(parts, 10.0, passes, seed)[1].length for seed in range(4))
        for passes in (40, 400)
    )
    assert many < few


class Watched(StripSearch):
    """A search that notes the strip that it leaves when it begins anew."""

    def run(self) -> Strip:
        self.left = list[float]()
        return super().run()

    def begin_anew(self, until: float) -> None:
        self.left.append(self.best.length)
        super().begin_anew(until)


def test_a_search_that_gains_nothing_begins_anew_and_keeps_the_shortest(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    parts = [Part(region=L_SHAPE, count=3, turns=QUARTERS), Part(region=TRIANGLE, count=2)]
    for most in (10**9, 3):
        monkeypatch.setattr("packwork.separation.strip.DEAD_ENDS", most)
        one = Watched(parts, Ground(9.0), seed=1, work=WorkBound(passes=15_000))
        found = one.run()
        assert (len(one.left) > 2) == (most == 3)
        assert found.length <= min([*one.left, math.inf])


def test_a_part_lies_in_the_hole_of_another_where_there_is_no_room_besides() -> None:
    parts = [Part(region=RING), Part(region=shapely.box(-1.5, -1.5, 1.5, 1.5))]
    problem, strip = search(parts, 8.2, 300)
    assert strip.length < 8.6
    assert overlap(placed(problem, strip.poses)) == 0.0


def test_squares_that_fit_exactly_once_are_laid_in_a_row() -> None:
    _, strip = search([Part(region=shapely.box(-1, -1, 1, 1), count=5)], 2.001, 200)
    assert 10.0 <= strip.length < 10.1


@pytest.mark.parametrize("seed", range(8))
def test_what_collides_is_what_overlaps(seed: int) -> None:
    """Prices of pairs are above 0 just where Shapely finds that they touch."""
    rng = np.random.default_rng(seed)
    parts = [Part(region=star(rng, 9), count=3, turns=None, mirrors=True),
             Part(region=RING, count=2, turns=None, mirrors=True),
             Part(region=L_SHAPE, count=4, turns=None, mirrors=True),
             Part(region=DOTS, count=4, turns=None, mirrors=True)]  # fmt: skip
    problem = Problem(parts, Ground(16.0))
    count = len(problem)
    poses = np.column_stack(
        [rng.uniform(0, 16, (count, 2)), rng.uniform(0, 6, count), rng.choice([-1, 1], count)]
    )
    layout = WorkerState.of(problem, 16.0, poses, 1)
    polygons = placed(problem, poses)
    for i, a in enumerate(polygons):
        for j, b in enumerate(polygons):
            if i != j:
                assert (layout.losses[i, j] > 0) == a.intersects(b)
        inside = shapely.box(0, 0, 16, 16).covers(a)
        assert (layout.losses[i, i] > 0) != inside
    np.testing.assert_array_equal(layout.losses, layout.losses.T)


def test_losses_kept_up_by_moves_are_those_of_the_poses() -> None:
    parts = [
        Part(region=L_SHAPE, count=8, turns=QUARTERS),
        Part(region=TRIANGLE, count=6, turns=None),
    ]
    problem = Problem(parts, Ground(9.0))
    rng = np.random.default_rng(0)
    poses = np.column_stack(
        [rng.uniform(0, 12, 14), rng.uniform(0, 9, 14), np.zeros(14), np.ones(14)]
    )
    layout = WorkerState.of(problem, 12.0, poses, 5)
    for _ in range(5):
        layout.move()
        layout.raise_weights()
        kept = layout.losses.copy()
        put_all(layout.poses, layout.arrays, problem.shapes, problem.turns, layout.weights,
                layout.losses, layout.sheet, layout.turned, layout.scratch)  # fmt: skip
        np.testing.assert_array_equal(kept > 0.0, layout.losses > 0.0)
        # Poles have 32 bits.
        np.testing.assert_allclose(kept, layout.losses, rtol=1e-4)


def test_scores_of_places_are_sums_of_the_image_below_the_part() -> None:
    parts = [Part(region=L_SHAPE, count=4, turns=QUARTERS), Part(region=TRIANGLE, count=3)]
    problem = Problem(parts, Ground(12.0))
    rng = np.random.default_rng(2)
    poses = np.column_stack([rng.uniform(2, 18, 7), rng.uniform(2, 10, 7), np.zeros(7), np.ones(7)])
    layout = WorkerState.of(problem, 20.0, poses, 1)
    layout.weights[:] = rng.uniform(1, 3, (7, 7))
    turns, moved = problem.turns, 6
    image = layout.image.copy()
    draw = getattr(draw_others, "py_func", draw_others)
    draw(moved, problem.pixel, layout.arrays[0], layout.arrays[1], layout.weights, turns.span_at,
         turns.spans, image)  # fmt: skip
    density = np.diff(image[:, MARGIN:-MARGIN], axis=1)
    first, last = turns.span_at[-2], turns.span_at[-1]
    scores = np.zeros(30, np.float32)
    getattr(score_row, "py_func", score_row)(10, 8, 15, first, last, turns.spans, image, scores)
    for c in range(0, 15, 3):
        total = sum(
            density[10 + row, 8 + c + begin : 8 + c + end].sum()
            for row, begin, end in turns.spans[:, first:last].T
        )
        assert scores[c] == pytest.approx(total, rel=1e-4, abs=1e-3)
    assert image.shape[0] == math.ceil(12.0 / problem.pixel)


@pytest.mark.parametrize("region", [L_SHAPE, RING, TRIANGLE, NEEDLE], ids="LRTN")
def test_poles_lie_inside_and_apart(region: shapely.Polygon) -> None:
    x, y, radius = poles_of(region)
    circles = [
        shapely.Point(a, b).buffer(r * (1 - 1e-9))
        for a, b, r in zip(x, y, radius, strict=True)
        if r
    ]
    assert all(region.buffer(1e-9).covers(circle) for circle in circles)
    assert overlap(circles) < 1e-6 * region.area


def test_a_simplified_outline_holds_the_true_one_and_its_gap() -> None:
    true = shapely.Point(0, 0).buffer(5, quad_segs=100)
    few = spare(true, 0.2)
    assert few.covers(true.buffer(0.1 - 1e-9, quad_segs=100))
    assert sum(map(len, rings_of(few))) < 100
    assert few.area < 1.06 * true.area


def test_a_part_is_mirrored_where_it_fits_only_so() -> None:
    hook = shapely.Polygon([(-2, -3), (2, -3), (2, -1), (0, -1), (0, 3), (-2, 3)])
    room = shapely.affinity.scale(hook, -1.0, 1.0, origin=(0, 0)).buffer(0.5)
    plate = shapely.box(-3, -4, 3, 4).difference(room)
    one_hand, mirrored = (
        min(
            search([Part(region=plate), Part(region=hook, mirrors=mirrors)], 8.001, 150, seed)[1]
            .length for seed in range(3)
        ) for mirrors in (False, True)
    )  # fmt: skip
    assert one_hand > 8.0
    assert mirrored < 6.1


def test_a_search_that_is_stopped_at_once_has_a_strip_all_the_same() -> None:
    parts = [Part(region=L_SHAPE, count=30, turns=QUARTERS), Part(region=RING, count=9, turns=None)]
    one = StripSearch(parts, Ground(14.0), work=WorkBound(passes=10**6), stop=lambda: True)
    strip = one.run()
    polygons = placed(one.problem, strip.poses)
    assert overlap(polygons) < 1e-9
    assert shapely.total_bounds(np.array(polygons))[3] < 14.0 + 1e-9


@pytest.mark.parametrize(
    ("kind", "ground", "name"),
    [(StripSearch, Ground(14.0), "length"), (SquareSearch, SquareGround(), "side")],
)
def test_progress_tells_what_gets_shorter(
    kind: type[StripSearch], ground: Ground, name: str
) -> None:
    work = WorkBound(passes=4, margins=2.0)
    found = kind([Part(region=L_SHAPE, count=6, turns=QUARTERS)], ground, work=work).run()
    assert work.best_so_far == f"{name} {found.length + 2.0:.5g}"
