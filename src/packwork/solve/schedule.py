"""How steps shrink and penalties grow over a run."""

from __future__ import annotations

from packwork.losses.linear import LinearWeights
from packwork.solve.options import SolveOptions


def epochs_per_level(epochs: int, levels: int) -> list[int]:
    """Epochs shared evenly; what does not divide goes to the finest levels.

    Examples
    --------
    >>> epochs_per_level(200, 3)
    [66, 67, 67]
    """
    return [(epochs * (k + 1)) // levels - (epochs * k) // levels for k in range(levels)]


def rate_factor(options: SolveOptions, progress: float) -> float:
    """Factor on all step lengths at ``progress`` (0..1) through the run.

    Examples
    --------
    >>> rate_factor(SolveOptions(cooling=0.25), 0.5)
    0.5
    """
    return float(options.cooling**progress)


def weights_at(options: SolveOptions, progress: float) -> LinearWeights:
    """Loss weights at ``progress`` (0..1): penalties grow geometrically, filling stays.

    Examples
    --------
    >>> weights_at(SolveOptions(overlap=2, hardening=9), 0.5).overlap
    6.0
    """
    growth = float(options.hardening**progress)
    return LinearWeights(options.containment * growth, options.overlap * growth, 1.0)
