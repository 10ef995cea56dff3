"""Area-share loss: variance of areas against those asked for."""

from __future__ import annotations

import numpy as np

from packwork.losses.term import PosedItems, PoseTerm


def area_shares(placed: PosedItems) -> PoseTerm:
    """Variance of the logarithm of area over area asked for.

    Zero when all items are larger or smaller than asked by one common factor. For free
    sizes: a soft form of what shared sizes hold exactly. An object-space loss; its value
    is dimensionless.

    Examples
    --------
    >>> from packwork.scene.pose import Poses
    >>> zero = np.zeros(2)
    >>> poses = Poses(zero, zero, zero, np.array([1.0, np.e]))
    >>> term = area_shares(PosedItems(poses, np.ones(2), np.ones(2)))
    >>> term.value, term.log_scale.tolist()
    (1.0, [-2.0, 2.0])
    """
    growth = 2 * np.log(placed.poses.scale / placed.nominal)
    deviation = growth - growth.mean()
    zero = np.zeros_like(deviation)
    return PoseTerm(
        float(np.mean(deviation**2)), zero, zero, log_scale=4 * deviation / len(deviation)
    )
