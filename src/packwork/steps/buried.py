"""Items that lie mostly under others or outside, and new places for them."""

from __future__ import annotations

import numpy as np

from packwork.arrays import FloatArray
from packwork.scene.limits import Limits
from packwork.scene.pose import Poses
from packwork.solve.detail import seen_posed
from packwork.solve.level import Level
from packwork.solve.relocate_trapped import violation_shares
from packwork.start.relocate_buried import relocated
from packwork.steps.place import Setting

RESOLUTION = 200
"""Pixels on the longer side of the image on which buried items are found. Chosen."""

BURIED_SHARE = 0.5
"""Share of an item under others or outside from which it is moved before a run that did
not choose its own start. Smaller undoes more of that start. Chosen."""


def unburied(setting: Setting, poses: Poses, limits: Limits) -> tuple[Poses, FloatArray]:
    """Poses in which buried items have been moved into voids.

    Returns
    -------
    poses
        Of all items.
    violation
        ``(n,)`` share of each item that lay under others or outside before.
    """
    seen = seen_posed(setting.outlines, poses, RESOLUTION / setting.region.side)
    level = Level(setting.region, seen, RESOLUTION, limits=limits)
    violation = violation_shares(level, poses, level.density(poses))
    buried = np.flatnonzero(violation > BURIED_SHARE)
    if len(buried):
        poses = relocated(setting.region, setting.outlines, poses, buried, setting.rng, limits)
    return poses, violation
