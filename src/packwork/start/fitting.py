"""Largest scale and turn of an outline in a void, by what is free in each direction."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import shapely

from packwork.arrays import BoolArray, FloatArray, IntArray
from packwork.geometry.outline import Outline

SECTORS = 72
"""Directions in which a void and an item are compared. More fit tighter and take longer, by
the square. Tried."""


def fitted(
    rays: FloatArray, sorts: Sequence[Outline], turns: BoolArray
) -> tuple[FloatArray, IntArray]:
    """Largest scale at which each outline fits into each void, and the turn at which it does.

    As far as :data:`SECTORS` directions tell, with the outline's origin on the void's centre.

    Parameters
    ----------
    rays
        ``(m, SECTORS)``, canvas units.
    sorts
        ``k`` outlines, item units.
    turns
        ``(SECTORS,)`` which turns, in steps of a sector, are allowed.

    Returns
    -------
    tuple
        Scales ``(m, k)``, and turns in sectors ``(m, k)``.

    Examples
    --------
    >>> bar = Outline.from_rings([np.array([[-4.0, -1], [4, -1], [4, 1], [-4, 1]])])
    >>> upright = np.where(np.abs(np.sin(2 * np.pi * np.arange(SECTORS) / SECTORS)) > 0.9, 9.0, 2.0)
    >>> scales, turn = fitted(upright[None], [bar], np.ones(SECTORS, dtype=bool))
    >>> bool(0.8 < scales[0, 0] < 2.2), int(turn[0, 0]) % (SECTORS // 2) == SECTORS // 4
    (True, True)
    """
    allowed, sector = np.flatnonzero(turns), np.arange(SECTORS)
    scales = np.zeros((len(rays), len(sorts)))
    best = np.zeros(scales.shape, dtype=np.int64)
    for k, outline in enumerate(sorts):
        reach = np.maximum(_profile(outline), 1e-9 * outline.extent)
        turned = 1 / reach[(sector[None, :] - allowed[:, None]) % SECTORS]
        for void, ray in enumerate(rays):
            by_turn = (ray * turned).min(axis=1)
            pick = int(np.argmax(by_turn))
            scales[void, k], best[void, k] = by_turn[pick], allowed[pick]
    return scales, best


def _profile(outline: Outline) -> FloatArray:
    """``(SECTORS,)`` how far an outline reaches from its origin, by direction."""
    points = np.concatenate([_dense(ring) for ring in outline.rings])
    sector = np.rint(np.arctan2(points[:, 1], points[:, 0]) * (SECTORS / (2 * np.pi)))
    reach = np.zeros(SECTORS)
    np.maximum.at(reach, sector.astype(np.int64) % SECTORS, np.hypot(points[:, 0], points[:, 1]))
    return reach


def _dense(ring: FloatArray) -> FloatArray:
    """Points on a closed ring, so near each other that few sectors are left out."""
    closed = shapely.LinearRing(ring)
    spacing = float(np.ptp(ring, axis=0).max()) / SECTORS / 2
    return np.asarray(shapely.get_coordinates(shapely.segmentize(closed, max(spacing, 1e-12))))
