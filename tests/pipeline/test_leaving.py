"""Films from one layout to another: who leaves, who comes, and when."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import packwork as pw
from packwork.scene.item import FlatArt
from packwork.scene.track import numbers_of
from packwork.writers.film.film import Film
from packwork.writers.film.options import FilmOptions

BEFORE = {"owl": 40.0, "fox": 28.0, "bear": 23.0, "wolf": 20.0}
AFTER = {"owl": 30.0, "fox": 28.0, "wolf": 20.0, "lynx": 26.0}
QUICK = {"epochs": 60, "levels": "50,150", "seed": 3, "effort": "draft"}


@pytest.fixture(scope="module")
def both(tmp_path_factory: pytest.TempPathFactory) -> tuple[pw.Layout, pw.Layout]:
    """A cloud, and one with a word gone and a word come."""
    before = pw.words("circle", BEFORE, **QUICK)
    file = tmp_path_factory.mktemp("before") / "words.geojson"
    before.save(file)
    return before, pw.words("circle", AFTER, start=str(file), stay=True, record=True, **QUICK)


def index(layout: pw.Layout, name: str) -> int:
    return [item.name for item in layout.items].index(name)


def test_a_word_that_is_gone_shrinks_where_it_was_by_the_first_third(
    both: tuple[pw.Layout, pw.Layout],
) -> None:
    before, after = both
    leaving = after.leaving
    assert leaving is not None
    assert [item.name for item in leaving.items] == ["bear"]
    k = index(before, "bear")
    for time, share in ((0.0, 1.0), (1 / 6, 0.5), (1 / 3, 0.0), (1.0, 0.0)):
        poses = leaving.at(time)
        assert poses.scale[0] == pytest.approx(share * before.poses.scale[k], abs=1e-9)
        assert poses.x[0] == pytest.approx(before.poses.x[k], abs=1e-6)


def test_a_new_word_grows_once_there_is_room(both: tuple[pw.Layout, pw.Layout]) -> None:
    _, after = both
    assert after.track is not None
    k = index(after, "lynx")
    scales = [after.track.at(time).scale[k] for time in (0.0, 1 / 3, 0.5, 1.0)]
    assert scales[:2] == pytest.approx([0.0, 0.0], abs=1e-12)
    assert 0.3 < scales[2] / scales[3] < 0.7
    assert scales[3] == after.poses.scale[k]


def test_the_film_begins_with_the_one_layout_and_ends_with_the_other(
    both: tuple[pw.Layout, pw.Layout],
) -> None:
    before, after = both
    film = Film(after, FilmOptions(fps=12, seconds=1))
    first, last = film.frames[0], film.frames[-1]
    np.testing.assert_array_equal(last[film.leaving :], numbers_of(after.poses))
    assert last[0, 3] == 0
    shown = {item.name: row for item, row in zip(film.items, first, strict=True) if row[3] > 0}
    assert set(shown) == set(BEFORE)
    for k, item in enumerate(before.items):
        np.testing.assert_allclose(shown[item.name], numbers_of(before.poses)[k], atol=1e-6)


def test_a_word_that_is_gone_is_set_with_its_holes_in_its_colour(
    both: tuple[pw.Layout, pw.Layout],
) -> None:
    before, after = both
    assert after.leaving is not None
    gone, was = after.leaving.items[0], before.items[index(before, "bear")]
    assert len(gone.ink.rings) == len(was.ink.rings) > len(was.outline.rings)
    assert not isinstance(gone.art, FlatArt)


def test_fewer_copies_and_another_kind_leave(tmp_path: Path) -> None:
    file = tmp_path / "shapes.geojson"
    pw.fill("circle", ["star", "heart", "square"], count=9, **QUICK).save(file)
    asked = {"start": str(file), "stay": True, "count": 4, **QUICK}
    after = pw.fill("circle", ["star", "heart"], record=True, **asked)
    assert after.leaving is not None
    assert sorted(item.name for item in after.leaving.items) == [
        "heart", "square", "square", "square", "star",
    ]  # fmt: skip
    assert pw.fill("circle", ["star", "heart"], **asked).leaving is None


def test_who_stays_leaves_nobody_behind(tmp_path: Path) -> None:
    file = tmp_path / "shapes.geojson"
    pw.fill("circle", "star", count=4, **QUICK).save(file)
    after = pw.fill("square", "star", count=4, start=str(file), stay=True, record=True, **QUICK)
    assert after.leaving is None
