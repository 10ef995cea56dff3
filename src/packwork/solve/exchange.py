"""Items of one kind that lie side by side change places with others."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from packwork.arrays import FloatArray
from packwork.geometry.outline import Outline
from packwork.scene.limits import Limits
from packwork.scene.mixing import mixed
from packwork.scene.neighbours import side_by_side
from packwork.scene.pose import Poses


def exchange(
    outlines: Sequence[Outline],
    poses: Poses,
    limits: Limits,
    smallest: FloatArray,
    largest: FloatArray,
) -> tuple[Poses, list[int]]:
    """Poses in which few items lie beside one of their kind, and who was moved.

    An item takes the place and, within its bounds, the area of the one that lay there.
    """
    if limits.kinds is None:
        return poses, []
    areas = np.array([outline.area for outline in outlines])
    placed = [outline.mapped(poses.matrix(k)) for k, outline in enumerate(outlines)]
    pairs = side_by_side(placed, poses.x, poses.y)
    order = mixed(limits.kinds, pairs, limits.groups)
    moved = np.flatnonzero(order != np.arange(len(order)))
    comers = order[moved]
    x, y, scale = poses.x.copy(), poses.y.copy(), poses.scale.copy()
    x[comers], y[comers] = poses.x[moved], poses.y[moved]
    fitting = poses.scale[moved] * np.sqrt(areas[moved] / areas[comers])
    scale[comers] = np.clip(fitting, smallest[comers], largest[comers])
    return replace(poses, x=x, y=y, scale=scale), [int(k) for k in comers]
