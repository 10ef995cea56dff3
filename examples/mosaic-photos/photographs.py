"""Small landscapes of every colour, and a picture to be shown by them: ``python photographs.py``.

Each is a sky, a disc in it and ridges, in colours about one hue, from blue over violet and red to
yellow: as if taken on many evenings.
"""

from __future__ import annotations

import colorsys
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

COUNT, SIDE_PX = 560, 48
PICTURE_PX = 480
Image_ = NDArray[np.float64]


def colour(hue: float, saturation: float, value: float) -> Image_:
    """Channels 0..255."""
    return 255 * np.array(
        colorsys.hsv_to_rgb(hue % 1, np.clip(saturation, 0, 1), np.clip(value, 0, 1))
    )


def ridge(width: int, rng: np.random.Generator) -> Image_:
    """Heights along a line, -1..1."""
    x = np.linspace(0, 2 * np.pi, width)
    waves = [
        0.55**k * np.sin(2.0**k * x * rng.uniform(0.6, 1.4) + rng.uniform(0, 7)) for k in range(6)
    ]
    line = np.sum(waves, axis=0)
    return line / np.abs(line).max()


def photograph(rng: np.random.Generator, side: int = SIDE_PX) -> Image_:
    """One of them: its mean colour anywhere between black, white and vivid."""
    hue = rng.choice([rng.uniform(0.58, 0.78), rng.uniform(0.9, 1.15), rng.normal(1.1, 0.03)])
    saturation, value = rng.beta(1.4, 1.5), rng.choice([rng.beta(1.2, 3), rng.beta(3, 1)])
    row, column = np.mgrid[:side, :side] / side
    horizon = rng.uniform(0.45, 0.75)
    top = colour(hue + rng.normal(0, 0.03), saturation * 1.1, value * 0.92)
    low = colour(hue + rng.normal(0, 0.05), saturation * 0.7, min(value * 1.15 + 0.04, 1.0))
    share = np.clip(row / horizon, 0, 1)[..., None]
    image = (1 - share) * top + share * low
    x, y, radius = rng.uniform(0.2, 0.8), rng.uniform(0.15, horizon), rng.uniform(0.05, 0.13)
    away = np.hypot(column - x, row - y)[..., None]
    light = low + 0.5 * (255 - low)
    image = image + np.clip((radius - away) * side, 0, 1) * (light - image)
    for k in range(3):
        edge = horizon + 0.13 * k - 0.09 * ridge(side, rng)
        land = colour(hue + rng.normal(0, 0.06), saturation * 1.1, value * (0.95 - 0.12 * k))
        image = image + np.clip((row - edge[None]) * side, 0, 1)[..., None] * (land - image)
    return np.asarray(image)


def picture(side: int = PICTURE_PX) -> Image_:
    """A sailing boat before an evening sun, on a sea that mirrors it."""
    row, column = np.mgrid[:side, :side] / side
    stops = np.array([[38, 44, 110], [150, 70, 130], [238, 120, 84], [252, 208, 120]])
    sky = np.stack([np.interp(row, [0, 0.3, 0.52, 0.66], stops[:, k]) for k in range(3)], axis=2)
    away = np.hypot(column - 0.62, row - 0.5)[..., None]
    image = np.where(away < 0.13, [255, 246, 205], sky + 90 * np.exp(-away / 0.12) * [1, 0.8, 0.4])
    sea = np.stack(
        [np.interp(row, [0.66, 1], pair) for pair in ((70, 14), (74, 26), (120, 66))], axis=2
    )
    gleam = np.exp(-(((column - 0.62) / (0.05 + 0.35 * (row - 0.66))) ** 2)) * (
        0.6 + 0.4 * np.sin(90 * row)
    )
    sea = sea + 0.75 * np.clip(gleam, 0, 1)[..., None] * (np.array([255, 200, 120]) - sea)
    image = np.where(row[..., None] > 0.66, sea, image)
    mast = 0.33
    main = (
        (column < mast - 0.008)
        & (row > 0.18)
        & (row < 0.66)
        & (column > mast - 0.42 * (row - 0.18))
    )
    jib = (
        (column > mast + 0.008) & (row > 0.26) & (row < 0.66) & (column < mast + 0.3 * (row - 0.26))
    )
    hull = (row > 0.68) & (row < 0.76) & (np.abs(column - mast) < 0.22 - 0.9 * (row - 0.68))
    image[main], image[jib], image[hull] = (246, 240, 228), (214, 70, 62), (70, 32, 34)
    return np.asarray(image)


def saved(image: Image_, path: Path) -> None:
    """Write a picture."""
    Image.fromarray(np.clip(image, 0, 255).astype(np.uint8)).save(path, quality=75)


if __name__ == "__main__":
    here = Path(__file__).resolve().parent
    (here / "album").mkdir(exist_ok=True)
    for k in range(COUNT):
        saved(photograph(np.random.default_rng(k)), here / "album" / f"{k:03}.jpg")
    saved(picture(), here / "boat.jpg")
