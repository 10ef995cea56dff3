"""What the benchmarks judge by, on cases whose answer is known."""

from __future__ import annotations

import sys
import time
from pathlib import Path

import numpy as np
import pytest

sys.path.append(str(Path(__file__).parents[1]))

from benchmarks.kit import circles
from benchmarks.paper import cases
from benchmarks.peers import peer_penrose, peering
from benchmarks.quality.photos import album


def test_one_circle_covers_its_own_and_two_equal_ones_half() -> None:
    assert circles.density(np.array([[5.0, 5.0, 2.0]])) == pytest.approx(1.0, abs=1e-4)
    two = np.array([[0.0, 0.0, 1.0], [2.0, 0.0, 1.0]])
    assert circles.density(two) == pytest.approx(0.5, abs=1e-4)


def test_circles_that_touch_are_not_deep_in_each_other() -> None:
    touching = np.array([[0.0, 0.0, 1.0], [3.0, 0.0, 2.0], [0.0, 9.0, 0.5]])
    assert circles.deepest(touching) == pytest.approx(0.0, abs=1e-12)
    assert circles.deepest(touching - [[0, 0, 0], [0.5, 0, 0], [0, 0, 0]]) == pytest.approx(0.5)


def test_our_circles_lie_beside_each_other() -> None:
    found, seconds = circles.packed(circles.lognormal(0, 8), seed=0)
    assert circles.deepest(found) == 0.0
    assert seconds > 0.0


def test_a_peer_is_stopped_when_its_time_is_up() -> None:
    def endless() -> None:
        while True:
            pass

    with pytest.raises(TimeoutError), peering.limited(0.05):
        endless()
    with peering.limited(0.05):
        time.sleep(0.1)  # Of the clock: not counted.


def test_long_runs_are_made_once() -> None:
    _, seconds = peering.repeated(lambda seed: (seed, peering.LONG_SECONDS + 1))
    assert len(seconds) == 1
    found, _ = peering.repeated(lambda seed: (seed, 0.1))
    assert found == list(range(peering.RUNS))


@pytest.mark.parametrize("task", ["circles", "polygons"])
def test_items_to_be_kept_apart_are_convex_and_of_one_area(task: str) -> None:
    for ring in peer_penrose.rings_of(task, 5):
        ahead = np.roll(ring, -1, axis=0) - ring
        after = np.roll(ahead, -1, axis=0)
        turns = ahead[:, 0] * after[:, 1] - ahead[:, 1] * after[:, 0]
        assert np.all(turns > 0) or np.all(turns < 0)
        area = abs(
            (ring[:, 0] * np.roll(ring[:, 1], -1) - ring[:, 1] * np.roll(ring[:, 0], -1)).sum()
        )
        assert area / 2 == pytest.approx(np.pi * circles.RADIUS**2, rel=1e-3)


def test_what_lies_over_another_or_outside_is_found() -> None:
    square = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
    clean = peer_penrose._faults([square, square - np.array([1.0, 0.0])], room=2.0)
    assert clean == {"overlap": 0.0, "outside": 0.0}
    wrong = peer_penrose._faults([square, square + np.array([0.5, 0.0]), square + 9.0], room=2.0)
    assert wrong["overlap"] == pytest.approx(0.5 / (4 * np.pi), rel=1e-3)
    assert wrong["outside"] == pytest.approx(1.0 / (4 * np.pi), rel=1e-3)


@pytest.mark.parametrize("case", cases.CASES, ids=lambda case: case.name)
def test_every_case_has_a_container_on_its_canvas(case: cases.Case) -> None:
    container = cases.container_of(case)
    left, top, right, bottom = container.outline.bounds
    assert min(left, top) >= -1e-9
    assert max(right, bottom) <= container.side + 1e-9
    assert container.outline.area > 0.2 * container.side**2


def test_photos_of_an_album_differ_in_shape(tmp_path: Path) -> None:
    album(tmp_path, 3, 0.01)
    assert len(list(tmp_path.glob("*.jpg"))) == 3
