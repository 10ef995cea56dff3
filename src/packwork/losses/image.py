"""The default losses of the density image, each by itself, and all of them fused for the solver."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields

import numpy as np

from packwork.arrays import Image
from packwork.fields.filters import box_mean
from packwork.losses import _kernels
from packwork.losses.term import Term


def containment(density: Image, container: Image) -> Term:
    """Mean density outside the container, of images ``(rows, columns)``: linear in that area.

    The density itself counts, not min(density, 1): coincident items outside must
    still be pushed back. Wang and Lu 2025, section 3.3, use a squared error; the linear
    form ends with less violation at equal coverage.

    Examples
    --------
    >>> term = containment(np.array([[1.0, 2.0]]), np.array([[1.0, 0.0]]))
    >>> term.value, term.adjoint.tolist()
    (1.0, [[0.0, 0.5]])
    """
    outside = 1 - container
    return Term(float(np.mean(density * outside)), outside / density.size)


SLACK = 1e-4
"""Density above one that still counts as one: float32 coverage is good to this. Larger
hides real overlap, smaller turns rounding into force. Derived."""


def overlap(density: Image, container: Image) -> Term:
    """Mean density above one, of images ``(rows, columns)``.

    Wang and Lu 2025, section 3.3, count pixels that are too opaque, which has no
    gradient; this is the rectified excess that their own code uses.

    Examples
    --------
    >>> term = overlap(np.array([[1.0, 2.0]]), np.ones((1, 2)))
    >>> term.value, term.adjoint.tolist()
    (0.5, [[0.0, 0.5]])
    """
    excess = density > 1 + SLACK
    return Term(
        float(np.mean(np.where(excess, density - 1, 0))),
        (excess / density.size).astype(density.dtype),
    )


def filling(density: Image, container: Image) -> Term:
    """Minus the mean of container covered, of images ``(rows, columns)``: items grow into gaps.

    Examples
    --------
    >>> term = filling(np.array([[0.5, 2.0]]), np.ones((1, 2)))
    >>> term.value, term.adjoint.tolist()
    (-0.75, [[-0.5, -0.0]])
    """
    free = density <= 1 + SLACK
    return Term(
        -float(np.mean(np.minimum(density, 1) * container)),
        (-(free * container) / density.size).astype(density.dtype),
    )


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

    ``container``: ``(rows, columns)`` coverage of the container.
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

        ``empty``: ``(rows, columns)`` of blocks: empty container in each, in pixels.
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
    return max(1, 2 * round((size - 1) / 2) + 1)


@dataclass(frozen=True)
class FusedWeights:
    """Weights of the fused losses at one moment of a run.

    ``containment``, ``overlap``, ``filling``, ``evenness``: all at least zero. Only their ratios
    matter to the result.
    """

    containment: float = 0.0
    overlap: float = 0.0
    filling: float = 0.0
    evenness: float = 0.0


FUSED = tuple(field.name for field in fields(FusedWeights))
"""Names of the losses that are evaluated together."""


class FusedAdjoint:
    """Adjoint of the weighted default losses straight from the accumulation buffer.

    Equal to the weighted sum of the adjoints of :func:`containment`, :func:`overlap`,
    :func:`filling` and :func:`evenness` times the number of pixels; one pass over the
    image instead of seven, two with evenness.

    ``container``: ``(rows, columns)`` coverage of the container.
    ``items``: how many items share it: sets the size of evenness' windows.

    Examples
    --------
    >>> fused = FusedAdjoint(np.ones((1, 2)))
    >>> fused(np.array([[0.5, 2.0], [0.0, 0.0]]), FusedWeights(1, 5, 2)).tolist()
    [[-2.0, 5.0]]
    """

    def __init__(self, container: Image, items: int = TYPICAL_ITEMS) -> None:
        self._items = items
        self._container = container
        self._running = np.zeros(container.shape[1], dtype=container.dtype)
        self._line = np.zeros_like(self._running)
        self._adjoint = np.empty_like(container)
        self._windows: Windows | None = None
        self._empty: Image = np.zeros((1, 1), dtype=container.dtype)

    def __call__(self, accumulation: Image, weights: FusedWeights) -> Image:
        """Adjoint ``(rows, columns)`` per unit of density; the next call reuses it.

        ``accumulation``: ``(rows + 1, columns)``, consumed: it is zero afterwards.
        """
        as_pixel = self._container.dtype.type
        emphasis, factor = self._emphasis(accumulation, weights.evenness)
        _kernels.adjoint(
            accumulation, self._container, self._running, self._line, emphasis, factor,
            as_pixel(weights.containment), as_pixel(weights.overlap),
            as_pixel(weights.filling), as_pixel(1 + SLACK), self._adjoint,
        )  # fmt: skip
        return self._adjoint

    def _emphasis(self, accumulation: Image, weight: float) -> tuple[Image, int]:
        """Price of covering a pixel for evenness, per block, and a block's side."""
        if weight == 0:
            return np.zeros((1, 1), dtype=accumulation.dtype), max(accumulation.shape)
        if self._windows is None:
            self._windows = Windows(self._container, self._items)
            self._empty = np.empty_like(self._windows.blocks(self._container))
        factor = self._windows.factor
        _kernels.gaps(accumulation, self._container, self._running, self._line, self._empty, factor)
        emphasis = self._windows.derivative(self._empty)
        emphasis *= emphasis.dtype.type(weight * self._container.size)
        return emphasis, factor
