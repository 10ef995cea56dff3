"""Outlines as a level sees items that are stretched."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from packwork.arrays import FloatArray
from packwork.geometry.affine import stretched
from packwork.geometry.outline import Outline
from packwork.scene.pose import Poses
from packwork.solve.detail import seen_at


def seen_posed(
    outlines: Sequence[Outline], poses: Poses, px_per_cu: float, margin_cu: float = 0.0
) -> list[Outline]:
    """Outlines simplified to a level's pixels in the shape and size of their poses.

    A pixel and a margin are as wide as high on the canvas, so an item that is stretched
    gets its detail and its margin stretched; the result is in item units all the same.

    Parameters
    ----------
    outlines
        One per item, item units.
    poses
        Scales and stretches are read; as many as outlines.
    px_per_cu
        Pixels of the level per canvas unit.
    margin_cu
        Every outline is grown by this much all round, canvas units.

    Examples
    --------
    >>> half = np.array([[-8.0, -8], [8, -8], [8, 8], [-8, 8]])
    >>> one = np.ones(1)
    >>> wide = Poses(one, one, 0 * one, one, 4 * one)
    >>> (seen,) = seen_posed([Outline.from_rings([half])], wide, 99.0, margin_cu=1.0)
    >>> [round(v, 2) for v in seen.bounds]
    [-8.5, -10.0, 8.5, 10.0]
    """
    # Items within a factor of two of one shape share one outline, as sizes do; but a
    # margin has the same width whatever the shape.
    ratios = poses.stretch if margin_cu > 0 else 2.0 ** np.rint(np.log2(poses.stretch))
    shaped = _stretched_once(outlines, ratios)
    return _stretched_once(seen_at(shaped, poses.scale, px_per_cu, margin_cu), 1 / ratios)


def _stretched_once(outlines: Sequence[Outline], ratios: FloatArray) -> list[Outline]:
    """Stretched outlines; copies stretched alike are made once, others left as they are."""
    done: dict[tuple[int, float], Outline] = {}
    result = []
    for outline, ratio in zip(outlines, ratios.tolist(), strict=True):
        key = (id(outline), ratio)
        if key not in done:
            done[key] = outline if ratio == 1.0 else outline.mapped(stretched(ratio))
        result.append(done[key])
    return result
