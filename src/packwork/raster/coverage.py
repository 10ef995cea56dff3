"""The renderer: one image for all items, gradients on the boundary.

Forward: exact coverage of every pixel, summed over all rings. Backward: the exact
derivative of any function of that image with respect to every vertex, by the transport
theorem (Wang and Lu 2025 use a sampled renderer here; ours has no samples). The renderer
knows polygons and images only.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from packwork.arrays import FloatArray, Image, IntArray, as_image, as_points, as_starts
from packwork.errors import ShapeError
from packwork.raster.kernels import coverage as kernels

_AREA_BITS = {np.dtype(np.float32): 16, np.dtype(np.float64): 44}
"""Deposits are multiples of 2**-bits pixel. More bits: finer coverage, but sums stay
exact only while fewer than 2**(24 - bits) (float32) or 2**(53 - bits) items share a
pixel; beyond that they are merely rounded. Derived."""

_X_BITS = {np.dtype(np.float32): 16, np.dtype(np.float64): 38}
"""The walk's x are multiples of 2**-bits pixel; it bounds the width of an image."""

MAX_SIDE_PX = 8_192
"""Largest image side: beyond it the float64 walk would lose its exact sums."""

CACHE_BYTES = 2**21
"""Images larger than this are swept from top to bottom: a second-level cache holds less.
Larger leaves big images to chance, smaller sorts where nothing is gained. Tried."""


class Rasteriser:
    """Renders rings into images of one size again and again, without allocating.

    Parameters
    ----------
    shape
        ``(rows, columns)``, each from 1 to ``MAX_SIDE_PX``.
    dtype
        float32 (fast; coverage within 1e-4) or float64.

    Examples
    --------
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
        self._order = np.zeros(0, dtype=np.int64)
        self._magic = tuple(1.5 * 2.0 ** (52 - bits[self.dtype]) for bits in (_X_BITS, _AREA_BITS))
        self._points = np.zeros((0, 2))
        self._starts = np.zeros(1, dtype=np.int64)
        self._first = np.zeros(1, dtype=np.int64)
        self._gradient = np.zeros((0, 2))
        self._cells = np.zeros(0, dtype=np.int32)
        self._leaves: Image = np.zeros(0, dtype=self.dtype)

    def sweep(self, points_px: FloatArray, starts: IntArray) -> None:
        """Walk every edge once: deposit its swept areas and record the cells it crosses.

        The points are kept by reference until the next sweep; they are not checked.

        Parameters
        ----------
        points_px
            ``(n, 2)`` float64, contiguous, finite. Rings may leave the image.
        starts
            ``(rings + 1,)`` int64.
        """
        self._reserve(points_px, len(starts) - 1)
        self._points, self._starts = points_px, starts
        self._order = self._visiting_order()
        kernels.sweep(
            points_px, starts, self._order, self._is_large, *self.shape, *self._magic,
            self._deposits.reshape(-1), self._cells, self._leaves, self._first,
        )  # fmt: skip

    def density(self, out: Image | None = None) -> Image:
        """Sum of all coverages per pixel; empties the accumulation buffer.

        Parameters
        ----------
        out
            Image to write to, of this size and dtype; a new one if None.
        """
        density = np.empty(self.shape, dtype=self.dtype) if out is None else out
        kernels.accumulate(self.accumulation, density)
        return density

    def pullback(self, adjoint: Image, beyond: float = 0.0) -> FloatArray:
        """Derivative of sum(adjoint * coverage) with respect to the swept vertices.

        Parameters
        ----------
        adjoint
            d loss / d density, of this size.
        beyond
            Constant adjoint of the plane outside the image, so that items that leave
            it still feel a force back.

        Returns
        -------
        FloatArray
            ``(n, 2)``; a buffer that the next call reuses.
        """
        kernels.pullback(
            self._points, self._starts, self._order, self._is_large, self.shape[1],
            self._cells, self._leaves, self._first,
            adjoint.reshape(-1), beyond, self._gradient,
        )  # fmt: skip
        return self._gradient

    def ring_integrals(self, image: Image) -> FloatArray:
        """Integral of ``image`` (constant in each pixel, zero off it) inside each ring.

        Exact for the swept polygons, by Green's theorem; holes come out negative.

        Returns
        -------
        FloatArray
            ``(rings,)``, in pixel areas.
        """
        prefix = np.zeros((self.shape[0] + 1, self.shape[1]))
        np.cumsum(image, axis=0, dtype=np.float64, out=prefix[1:])
        totals = np.zeros(len(self._starts) - 1)
        kernels.ring_integrals(
            self._points, self._starts, self._order, self._cells, self._leaves, self._first,
            image, prefix, totals,
        )  # fmt: skip
        return totals

    def _visiting_order(self) -> IntArray:
        """Rings from top to bottom, where the image is larger than the cache.

        Sums are exact in any order; neighbours in time then touch the same rows.
        """
        if not self._is_large or len(self._points) == 0:
            return np.arange(len(self._starts) - 1)
        first = np.minimum(self._starts[:-1], len(self._points) - 1)
        return np.argsort(self._points[first, 1], kind="stable")

    def _reserve(self, points_px: FloatArray, rings: int) -> None:
        """Make room for the record: a walk crosses a grid line once per pixel it spans."""
        count = len(points_px)
        if len(self._first) != count + 1:
            self._first = np.zeros(count + 1, dtype=np.int64)
            self._gradient = np.zeros((count, 2))
        spanned = kernels.record_bound(points_px, *self.shape)
        # The closing edge of a ring is as long as its other edges together at most,
        # the links between rings are counted too; eight covers cuts and rounding per edge.
        need = int(2 * spanned) + 8 * count + rings
        if need > len(self._cells):
            room = need + need // 4
            self._cells = np.zeros(room, dtype=np.int32)
            self._leaves = np.zeros(room, dtype=self.dtype)


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
    points_px, starts
        As for :func:`coverage`.
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
