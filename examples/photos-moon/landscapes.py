"""Forty landscapes that no camera has seen: ``python landscapes.py album``.

Each is a sky, a sun or a moon, ridges that fade into the distance, and here and there a lake.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

COUNT = 40
LONGER_PX = 420
SKIES = (
    ("#0b1030", "#24366e", "#e08a5c"), ("#132a4f", "#3f6fa3", "#f2d7a6"),
    ("#2b1740", "#a4446a", "#f6b26b"), ("#0a1a2f", "#14455c", "#7ec4b0"),
    ("#5aa0d0", "#a9d3ea", "#f5ead2"), ("#06070f", "#131a3a", "#3c4a7d"),
    ("#36556b", "#88a6ac", "#e9d9c3"), ("#401b2e", "#c5543f", "#fbd37a"),
)  # fmt: skip
LANDS = ("#16242e", "#1d2f2a", "#2a1f33", "#33261f", "#12263d", "#23301c")
Image_ = NDArray[np.float64]


def rgb(text: str) -> Image_:
    """Channels of ``#rrggbb``."""
    return np.array([int(text[k : k + 2], 16) for k in (1, 3, 5)], dtype=np.float64)


def ridge(width: int, rough: float, rng: np.random.Generator) -> Image_:
    """Heights along a line, -1..1: waves of all lengths, the shorter the lower."""
    x = np.linspace(0, 2 * np.pi, width)
    waves = [
        rough**octave * np.sin(2.0**octave * x * rng.uniform(0.6, 1.4) + rng.uniform(0, 7))
        for octave in range(8)
    ]
    line = np.sum(waves, axis=0)
    return line / np.abs(line).max()


def sky(shape: tuple[int, int], horizon: float, rng: np.random.Generator) -> Image_:
    """Three colours, one into the next, down to the horizon."""
    colours = np.array([rgb(c) for c in SKIES[rng.integers(len(SKIES))]])
    down = np.clip(np.arange(shape[0]) / (horizon * shape[0]), 0, 1)
    column = np.stack([np.interp(down, [0, 0.55, 1], colours[:, k]) for k in range(3)], axis=1)
    return np.repeat(column[:, None], shape[1], axis=1)


def with_light(image: Image_, horizon: float, rng: np.random.Generator) -> Image_:
    """Stars if it is dark, a disc, and its glow."""
    rows, columns = image.shape[:2]
    if image[0].mean() < 40:
        for _ in range(columns // 5):
            row, column = rng.integers(int(rows * horizon)), rng.integers(columns)
            image[row, column] += rng.uniform(60, 190)
    x, y = rng.uniform(0.15, 0.85) * columns, rng.uniform(0.25, 0.95) * horizon * rows
    radius = rng.uniform(0.03, 0.08) * min(rows, columns)
    row, column = np.mgrid[:rows, :columns]
    away = np.hypot(column - x, row - y)
    glow = np.exp(-away / (4 * radius))[..., None]
    image = image + 0.7 * glow * (np.array([255, 225, 180]) - image)
    disc = np.clip(radius + 0.5 - away, 0, 1)[..., None]
    return image + disc * (np.array([255, 246, 224]) - image)


def with_ridges(image: Image_, horizon: float, rng: np.random.Generator) -> Image_:
    """Mountains, the nearer the less of the air's colour."""
    rows, columns = image.shape[:2]
    air, near = image[int(horizon * rows) - 1].mean(axis=0), rgb(LANDS[rng.integers(len(LANDS))])
    row = np.arange(rows)[:, None]
    count = rng.integers(3, 6)
    for k in range(count):
        share = (k + 1) / count
        top = horizon + (share - 0.5) * 0.35
        edge = rows * (top - rng.uniform(0.05, 0.12) * ridge(columns, 0.55, rng))
        below = np.clip(row - edge[None] + 0.5, 0, 1)[..., None]
        colour = air + share**0.7 * (near - air)
        image = image + below * (colour - image)
    return image


def with_lake(image: Image_, rng: np.random.Generator) -> Image_:
    """The lowest quarter mirrors what lies above, in ripples."""
    rows = len(image)
    shore = int(rows * rng.uniform(0.72, 0.82))
    depth = np.arange(rows - shore)
    shift = np.round(depth * 0.08 * np.sin(depth * 1.7)).astype(int)
    mirrored = image[np.clip(shore - 2 * depth + shift, 0, shore - 1)]
    image[shore:] = 0.82 * mirrored + 0.18 * np.array([40, 60, 90])
    return image


def landscape(rng: np.random.Generator) -> Image.Image:
    """One of them, wide or high."""
    aspect = float(np.exp(rng.uniform(np.log(2 / 3), np.log(3 / 2))))
    columns = round(LONGER_PX * min(1.0, aspect))
    rows = round(columns / aspect)
    horizon = float(rng.uniform(0.5, 0.7))
    image = with_ridges(with_light(sky((rows, columns), horizon, rng), horizon, rng), horizon, rng)
    if rng.random() < 0.45:
        image = with_lake(image, rng)
    image = image + rng.normal(0, 2.0, (rows, columns, 1))
    return Image.fromarray(np.clip(image, 0, 255).astype(np.uint8))


def main(folder: Path) -> None:
    """Draw all of them."""
    folder.mkdir(exist_ok=True)
    for k in range(COUNT):
        picture = landscape(np.random.default_rng(k))
        picture.save(folder / f"landscape-{k + 1:02}.jpg", quality=82)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
