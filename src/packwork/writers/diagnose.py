"""The diagnostic picture: what overlaps and what sticks out, at a glance.

Container yellow, items grey, overlap red, items outside the container blue, the rest
white: the colours of Wang and Lu 2025.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeAlias

import numpy as np
import numpy.typing as npt
from PIL import Image

from packwork.geometry.outline import Outline, joined
from packwork.raster.drawing import encoded_picture
from packwork.raster.membership import centre_count
from packwork.scene.layout import Layout
from packwork.writers.frame import PictureFrame, picture_frame

_Pixels: TypeAlias = npt.NDArray[np.uint8]

BACKGROUND, CONTAINER, ITEM, OUTSIDE, OVERLAP = range(5)
"""What a sample shows; the later wins."""

PALETTE: _Pixels = np.array(
    [(255, 255, 255), (255, 221, 87), (140, 140, 140), (38, 97, 214), (214, 31, 38)], np.uint8
)
"""Red, green, blue of each of the above."""

SAMPLES = 3
"""Samples per pixel and direction. Fewer: jagged edges, and slivers of overlap that slip
between; more: slower. Chosen."""

_BAND_ROWS = 256
"""Pixel rows drawn at a time: bounds memory. Fewer: outlines are walked more often."""


def diagnose_png(layout: Layout, longer_side_px: int) -> bytes:
    """PNG file (RGB) of a layout's faults, by the true outlines."""
    frame = picture_frame(layout.container, longer_side_px)
    picture = np.empty((frame.rows, frame.columns, 3), dtype=np.uint8)
    for top in range(0, frame.rows, _BAND_ROWS):
        bottom = min(top + _BAND_ROWS, frame.rows)
        picture[top:bottom] = _averaged(_classes(layout, frame, top, bottom))
    return encoded_picture(Image.fromarray(picture), "PNG")


def _classes(layout: Layout, frame: PictureFrame, top: int, bottom: int) -> _Pixels:
    """Class of each sample of the pixel rows ``top`` to ``bottom`` shows."""
    inside = _counts([layout.container.outline], frame, top, bottom) > 0
    items = _counts(layout.outlines, frame, top, bottom)
    classes = np.where(inside, CONTAINER, BACKGROUND).astype(np.uint8)
    classes[items > 0] = ITEM
    classes[(items > 0) & ~inside] = OUTSIDE
    classes[items > 1] = OVERLAP
    return classes


def _counts(
    outlines: Sequence[Outline], frame: PictureFrame, top: int, bottom: int
) -> npt.NDArray[np.int32]:
    """Outlines that hold each sample of some pixel rows."""
    shape = ((bottom - top) * SAMPLES, frame.columns * SAMPLES)
    points, starts = joined(outlines)
    return centre_count((points * frame.px_per_cu - [0.0, top]) * SAMPLES, starts, shape)


def _averaged(classes: _Pixels) -> _Pixels:
    """Mean colour of each pixel's samples."""
    rows, columns = (side // SAMPLES for side in classes.shape)
    samples = PALETTE[classes].reshape(rows, SAMPLES, columns, SAMPLES, 3)
    total = samples.sum(axis=(1, 3), dtype=np.uint16)
    return np.asarray((total + SAMPLES**2 // 2) // SAMPLES**2, dtype=np.uint8)
