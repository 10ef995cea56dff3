"""The renderer: one image for all items, gradients on the boundary.

Forward: exact coverage of every pixel, summed over all rings. Backward: the exact
derivative of any function of that image with respect to every vertex, by the transport
theorem (Wang and Lu 2025 use a sampled renderer here; ours has no samples). The renderer
knows polygons and images only.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from packwork.arrays import FloatArray, Image, IntArray, as_image, as_points, as_starts
from packwork.errors import ShapeError
from packwork.geometry.outline import Outline
from packwork.raster.kernels import coverage as kernels
from packwork.raster.kernels.coverage import record_bounds
from packwork.threads import at_once

_AREA_BITS = {np.dtype(np.float32): 16, np.dtype(np.float64): 44}
"""Deposits are multiples of 2**-bits pixel. More bits: finer coverage, but sums stay exact only
while fewer than 2**(24 - bits) (float32) or 2**(53 - bits) items share a pixel. Derived."""

_X_BITS = {np.dtype(np.float32): 16, np.dtype(np.float64): 38}
"""The walk's x are multiples of 2**-bits pixel; it bounds the width of an image."""

TOUCHED = 1e-3
"""Coverage from which on a pixel counts as taken: those that are only grazed are not. Derived: ten
times what float32 images are off by."""

MAX_SIDE_PX = 8_192
"""Largest image side: beyond it the float64 walk would lose its exact sums."""

CACHE_BYTES = 2**21
"""Images larger than this, which a second-level cache does not hold, are swept from top to bottom.
Tried."""

BANDS = 4
"""Bands of rows whose rings are swept at once. More keep more cores busy and have more rings on
their borders. Chosen."""

PARTED = 200_000
"""Length of the record, at most, from which rings are swept so: 0.6 ms of one core. Measured."""

APART = 3
"""Rows between a ring swept with one band and the next: what a walk deposits beyond its cells.
Derived."""


class Record:
    """Walk of some rings: which, the cells that they crossed, and where they left them."""

    def __init__(self, dtype: np.dtype[Any]) -> None:
        self.order: IntArray = np.zeros(0, dtype=np.int64)
        self.first: IntArray = np.zeros(1, dtype=np.int64)
        self.cells = np.zeros(0, dtype=np.int32)
        self.leaves: Image = np.zeros(0, dtype=dtype)

    def reserve(self, order: IntArray, edges: int, need: int) -> None:
        """Make room for rings ``(m,)`` of so many edges, whose record is as long as needed."""
        self.order = order
        if len(self.first) < edges + 1:
            self.first = np.zeros(edges + 1, dtype=np.int64)
        if need > len(self.cells):
            room = need + need // 4
            self.cells = np.zeros(room, dtype=np.int32)
            self.leaves = np.zeros(room, dtype=self.leaves.dtype)


class Swept(NamedTuple):
    """Record of a rasteriser's last walk, for whatever reads it.

    ``points``, ``starts``: the rings, in pixels; ``records``: of rings that lie in one band each,
    then of the rest; ``x_magic``, ``area_magic``: what rounds x and deposits to the lattice when it
    is added and taken away again.
    """

    points: FloatArray
    starts: IntArray
    records: list[Record]
    x_magic: float
    area_magic: float


class Rasteriser:
    """Renders rings into images of one size again and again, without allocating.

    ``shape``: ``(rows, columns)``, each from 1 to ``MAX_SIDE_PX``; ``dtype``: float32 (fast;
    coverage within 1e-4) or float64.

    >>> import numpy as np
    >>> rasteriser = Rasteriser((2, 2), np.float64)
    >>> rasteriser.sweep(np.array([[0, 0], [1, 0], [1, 2], [0, 2.0]]), np.array([0, 4]))
    >>> rasteriser.density().tolist()
    [[1.0, 0.0], [1.0, 0.0]]
    >>> rasteriser.pullback(np.ones((2, 2)))[:, 0].tolist()
    [-1.0, 1.0, 1.0, -1.0]
    """

    def __init__(self, shape: tuple[int, int], dtype: npt.DTypeLike = np.float32) -> None:
        rows, columns = int(shape[0]), int(shape[1])
        if not (1 <= rows <= MAX_SIDE_PX and 1 <= columns <= MAX_SIDE_PX):
            raise ShapeError(f"an image's sides must be 1 to {MAX_SIDE_PX} px, not {shape}")
        self.shape = (rows, columns)
        self.dtype = np.dtype(dtype)
        if self.dtype not in _AREA_BITS:
            raise ShapeError(f"an image must be float32 or float64, not {self.dtype}")
        self._deposits: Image = np.zeros((rows + kernels.SPARE_ROWS, columns), dtype=self.dtype)
        self.accumulation: Image = self._deposits[: rows + 1]
        """Swept areas, waiting for their running sum down the columns."""
        self._is_large = self.accumulation.nbytes > CACHE_BYTES
        self._records = [Record(self.dtype)]
        self._used = self._records
        bits = _X_BITS[self.dtype], _AREA_BITS[self.dtype]
        self._magic = (1.5 * 2.0 ** (52 - bits[0]), 1.5 * 2.0 ** (52 - bits[1]))
        self._points = np.zeros((0, 2))
        self._starts = np.zeros(1, dtype=np.int64)
        self._rows = np.zeros((0, 2), dtype=np.int64)
        self._bounds = np.zeros(0, dtype=np.int64)
        self._gradient = np.zeros((0, 2))

    @property
    def swept(self) -> Swept:
        """The rings of the last sweep and the record of their walk."""
        return Swept(self._points, self._starts, self._used, *self._magic)

    def sweep(self, points_px: FloatArray, starts: IntArray) -> None:
        """Walk every edge once: deposit its swept areas and record the cells it crosses.

        The points, ``(n, 2)`` float64, contiguous, finite, on or off the image, are kept by
        reference until the next sweep and not checked.
        """
        self._points, self._starts = points_px, starts
        self._reserve()
        if len(self._used) > 1:
            # What lies in one band alone goes at once; deposits of the rest may be anywhere.
            at_once(self._sweep, [(record,) for record in self._used[:-1]])
        self._sweep(self._used[-1])

    def _sweep(self, record: Record) -> None:
        kernels.sweep(
            self._points, self._starts, record.order, self._is_large, *self.shape, *self._magic,
            self._deposits.reshape(-1), record.cells, record.leaves, record.first,
        )  # fmt: skip

    def density(self, out: Image | None = None) -> Image:
        """Sum of all coverages per pixel; empties the accumulation buffer."""
        density = np.empty(self.shape, dtype=self.dtype) if out is None else out
        kernels.accumulate(self.accumulation, density)
        return density

    def pullback(self, adjoint: Image, beyond: float = 0.0) -> FloatArray:
        """Derivative ``(n, 2)`` of sum(adjoint * coverage) by the swept vertices; a buffer.

        ``beyond``: constant adjoint of the plane outside the image, so that items that leave it
        still feel a force back. The next call reuses the buffer.
        """
        flat = adjoint.reshape(-1)
        at_once(self._pull_back, [(record, flat, beyond) for record in self._used])
        return self._gradient

    def _pull_back(self, record: Record, adjoint: Image, beyond: float) -> None:
        kernels.pullback(
            self._points, self._starts, record.order, self._is_large, self.shape[1],
            record.cells, record.leaves, record.first, adjoint, beyond, self._gradient,
        )  # fmt: skip

    def ring_integrals(self, image: Image) -> FloatArray:
        """Integrals ``(rings,)`` of ``image``, constant in pixels and zero off it, inside rings.

        In pixel areas, exact for the swept polygons, by Green's theorem; holes come out negative.
        """
        prefix = np.zeros((self.shape[0] + 1, self.shape[1]))
        np.cumsum(image, axis=0, dtype=np.float64, out=prefix[1:])
        totals = np.zeros(len(self._starts) - 1)
        for record in self._used:
            kernels.ring_integrals(
                self._points, self._starts, record.order, record.cells, record.leaves, record.first,
                image, prefix, totals,
            )  # fmt: skip
        return totals

    def _visiting_order(self) -> IntArray:
        """Rings from top to bottom, where the image is larger than the cache.

        Sums are exact in any order; neighbours in time then touch the same rows.
        """
        if not self._is_large:
            return np.arange(len(self._starts) - 1)
        # Of short integers NumPy sorts by their digits, in a tenth of the time.
        return np.argsort(self._rows[:, 0].astype(np.uint16), kind="stable")

    def _reserve(self) -> None:
        """Make room for the records of all rings, in bands where that is worth it."""
        rings = len(self._starts) - 1
        if len(self._gradient) != len(self._points) or len(self._bounds) != rings:
            self._gradient = np.zeros((len(self._points), 2))
            self._rows = np.zeros((rings, 2), dtype=np.int64)
            self._bounds = np.zeros(rings, dtype=np.int64)
        need = record_bounds(self._points, self._starts, *self.shape, self._rows, self._bounds)
        order = self._visiting_order()
        if need < PARTED:
            self._used = self._records[:1]
            self._used[0].reserve(order, len(self._points), int(need))
            return
        self._records += [Record(self.dtype) for _ in range(BANDS + 1 - len(self._records))]
        self._used = self._records
        band = self._bands()[order]
        for k, record in enumerate(self._used):
            mine = order[band == k]
            edges = int((self._starts[mine + 1] - self._starts[mine]).sum())
            record.reserve(mine, edges, int(self._bounds[mine].sum()))

    def _bands(self) -> IntArray:
        """``(rings,)`` band of rows that each ring lies in, ``BANDS`` for none alone."""
        height = -(-self.shape[0] // BANDS)
        first = np.maximum(self._rows[:, 0] - APART, 0) // height
        last = np.minimum((self._rows[:, 1] + APART) // height, BANDS - 1)
        return np.where(first == last, first, BANDS)


def coverage(
    points_px: npt.ArrayLike,
    starts: npt.ArrayLike,
    shape: tuple[int, int],
    dtype: npt.DTypeLike = np.float64,
) -> Image:
    """Sum over all rings of the exact area share of each pixel that they cover.

    Parameters
    ----------
    points_px
        ``(n, 2)`` vertices in pixels; rings simple, outer ones clockwise on screen.
    starts
        Ring starts, from 0 to n.
    shape
        ``(rows, columns)``.
    dtype
        float64 (default) or float32.

    Examples
    --------
    >>> coverage([[0.5, 0], [2, 0], [2, 1], [0.5, 1]], [0, 4], (1, 3)).tolist()
    [[0.5, 1.0, 0.0]]
    """
    points = as_points(points_px)
    rasteriser = Rasteriser(shape, dtype)
    rasteriser.sweep(points, as_starts(starts, len(points)))
    return rasteriser.density()


def coverage_pullback(
    points_px: npt.ArrayLike,
    starts: npt.ArrayLike,
    adjoint: npt.ArrayLike,
    beyond: float = 0.0,
) -> FloatArray:
    """Derivative of ``sum(adjoint * coverage(points))`` with respect to the points.

    Parameters
    ----------
    adjoint
        ``(rows, columns)``, d loss / d density.
    beyond
        Constant adjoint outside the image.

    Examples
    --------
    Moving the right side of a square outward adds its length in area:

    >>> import numpy as np
    >>> square = [[0.5, 0.5], [1.5, 0.5], [1.5, 1.5], [0.5, 1.5]]
    >>> coverage_pullback(square, [0, 4], np.ones((2, 2)))[:, 0].tolist()
    [-0.5, 0.5, 0.5, -0.5]
    """
    points = as_points(points_px)
    image: npt.NDArray[Any] = as_image(adjoint)
    rasteriser = Rasteriser((image.shape[0], image.shape[1]), image.dtype)
    rasteriser.sweep(points, as_starts(starts, len(points)))
    return rasteriser.pullback(image, beyond).copy()


def image_shape(width_cu: float, height_cu: float, resolution: int) -> tuple[int, int]:
    """Rows and columns of the image whose longer side has ``resolution`` pixels.

    >>> image_shape(600, 300, 50)
    (25, 50)
    """
    per_cu = resolution / max(width_cu, height_cu)
    return max(math.ceil(height_cu * per_cu - 1e-9), 1), max(math.ceil(width_cu * per_cu - 1e-9), 1)


def region_image(outline: Outline, rasteriser: Rasteriser, px_per_cu: float) -> Image:
    """Coverage of a region given in canvas units, in the rasteriser's image.

    >>> import numpy as np
    >>> square = Outline.from_rings([np.array([[0, 0], [2, 0], [2, 2], [0, 2.0]])])
    >>> region_image(square, Rasteriser((1, 2), np.float64), 0.5).tolist()
    [[1.0, 0.0]]
    """
    rasteriser.sweep(outline.points * px_per_cu, outline.starts)
    return rasteriser.density()
