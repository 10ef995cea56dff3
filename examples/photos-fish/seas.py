"""Thirty views from under water: ``python seas.py album``.

Each is light that fades with depth, rays, weed on the ground, and a shoal.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw, ImageFilter

COUNT = 30
LONGER_PX = 400
FINER = 2
WATERS = (
    ("#bff3ef", "#1f8ea3", "#06263f"), ("#d8f7d0", "#2fa58c", "#073b3a"),
    ("#cde9ff", "#2f6fc0", "#0a1b46"), ("#ffe3c2", "#d98a6a", "#3a2450"),
)  # fmt: skip
SCALES = ("#ff8552", "#ffd166", "#f8f0e3", "#ef476f", "#9be7ff")


def rgb(text: str) -> tuple[int, int, int]:
    """Channels of ``#rrggbb``."""
    return int(text[1:3], 16), int(text[3:5], 16), int(text[5:7], 16)


def water(width: int, height: int, rng: np.random.Generator) -> Image.Image:
    """Light from above, in rays."""
    colours = np.array([rgb(c) for c in WATERS[rng.integers(len(WATERS))]], dtype=np.float64)
    down = np.linspace(0, 1, height)
    column = np.stack([np.interp(down, [0, 0.4, 1], colours[:, k]) for k in range(3)], axis=1)
    image = np.repeat(column[:, None], width, axis=1)
    slant = np.arange(width)[None] - rng.uniform(-0.6, 0.6) * np.arange(height)[:, None]
    rays = sum(np.sin(slant / width * f + rng.uniform(0, 7)) for f in (9, 17, 31)) / 3
    image += 60 * np.clip(rays, 0, 1)[..., None] * (1 - down)[:, None, None]
    return Image.fromarray(np.clip(image, 0, 255).astype(np.uint8))


def weed(draw: ImageDraw.ImageDraw, size: tuple[int, int], rng: np.random.Generator) -> None:
    """Stalks that sway, thinner towards their tips."""
    width, height = size
    for _ in range(rng.integers(4, 11)):
        x, tall = rng.uniform(0, width), rng.uniform(0.15, 0.45) * height
        sway, phase = rng.uniform(0.01, 0.05) * width, rng.uniform(0, 7)
        up = np.linspace(0, 1, 40)
        line = [(x + sway * np.sin(5 * u + phase) * u, height - tall * u) for u in up]
        for (x0, y0), (x1, y1), u in zip(line, line[1:], up, strict=False):
            thick = max(2, round(0.03 * width * (1 - u)))
            draw.line((x0, y0, x1, y1), fill=(10, 60, 58), width=thick)


def swimmer(
    draw: ImageDraw.ImageDraw, x: float, y: float, long: float, way: int, fill: str
) -> None:
    """A body, a tail and an eye."""
    turn = np.linspace(0, 2 * np.pi, 40)
    body = [(x + way * long * np.cos(t) / 2, y + long * np.sin(t) / 4.5) for t in turn]
    shares = ((0.42, 0), (0.75, -0.2), (0.68, 0), (0.75, 0.2))
    tail = [(x - way * long * a, y + long * b) for a, b in shares]
    draw.polygon(body, fill=fill)
    draw.polygon(tail, fill=fill)
    eye_x, eye_y, r = x + way * 0.32 * long, y - 0.04 * long, 0.03 * long
    draw.ellipse((eye_x - r, eye_y - r, eye_x + r, eye_y + r), fill="#1a2233")


def sea(rng: np.random.Generator) -> Image.Image:
    """One view: a shoal before blurred weed."""
    aspect = float(np.exp(rng.uniform(np.log(2 / 3), np.log(3 / 2))))
    width = round(FINER * LONGER_PX * min(1.0, aspect))
    height = round(width / aspect)
    image = water(width, height, rng)
    draw = ImageDraw.Draw(image)
    weed(draw, image.size, rng)
    image = image.filter(ImageFilter.GaussianBlur(3))
    draw = ImageDraw.Draw(image)
    way, fill = int(rng.choice([-1, 1])), SCALES[rng.integers(len(SCALES))]
    long = rng.uniform(0.1, 0.32) * width
    for _ in range(max(1, round(0.5 * width / long))):
        x, y = rng.uniform(0.15, 0.85) * width, rng.uniform(0.2, 0.75) * height
        swimmer(draw, x, y, long * rng.uniform(0.75, 1.15), way, fill)
    return image.resize((width // FINER, height // FINER), Image.Resampling.LANCZOS)


def main(folder: Path) -> None:
    """Draw all of them."""
    folder.mkdir(exist_ok=True)
    for k in range(COUNT):
        sea(np.random.default_rng(k)).save(folder / f"sea-{k + 1:02}.jpg", quality=82)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
