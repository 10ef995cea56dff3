"""Piles from recipe to result: open containers, none at all, what does not fit."""

from __future__ import annotations

import logging
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import shapely

import packwork as pw
from packwork import pipeline, uses
from packwork.cli.show import pile_line
from packwork.errors import ReadError, RecipeError
from packwork.geometry import affine
from packwork.live.file.things import Shared, Things, container_of, container_record
from packwork.progress import Step
from packwork.readers.layouts.read import read_written
from packwork.readers.svg.curve import walled_container
from packwork.scene.container import Container
from packwork.settle import bottom_left
from packwork.uses.piles.opening import opened
from packwork.writers.svg import SvgOptions, svg_text
from scenes import box, disc, flat_item

JAR = (
    '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100">'
    '<path d="M20 30V90H80V30" fill="none" stroke="#000"/></svg>'
)


def _run(container: str, **options: object) -> pipeline.Run:
    return uses.fill(uses.pile_recipe(container, ["circle", "star"], **options))


def test_a_pile_is_certified_and_lies_low() -> None:
    run = _run("square", count=12, size="15%")
    assert run.certified
    assert run.is_as_asked
    assert run.layout.poses.y.mean() > 420
    extents = [o.extent for o in run.layout.outlines if o.extent]
    assert max(extents) < 1.5 * 90


def test_other_ways_lead_elsewhere() -> None:
    up = _run("square", count=8, size="12%", force="up").layout.poses
    left = _run("square", count=8, size="12%", force=["left"]).layout.poses
    assert up.y.mean() < 150
    assert left.x.mean() < 150


def test_forces_act_on_those_that_they_name() -> None:
    run = _run("square", count=10, size="12%", force=["up items=star", "down items=circle"])
    y = {name: [] for name in ("star", "circle")}
    for item, at in zip(run.layout.items, run.layout.poses.y, strict=True):
        y[item.name].append(at)
    assert max(y["star"]) < min(y["circle"])


def test_without_a_container_items_gather_round_the_centre() -> None:
    run = _run("none", count=19, size="8%", compact=True)
    poses, side = run.layout.poses, run.layout.container.side
    assert np.hypot(poses.x - side / 2, poses.y - side / 2).max() < 0.4 * side
    assert run.pile is not None
    assert 0.3 < run.pile["compact"]["circle"] < 1
    assert run.report()["pile"]["compact"] == run.pile["compact"]


def test_many_icons_without_a_container_are_mixed_and_close() -> None:
    names = ["leaf", "owl", "anchor", "kite"]
    run = uses.fill(uses.pile_recipe("none", names, count=72, compact=True, seed=1))
    assert run.certified
    assert run.pile is not None
    assert run.pile["compact"]["circle"] > 0.55
    poses, side = run.layout.poses, run.layout.container.side
    off = np.hypot(poses.x - side / 2, poses.y - side / 2)
    kinds = np.array([item.name for item in run.layout.items])
    means = [off[kinds == name].mean() for name in names]
    # Rings of one kind each, the largest innermost, come to more than a half.
    assert np.ptp(means) < 0.3 * off.max()


BEST_OF_TEN = 0.6878
"""Share of a disc that ten equal ones cover at most, as far as is known."""


def _roundness(**options: object) -> float:
    """Share of the enclosing disc that discs cover, and how many are left out: medians of seeds."""
    found = []
    for seed in range(3):
        run = uses.fill(uses.pile_recipe("none", ["circle"], compact=True, seed=seed, **options))
        assert run.certified
        assert run.pile is not None
        found.append([run.pile["compact"]["circle"], len(run.unplaced)])
    share, left_out = np.median(found, axis=0)
    assert left_out == 0
    return float(share)


def test_a_few_equal_items_make_a_round_pack() -> None:
    assert _roundness(count=10) > 0.9 * BEST_OF_TEN


def test_a_round_pack_leaves_nobody_out_where_the_sheet_is_narrow() -> None:
    assert _roundness(count=19, padding="3%") > 1 / 2


@pytest.mark.parametrize(("count", "padding"), [(7, "5%"), (19, "3%"), (30, "3%"), (19, "20px")])
def test_a_bare_sheet_has_room_for_the_padding_too(count: int, padding: str) -> None:
    for seed in (3, 4):
        run = uses.fill(
            uses.pile_recipe("none", ["circle"], count=count, padding=padding, seed=seed)
        )
        assert len(run.layout.items) == count


@pytest.mark.parametrize("count", [2, 3])
def test_a_bare_sheet_holds_few_items(count: int) -> None:
    assert len(pw.pile("none", ["circle"], count=count).items) == count


def test_a_horizontal_line_makes_a_strip() -> None:
    run = _run("none", count=12, size="6%", force="towards horizontal")
    assert np.ptp(run.layout.poses.y) < 0.5 * np.ptp(run.layout.poses.x)


def test_forces_that_throw_items_off_say_who_holds_them(
    caplog: pytest.LogCaptureFixture,
) -> None:
    with caplog.at_level(logging.WARNING, "packwork"):
        run = _run("none", count=9, size="10%", force="away centre")
    assert run.certified
    assert "off the canvas; its edge holds" in caplog.text


def test_what_does_not_fit_is_named_and_left_out() -> None:
    run = _run("square", count=20, size="30%")
    assert not run.is_as_asked
    kept = len(run.layout.items)
    assert 4 <= kept < 20
    assert run.asked_for == 20
    assert len(run.unplaced) == 20 - kept
    assert f"{kept} of 20 items fit" in run.broken[0]
    assert run.metrics.exact.is_clean
    assert run.report()["placed"] == kept


def test_a_stop_is_told_and_is_no_lack_of_room(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(bottom_left, "EVERY", 4)
    recipe = uses.pile_recipe("square", ["circle"], count=9, size="10%")
    run = uses.fill(recipe, stop=lambda: True)
    assert run.certified
    assert len(run.layout.items) == 4
    assert {one.reason for one in run.unplaced} == {"the run was stopped before it found a place"}
    assert run.pile is not None
    assert pile_line(run.pile) == "stopped after 0 rounds"


def test_an_open_path_is_a_wall(tmp_path: Path) -> None:
    file = tmp_path / "jar.svg"
    file.write_text(JAR, encoding="utf-8")
    run = _run(str(file), count=10, size="12%")
    assert run.certified
    left, top, right, bottom = run.layout.container.outline.bounds
    assert (left, top, right, bottom) == pytest.approx((120, 0, 480, 540))
    assert run.layout.poses.y.min() > 180


@pytest.mark.parametrize("canvas", ["200mm", "200x100mm"])
def test_an_opening_follows_its_container_to_other_canvases(tmp_path: Path, canvas: str) -> None:
    file = tmp_path / "jar.svg"
    file.write_text(JAR, encoding="utf-8")
    run = _run(str(file), count=4, size="10%", canvas=canvas)
    container = run.layout.container
    assert container.outline.bounds[1] == pytest.approx(0, abs=1e-9)
    assert container.outline.bounds[3] == pytest.approx(0.9 * container.height)


def test_a_white_sheet_behind_a_jar_is_none_of_it(tmp_path: Path) -> None:
    file = tmp_path / "jar.svg"
    file.write_text(
        JAR.replace("<path", '<rect width="100" height="100" fill="white"/><path'), encoding="utf-8"
    )
    jar, mouths = walled_container(str(file), None) or (None, None)
    assert jar is not None
    assert len(mouths) == 1
    assert jar.outline.bounds == pytest.approx((120, 180, 480, 540))


def test_the_handle_of_a_cup_is_no_wall(tmp_path: Path) -> None:
    file = tmp_path / "cup.svg"
    handle = '<path d="M60 40H80V60H60" fill="none" stroke="#000" stroke-width="6"/>'
    file.write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100"><rect width="100" '
        f'height="100" fill="#fff"/><path d="M20 30H60V90H20z"/>{handle}</svg>',
        encoding="utf-8",
    )
    assert walled_container(str(file), None) is None
    run = _run(str(file), count=4, size="10%")
    left, top, right, bottom = run.layout.container.outline.bounds
    assert (left, top, right, bottom) == pytest.approx((120, 180, 498, 540), abs=3)


def test_paths_that_surround_nothing_are_no_container(tmp_path: Path) -> None:
    file = tmp_path / "line.svg"
    file.write_text(JAR.replace("M20 30V90H80V30", "M20 30H90"), encoding="utf-8")
    with pytest.raises(ReadError, match="surround nothing"):
        _run(str(file), count=4)


@pytest.mark.parametrize(
    ("side", "bounds"),
    [
        ("top", (30, 0, 70, 80)),
        ("bottom", (30, 20, 70, 100)),
        ("left", (0, 20, 70, 80)),
        ("right", (30, 20, 100, 80)),
    ],
)
def test_a_lid_is_taken_off_up_to_the_edge(side: str, bounds: tuple[float, ...]) -> None:
    tile = Container("tile", "tile", box(30, 20, 70, 80), 100.0, 100.0)
    found = opened(tile, [side], None, 50.0)  # type: ignore[list-item]
    assert found.container.outline.bounds == pytest.approx(bounds)
    assert found.basin is not None
    assert found.basin.area > found.container.outline.area


def test_a_round_container_opens_by_its_cap() -> None:
    outline = disc(40.0, 64).mapped(affine.similarity(50.0, 50.0, 0.0, 1.0))
    found = opened(Container("disc", "disc", outline, 100.0, 100.0), ["top"], None, 1.0)
    points = found.container.outline.points
    mouth = np.ptp(points[points[:, 1] < 1, 0])
    assert mouth == pytest.approx(2 * np.sqrt(40.0**2 - 32.0**2), rel=0.02)


def test_python_takes_items_and_containers() -> None:
    tile = pw.Container("tile", "tile", box(0, 0, 100, 100), 100.0, 100.0)
    layout = pw.pile(tile, [flat_item("a", disc(9.0))], count=5, rotate="none", size=18)
    assert layout.poses.scale.tolist() == pytest.approx([1.0] * 5)
    assert layout.metrics["exact"]["OO"] == 0


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"open": "top", "container": "none"}, "open: there is no container"),
        ({"open": "lid"}, "open: must be"),
        ({"size": "0"}, "size: must be more than nothing"),
        ({"size": "big"}, "size: use a length"),
        ({"size": "300%"}, "size: none of the 2 items fits"),
        ({"sizes": "free"}, "sizes: items of a pile keep"),
        ({"force": "down items=cow"}, "force: no item is called 'cow'"),
        ({"force": "towards 1furlong,2"}, "force: use towards or away with"),
        ({"rules": [{"items": "star", "pin": {"x": 3}}]}, "pin has no meaning in a pile"),
        ({"smallest": "1%", "filler": ["star"]}, "pile: is settled"),
    ],
)
def test_bad_input_is_refused_in_one_line(options: dict[str, object], message: str) -> None:
    container = str(options.pop("container", "square"))
    with pytest.raises(RecipeError) as caught:
        _run(container, **options)
    assert message in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_curve_that_is_no_file_is_refused() -> None:
    with pytest.raises(ReadError, match="there is no such file"):
        _run("square", force="towards nowhere.svg")


def test_items_gather_along_a_drawn_curve(tmp_path: Path) -> None:
    file = tmp_path / "curve.svg"
    file.write_text(JAR.replace("M20 30V90H80V30", "M0 80L100 80"), encoding="utf-8")
    run = _run("none", count=8, size="6%", canvas=600, force=f"towards {file}")
    assert abs(run.layout.poses.y.mean() - 480) < 40


def test_a_lid_is_not_drawn() -> None:
    tile = Container("tile", "tile", box(30, 20, 70, 80), 100.0, 100.0)
    (jar,) = opened(tile, ["top"], None, 50.0).container.walls or ()
    corners = {(30, 20), (30, 80), (70, 80), (70, 20)}
    assert {tuple(point) for point in jar.round(3)} == corners
    assert {tuple(point) for point in jar[[0, -1]].round(3)} == {(30, 20), (70, 20)}
    rails = opened(tile, ["left", "right"], None, 50.0).container.walls or ()
    assert sorted(set(line[:, 1].round(3)).pop() for line in rails) == [20, 80]
    assert all(np.ptp(line[:, 1]) < 1e-3 for line in rails)
    assert opened(tile, [], None, 50.0).container.walls is None


def test_a_jar_shows_its_mouth_open_and_is_measured_whole(tmp_path: Path) -> None:
    run = _run("circle", count=3, size="20%", open="top", canvas="100")
    (wall,) = run.layout.container.walls or ()
    assert wall[:, 1].min() == pytest.approx(10, abs=0.1)
    text = svg_text(run.layout, SvgOptions(show_container=True))
    path, line = re.findall(r"<(?:path|polyline)[^>]*>", text.partition('id="container"')[2])[:2]
    assert 'stroke="none"' in path
    assert line.startswith("<polyline")
    (tmp_path / "jar.svg").write_text(text, encoding="utf-8")
    measured = read_written(tmp_path / "jar.svg").container
    assert measured.outline.area == pytest.approx(run.layout.container.outline.area, rel=1e-6)


def test_a_drawn_jar_shows_its_own_walls(tmp_path: Path) -> None:
    (tmp_path / "jar.svg").write_text(JAR, encoding="utf-8")
    run = _run(str(tmp_path / "jar.svg"), count=4, size="10%")
    (wall,) = run.layout.container.walls or ()
    assert wall[[0, -1], 1] == pytest.approx([180, 180], abs=0.01)


@pytest.mark.parametrize(
    ("stroke", "is_shown", "colour", "width"),
    [
        ('stroke="teal" stroke-width="2"', True, "#008080", 2.0),
        ('style="stroke:#F00;stroke-width:1e6"', True, "#ff0000", 2.0),
        ('stroke="url(#g)" stroke-width="2"', False, "#1a202c", 0.2),
    ],
)
def test_a_drawn_jar_shows_its_own_line_in_files_and_sessions(
    stroke: str, is_shown: bool, colour: str, width: float, tmp_path: Path
) -> None:
    jar = tmp_path / "jar.svg"
    jar.write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 50">'
        '<linearGradient id="g"><stop stop-color="red"/><stop offset="1"/></linearGradient>'
        f'<path d="M10 0V40H90V0" fill="none" {stroke}/></svg>',
        encoding="utf-8",
    )
    layout = _run(str(jar), count=1, size="10%", canvas="100").layout
    record = container_record(layout.container, Things())
    kept = replace(layout, container=container_of(record, Shared(lambda _: b"")))
    for one in (layout, kept):
        text = svg_text(one)
        [group] = re.findall(r'<g id="container"[^>]*>', text)
        assert ("display" not in group) == is_shown
        assert f'stroke="{colour}" stroke-width="{width:g}"' in group
    hidden = svg_text(kept, SvgOptions(show_container=False))
    assert 'display="none"' in hidden


@pytest.mark.parametrize("container", ["square", "heart"])
def test_without_a_size_all_find_room_and_the_pile_is_two_thirds_high(container: str) -> None:
    run = uses.fill(uses.pile_recipe(container, ["star", "circle", "owl"], count=18))
    assert len(run.layout.items) == 18
    assert run.is_as_asked
    _, top, _, bottom = run.layout.container.outline.bounds
    highest = min(outline.bounds[1] for outline in run.layout.outlines)
    assert 0.5 < (bottom - highest) / (bottom - top) < 0.85


@pytest.mark.parametrize("most", [3, 4])
def test_a_pile_of_very_many_says_beforehand_that_it_takes_long(
    most: int, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    monkeypatch.setattr("packwork.uses.piles.use.MANY", most)
    _run("square", count=4, size="12%")
    assert ("a pile of 4 items takes minutes" in caplog.text) == (most < 4)


def test_a_pile_leaves_little_bare() -> None:
    found = []
    for seed in range(3):
        recipe = uses.pile_recipe(
            "square", ["star", "moon", "square"], count=40, size="12%", seed=seed
        )
        run = uses.fill(recipe)
        left, _, right, bottom = run.layout.container.outline.bounds
        top = np.median([outline.bounds[1] for outline in run.layout.outlines])
        below = shapely.box(left, top, right, bottom)
        covered = sum((outline.region & below).area for outline in run.layout.outlines)
        found.append(covered / below.area)
    assert np.median(found) > 0.7


def test_items_are_told_one_after_another() -> None:
    counts = []

    class Watcher:
        every = 1

        def on_step(self, step: Step) -> None:
            counts.append(len(step.poses))

    recipe = uses.pile_recipe("square", ["circle", "star"], count=9, size="12%")
    uses.fill(recipe, observer=Watcher())
    assert counts[:9] == list(range(1, 10))
    assert set(counts[9:]) == {9}


@pytest.mark.parametrize("emit", [{}, {"emit": "top"}], ids=["laid", "poured"])
@pytest.mark.parametrize("rotate", ["none", "0,90", "10"])
def test_items_have_only_angles_that_they_may_have(rotate: str, emit: dict[str, str]) -> None:
    for seed in range(2):
        run = _run("square", count=8, size="14%", rotate=rotate, seed=seed, **emit)
        assert run.certified
        angles = np.degrees(run.layout.poses.angle)
        if rotate == "10":
            assert np.all(np.abs(angles) <= 10.0 + 1e-4)
        else:
            allowed = [0.0] if rotate == "none" else [0.0, 90.0]
            off = np.abs((np.subtract.outer(angles, allowed) + 180.0) % 360.0 - 180.0)
            assert np.all(off.min(axis=1) < 1e-4)
