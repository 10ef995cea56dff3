"""Films in every format: as long, as large and as fast as asked, and the same pictures."""

from __future__ import annotations

import base64
import io
import itertools
import json
import re
import shutil
import subprocess
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest
from PIL import Image, ImageSequence

from packwork.errors import WriteError
from packwork.scene.layout import Layout
from packwork.scene.track import Leaving, track_of
from packwork.writers.film.film import Film, in_frame
from packwork.writers.film.gif import gif_bytes
from packwork.writers.film.options import FilmOptions
from packwork.writers.film.projector import Projector
from packwork.writers.film.registry import FILMS, check_film, film_bytes

Pixels = npt.NDArray[np.int16]
MakeFilm = Callable[..., Film]

FPS, SECONDS, HOLD, SIDE = 10.0, 1.0, 0.5, 120
CHROMIUM = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "chrome"))), None)


@pytest.fixture
def make_film(three: Layout) -> MakeFilm:
    """Films of three items that gather from far away; one of them grows from nothing.

    With ``is_left`` three more leave.
    """
    end = three.poses
    start = replace(end, x=80 - end.x, angle=end.angle + 1, scale=end.scale * [1, 0, 0.5])

    def make(
        background: str = "ivory",
        show_container: bool = True,
        is_left: bool = False,
        **options: Any,
    ) -> Film:
        given = {"fps": FPS, "seconds": SECONDS, "hold": HOLD, "film_pixels": SIDE} | options
        gone = Leaving(three.items, replace(end, y=60 - end.y, scale=0.7 * end.scale))
        moving = replace(three, track=track_of([start, end]), leaving=gone if is_left else None)
        return Film(moving, FilmOptions(**given), background, show_container)

    return make


def pictures_of(data: bytes, mode: str = "RGB") -> tuple[list[Pixels], list[float]]:
    """Frames and how long each is shown, in seconds."""
    with Image.open(io.BytesIO(data)) as film:
        frames, times = [], []
        for frame in ImageSequence.Iterator(film):
            frames.append(np.asarray(frame.convert(mode), dtype=np.int16))
            times.append(frame.info["duration"] / 1_000)
    return frames, times


def expected(film: Film, mode: str = "RGB") -> list[Pixels]:
    return [p[:, :, : len(mode)].astype(np.int16) for p in Projector(in_frame(film)).pictures()]


def difference(one: Pixels, other: Pixels) -> float:
    return float(np.abs(one - other).mean())


@pytest.mark.parametrize("is_left", [False, True])
@pytest.mark.parametrize(("ending", "bound"), [(".gif", 4.0), (".webp", 4.0)])
def test_pictures_that_move_hold_the_frames(
    make_film: MakeFilm, ending: str, bound: float, is_left: bool
) -> None:
    film = make_film(is_left=is_left)
    frames, times = pictures_of(film_bytes(film, f"a{ending}"))
    assert len(frames) == film.options.frames == 10
    assert sum(times) == pytest.approx(SECONDS + HOLD, abs=0.02)
    assert times[:-1] == pytest.approx([1 / FPS] * 9, abs=0.011)
    for got, true in zip(frames, expected(film), strict=True):
        assert difference(got, true) <= bound
    assert difference(frames[0], frames[-1]) > bound + 5


@pytest.mark.parametrize("ending", [".gif", ".webp"])
def test_a_clear_background_stays_clear(make_film: MakeFilm, ending: str) -> None:
    film = make_film(background="none", show_container=False)
    frames, _ = pictures_of(film_bytes(film, f"a{ending}"), "RGBA")
    for got, true in zip(frames, expected(film, "RGBA"), strict=True):
        assert (got[:, :, 3] == 0)[true[:, :, 3] == 0].mean() > 0.99
        assert (got[:, :, 3] > 200)[true[:, :, 3] == 255].all()


@pytest.mark.parametrize(("ending", "once"), [(".gif", None), (".webp", 1)])
def test_a_film_loops_unless_told_not_to(
    make_film: MakeFilm, ending: str, once: int | None
) -> None:
    for loop, expected_loops in (("again", 0), ("back", 0), ("cycle", 0), ("once", once)):
        with Image.open(io.BytesIO(film_bytes(make_film(loop=loop), f"a{ending}"))) as film:
            assert film.info.get("loop") == expected_loops


def test_gif_keeps_its_time_where_hundredths_do_not_divide(make_film: MakeFilm) -> None:
    _, times = pictures_of(film_bytes(make_film(fps=30.0), "a.gif"))
    assert sum(times) == pytest.approx(SECONDS + HOLD, abs=0.011)
    assert {round(100 * t) for t in times[:-1]} == {3, 4}


def test_gif_is_no_faster_than_browsers(
    make_film: MakeFilm, caplog: pytest.LogCaptureFixture
) -> None:
    frames, times = pictures_of(gif_bytes(make_film(fps=100.0)))
    assert "50 pictures a second instead of 100" in caplog.text
    assert len(frames) == 50
    assert min(times) >= 0.02


def test_the_last_frame_is_the_picture_of_the_layout(make_film: MakeFilm) -> None:
    from packwork.writers.bitmaps import png_bytes
    from packwork.writers.svg import SvgOptions

    film = make_film()
    drawn = png_bytes(film.layout, SIDE, SvgOptions(background="ivory", show_container=True))
    with Image.open(io.BytesIO(drawn)) as picture:
        true = np.asarray(picture.convert("RGB"), dtype=np.int16)
    # Only soft edges differ, by what a second sampling costs.
    got = expected(film)[-1]
    assert difference(got, true) < 2.0
    assert np.abs(got - true).max() < 100


def test_items_are_not_drawn_before_they_come(make_film: MakeFilm) -> None:
    film = make_film(background="none", show_container=False)
    second = np.array([1])
    alone = replace(
        film.layout,
        items=film.layout.items[1:2],
        poses=film.layout.poses.subset(second),
        weights=film.layout.weights[second],
        track=replace(film.track, numbers=film.track.numbers[:, second]),
    )
    inked = [p[:, :, 3].sum() for p in Projector(replace(film, layout=alone)).pictures()]
    assert inked[0] == 0
    assert all(a <= b for a, b in itertools.pairwise(inked))


@pytest.mark.parametrize("ending", [".mp4", ".webm"])
def test_video(make_film: MakeFilm, ending: str) -> None:
    av = pytest.importorskip("av")
    film = make_film()
    with av.open(io.BytesIO(film_bytes(film, f"a{ending}"))) as container:
        frames = [frame.to_ndarray(format="rgb24") for frame in container.decode(video=0)]
    assert len(frames) == round(FPS * (SECONDS + HOLD))
    for got, true in zip(frames, expected(film), strict=False):
        assert difference(got[: true.shape[0]].astype(np.int16), true) < 8.0
    np.testing.assert_allclose(frames[-1].astype(int), frames[10].astype(int), atol=16)


@pytest.mark.parametrize(
    ("side", "columns", "rows"), [(120, 120, 90), (121, 122, 92), (40, 40, 30)]
)
def test_video_has_even_sides(
    make_film: MakeFilm, side: int, columns: int, rows: int, caplog: pytest.LogCaptureFixture
) -> None:
    av = pytest.importorskip("av")
    data = film_bytes(make_film(film_pixels=side, seconds=0.2), "a.mp4")
    with av.open(io.BytesIO(data)) as container:
        stream = container.streams.video[0]
        assert (stream.width, stream.height) == (columns, rows)
    assert ("needs even sides" in caplog.text) == bool(side % 2)


def test_video_has_no_clear_background(
    make_film: MakeFilm, caplog: pytest.LogCaptureFixture
) -> None:
    pytest.importorskip("av")
    film_bytes(make_film(background="none", seconds=0.2), "a.webm")
    assert "no clear background" in caplog.text


def test_the_missing_package_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    with pytest.raises(WriteError, match=r"needs the package av; .*packwork.video"):
        check_film(tmp_path / "a.mp4")


@pytest.mark.parametrize("name", ["a.png", "a", "a.geojson", "a.gif.bak"])
def test_an_ending_of_no_film(name: str) -> None:
    with pytest.raises(WriteError, match=r"use one of \.svg, \.gif"):
        check_film(name)


@pytest.mark.parametrize("ending", [".svg", ".gif", ".webp", ".json"])
def test_same_film_same_bytes_and_somebody_is_told(make_film: MakeFilm, ending: str) -> None:
    told: list[float] = []
    one = film_bytes(make_film(), f"a{ending}", told.append)
    assert one == film_bytes(make_film(), f"a{ending}")
    assert told == sorted(told)
    assert told[-1] == 1.0


@pytest.mark.parametrize("ending", [".mp4", ".webm"])
def test_memory_that_nobody_has_written_is_in_no_video(
    make_film: MakeFilm, ending: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    noise = np.random.default_rng(0)
    film = make_film(film_pixels=100)
    frame = Projector(film, is_even=True).frame
    pictures = noise.integers(0, 255, (6, frame.rows, frame.columns, 3), dtype=np.uint8)
    monkeypatch.setattr("packwork.writers.film.video._held", lambda *_: iter(pictures))
    made = set()
    for _ in range(12):
        dirt = [noise.bytes(size) for size in noise.integers(1_000, 200_000, 20)]
        del dirt[::2]
        made.add(film_bytes(film, f"a{ending}"))
    assert len(made) == 1


def test_every_ending_has_a_test_here() -> None:
    assert set(FILMS) == {".svg", ".gif", ".webp", ".mp4", ".webm", ".json"}


@pytest.mark.skipif(CHROMIUM is None, reason="no Chromium is installed")
@pytest.mark.parametrize(
    ("seconds", "is_left"), [(0.0, False), (0.0, True), (0.25, True), (0.5, False), (1.3, True)]
)
def test_an_animated_svg_looks_like_the_film(
    make_film: MakeFilm, tmp_path: Path, seconds: float, is_left: bool
) -> None:
    film = make_film(fps=20.0, is_left=is_left)
    svg = film_bytes(film, "a.svg").decode()
    page, picture = tmp_path / "page.html", tmp_path / "page.png"
    script = (
        f"document.getAnimations().forEach(a => {{a.pause(); a.currentTime = {1_000 * seconds}}})"
    )
    page.write_text(
        f"<!doctype html><body style='margin:0'>{svg[svg.index('<svg') :]}"
        f"<script>{script}</script>",
        encoding="utf-8",
    )
    subprocess.run(
        [str(CHROMIUM), "--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars",
         f"--user-data-dir={tmp_path}/profile", f"--screenshot={picture}",
         "--window-size=300,300", str(page)],
        check=True, capture_output=True, timeout=120,
    )  # fmt: skip
    number = min(round(seconds * 20), film.options.frames - 1)
    true = expected(film)[number]
    with Image.open(picture) as shown:
        got = np.asarray(shown.convert("RGB"), dtype=np.int16)[: true.shape[0], : true.shape[1]]
    assert difference(got, true) < 4.0
    assert (np.abs(got - true).max(axis=2) > 96).mean() < 0.01


def test_an_animated_svg_has_no_script_and_ends_as_the_layout(make_film: MakeFilm) -> None:
    svg = film_bytes(make_film(loop="once"), "a.svg").decode()
    assert "<script" not in svg
    assert 'transform="translate(15 20)rotate(17.188' in svg
    assert "1.5s linear 1 both" in svg
    last = re.findall(r"100%\{transform:translate\(([\d.]+)px,([\d.]+)px\)", svg)
    assert np.allclose(np.array(last, dtype=float), [[15, 20], [40, 35], [62.5, 25.25]], atol=0.01)


def test_those_who_leave_are_seen_at_first_and_gone_by_the_middle(make_film: MakeFilm) -> None:
    shown, alone = (
        [p[:, :, 3] > 0 for p in Projector(in_frame(film)).pictures()]
        for film in (
            make_film(background="none", show_container=False, is_left=is_left)
            for is_left in (True, False)
        )
    )
    more = [int((a & ~b).sum()) for a, b in zip(shown, alone, strict=True)]
    assert more[0] > 100
    assert all(a >= b for a, b in itertools.pairwise(more))
    assert more[6:] == [0, 0, 0, 0]


def test_an_animated_svg_shows_none_who_leave_where_nothing_moves(make_film: MakeFilm) -> None:
    svg = film_bytes(make_film(is_left=True), "a.svg").decode()
    groups = re.findall(r'<g id="(leaving-\d)" transform="(.*?)">', svg)
    assert groups == [(f"leaving-{k}", "scale(0)") for k in (1, 2, 3)]
    assert svg.index('id="leaving"') < svg.index('<g id="items"')
    ids = re.findall(r'\bid="([^"]+)"', svg.partition("</style>")[2])
    assert len(ids) == len(set(ids))


def test_lottie_lays_those_who_leave_beneath(make_film: MakeFilm) -> None:
    layers = json.loads(film_bytes(make_film(is_left=True), "a.json"))["layers"]
    ends = [layer["ks"]["s"] for layer in layers[:6]]
    last = [size["k"][-1]["s"][0] if size["a"] else size["k"][0] for size in ends]
    assert [size > 0 for size in last] == [True] * 3 + [False] * 3


def test_lottie_has_what_the_format_asks_for(make_film: MakeFilm) -> None:
    film = make_film()
    whole = json.loads(film_bytes(film, "a.json"))
    assert {"fr", "ip", "op", "w", "h", "layers", "assets"} <= set(whole)
    assert (whole["fr"], whole["op"], whole["w"], whole["h"]) == (10.0, 15.0, 120, 90)
    kinds = [layer["ty"] for layer in whole["layers"]]
    assert kinds == [2, 2, 4, 4, 1]  # pictures on top, then the shape, the line, the ground
    known = {asset["id"] for asset in whole["assets"]}
    for layer in whole["layers"]:
        assert {"ty", "ks", "ip", "op", "st", "ind"} <= set(layer)
        assert layer["op"] == whole["op"]
        if layer["ty"] == 2:
            assert layer["refId"] in known
        for name in "apsr":
            check_property(layer["ks"][name], whole["op"])
    for asset in whole["assets"]:
        data = base64.b64decode(asset["p"].partition(",")[2])
        with Image.open(io.BytesIO(data)) as picture:
            assert picture.size == (asset["w"], asset["h"])


def check_property(value: dict[str, Any], end: float) -> None:
    """A number or keyframes: times that rise, values and both handles for each."""
    if value["a"] == 0:
        return
    times = [key["t"] for key in value["k"]]
    assert times == sorted(set(times))
    assert 0 <= times[0] <= times[-1] <= end
    assert all({"s", "i", "o"} <= set(key) for key in value["k"])


def test_lottie_places_items_where_the_film_has_them(make_film: MakeFilm) -> None:
    film = make_film()
    whole = json.loads(film_bytes(film, "a.json"))
    ring = next(layer for layer in whole["layers"] if layer["nm"] == "ring")
    last = {name: ring["ks"][name] for name in "prs"}
    got = [v["k"][-1]["s"] if v["a"] else v["k"] for v in last.values()]
    scale = SIDE / 80
    assert np.allclose(got[0], [15 * scale, 20 * scale], atol=1e-3)
    assert np.allclose(got[1], np.degrees(0.3), atol=1e-3)
    assert np.allclose(got[2], [90 * scale, 90 * scale], atol=1e-2)
