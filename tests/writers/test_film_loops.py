"""Films that go round: no jump at the end, nothing cut, proportions as asked."""

from __future__ import annotations

import json
import re
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from packwork.errors import RecipeError
from packwork.recipe.refusals import validated
from packwork.scene.layout import Layout
from packwork.scene.track import Leaving, poses_of, track_of
from packwork.writers.film.film import Film, in_frame
from packwork.writers.film.options import FilmOptions
from packwork.writers.film.registry import film_bytes


def film(three: Layout, is_left: bool = False, **options: Any) -> Film:
    """Three items that come in from beyond the canvas, turning."""
    end = three.poses
    start = replace(end, x=-2 * end.x, y=end.y + 30, angle=end.angle + 5, scale=end.scale / 2)
    gone = Leaving(three.items, replace(end, x=-60 - end.x)) if is_left else None
    moving = replace(three, track=track_of([start, end]), leaving=gone)
    given = {"fps": 10.0, "seconds": 2.0, "hold": 0.5, "film_pixels": 100} | options
    return Film(moving, FilmOptions(**given))


def steps(frames: Any) -> Any:
    """Longest way of any item from each frame to the next, and from the last to the first."""
    ways = np.linalg.norm(np.diff(frames, axis=0, append=frames[:1])[:, :, :2], axis=2)
    return ways.max(axis=1)


@pytest.mark.parametrize("loop", ["back", "cycle"])
@pytest.mark.parametrize("is_left", [False, True])
def test_at_the_end_nothing_jumps(three: Layout, loop: str, is_left: bool) -> None:
    made = film(three, is_left, loop=loop, easing="linear")
    ways = steps(made.frames)
    assert ways[-1] <= 1.5 * ways[:-1].max()
    jumping = steps(film(three, is_left, easing="linear").frames)
    assert jumping[-1] > 5 * jumping[:-1].max()
    turned = made.frames[-1, :, 2] - made.frames[0, :, 2]
    rest = np.abs(turned - 2 * np.pi * np.round(turned / (2 * np.pi)))
    assert rest.max() < 1.0


def test_the_way_back_is_the_way_that_they_came(three: Layout) -> None:
    made = film(three, loop="back", easing="ease-in")
    there, back = made.frames[: made.arrival + 1], made.frames[made.arrival + 1 :]
    assert np.array_equal(back[0], there[-1])
    assert np.array_equal(back[1:][::-1], there[1:-1])


@pytest.mark.parametrize("loop", ["again", "back", "cycle", "once"])
def test_they_are_held_where_they_have_arrived(three: Layout, loop: str) -> None:
    made = film(three, loop=loop)
    assert made.seconds[made.arrival] == pytest.approx(0.6)
    assert poses_of(made.frames[made.arrival]).x == pytest.approx(three.poses.x)
    assert made.seconds.sum() == pytest.approx(
        {"again": 2.5, "once": 2.5, "back": 4.4, "cycle": 3.4}[loop]
    )


def test_an_item_of_an_svg_stays_while_it_is_held(three: Layout) -> None:
    svg = film_bytes(film(three, loop="cycle", easing="linear"), "a.svg").decode()
    frames = re.search(r"@keyframes [^{]+\{(.*?)\}\}", svg)
    assert frames is not None
    marks = re.findall(r"([\d.]+)%\{transform:(\S+?)\}", frames.group(1) + "}")
    held = [float(share) for share, place in marks if place == f"{marks[1][1]}"]
    total = 3.4
    assert held[0] == pytest.approx(100 * 1.9 / total, abs=0.01)
    assert held[-1] == pytest.approx(100 * 2.5 / total, abs=0.01)


def test_lottie_has_its_keyframes_in_time(three: Layout) -> None:
    whole = json.loads(film_bytes(film(three, loop="cycle", easing="linear"), "a.json"))
    assert whole["op"] == pytest.approx(34)
    times = [key["t"] for key in whole["layers"][0]["ks"]["p"]["k"]]
    assert times == sorted(set(times))
    assert {19, 25} <= set(times)


@pytest.mark.parametrize(("ratio", "by"), [("1:1", 1.0), ("4:5", 0.8), ("9:16", 0.5625)])
def test_proportions_are_those_asked_for(three: Layout, ratio: str, by: float) -> None:
    canvas = in_frame(film(three, film_ratio=ratio)).layout.container
    assert canvas.width / canvas.height == pytest.approx(by)


@pytest.mark.parametrize("ratio", ["canvas", "1:1", "9:16", "16:9"])
@pytest.mark.parametrize("is_left", [False, True])
def test_the_first_picture_and_the_arrival_are_whole(
    three: Layout, ratio: str, is_left: bool
) -> None:
    made = in_frame(film(three, is_left, film_ratio=ratio))
    canvas = made.layout.container
    for at in (0, made.arrival):
        poses = poses_of(made.frames[at])
        for k in np.flatnonzero(poses.scale > 0):
            left, top, right, bottom = made.items[k].ink.mapped(poses.matrix(k)).bounds
            assert min(left, top) >= -1e-9
            assert right <= canvas.width + 1e-9
            assert bottom <= canvas.height + 1e-9


def test_a_film_that_stays_on_its_canvas_has_its_size(three: Layout) -> None:
    moving = replace(three, track=track_of([three.poses, three.poses]))
    made = Film(moving, FilmOptions())
    assert in_frame(made) is made


@pytest.mark.parametrize("ratio", ["", "16", "0:1", "1:11", "16:9:1", "a:b", "-1:1"])
def test_what_is_no_ratio_is_refused(ratio: str) -> None:
    with pytest.raises(RecipeError, match=r"film_ratio: is width:height, such as 9:16"):
        validated(FilmOptions, {"film_ratio": ratio})


def test_earlier_recipes_say_true_and_false() -> None:
    assert FilmOptions(loop=True).loop == "again"
    assert FilmOptions(loop=False).loop == "once"
