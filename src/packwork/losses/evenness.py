"""Evenness loss: large empty places cost more than many small ones."""

from __future__ import annotations

import math

import numpy as np

from packwork.arrays import Image
from packwork.fields.boxes import box_mean
from packwork.losses import _kernels
from packwork.losses.overlap import SLACK
from packwork.losses.term import Term

WINDOWS = (0.36, 0.6, 0.84)
"""Sides of the windows, as shares of the items' pitch (the side of the square of
container that each item has): about the gaps that an eye notices between them. Larger
ones even out whole regions, smaller ones look at gaps that are small already. Tried."""

SHARPNESS = 6
"""Power of a window's emptiness: 1 would be a plain reward for coverage, larger looks at
nothing but windows that are almost wholly empty. Tried; written out in the kernel."""

BLOCKS = 3
"""Blocks on the side of the smallest window: more are slower and no better. Tried."""

MOST_BLOCKS = 150
"""Blocks on the longer side of the image: many small items get windows of whole blocks.
Larger is slower. Chosen."""

FAINT = 0.1
"""Least share of a window that counts as container. Smaller lets a sliver of container
in a window's corner speak for the whole window. Tried."""

TYPICAL_ITEMS = 100
"""Number of items that windows are for where nothing says it. Chosen."""


class Windows:
    """Windows of growing size over the blocks of one container's image.

    Parameters
    ----------
    container
        ``(rows, columns)`` coverage of the container.
    """

    def __init__(self, container: Image, items: int = TYPICAL_ITEMS) -> None:
        pitch = math.sqrt(float(container.sum()) / items)
        finest = math.ceil(max(container.shape) / MOST_BLOCKS)
        self.factor = max(finest, round(WINDOWS[0] * pitch / BLOCKS))
        """Pixels on the side of a block."""
        self._shape_px = container.shape
        inside = self.blocks(container)
        self._sizes = [_odd(share * pitch / self.factor) for share in WINDOWS]
        faintest = inside.dtype.type(FAINT * self.factor**2)
        self._per_inside = [
            (inside > 0) / np.maximum(box_mean(inside, size), faintest) for size in self._sizes
        ]
        self._per_window = self.factor**2 / len(WINDOWS) / container.size

    def blocks(self, image: Image) -> Image:
        """Sums of an image ``(rows, columns)`` over squares of ``factor`` pixels."""
        rows, columns = (np.arange(0, side, self.factor) for side in image.shape)
        return np.ascontiguousarray(
            np.add.reduceat(np.add.reduceat(image, rows, axis=0), columns, axis=1)
        )

    def spread(self, blocks: Image) -> Image:
        """Image ``(rows, columns)`` with each block's value at all of its pixels."""
        rows, columns = self._shape_px
        wide = blocks.repeat(self.factor, axis=0).repeat(self.factor, axis=1)
        return wide[:rows, :columns]

    def value(self, empty: Image) -> float:
        """Mean emptiness of all windows to the power ``SHARPNESS``.

        Parameters
        ----------
        empty
            ``(rows, columns)`` of blocks: empty container in each, in pixels.
        """
        totals = [
            float(np.sum((box_mean(empty, size) * per_inside) ** SHARPNESS))
            for size, per_inside in zip(self._sizes, self._per_inside, strict=True)
        ]
        return float(sum(totals) * self._per_window)

    def derivative(self, empty: Image) -> Image:
        """Derivative of :meth:`value` by each block's empty pixels, ``(rows, columns)``."""
        by_empty = np.zeros_like(empty)
        slope = empty.dtype.type(SHARPNESS * self._per_window)
        for size, per_inside in zip(self._sizes, self._per_inside, strict=True):
            emptiness = box_mean(empty, size)
            _kernels.steepen(emptiness, per_inside, slope)
            by_empty += box_mean(emptiness, size)
        return by_empty


def evenness(density: Image, container: Image, items: int = TYPICAL_ITEMS) -> Term:
    """Mean emptiness of windows of growing size, to a high power, of images ``(rows, columns)``.

    Wang and Lu 2025, section 3.3 (the uniform loss), keep only windows whose mean
    emptiness is above 0.999; the power is a smooth form of that. A window's emptiness is
    the free share of the *container* in it: a gap along the wall counts like a gap
    between two items. Windows slide over blocks of pixels, so they cost the same at any
    size, and the derivative is carried back by the same boxes. They are as large as the
    gaps to be expected among that many items.

    Examples
    --------
    >>> empty, full = np.zeros((9, 9)), np.ones((9, 9))
    >>> evenness(full, full).value, evenness(empty, full).value > 0.1
    (0.0, True)
    """
    windows = Windows(container, items)
    room = container * (density <= 1 + SLACK)
    empty = windows.blocks(room * np.maximum(1 - density, 0).astype(density.dtype))
    return Term(windows.value(empty), -room * windows.spread(windows.derivative(empty)))


def _odd(size: float) -> int:
    """Nearest odd number, at least 1."""
    return max(1, 2 * round((size - 1) / 2) + 1)
