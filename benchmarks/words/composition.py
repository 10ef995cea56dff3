"""Where a cloud's weight lies: near the middle of its room or not, evenly or not, and how bare."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt
from scipy import ndimage

from benchmarks.kit.manifests import Manifest
from packwork.metrics.pixel import REACH

WIDEST = 0.9
"""Clearance, as a share of the largest, from which on a pixel is of the region of greatest
clearance. As first fit counts it."""

BLUR = 0.1
"""Standard deviation of the window in which ink is counted, over the square root of the free
area. Smaller tells words from gaps, larger tells nothing. Chosen."""

Free = npt.NDArray[np.bool_]
"""``(rows, columns)`` pixels that words may lie on."""


def composition(ink: Free, weight: npt.NDArray[np.float64], free: Free) -> Manifest:
    """How far in, how uneven and how bare a cloud is.

    Parameters
    ----------
    ink
        ``(rows, columns)`` pixels that are drawn on.
    weight
        As many: the height of the word that is drawn there, in any unit, else 0.
    free
        As many: pixels that words may lie on.

    Examples
    --------
    >>> free = np.ones((30, 30), bool)
    >>> found = composition(free, np.ones((30, 30)), free)
    >>> round(found["inwards"], 2), round(found["uneven"], 2), found["near"], found["gap"]
    (1.0, 0.0, 1.0, 0.0)
    """
    return {
        "inwards": distance_of_weight(weight, free),
        "uneven": unevenness(ink, free),
        **bareness(ink, free),
    }


def distance_of_weight(weight: npt.NDArray[np.float64], free: Free) -> float:
    """Mean distance of weight from the region of greatest clearance, over that of the free area.

    1 for weight spread evenly, 0 for all of it in that region.

    Examples
    --------
    >>> weight = np.zeros((9, 9))
    >>> weight[4, 4] = 1
    >>> distance_of_weight(weight, np.ones((9, 9), bool))
    0.0
    """
    clearance = _clearance(free)
    away = ndimage.distance_transform_edt(clearance < WIDEST * clearance.max())
    held = np.where(free, weight, 0.0)
    return float((held * away).sum() / held.sum() / away[free].mean())


def unevenness(ink: Free, free: Free) -> float:
    """Standard deviation over mean of the share of ink round each free pixel; 0 is even."""
    width = BLUR * math.sqrt(float(free.sum()))
    drawn, room = (
        ndimage.gaussian_filter(one.astype(np.float64), width, mode="constant")
        for one in (ink & free, free)
    )
    share = drawn[free] / room[free]
    return float(share.std() / share.mean())


def bareness(ink: Free, free: Free) -> Manifest:
    """Share of the free area near ink, and radius of the largest empty disc over its own largest.

    Near is within 3 % of its longer side.
    """
    away = ndimage.distance_transform_edt(~ink)
    rows, columns = np.nonzero(free)
    reach = REACH * max(np.ptp(rows) + 1, np.ptp(columns) + 1)
    clearance = _clearance(free)
    return {
        "near": float(np.mean(away[free] <= reach)),
        "gap": float(np.minimum(away, clearance).max() / clearance.max()),
    }


def _clearance(free: Free) -> npt.NDArray[np.float64]:
    """Distance of each pixel from what is not free; the canvas ends there too."""
    return np.asarray(ndimage.distance_transform_edt(np.pad(free, 1)))[1:-1, 1:-1]
