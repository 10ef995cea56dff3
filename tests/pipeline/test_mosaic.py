"""Layouts that show a picture: colours, ground, places, refusals."""

from __future__ import annotations

import gc
import gzip
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import packwork as pw
from packwork.errors import ReadError, RecipeError
from packwork.geometry.outline import Outline
from packwork.pipeline import Run
from packwork.readers.builtin import builtin_container
from packwork.readers.options import ReadOptions
from packwork.readers.target import read_target
from packwork.recipe import make_recipe
from packwork.scene import swatch
from packwork.scene.colour import css_colour
from packwork.scene.contrast import channels_of
from packwork.scene.item import FlatArt, Item
from packwork.scene.swatch import mean_lights
from packwork.scene.target import TargetPicture
from packwork.steps.mosaic import LEAST, best_ground, correlation_with
from packwork.uses import fill, read

QUICK = {"levels": "50", "epochs": 20, "effort": "draft", "seed": 0}


@pytest.fixture
def halves(tmp_path: Path) -> str:
    """A picture, red on its left and blue on its right."""
    pixels = np.zeros((40, 60, 3), dtype=np.uint8)
    pixels[:, :30], pixels[:, 30:] = (200, 30, 30), (30, 30, 200)
    Image.fromarray(pixels).save(tmp_path / "halves.png")
    return str(tmp_path / "halves.png")


@pytest.fixture
def tiles(tmp_path: Path) -> str:
    """A folder of photographs, half of them red and half of them blue."""
    (tmp_path / "tiles").mkdir()
    for k in range(12):
        colour = (190, 40, 40) if k % 2 else (40, 40, 190)
        Image.new("RGB", (30, 30), colour).save(tmp_path / "tiles" / f"tile-{k}.png")
    return str(tmp_path / "tiles")


def test_light_of_an_art_is_known_though_an_equal_one_goes(monkeypatch: pytest.MonkeyPatch) -> None:
    square = Outline.box(-1, -1, 1, 1)
    gone, red, blue = (
        Item(colour, "", square, square, FlatArt(colour)) for colour in ("red", "red", "blue")
    )
    mean_lights([gone])
    held = [gone]
    del gone

    def mean_light(item: Item) -> np.ndarray:
        held.clear()
        gc.collect()
        return swatch_light(item)

    swatch_light = swatch.mean_light
    monkeypatch.setattr(swatch, "mean_light", mean_light)
    assert mean_lights([red, blue]).tolist() == [[1, 0, 0], [0, 0, 1]]


def _sides(layout: pw.Layout) -> tuple[np.ndarray, np.ndarray]:
    """Red less blue, as channels, of items on the left and on the right."""
    colours = channels_of(mean_lights(layout.items))
    leaning = colours[:, 0] - colours[:, 2]
    middle = layout.container.width / 2
    off = np.abs(layout.poses.x - middle) > 0.1 * layout.container.width
    return leaning[off & (layout.poses.x < middle)], leaning[off & (layout.poses.x > middle)]


def test_items_take_on_the_colours_of_the_picture(halves: str) -> None:
    layout = pw.fill("square", ["star", "owl"], count=24, picture=halves, **QUICK)
    left, right = _sides(layout)
    assert left.min() > 0 > right.max()
    assert layout.ground


@pytest.mark.parametrize("light", [0.02, 0.5, 0.9])
def test_seams_of_tiles_are_like_the_picture(light: float) -> None:
    light_of_all = np.full((40, 40, 3), light)
    light_of_all[:10] = 0.3
    target = TargetPicture(light_of_all, 1.0)
    seams = css_colour(best_ground(target, 0.9998))[0] / 255
    assert abs(seams - float(channels_of(np.array([light]))[0])) < 0.05
    # Where there are gaps, items stand out from them.
    assert abs(css_colour(best_ground(target, 0.8))[0] / 255 - seams) > 0.1


def test_icons_lie_as_they_do_without_a_picture(halves: str) -> None:
    plain = pw.fill("circle", "star", count=9, size_ratio=1.5, **QUICK)
    shown = pw.fill("circle", "star", count=9, picture=halves, detail=0, **QUICK)
    assert np.array_equal(plain.poses.x, shown.poses.x)
    assert np.array_equal(plain.poses.scale, shown.poses.scale)


def test_gaps_are_made_up_for(halves: str) -> None:
    """On white items are darker than on black, so that both blend to the same."""
    white, black = (
        pw.fill("square", "star", count=16, picture=halves, ground=ground, **QUICK)
        for ground in ("white", "black")
    )
    assert mean_lights(white.items).sum() < mean_lights(black.items).sum() - 1


def test_photos_keep_their_colours_and_find_their_places(halves: str, tiles: str) -> None:
    layout = pw.photos("square", tiles, picture=halves, **QUICK)
    left, right = _sides(layout)
    assert left.min() > 0
    assert right.max() < 0
    assert layout.manifest["certified"]


@pytest.mark.parametrize(("tint", "red"), [(None, 6), ("100%", 4)])
def test_of_more_photos_than_places_those_that_suit_are_taken(
    tmp_path: Path, tiles: str, tint: str | None, red: int
) -> None:
    """Of six red and six blue ones all red ones, for a picture that is red but for its edge."""
    pixels = np.zeros((40, 80, 3), dtype=np.uint8)
    pixels[:, :55], pixels[:, 55:] = (200, 30, 30), (30, 30, 200)
    Image.fromarray(pixels).save(tmp_path / "red.png")
    picture = str(tmp_path / "red.png")
    layout = pw.photos("square", tiles, count=8, picture=picture, tint=tint, **QUICK)
    taken = [Path(item.source).stem for item in layout.items]
    assert sum(int(name.split("-")[1]) % 2 for name in taken) == red
    assert len(set(taken)) == 8


def test_a_tint_moves_the_colours_of_photos(halves: str, tiles: str) -> None:
    plain, tinted = (
        pw.photos("square", tiles, picture=halves, tint=tint, **QUICK) for tint in (0, "50%")
    )
    assert np.ptp(mean_lights(plain.items)[:, 1]) < 1e-6
    assert not np.array_equal(mean_lights(plain.items), mean_lights(tinted.items))


def test_an_item_with_a_colour_of_its_own_keeps_it(halves: str) -> None:
    rules = [{"items": "star", "color": "#00ff00"}]
    layout = pw.fill("square", ["star", "moon"], count=8, picture=halves, rules=rules, **QUICK)
    colours = {item.name: light for item, light in zip(
        layout.items, mean_lights(layout.items), strict=True)}  # fmt: skip
    assert colours["star"] == pytest.approx([0, 1, 0], abs=0.02)


def test_words_can_be_read_on_the_ground(tmp_path: Path) -> None:
    Image.fromarray(np.tile(np.arange(0, 64, dtype=np.uint8), (64, 1))).save(tmp_path / "dark.png")
    picture = str(tmp_path / "dark.png")
    layout = pw.words("square", "one two three four", picture=picture, effort="draft")
    from packwork.scene.contrast import contrast
    from packwork.scene.swatch import representative_colour

    for item in layout.items:
        assert contrast(representative_colour(item), layout.ground) > 1.5


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"tint": 0.5}, "tint: is of picture"),
        ({"ground": "white"}, "ground: is of picture"),
        ({"detail": 0.5}, "detail: is of picture"),
        ({"picture": "", "tint": 0.5}, "picture: is an empty name"),
    ],
)
def test_what_has_no_meaning_is_refused(options: dict[str, object], said: str) -> None:
    with pytest.raises(RecipeError, match=said):
        pw.fill("circle", "star", count=2, **options, **QUICK)


@pytest.fixture
def corner(tmp_path: Path) -> str:
    """A picture, grey but for a chequered corner at the top left."""
    pixels = np.full((60, 60), 128, dtype=np.uint8)
    y, x = np.mgrid[0:24, 0:24]
    pixels[:24, :24] = np.where((x // 4 + y // 4) % 2, 255, 0)
    Image.fromarray(pixels).save(tmp_path / "corner.png")
    return str(tmp_path / "corner.png")


def test_items_are_small_where_the_picture_has_much_to_show(corner: str) -> None:
    def smaller(detail: float) -> float:
        """Median size in the corner over that elsewhere, the median of seeds."""
        ratios = []
        for seed in range(3):
            asked = {**QUICK, "seed": seed, "detail": detail, "picture": corner}
            layout = pw.fill("square", "star", count=20, **asked)
            assert layout.manifest["certified"]
            near = np.maximum(layout.poses.x, layout.poses.y) < 0.4 * layout.container.width
            scale = layout.poses.scale
            ratios.append(float(np.median(scale[near]) / np.median(scale[~near])))
        return float(np.median(ratios))

    assert smaller(1.0) < smaller(0.0)


def test_the_heaviest_come_where_there_is_least_to_show(corner: str) -> None:
    weights = {"star": 4, "moon": 1}
    ratios = []
    for seed in range(3):
        asked = {**QUICK, "seed": seed, "picture": corner, "detail": 1, "weights": weights}
        layout = pw.fill("square", ["star", "moon"], count=16, **asked)
        is_star = np.array([item.name == "star" for item in layout.items])
        scale = layout.poses.scale
        ratios.append(np.median(scale[is_star]) / np.median(scale[~is_star]))
    assert np.median(ratios) > 1


def test_pinned_items_keep_their_places_among_detail(corner: str) -> None:
    rules = [{"items": "moon", "count": 1, "pin": {"x": "50%", "y": "50%", "size": "20%"}}]
    layout = pw.fill("square", ["star", "moon"], count=20, rules=rules, picture=corner, **QUICK)
    moon = next(k for k, item in enumerate(layout.items) if item.name == "moon")
    assert layout.poses.x[moon] == layout.container.width / 2
    assert layout.manifest["certified"]


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"sizes": "shared"}, "detail: makes sizes follow the picture, and they are shared"),
        ({"start": "scatter"}, "detail: chooses places by the picture; leave start out"),
        (
            {"rules": [{"items": "star", "region": [0, 0, "50%", "100%"]}]},
            "detail: chooses places by the picture, and a rule keeps items to a region",
        ),
    ],
)
def test_detail_is_refused_where_places_or_sizes_are_given(
    halves: str, options: dict[str, object], said: str
) -> None:
    with pytest.raises(RecipeError, match=said):
        pw.fill("square", "star", count=4, picture=halves, detail=0.5, **options, **QUICK)
    # Where it was not asked for, the picture is shown without it.
    assert pw.fill("square", "star", count=4, picture=halves, **options, **QUICK).ground


def test_a_clear_picture_is_refused(tmp_path: Path) -> None:
    Image.new("RGBA", (9, 9)).save(tmp_path / "clear.png")
    with pytest.raises(ReadError, match="shows nothing, for it is clear"):
        pw.fill("circle", "star", count=2, picture=str(tmp_path / "clear.png"), **QUICK)


def test_the_ground_does_not_hide_the_items() -> None:
    """A picture of one shade and a few dark lines is not shown on that shade."""
    light = np.full((40, 40, 3), [0.8, 0.25, 0.01])
    light[10:13] = 0.01
    ground = np.array([int(best_ground(TargetPicture(light, 1.0), 0.8)[k : k + 2], 16)
                       for k in (1, 3, 5)]) / 255  # fmt: skip
    assert np.abs(ground - channels_of(light[0, 0])).max() > 0.15


def test_a_picture_of_one_colour_is_refused(tmp_path: Path) -> None:
    Image.new("RGB", (9, 9), "teal").save(tmp_path / "plain.png")
    with pytest.raises(ReadError, match="has one colour only"):
        pw.fill("circle", "star", count=2, picture=str(tmp_path / "plain.png"), **QUICK)


def test_a_missing_picture_is_one_line() -> None:
    with pytest.raises(ReadError, match=r"missing\.png"):
        pw.fill("circle", "star", count=2, picture="missing.png", **QUICK)


def test_the_picture_covers_the_container(halves: str) -> None:
    target = read_target(halves, builtin_container("square"))
    rows, columns = target.light.shape[:2]
    left = target.light[rows // 2, columns // 4]
    right = target.light[rows // 2, 3 * columns // 4]
    assert left[0] > 0.5 > left[2]
    assert right[2] > 0.5 > right[0]


def test_a_pale_picture_asks_for_a_pale_ground() -> None:
    """No dark one, on which whites could not make up for the gaps; none as pale as the items."""
    light = np.full((20, 20, 3), 0.9)
    light[:10] = 0.8
    assert "#888888" < best_ground(TargetPicture(light, 1.0), 0.8) < "#e0e0e0"


def test_a_background_that_is_asked_for_is_the_ground(tmp_path: Path, halves: str) -> None:
    from packwork.cli import app

    out = tmp_path / "out.svg"
    line = ["fill", "square", "star", "-n", "4", "--picture", halves, "--background", "ivory",
            "--levels", "50", "--epochs", "9", "-q", "-o", str(out)]  # fmt: skip
    with pytest.raises(SystemExit) as ended:
        app(line)
    assert ended.value.code == 0
    assert 'id="background"' in out.read_text(encoding="utf-8")


def test_a_chart_and_a_picture_behind_are_refused(halves: str, tmp_path: Path) -> None:
    (tmp_path / "a.csv").write_text("name,value\na,1\nb,2\n", encoding="utf-8")
    chart = {"container": "square", "chart": {"data": str(tmp_path / "a.csv")}}
    with pytest.raises(RecipeError, match="no meaning in a chart"):
        read(make_recipe(**chart, picture=halves))
    with pytest.raises(RecipeError, match="no meaning round a picture"):
        read(make_recipe(container=f"around:{halves}", items=["star"], picture=halves))


def test_a_session_keeps_the_ground(halves: str) -> None:
    layout = pw.fill("square", "star", count=4, picture=halves, ground="Ivory", **QUICK)
    assert layout.ground == "#fffff0"
    with layout.edit() as session:
        assert session.layout.ground == layout.ground


@pytest.mark.parametrize("ending", [".svg", ".svgz", ".xml"])
def test_a_drawing_may_be_the_picture(halves: str, ending: str, tmp_path: Path) -> None:
    text = (
        b'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 80 60">'
        b'<path d="M10 10h30v40h-30z" fill="#c81e1e"/><path d="M40 10h30v40h-30z" fill="#1e1ec8"/>'
        b"</svg>"
    )
    file = tmp_path / f"logo{ending}"
    file.write_bytes(gzip.compress(text) if ending == ".svgz" else text)
    square = builtin_container("square")
    drawn, painted = (read_target(path, square).light for path in (file, halves))
    assert np.abs(drawn - painted).max(axis=2).mean() < 0.01


def test_a_page_of_a_drawing_is_shown_if_it_is_to_stay(tmp_path: Path) -> None:
    file = tmp_path / "logo.svg"
    file.write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 80 60"><path d="M0 0h80v60h-80z" '
        'fill="#fff"/><path d="M30 20h20v20h-10z" fill="#c81e1e"/><path d="M30 20v20h10z"/></svg>',
        encoding="utf-8",
    )
    square = builtin_container("square")
    bare, whole = (
        read_target(file, square, ReadOptions(keep_page=keep)).light for keep in (None, True)
    )
    assert whole.mean() > bare.mean() + 0.1


def test_a_broken_drawing_is_one_line(tmp_path: Path) -> None:
    (tmp_path / "cut.svg").write_text("<svg", encoding="utf-8")
    with pytest.raises(ReadError, match=r"cut\.svg: "):
        pw.fill("square", "star", count=4, picture=str(tmp_path / "cut.svg"), **QUICK)


@pytest.fixture(scope="module")
def checks(tmp_path_factory: pytest.TempPathFactory) -> str:
    """A picture of six by six squares in two colours."""
    board = np.indices((6, 6)).sum(axis=0) % 2
    pixels = np.where(board[..., None], (220, 180, 40), (20, 40, 140)).astype(np.uint8)
    path = tmp_path_factory.mktemp("checks") / "c.png"
    Image.fromarray(pixels).resize((240, 240), Image.Resampling.NEAREST).save(path)
    return str(path)


def _squares(picture: str, count: int, seed: int = 0) -> Run:
    options = {**QUICK, "seed": seed, "picture": picture}
    return fill(make_recipe(container="square", items=["square"], count=count, **options))


@pytest.fixture(scope="module")
def many(checks: str) -> Run:
    """As many squares as show the picture."""
    return _squares(checks, 300)


@pytest.mark.parametrize("seed", range(3))
def test_too_few_items_for_a_picture_are_told_of(checks: str, seed: int) -> None:
    told = " ".join(_squares(checks, 12, seed).advice)
    assert "the picture shows to" in told
    assert "would show it" in told


def test_enough_items_for_a_picture_are_not_told_of(many: Run) -> None:
    assert "the picture shows to" not in " ".join(many.advice)


def test_what_a_picture_loses_is_told_with_the_number_that_would_show_it(many: Run) -> None:
    [told] = [one for one in many.remarks if "can show the picture" in one]
    found = re.fullmatch(r"300 items can show the picture to (\d+) %; -n (\d+) to (\d+) %", told)
    assert found
    shown, more, then = map(int, found.groups())
    assert shown < then <= 100
    assert more > 300


def test_shuffled_items_are_like_no_picture(checks: str, many: Run) -> None:
    layout = many.layout
    target = read_target(checks, layout.container)
    assert correlation_with(layout, target) > LEAST
    for seed in range(4):
        order = np.random.default_rng(seed).permutation(len(layout.items))
        assert (
            abs(correlation_with(replace(layout, poses=layout.poses.subset(order)), target)) < 0.4
        )
