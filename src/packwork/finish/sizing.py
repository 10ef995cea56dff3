"""Size mode that a finish is asked for."""

from __future__ import annotations

import numpy as np

from packwork.arrays import FloatArray
from packwork.compaction.objective import FixedSize, FreeSizes, SharedSize, Sizing, turn_ranges
from packwork.finish.options import FinishOptions
from packwork.scene.pose import Poses


def sizing_of(poses: Poses, areas: FloatArray, options: FinishOptions) -> Sizing:
    """Size mode that the options ask for; ``areas``: ``(n,)`` of the items at these poses."""
    turns = turn_ranges(poses.angle, options)
    if options.sizes == "free":
        smallest = poses.scale / 2 if options.smallest is None else np.array(options.smallest)
        largest = poses.scale * 2 if options.largest is None else np.array(options.largest)
        return FreeSizes(
            areas, turns, np.log(smallest / poses.scale), np.log(largest / poses.scale)
        )
    return (FixedSize if options.sizes == "fixed" else SharedSize)(areas, turns)
