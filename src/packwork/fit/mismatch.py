"""Distance of a chain's picture from the target's, and the gradient by its controls."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from packwork.arrays import FloatArray
from packwork.fit.chains import Chains
from packwork.geometry.outline import Outline
from packwork.raster.coverage import Rasteriser
from packwork.raster.pyramid import image_shape

MARGIN_PX = 2
"""Rim of the image round the target, so that what sticks out is seen. Chosen."""

STEPS = 16
"""Polygon edges per curve while fitting. At fewer, the chords' sag is fitted too; more
cost time. Chosen."""


class Mismatch:
    """Mean squared difference between the images of closed chains and of a target.

    Loops count: where a chain winds round a pixel twice, or backwards, so does its
    coverage, and the target's does not. Polygon vertices outside the image, where nothing
    is seen, cost their squared distance from it.

    Examples
    --------
    >>> from packwork.fit.chains import straight_chain
    >>> square = np.array([[0, 0], [2, 0], [2, 2], [0, 2.0]])
    >>> mismatch = Mismatch(Outline.from_rings([square]), [4], 8)
    >>> value, gradient = mismatch(mismatch.to_px(straight_chain(square)))
    >>> value, gradient.shape
    (0.0, (4, 3, 2))
    """

    def __init__(self, target: Outline, counts: Sequence[int], resolution: int) -> None:
        left, top, right, bottom = target.bounds
        self._px_per_unit = resolution / target.extent
        self._corner = np.array([left, top])
        rows, columns = image_shape(right - left, bottom - top, resolution)
        shape = (rows + 2 * MARGIN_PX, columns + 2 * MARGIN_PX)
        self._corner_px = np.array([shape[1], shape[0]])
        self._rasteriser = Rasteriser(shape, np.float64)
        self._rasteriser.sweep(self.to_px(target.points), target.starts)
        self._target = self._rasteriser.density()
        self._chains = Chains(counts, STEPS)

    @property
    def inked(self) -> float:
        """Share of the image that the target covers."""
        return float(self._target.mean())

    def to_px(self, points: FloatArray) -> FloatArray:
        """Points ``(n, 2)`` in this image's pixels."""
        return np.asarray((points - self._corner) * self._px_per_unit + MARGIN_PX)

    def to_units(self, points_px: FloatArray) -> FloatArray:
        """Inverse of :meth:`to_px`, of points ``(n, 2)``."""
        return np.asarray((points_px - MARGIN_PX) / self._px_per_unit + self._corner)

    def __call__(self, controls_px: FloatArray) -> tuple[float, FloatArray]:
        """Value, and its derivative by the controls ``(k, 3, 2)``."""
        points = self._chains.points(controls_px)
        self._rasteriser.sweep(points, self._chains.starts)
        difference = self._rasteriser.density() - self._target
        outside = points - np.clip(points, 0, self._corner_px)
        # Not a dot product: on images as small as these its threads cost more than they do.
        value = float(np.square(difference).sum() + np.square(outside).sum())
        by_points = self._rasteriser.pullback(2 * difference) + 2 * outside
        size = difference.size
        return value / size, self._chains.gather(by_points) / size
