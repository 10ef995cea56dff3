"""Mosaics on a grid: places, repeats, what is shown."""

from __future__ import annotations

from collections import Counter
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import packwork as pw
from packwork.errors import RecipeError
from packwork.geometry.outline import Outline
from packwork.recipe import make_recipe
from packwork.steps.lay_grid import APART, grid_in
from packwork.uses import fill


def album_of(folder: Path, seed: int) -> Path:
    """Forty photographs, from dark to bright, half of them dark above and bright below."""
    rng = np.random.default_rng(seed)
    for k in range(40):
        pixels = np.full((48, 64, 3), 255 * (k // 2 + 0.5) / 20)
        if k % 2:
            pixels[:24] *= 0.6
        pixels += rng.normal(0, 4, pixels.shape)
        name = folder / f"p{k:02}.png"
        Image.fromarray(np.clip(pixels, 0, 255).astype(np.uint8)).save(name)
    return folder


@pytest.fixture(scope="module")
def ramp() -> np.ndarray:
    """From dark at the left to bright at the right, a dark line across the middle."""
    picture = np.tile(np.linspace(0, 1, 120), (120, 1))
    picture[57:63] = 0
    return np.repeat(picture[..., None], 3, axis=2)


@pytest.fixture(scope="module")
def album(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return album_of(tmp_path_factory.mktemp("album"), 0)


@pytest.fixture(scope="module", params=[0, 1, 2])
def one_of_three(tmp_path_factory: pytest.TempPathFactory, request: pytest.FixtureRequest) -> Path:
    return album_of(tmp_path_factory.mktemp("album"), request.param)


@pytest.fixture(scope="module")
def laid(one_of_three: Path, ramp: np.ndarray) -> pw.Layout:
    """A hundred tiles of an album."""
    return pw.photos("square", one_of_three, picture=ramp, grid=True, count=100)


def names(layout: pw.Layout) -> Counter[str]:
    return Counter(item.name for item in layout.items)


def test_tiles_fill_a_sheet_and_are_certified(laid: pw.Layout) -> None:
    assert len(laid.items) == 100
    assert laid.certified
    assert laid.metrics["exact"]["LC"] > 0.99
    assert max(names(laid).values()) <= 5


def test_repeats_are_bounded_and_apart(one_of_three: Path, ramp: np.ndarray) -> None:
    layout = pw.photos("square", one_of_three, picture=ramp, grid=True, count=100, repeats=4)
    assert max(names(layout).values()) <= 4
    places = np.column_stack([layout.poses.x, layout.poses.y])
    side = places[:, 0].max() - places[:, 0].min()
    for name in names(layout):
        own = places[[item.name == name for item in layout.items]]
        away = np.abs(own[:, None] - own[None]).max(axis=2) + 1e9 * np.eye(len(own))
        assert away.min() > (APART + 0.5) * side / 9


def test_what_is_dark_lies_where_the_picture_is(laid: pw.Layout) -> None:
    brightness = [int(item.name[1:]) for item in laid.items]
    middle = np.median(laid.poses.y)
    aside = np.abs(laid.poses.y - middle) > 0.12 * laid.container.height
    assert np.corrcoef(np.array(brightness)[aside], laid.poses.x[aside])[0, 1] > 0.8


def test_too_few_repeats_are_refused(album: Path, ramp: np.ndarray) -> None:
    with pytest.raises(RecipeError, match="repeats: 40 photos make 80 tiles at most, not 100"):
        pw.photos("square", album, picture=ramp, grid=True, count=100, repeats=2)


@pytest.mark.parametrize(
    ("options", "told"),
    [
        ({"grid": True}, "grid: is of picture"),
        ({"repeats": 2}, "repeats: is of picture"),
        ({"repeats": 2, "picture": "a"}, "repeats: is of grid"),
    ],
)
def test_options_that_have_no_meaning_are_refused(
    album: Path, ramp: np.ndarray, options: dict[str, object], told: str
) -> None:
    if "picture" in options:
        options = {**options, "picture": ramp}
    with pytest.raises(RecipeError, match=told):
        pw.photos("square", album, **options)  # type: ignore[arg-type]


def test_cells_lie_in_the_container() -> None:
    disc = Outline.from_rings(
        [
            np.column_stack([50 + 50 * np.cos(t), 50 + 50 * np.sin(t)])
            for t in [np.linspace(0, 6.28, 90)]
        ]
    )
    grid = grid_in(disc, 200)
    assert 150 < len(grid.cells) <= 200
    corners = grid.centres[:, None] + grid.side / 2 * np.array([[-1, -1], [1, 1], [-1, 1], [1, -1]])
    assert np.hypot(*(corners - 50).reshape(-1, 2).T).max() < 50.01


def test_padding_is_kept(album: Path, ramp: np.ndarray) -> None:
    layout = pw.photos(
        "square", album, picture=ramp, grid=True, count=64, padding="1%", canvas="100mm"
    )
    assert layout.certified
    assert layout.metrics["exact"]["min_gap"] >= 1.0


@pytest.mark.parametrize(
    ("count", "told"),
    [(1, "1 tile is too large .* use 8"), (3, "3 tiles are too large .* use 6")],
)
def test_tiles_too_large_for_the_container_are_refused(
    album: Path, ramp: np.ndarray, count: int, told: str
) -> None:
    with pytest.raises(RecipeError, match=told):
        pw.photos("heart", album, picture=ramp, grid=True, count=count)


def test_one_photo_is_told_in_the_singular(album: Path, ramp: np.ndarray) -> None:
    with pytest.raises(RecipeError, match="1 photo makes 5 tiles at most, not 36; use 36 or more"):
        pw.photos("square", album / "p00.png", picture=ramp, grid=True, count=36, repeats=5)


def test_a_picture_finer_than_the_tiles_is_told(album: Path, tmp_path: Path) -> None:
    """Stripes show once each tile lies in one."""
    stripes = 5
    row = np.repeat(np.arange(stripes) % 2 * 255, 320 // stripes).astype(np.uint8)
    Image.fromarray(np.tile(row, (320, 1))).save(tmp_path / "stripes.png")
    few, enough = (
        fill(
            make_recipe(
                container="square", photos={"sources": [str(album)]}, grid=True,
                picture=str(tmp_path / "stripes.png"), tint="80%", count=side**2,
            )
        ).advice
        for side in (stripes - 1, stripes)
    )  # fmt: skip
    assert any(f"hard to recognise with {(stripes - 1) ** 2} tiles; -n " in one for one in few)
    assert not any("hard to recognise" in one for one in enough)


def test_photos_that_lack_the_colours_of_a_picture_are_no_want_of_tiles(
    album: Path, tmp_path: Path
) -> None:
    """One photograph shows nothing, in tiles as small as they may be."""
    stripes = np.repeat([0, 255] * 5, 32).astype(np.uint8)
    Image.fromarray(np.tile(stripes, (320, 1))).save(tmp_path / "stripes.png")
    few, many = (
        " ".join(
            fill(
                make_recipe(
                    container="square", photos={"sources": [str(album / "p00.png")]}, grid=True,
                    picture=str(tmp_path / "stripes.png"), count=side**2,
                )
            ).advice
        )
        for side in (9, 10)
    )  # fmt: skip
    assert "with --tint 50% or more photographs, of its colours, would do" in few
    assert "--tint 50% or more photographs, of its colours, would show it" in many
    assert "-n" not in many


def test_fewer_tiles_than_asked_are_told(album: Path, ramp: np.ndarray, tmp_path: Path) -> None:
    Image.fromarray((255 * ramp).astype(np.uint8)).save(tmp_path / "ramp.png")
    asked, met = (
        fill(
            make_recipe(
                container="square", photos={"sources": [str(album)]}, grid=True,
                picture=str(tmp_path / "ramp.png"), count=count,
            )
        )
        for count in (60, 49)
    )  # fmt: skip
    assert len(asked.layout.items) == len(met.layout.items) == 49
    told = "49 tiles, not 60: rows of equal squares fill this container with so many"
    assert told in asked.remarks
    assert not any("rows of" in one for one in met.remarks)
