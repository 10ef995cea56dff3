"""Chains drawn to a target's picture, coarse to fine, by quasi-Newton steps.

The renderer's gradient is exact, so curvature can be learned from it: Adam with decaying
steps needs three times the renderings and ends farther off
(docs/decisions/0004-fitted-outlines.md).

Limited-memory BFGS: Nocedal and Wright, "Numerical Optimization" (2006), algorithm 7.4, with the
bisection line search of Lewis and Overton (2013) for the weak Wolfe conditions. SciPy's L-BFGS-B
ends alike, but on a busy machine its BLAS threads wait for each other many times longer than they
compute, on vectors as short as these.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Sequence
from typing import NamedTuple, TypeAlias

import numpy as np

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


Objective: TypeAlias = Callable[[FloatArray], tuple[float, FloatArray]]


MEMORY = 5
"""Steps that the quasi-Newton matrix remembers; 5 to 40 end alike. Tried."""

LEAST_DECREASE = 1e-4
"""Share of the slope's promise that a step must keep. Customary."""

LEAST_FLATTENING = 0.9
"""Share of the slope at most that may remain after a step. Customary."""

MOST_TRIALS = 20
"""Trials of one line search, after which the value is taken to be at its floor. Chosen."""


class Visit(NamedTuple):
    """A point with its value and gradient."""

    x: FloatArray
    value: float
    gradient: FloatArray


def minimise(
    objective: Objective, start: FloatArray, iterations: int, least_gain: float
) -> FloatArray:
    """Point near ``start`` where a smooth function is lowest.

    ``start``: in units in which a step of length one is cautious; ``least_gain``: ends when an
    iteration lowers the value by less.

    >>> def bowl(x):
    ...     return float(x[0] ** 2 + 10 * x[1] ** 2), np.array([2 * x[0], 20 * x[1]])
    >>> minimise(bowl, np.array([3.0, 1.0]), 50, 1e-12).round(4).tolist()
    [0.0, 0.0]
    """
    here = Visit(start, *objective(start))
    steps: deque[tuple[FloatArray, FloatArray, float]] = deque(maxlen=MEMORY)
    for _ in range(iterations):
        direction = _direction(here.gradient, steps)
        if not float(direction @ here.gradient) < 0:
            break
        there = _line_search(objective, here, direction)
        if there is None:
            break
        move, turn = there.x - here.x, there.gradient - here.gradient
        curvature = float(move @ turn)
        if curvature > 0:
            steps.append((move, turn, curvature))
        gain, here = here.value - there.value, there
        if gain < least_gain:
            break
    return here.x


def _direction(
    gradient: FloatArray, steps: deque[tuple[FloatArray, FloatArray, float]]
) -> FloatArray:
    """Downhill through the remembered curvature (two-loop recursion); length one at first."""
    if not steps:
        return -gradient / max(float(np.sqrt(gradient @ gradient)), 1e-300)
    rest = gradient.copy()
    shares = []
    for move, turn, curvature in reversed(steps):
        shares.append(float(move @ rest) / curvature)
        rest -= shares[-1] * turn
    _, turn, curvature = steps[-1]
    rest *= curvature / float(turn @ turn)
    for (move, turn, curvature), share in zip(steps, reversed(shares), strict=True):
        rest += (share - float(turn @ rest) / curvature) * move
    return -rest


def _line_search(objective: Objective, here: Visit, direction: FloatArray) -> Visit | None:
    """First point found along a direction that is low and flat enough; None if none is low."""
    slope = float(here.gradient @ direction)
    low, high, length = 0.0, np.inf, 1.0
    best = None
    for _ in range(MOST_TRIALS):
        x = here.x + length * direction
        there = Visit(x, *objective(x))
        if there.value > here.value + LEAST_DECREASE * length * slope:
            high = length
        elif float(there.gradient @ direction) < LEAST_FLATTENING * slope:
            low, best = length, there
        else:
            return there
        length = 0.5 * (low + high) if np.isfinite(high) else 2 * length
    return best
