"""Linear programmes whose rows touch one item or two, by an interior-point method.

S. Mehrotra, "On the implementation of a primal-dual interior point method", SIAM Journal on
Optimization 2 (1992), 575-601, doi:10.1137/0802028. Ours keeps the normal equations in an
envelope of four unknowns an item, and starts from the layout as it is.
"""

from __future__ import annotations

import numpy as np

from packwork.arrays import FloatArray
from packwork.compaction.interior_point import _kernels
from packwork.compaction.interior_point._kernels import Rows


def maximise(
    gain: FloatArray, rows: Rows, low: FloatArray, high: FloatArray, accuracy: float
) -> FloatArray:
    """Unknowns ``(n, 4)`` within bounds and rows with nearly the largest total gain.

    Starts from standing still; deterministic. The result may break rows by
    a little: the caller checks.

    Parameters
    ----------
    gain
        ``(n, 4)`` what one unit of each unknown is worth.
    rows
        The conditions.
    low, high
        ``(n, 4)`` bounds, ``low <= 0 <= high``.
    accuracy
        Share of the total gain at which to stop. Larger stops earlier and leaves items
        more in the middle of their room.

    Examples
    --------
    >>> rows = Rows(np.array([0]), np.array([-1]), np.eye(1, 8), np.array([0.25]))
    >>> bounds = np.ones((1, 4))
    >>> z = maximise(np.eye(1, 4), rows, -bounds, bounds, 1e-6)
    >>> abs(float(z[0, 0]) - 0.25) < 1e-4
    True
    """
    z = _kernels.maximise(rows, gain.ravel(), low.ravel(), high.ravel(), accuracy)
    return np.asarray(z).reshape(gain.shape)
