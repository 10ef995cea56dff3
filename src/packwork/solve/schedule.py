"""How steps shrink and penalties grow over a run."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from packwork.losses.linear import LinearWeights
from packwork.solve.options import SolveOptions


def epochs_per_level(epochs: int, shares: Sequence[float]) -> list[int]:
    """Whole epochs in the proportion of ``shares``, rounded so that none is lost.

    Examples
    --------
    >>> epochs_per_level(200, [1, 1, 1])
    [67, 66, 67]
    """
    ends = np.rint(np.cumsum(shares) / np.sum(shares) * epochs).astype(int)
    return [int(n) for n in np.diff(ends, prepend=0)]


def rate_factor(options: SolveOptions, progress: float) -> float:
    """Factor on all step lengths at ``progress`` (0..1) through the run.

    Examples
    --------
    >>> rate_factor(SolveOptions(cooling=0.25), 0.5)
    0.5
    """
    return float(options.cooling**progress)


def weights_at(options: SolveOptions, progress: float) -> LinearWeights:
    """Loss weights at ``progress`` (0..1) through the run.

    Penalties grow geometrically, filling stays one until the run settles.

    Examples
    --------
    >>> weights_at(SolveOptions(overlap=2, hardening=9), 0.5).overlap
    6.0
    """
    growth = float(options.hardening**progress)
    settles = progress > 1 - options.settling
    filling = options.settling_filling if settles else 1.0
    return LinearWeights(options.containment * growth, options.overlap * growth, filling)
