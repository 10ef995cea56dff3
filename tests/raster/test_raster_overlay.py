"""Pictures laid over each other: whole where they are whole, soft at their edges."""

from __future__ import annotations

import numpy as np
import pytest

from packwork.geometry import affine
from packwork.raster.coverage import coverage
from packwork.raster.overlay import Picture, premultiplied, straight, texture_of


def tile(side: int, colour: tuple[int, int, int, int] = (200, 40, 10, 255)) -> Picture:
    return np.full((side, side, 4), colour, dtype=np.uint8)


def blank(rows: int, columns: int, level: int = 0) -> Picture:
    return np.full((rows, columns, 4), level, dtype=np.uint8)


def about_the_middle(side: int) -> np.ndarray:
    """Map from units in which the tile is two wide, about its middle, to its pixels."""
    return affine.similarity(side / 2, side / 2, 0.0, side / 2)


@pytest.mark.parametrize("angle", [0.0, 0.4, np.pi / 4, 2.5])
@pytest.mark.parametrize("half", [3.3, 8.0, 20.5])
def test_a_square_covers_what_a_square_covers(angle: float, half: float) -> None:
    texture = texture_of(tile(64), about_the_middle(64))
    image = blank(60, 50)
    place = affine.similarity(24.3, 31.6, angle, half)
    texture.lay(image, place)
    corners = affine.apply(place, np.array([[-1.0, -1], [1, -1], [1, 1], [-1, 1]]))
    true = coverage(corners, [0, 4], (60, 50))
    got = image[:, :, 3] / 255
    assert got.sum() == pytest.approx(true.sum(), rel=0.03)
    inside, outside = true > 0.999, true < 0.001
    # Soft edges reach half a pixel further than a pixel's own.
    assert got[inside].mean() > 0.97
    assert got[outside].mean() < 0.03
    assert np.abs(got - true).max() < 0.55


def test_many_coarse_copies_beside_the_fine_one() -> None:
    texture = texture_of(tile(512), about_the_middle(512))
    for half in (2.0, 9.0, 40.0):
        image = blank(100, 100)
        texture.lay(image, affine.similarity(50.0, 50.0, 0.3, half))
        assert image[:, :, 3].sum() / 255 == pytest.approx(4 * half**2, rel=0.1)


def test_what_lies_over_hides_what_lies_under() -> None:
    image = blank(20, 20, 255)
    texture_of(tile(40), about_the_middle(40)).lay(image, affine.similarity(10, 10, 0.2, 6))
    assert image[10, 10].tolist() == [200, 40, 10, 255]
    assert image[0, 0].tolist() == [255] * 4
    half = tile(40, (0, 0, 255, 128))
    texture_of(half, about_the_middle(40)).lay(image, affine.similarity(10, 10, 0.2, 6))
    assert np.abs(image[10, 10].astype(int) - [100, 20, 133, 255]).max() <= 1


@pytest.mark.parametrize("x", [-40.0, -2.0, 0.0, 19.0, 22.0, 1e6])
def test_what_lies_outside_is_cut_off(x: float) -> None:
    texture = texture_of(tile(16), about_the_middle(16))
    wide, image = blank(20, 120), blank(20, 20)
    texture.lay(image, affine.similarity(x, 8.0, 0.7, 5.0))
    texture.lay(wide, affine.similarity(x + 50, 8.0, 0.7, 5.0))
    np.testing.assert_array_equal(image, wide[:, 50:70])


def test_what_has_no_size_is_not_drawn() -> None:
    image = blank(9, 9)
    texture_of(tile(8), about_the_middle(8)).lay(image, affine.similarity(4.0, 4.0, 0.0, 0.0))
    assert not image.any()


def test_premultiplied_and_straight_are_each_others_inverse() -> None:
    rng = np.random.default_rng(4)
    picture = rng.integers(0, 256, (20, 20, 4)).astype(np.uint8)
    picture[:, :, 3] = np.maximum(picture[:, :, 3], 128)
    again = straight(premultiplied(picture))
    assert np.abs(again.astype(int) - picture).max() <= 1
