"""Chains drawn to a target's picture, coarse to fine, by quasi-Newton steps.

The renderer's gradient is exact, so curvature can be learned from it: Adam with decaying
steps needs three times the renderings and ends farther off
(docs/decisions/0004-fitted-outlines.md).
"""

from __future__ import annotations

from collections.abc import Sequence

from packwork.arrays import FloatArray
from packwork.fit.mismatch import Mismatch
from packwork.fit.quasi_newton import lowest
from packwork.geometry.outline import Outline

LEVELS = ((32, 60), (64, 100), (128, 200))
"""Pixels on the longer side, and iterations at most, from coarse to fine. Coarse levels
are cheap and carry far: without them the worst icon ends at 0.969 instead of 0.975. A
further level at 256 px takes a quarter more time for 0.0002 of IoU. Tried."""

LEAST_GAIN = 5e-7
"""A level ends when an iteration lowers the mean squared difference by less than this
times the share of the image that is inked. A twentieth of it gains 0.0003 of IoU in
twice the time. Tried."""


def drawn_to(target: Outline, chain: FloatArray, counts: Sequence[int]) -> list[FloatArray]:
    """Controls ``(k, 3, 2)`` after each level, coarse to fine, the start in front.

    Parameters
    ----------
    chain
        Controls to start from, the chains of all rings one after another.

    Examples
    --------
    >>> import numpy as np
    >>> from packwork.fit.chains import Chains, straight_chain
    >>> from packwork.geometry.polygon import signed_area
    >>> square = np.array([[0, 0], [2, 0], [2, 2], [0, 2.0]])
    >>> stages = drawn_to(Outline.from_rings([square]), straight_chain(0.9 * square), [4])
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
    return lowest(value_and_gradient, controls_px.ravel(), iterations, least_gain).reshape(shape)
