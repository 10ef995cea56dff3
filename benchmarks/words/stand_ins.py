"""Pictures of ours in place of the peer's examples' pictures, for pages that we publish."""

from __future__ import annotations

import io
import shutil
from collections.abc import Callable
from pathlib import Path

import numpy as np
from PIL import Image, ImageOps

from benchmarks.kit.manifests import DOCS
from packwork.raster.drawing import drawn_png
from packwork.raster.membership import centre_count
from packwork.readers.container import read_container

BUNDLED = DOCS.parent / "src" / "packwork" / "bundled"
PORTION = 0.9
"""Of the picture that the shape takes, as in the pictures that it stands for. Chosen."""


def mask(name: str, size: tuple[int, int]) -> Image.Image:
    """A bundled container in black on white."""
    container = read_container(name)
    scale = 1_000 / container.side
    outline = container.outline
    shape = (round(container.height * scale), round(container.width * scale))
    inside = centre_count(outline.points * scale, outline.starts, shape) > 0
    return _centred(Image.fromarray(np.where(inside, 0, 255).astype(np.uint8)), size, "white")


def icon(name: str, size: tuple[int, int], ground: str) -> Image.Image:
    """A bundled icon in its colours."""
    drawing = (BUNDLED / "icons" / f"{name}.svg").read_text(encoding="utf-8")
    with Image.open(io.BytesIO(drawn_png(drawing))) as drawn:
        image = drawn.convert("RGBA")
    whole = Image.new("RGBA", image.size, ground)
    whole.alpha_composite(image)
    return _centred(whole.convert("RGB"), size, ground)


def _centred(image: Image.Image, size: tuple[int, int], ground: str) -> Image.Image:
    width, height = size
    fitted = ImageOps.contain(image, (round(width * PORTION), round(height * PORTION)))
    whole = Image.new(image.mode, size, ground)
    whole.paste(fitted, ((width - fitted.width) // 2, (height - fitted.height) // 2))
    return whole


FILES: dict[str, Callable[[], Image.Image]] = {
    "alice_mask.png": lambda: mask("cat", (900, 900)),
    "stormtrooper_mask.png": lambda: mask("bear", (1190, 1028)),
    "alice_color.png": lambda: icon("tulip", (600, 800), "white"),
    "parrot-by-jose-mari-gimenez2.jpg": lambda: icon("butterfly", (4017, 3235), "black"),
    "wc_cn/LuXun_color.jpg": lambda: icon("guitar", (300, 480), "white"),
}
"""By the file of the examples that each stands for, of the same size."""

PICTURES = {
    "masked": "alice_mask.png",
    "a_new_hope": "stormtrooper_mask.png",
    "colored": "alice_color.png",
    "parrot": "parrot-by-jose-mari-gimenez2.jpg",
    "wordcloud_cn": "wc_cn/LuXun_color.jpg",
    "frequency": "alice_mask.png",
}
"""Whose picture each example needs."""


def with_stand_ins(folder: Path, to: Path) -> Path:
    """A copy of the examples' folder in which those pictures are ours."""
    copy = Path(shutil.copytree(folder, to))
    for name, make in FILES.items():
        make().save(copy / name, quality=95)
    return copy
