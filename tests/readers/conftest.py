"""Twins of the readers: what resvg shows, and what a region covers in pixels."""

from __future__ import annotations

from collections.abc import Callable
from io import BytesIO

import numpy as np
import pytest
import resvg_py
import shapely
from PIL import Image

from packwork.fonts import fonts_of
from packwork.geometry import affine
from packwork.geometry.outline import Outline
from packwork.raster.coverage import Rasteriser
from packwork.raster.drawing import font_options
from packwork.scene.item import Item, VectorArt

SIDE_PX = 500


def alpha_by_resvg(text: str, **size: int) -> np.ndarray:
    fonts = fonts_of(text)
    options = font_options(fonts) if fonts else {}
    data = bytes(
        resvg_py.svg_to_bytes(svg_string=text, dpi=96.0, skip_system_fonts=True, **options, **size)
    )
    return np.asarray(Image.open(BytesIO(data)).convert("RGBA"))[:, :, 3] / 255.0


def coverage(region, shape: tuple[int, int]) -> np.ndarray:
    outline = Outline.from_region(region)
    rasteriser = Rasteriser(shape, np.float64)
    rasteriser.sweep(outline.points, outline.starts)
    return np.clip(rasteriser.density(), 0.0, 1.0)


def iou(a: np.ndarray, b: np.ndarray) -> float:
    """Intersection over union, partly covered pixels counted by their share."""
    return float(np.minimum(a, b).sum() / max(1.0, np.maximum(a, b).sum()))


@pytest.fixture(scope="session")
def iou_with_resvg() -> Callable[[str], float]:
    """IoU of a page's computed ink with resvg's rendering of the raw file."""
    from packwork.readers.regions import clean_union
    from packwork.readers.svg.drawing import read_drawing

    def compare(text: str) -> float:
        drawing = read_drawing(text.encode())
        assert drawing.page is not None
        longer = max(drawing.page.width, drawing.page.height)
        alpha = alpha_by_resvg(
            text, **{"width" if longer == drawing.page.width else "height": SIDE_PX}
        )
        scale = SIDE_PX / longer
        ink = shapely.transform(clean_union(drawing.ink.whole), lambda p: p * scale)
        return iou(coverage(ink, alpha.shape), alpha)

    return compare


@pytest.fixture(scope="session")
def art_iou() -> Callable[[Item], float]:
    """IoU of an item's ink with resvg's rendering of its art in a fresh document."""

    def compare(item: Item) -> float:
        assert isinstance(item.art, VectorArt)
        left, top, right, bottom = item.ink.bounds
        scale = SIDE_PX / max(right - left, bottom - top)
        to_px = np.array([[scale, 0.0, -left * scale], [0.0, scale, -top * scale]])
        matrix = " ".join(repr(float(v)) for v in affine.compose(to_px, item.art.matrix).T.ravel())
        width, height = (max(1, round(s * scale)) for s in (right - left, bottom - top))
        text = (
            f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}">'
            f'<g transform="matrix({matrix})">{item.art.markup}</g></svg>'
        )
        alpha = alpha_by_resvg(text)
        ink = item.ink.mapped(to_px).region
        return iou(coverage(ink, alpha.shape), alpha)

    return compare
