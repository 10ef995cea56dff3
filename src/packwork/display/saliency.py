"""Picture of saliency: what stands out in red, a line round the part that is filled."""

from __future__ import annotations

import io
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw

from packwork.errors import RecipeError
from packwork.readers.container import read_container
from packwork.readers.pictures.decode import MAX_PICTURE_BYTES
from packwork.readers.pictures.developing import developed, inspected
from packwork.readers.reading import read_bytes
from packwork.readers.saliency import QuietOptions, saliency_map
from packwork.recipe import Recipe
from packwork.recipe_paths import AROUND
from packwork.writers.atomic import check_writable, write_atomic

SIDE_PX = 1_000
"""Longer side of the picture. Chosen."""

_PALE = 0.6
_LINE_PX = 4
_RED = np.array([220.0, 30.0, 30.0])


def write_saliency(recipe: Recipe, path: Path) -> None:
    """Write the saliency of a recipe's picture and the outline of its quiet part, as PNG.

    Raises ``ReadError`` if the picture cannot be used. ``RecipeError`` if the container is no
    picture. ``WriteError`` if nothing can be written there.
    """
    if not recipe.container.startswith(AROUND):
        raise RecipeError(
            "show_saliency", f"needs a container {AROUND}IMAGE, not {recipe.container[:40]!r}"
        )
    check_writable(path)
    quiet = QuietOptions(recipe.quiet_share, recipe.keep_clear or ())
    write_atomic(path, saliency_png(recipe.container, quiet))


def saliency_png(source: str, quiet: QuietOptions) -> bytes:
    """PNG of the picture in grey, what stands out red, a line round what is filled.

    ``source``: ``around:IMAGE``.

    Raises ``ReadError`` if the picture cannot be used.
    """
    container = read_container(source, float(SIDE_PX), quiet=quiet)
    data = read_bytes(source.removeprefix(AROUND), MAX_PICTURE_BYTES)
    negative = inspected(data)
    size = max(1, round(container.width)), max(1, round(container.height))
    full = (0.0, 0.0, float(negative.width), float(negative.height))
    grey = np.asarray(developed(data, full, size).convert("L"), dtype=np.float64)[:, :, None]
    heat = Image.fromarray(saliency_map(data, negative).astype(np.float32)).resize(size)
    share = np.clip(np.asarray(heat, dtype=np.float64), 0.0, 1.0)[:, :, None]
    mixed = (1 - share) * (_PALE * grey + 255 * (1 - _PALE)) + share * _RED
    picture = Image.fromarray(np.clip(mixed, 0, 255).astype(np.uint8))
    draw = ImageDraw.Draw(picture)
    for ring in container.outline.rings:
        closed = np.vstack([ring, ring[:1]])
        draw.line([(float(x), float(y)) for x, y in closed], fill="#003f88", width=_LINE_PX)
    file = io.BytesIO()
    picture.save(file, "PNG")
    return file.getvalue()
