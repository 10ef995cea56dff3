"""Emitters: where items come from, at once or one after another."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
import shapely

from packwork import pipeline, uses
from packwork.arrays import IntArray
from packwork.errors import ReadError, RecipeError
from packwork.progress import Step
from packwork.scene.pose import Poses

CURVE = (
    '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100">'
    '<path d="M10 30H90" fill="none" stroke="#000"/></svg>'
)


class Film:
    """Keeps the poses of every step, and whose they are."""

    every = 1

    def __init__(self) -> None:
        self.frames: list[tuple[IntArray, Poses]] = []

    def on_step(self, step: Step) -> None:
        assert step.ids is not None
        self.frames.append((step.ids, step.poses))


def _film(**options: object) -> tuple[pipeline.Run, Film]:
    film = Film()
    recipe = uses.pile_recipe("square", ["circle", "star"], count=10, size="12%", **options)
    return uses.fill(recipe, observer=film), film


def test_items_pour_from_a_point_one_after_another() -> None:
    run, film = _film(emit="50%,15%", release=3)
    assert run.certified
    counts = [len(ids) for ids, _ in film.frames]
    assert counts[0] == 1
    assert counts[-1] == 10
    assert set(np.diff(counts)) == {0, 1}
    # The first frame that shows an item shows it near the emitter, a round on its way.
    for (before, _), (after, poses) in pairwise(film.frames):
        new = ~np.isin(after, before)
        assert (np.abs(poses.x[new] - 300) < 30).all()
        assert (np.abs(poses.y[new] - 90) < 30).all()


def test_who_waits_is_not_there_on_the_way_and_grows_where_it_comes_in() -> None:
    recipe = uses.pile_recipe(
        "square", ["circle", "star"], count=10, size="12%", emit="top", release=9
    )
    layout = uses.fill(recipe, record=True).layout
    assert layout.track is not None
    numbers = layout.track.numbers
    assert (numbers[:, :, 0] > -100).all()
    assert (numbers[:, :, 0] < 700).all()
    there = numbers[:, :, 3] > 0
    assert 1 <= there[0].sum() < there[len(there) // 4].sum() < 10
    assert there[-1].all()


def test_nothing_meets_while_items_pour() -> None:
    run, film = _film(emit="top", release=2)
    for ids, frame in film.frames[::7]:
        regions = [
            run.layout.items[k].outline.mapped(frame.matrix(row)).region
            for row, k in enumerate(ids)
        ]
        tree = shapely.STRtree(regions)
        first, second = tree.query(regions, predicate="intersects")
        assert (first == second).all()


def test_the_same_seed_pours_the_same() -> None:
    first, second = (_film(emit="left", release=2)[0] for _ in range(2))
    assert first.layout.poses.x.tolist() == second.layout.poses.x.tolist()


def test_all_at_once_begin_about_the_emitter() -> None:
    run, film = _film(emit="50%,50%", force="right")
    assert run.certified
    _, first = film.frames[0]
    assert np.hypot(first.x - 300, first.y - 300).max() < 200


def test_an_open_lid_lets_items_in_from_beyond_the_canvas() -> None:
    run, film = _film(emit="top", release=4, open="top")
    assert run.certified
    assert min(frame.y.min() for _, frame in film.frames) < 0


@pytest.mark.parametrize("emit", ["10%,20% 90%,20%", "curve.svg", "in heart"])
def test_items_come_from_lines_curves_and_regions(
    emit: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("curve.svg").write_text(CURVE, encoding="utf-8")
    assert _film(emit=emit, release=2)[0].certified


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"emit": "-50%,20%"}, "lies outside the container"),
        ({"emit": "tap"}, "emit: use top"),
        ({"emit": "5%,5% 5%,5%"}, "has no length"),
        ({"emit": "1parsec,2"}, "emit: use top"),
        ({"release": 3}, "release: says when"),
        ({"emit": "top", "release": -1}, "release: must be at least 0"),
    ],
)
def test_bad_emitters_are_refused_in_one_line(options: dict[str, object], message: str) -> None:
    with pytest.raises(RecipeError) as caught:
        _film(**options)
    assert message in str(caught.value)
    assert "\n" not in str(caught.value)


def test_an_emitter_that_is_no_file_is_refused() -> None:
    with pytest.raises(ReadError):
        _film(emit="tap.svg")
