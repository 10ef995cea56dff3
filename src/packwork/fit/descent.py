"""Chains drawn to a target's picture, coarse to fine, by quasi-Newton steps.

The renderer's gradient is exact, so curvature can be learned from it: Adam with decaying
steps needs three times the renderings and ends farther off
(docs/decisions/0004-fitted-outlines.md).

Limited-memory BFGS is SciPy's (Zhu, Byrd, Lu and Nocedal, "Algorithm 778: L-BFGS-B", 1997).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from scipy.optimize import OptimizeResult, minimize

from packwork.arrays import FloatArray
from packwork.fit.chains import Chains
from packwork.geometry.outline import Outline
from packwork.raster.coverage import Rasteriser, image_shape

LEVELS = ((32, 60), (64, 100), (128, 200))
"""Pixels on the longer side, and iterations at most, from coarse to fine. Coarse levels are cheap
and carry far. A further one takes a quarter more time for 0.0002 of IoU. Tried."""

LEAST_GAIN = 5e-7
"""A level ends when an iteration lowers the mean squared difference by less, times the share of the
image that is inked. Smaller takes twice the time. Tried."""


def fit_to_picture(target: Outline, chain: FloatArray, counts: Sequence[int]) -> list[FloatArray]:
    """Controls ``(k, 3, 2)`` after each level, coarse to fine, the start in front.

    >>> from packwork.fit.chains import Chains, straight_chain
    >>> from packwork.geometry.polygon import signed_area
    >>> square = np.array([[0, 0], [2, 0], [2, 2], [0, 2.0]])
    >>> stages = fit_to_picture(Outline.from_rings([square]), straight_chain(0.9 * square), [4])
    >>> [round(signed_area(Chains([4], 16).points(stage)), 1) for stage in stages]
    [3.2, 4.0, 4.0, 4.0]
    """
    stages = [chain]
    for resolution, iterations in LEVELS:
        mismatch = Mismatch(target, counts, resolution)
        stages.append(mismatch.to_units(_descend(mismatch, mismatch.to_px(stages[-1]), iterations)))
    return stages


def _descend(mismatch: Mismatch, controls_px: FloatArray, iterations: int) -> FloatArray:
    """Controls where the mismatch stops falling; in pixels, so that a unit step is one."""
    shape = controls_px.shape

    def value_and_gradient(flat: FloatArray) -> tuple[float, FloatArray]:
        value, gradient = mismatch(flat.reshape(shape))
        return value, gradient.ravel()

    least_gain = LEAST_GAIN * mismatch.inked
    return minimise(value_and_gradient, controls_px.ravel(), iterations, least_gain).reshape(shape)


MARGIN_PX = 2
"""Rim of the image round the target, so that what sticks out is seen. Chosen."""

STEPS = 16
"""Polygon edges per curve while fitting. At fewer, the chords' sag is fitted too; more
cost time. Chosen."""


class Mismatch:
    """Mean squared difference between the images of closed chains and of a target.

    Loops count: where a chain winds round a pixel twice, or backwards, so does its coverage.
    Polygon vertices outside the image cost their squared distance from it.

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


MEMORY = 5
"""Steps that the quasi-Newton matrix remembers; 5 to 40 end alike. Tried."""


def minimise(
    objective: Callable[[FloatArray], tuple[float, FloatArray]],
    start: FloatArray,
    iterations: int,
    least_gain: float,
) -> FloatArray:
    """Point near ``start`` where a smooth function is lowest.

    ``start``: in units in which a step of length one is cautious; ``least_gain``: ends when an
    iteration lowers the value by less.

    >>> def bowl(x):
    ...     return float(x[0] ** 2 + 10 * x[1] ** 2), np.array([2 * x[0], 20 * x[1]])
    >>> minimise(bowl, np.array([3.0, 1.0]), 50, 1e-12).round(4).tolist()
    [0.0, 0.0]
    """
    if iterations == 0:
        return start
    best = start, objective(start)[0]

    def stop_if_flat(intermediate_result: OptimizeResult) -> None:
        nonlocal best
        gain = best[1] - intermediate_result.fun
        if gain > 0:
            best = intermediate_result.x.copy(), float(intermediate_result.fun)
        if gain < least_gain:
            raise StopIteration

    # Its own tolerance is a share of the value, which at a good fit is next to nothing.
    options = {"maxiter": iterations, "maxcor": MEMORY, "ftol": 0.0, "gtol": 0.0}
    minimize(objective, start, jac=True, method="L-BFGS-B", callback=stop_if_flat, options=options)
    return best[0]
