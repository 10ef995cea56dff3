"""From keyframes to frames: ends that are met, soft steps, few knots."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from packwork.errors import RecipeError, WriteError
from packwork.recipe.verbs import film_options
from packwork.scene.layout import Layout
from packwork.scene.track import numbers_of, track_of
from packwork.writers.film.film import Film, item_knots, knots
from packwork.writers.film.options import FilmOptions


@pytest.fixture
def leaping(three: Layout) -> Layout:
    """One item that leaps across the canvas from one keyframe to the next."""
    before = replace(three.poses, x=three.poses.x - [60.0, 0.0, 0.0])
    return replace(three, track=track_of([before] * 80 + [three.poses] * 80))


def speeds(film: Film) -> np.ndarray:
    return np.abs(np.diff(film.frames[:, 0, 0]))


@pytest.mark.parametrize("easing", ["smooth", "linear"])
def test_the_first_and_the_last_frame_are_the_tracks(leaping: Layout, easing: str) -> None:
    film = Film(leaping, FilmOptions(fps=60, easing=easing))
    assert len(film.frames) == 300
    np.testing.assert_array_equal(film.frames[-1], numbers_of(leaping.poses))
    np.testing.assert_array_equal(film.frames[0], leaping.track.numbers[0])


def test_a_leap_is_drawn_out_where_it_is_smooth(leaping: Layout) -> None:
    smooth, linear = (
        speeds(Film(leaping, FilmOptions(fps=60, easing=easing))) for easing in ("smooth", "linear")
    )
    assert linear.max() > 2 * smooth.max()
    assert (smooth > 0.01).sum() > 2 * (linear > 0.01).sum()
    assert smooth.sum() == pytest.approx(60.0)


def test_items_set_off_and_stop_softly(three: Layout) -> None:
    before = replace(three.poses, x=three.poses.x - 60)
    film = Film(replace(three, track=track_of([before, three.poses])), FilmOptions(fps=60))
    fast = speeds(film)
    assert fast[0] < 0.1 * fast.max()
    assert fast[-1] < 0.1 * fast.max()
    assert np.diff(film.frames[:, 0, 0]).min() >= 0


@pytest.mark.parametrize("seconds", [0.01, 0.1, 0.5])
def test_short_films_have_two_ends_too(leaping: Layout, seconds: float) -> None:
    film = Film(leaping, FilmOptions(fps=20, seconds=seconds))
    assert len(film.frames) == max(round(20 * seconds), 2)
    assert film.frames[0, 0, 0] == pytest.approx(leaping.poses.x[0] - 60)
    assert film.frames[-1, 0, 0] == leaping.poses.x[0]


def test_a_layout_without_a_track_has_no_film(three: Layout) -> None:
    with pytest.raises(WriteError, match="give record=True to fill or words"):
        Film(three)


def test_a_track_of_other_items_is_refused(leaping: Layout) -> None:
    fewer = replace(
        leaping, items=leaping.items[:2], poses=leaping.poses.subset(np.arange(2)),
        weights=leaping.weights[:2],
    )  # fmt: skip
    with pytest.raises(WriteError, match="the track is of 3 items, not 2"):
        Film(fewer)


def test_a_background_is_a_colour(leaping: Layout) -> None:
    with pytest.raises(RecipeError, match="background: 'no colour' is no colour"):
        Film(leaping, background="no colour")


def test_knots_are_few_and_near_enough() -> None:
    rng = np.random.default_rng(5)
    path = np.cumsum(np.cumsum(rng.normal(size=(200, 2)), axis=0), axis=0) / 100
    chosen = knots(path, 0.2)
    assert 3 < len(chosen) < 60
    for k in range(2):
        straight = np.interp(np.arange(200), chosen, path[chosen, k])
        assert np.abs(straight - path[:, k]).max() <= 0.2


def test_what_stands_still_has_two_knots() -> None:
    still = np.tile([3.0, 4.0, 0.5, 2.0, 1.0], (50, 1))
    assert item_knots(still, 10.0, 1e-6).tolist() == [0, 49]


def test_a_turn_of_a_large_item_counts_more() -> None:
    frames = np.tile([0.0, 0.0, 0.0, 1.0, 1.0], (50, 1))
    frames[:, 2] = 0.1 * np.sin(np.linspace(0, 6, 50))
    assert len(item_knots(frames, 100.0, 0.1)) > len(item_knots(frames, 2.0, 0.1))


@pytest.mark.parametrize(
    ("asked", "message"),
    [
        ({"fps": 0}, "fps: must be at least 1, not 0"),
        ({"fps": float("nan")}, "fps: "),
        ({"film_pixels": 0}, "film_pixels: must be at least 16, not 0"),
        ({"film_pixels": 100_000}, "film_pixels: must be at most 4096"),
        ({"seconds": -1}, "seconds: must be more than 0, not -1"),
        ({"hold": -1}, "hold: must be at least 0"),
        ({"easing": "bouncy"}, "easing: "),
        ({"seconds": 600, "fps": 100}, "seconds: 600 at 100 pictures a second are 60000"),
        ({"second": 2}, "second: no such option; did you mean seconds?"),
    ],
)
def test_bad_options_are_one_line(asked: dict[str, object], message: str) -> None:
    with pytest.raises(RecipeError) as caught:
        film_options(**asked)
    assert str(caught.value).startswith(message)


def test_what_is_given_comes_before_the_recipe() -> None:
    made = film_options(FilmOptions(fps=12, hold=3), fps=24, hold=None)
    assert (made.fps, made.hold, made.seconds) == (24, 3, 5)
