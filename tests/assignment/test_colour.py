"""Items in those of their places in which, seen from afar, they show a picture best."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from packwork.arrays import FloatArray
from packwork.assignment.orders import GRID, order_by_colour
from packwork.readers.photo_options import PhotoOptions
from packwork.readers.photos import read_photos
from packwork.scene.contrast import light_of, oklabs_of_light
from packwork.scene.swatch import mean_light, patch_of

MANY = 6


def _places() -> FloatArray:
    x, y = (one.ravel() for one in np.meshgrid(np.arange(MANY), np.arange(MANY)))
    return np.column_stack([x, y, np.zeros(MANY**2)]).astype(float)


def _patches(lights: FloatArray) -> FloatArray:
    return np.repeat(lights[:, None], GRID**2, axis=1)


def _exchanged(
    patches: FloatArray, wanted: FloatArray, shapes: FloatArray | None = None, blur: float = 0.5
) -> np.ndarray:
    count = len(patches)
    return order_by_colour(
        np.arange(count), _places(), np.ones((count, 2)), patches, wanted,
        np.zeros((count, 0)) if shapes is None else shapes, blur, np.random.default_rng(0),
    )  # fmt: skip


def _seen_away(order: np.ndarray, patches: FloatArray, wanted: FloatArray, blur: float) -> float:
    """The same by a sum over everything, part by part."""
    steps = (np.arange(GRID) + 0.5) / GRID - 0.5
    total = 0.0
    for at, asked in zip(_places(), oklabs_of_light(wanted), strict=True):
        light, weight = np.zeros(3), 0.0
        for place, item in zip(_places(), order, strict=True):
            for row, down in enumerate(steps):
                for column, across in enumerate(steps):
                    away = np.hypot(place[0] + across - at[0], place[1] + down - at[1])
                    share = np.exp(-((away / blur) ** 2) / 2)
                    light += share * patches[item, row * GRID + column]
                    weight += share
        total += float(np.linalg.norm(oklabs_of_light((light / weight)[None])[0] - asked))
    return total


def test_what_is_seen_comes_nearer_and_none_is_lost() -> None:
    rng = np.random.default_rng(1)
    patches = rng.random((MANY**2, GRID**2, 3))
    wanted = np.repeat(np.linspace(0.1, 0.9, MANY**2)[:, None], 3, axis=1)
    order = _exchanged(patches, wanted)
    assert sorted(order.tolist()) == list(range(MANY**2))
    before = _seen_away(np.arange(MANY**2), patches, wanted, 0.5)
    assert _seen_away(order, patches, wanted, 0.5) < 0.8 * before
    # None that is left would be for the better.
    worst = min(
        _seen_away(_swapped(order, *rng.integers(0, MANY**2, 2)), patches, wanted, 0.5)
        for _ in range(10)
    )
    assert worst > 0.99 * _seen_away(order, patches, wanted, 0.5)


def _swapped(order: np.ndarray, one: int, other: int) -> np.ndarray:
    swapped = order.copy()
    swapped[[one, other]] = order[[other, one]]
    return swapped


def test_black_and_white_come_to_stand_in_turn_where_grey_is_wanted() -> None:
    lights = np.repeat(np.arange(MANY**2)[:, None] < MANY**2 // 2, 3, axis=1).astype(float)
    order = _exchanged(_patches(lights), np.full((MANY**2, 3), 0.5), blur=0.7)
    grid = lights[order, 0].reshape(MANY, MANY)
    unlike = [(grid[1:] != grid[:-1]).mean(), (grid[:, 1:] != grid[:, :-1]).mean()]
    # Of black above and white below it would be one in ten, in no order one in two.
    assert np.mean(unlike) > 1 / 2


def test_halves_are_seen_and_not_the_mean_alone() -> None:
    upper, lower = (np.zeros((GRID, GRID, 3)) for _ in range(2))
    upper[0], lower[-1] = 1.0, 1.0
    patches = np.array([upper, lower] * (MANY**2 // 2)).reshape(MANY**2, GRID**2, 3)
    bright = np.zeros((MANY, MANY))
    bright[0] = 0.6
    order = _exchanged(patches, np.repeat(bright.reshape(-1, 1), 3, axis=1), blur=0.3)
    # Of items as bright as each other those stand in the first row whose upper edge is.
    assert np.mean(order.reshape(MANY, MANY)[0] % 2 == 0) > 0.8


def test_unlike_shapes_keep_items_where_they_are() -> None:
    rng = np.random.default_rng(2)
    patches = rng.random((MANY**2, GRID**2, 3))
    shapes = 10.0 * np.arange(MANY**2)[:, None]
    assert _exchanged(patches, rng.random((MANY**2, 3)), shapes).tolist() == list(range(MANY**2))


def test_patches_of_a_picture_are_its_parts(tmp_path: Path) -> None:
    greys = np.array([[20, 250, 80], [200, 10, 140], [100, 180, 40]], dtype=np.uint8)
    Image.fromarray(greys).resize((90, 90), Image.Resampling.NEAREST).save(tmp_path / "nine.png")
    (item,) = read_photos(PhotoOptions(sources=(str(tmp_path / "nine.png"),))).items
    patch = patch_of(item, GRID)
    wanted = light_of(np.repeat(greys.reshape(-1, 1), 3, axis=1) / 255)
    # Its small copy is a JPEG.
    assert patch == pytest.approx(wanted, abs=0.06)
    assert patch.mean(axis=0) == pytest.approx(mean_light(item), abs=0.02)
