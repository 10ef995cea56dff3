"""Patches of a quilt, and a fox to be sewn of them: ``python patches.py``.

Each is of two cloths: half-square triangles, quarter discs, discs, stripes, chevrons.
"""

from __future__ import annotations

import colorsys
import random
from pathlib import Path

from PIL import Image, ImageDraw

COUNT, SIDE_PX = 640, 48
PICTURE_PX = 480

HUES = {"fox": (0.055, 0.025), "cream": (0.11, 0.02), "night": (0.56, 0.05), "moss": (0.40, 0.05)}
"""Hue and its spread of cloths."""


def cloth(hue: float, saturation: float, value: float) -> tuple[int, int, int]:
    """Channels of a colour."""
    red, green, blue = colorsys.hsv_to_rgb(hue % 1, min(saturation, 1.0), min(value, 1.0))
    return round(255 * red), round(255 * green), round(255 * blue)


def patch(rng: random.Random) -> Image.Image:
    """One patch, one cloth a little lighter than the other."""
    kind = rng.choice(sorted(HUES))
    hue = rng.gauss(*HUES[kind])
    saturation = rng.uniform(0.04, 0.35) if kind == "cream" else rng.uniform(0.4, 0.95)
    value = rng.uniform(0.8, 1.0) if kind == "cream" else rng.uniform(0.1, 0.95)
    step = rng.uniform(0.07, 0.2) * (-1 if value > 0.7 else 1)
    ground = cloth(hue, saturation, value)
    other = cloth(hue + rng.gauss(0, 0.02), saturation * 0.9, value * (1 + step) + 0.02)
    large = 4 * SIDE_PX
    image = Image.new("RGB", (large, large), ground)
    draw = ImageDraw.Draw(image)
    shape = rng.randrange(6)
    if shape == 0:
        draw.polygon([(0, 0), (large, 0), (0, large)], fill=other)
    elif shape == 1:
        draw.ellipse((-large, -large, large, large), fill=other)
    elif shape == 2:
        draw.ellipse((large * 0.18, large * 0.18, large * 0.82, large * 0.82), fill=other)
    elif shape == 3:
        for k in range(0, 6, 2):
            draw.rectangle((0, k * large // 6, large, (k + 1) * large // 6 - 1), fill=other)
    elif shape == 4:
        half = large // 2
        draw.polygon([(0, half), (half, 0), (large, half), (half, large)], fill=other)
    else:
        draw.ellipse((-large / 2, -large / 2, large / 2, large / 2), fill=other)
        draw.ellipse((large / 2, large / 2, 1.5 * large, 1.5 * large), fill=other)
    turned = image.rotate(90 * rng.randrange(4))
    return turned.resize((SIDE_PX, SIDE_PX), Image.Resampling.BOX)


def fox() -> Image.Image:
    """A fox's face before the night."""
    s = 4 * PICTURE_PX
    image = Image.new("RGB", (s, s))
    draw = ImageDraw.Draw(image)
    for y in range(s):
        draw.line((0, y, s, y), fill=cloth(0.58 - 0.18 * y / s, 0.75, 0.3 + 0.22 * y / s))

    def shape(fill: str, *points: tuple[float, float], both: bool = True) -> None:
        for sign in (1, -1) if both else (1,):
            draw.polygon([(s * (0.5 + sign * x), s * y) for x, y in points], fill=fill)

    draw.ellipse((s * 0.39, s * 0.05, s * 0.61, s * 0.27), fill="#f6e7b4")
    shape("#d9631e", (0.10, 0.34), (0.30, 0.06), (0.40, 0.46))
    shape("#3a1d14", (0.19, 0.31), (0.285, 0.155), (0.335, 0.38))
    shape("#e8772a", (0.0, 0.32), (0.20, 0.28), (0.40, 0.46), (0.40, 0.56), (0.0, 0.9))
    shape("#c9551a", (0.0, 0.32), (0.08, 0.31), (0.05, 0.62), (0.0, 0.66))
    shape(
        "#f7ead0", (0.42, 0.55), (0.23, 0.56), (0.07, 0.70), (0.0, 0.86), (0.0, 0.95), (0.20, 0.82)
    )
    shape("#1c1512", (0.11, 0.52), (0.19, 0.48), (0.23, 0.52), (0.18, 0.555))
    shape("#1c1512", (0.0, 0.83), (0.07, 0.84), (0.06, 0.90), (0.0, 0.94))
    return image.resize((PICTURE_PX, PICTURE_PX), Image.Resampling.BOX)


if __name__ == "__main__":
    here = Path(__file__).resolve().parent
    (here / "patches").mkdir(exist_ok=True)
    for k in range(COUNT):
        rng = random.Random(k)  # noqa: S311 - no secret
        patch(rng).save(here / "patches" / f"{k:03}.png")
    fox().quantize(64).save(here / "fox.png", optimize=True)
