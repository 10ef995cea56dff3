"""First angles of items, within limits or among choices, and first scales, of weights and areas."""

from __future__ import annotations

import numpy as np

from packwork.arrays import FloatArray


def start_angles(
    count: int,
    limit_rad: float | None,
    choices_rad: tuple[float, ...] | None,
    rng: np.random.Generator,
) -> FloatArray:
    """``(count,)`` angles: among the choices if there are any, else within the limit.

    ``limit_rad``: largest turn from upright; None for any.
    ``choices_rad``: the only angles allowed, or None.

    Examples
    --------
    >>> start_angles(3, 0.0, None, np.random.default_rng(0)).tolist()
    [0.0, 0.0, 0.0]
    """
    if choices_rad is not None:
        return np.asarray(rng.choice(np.asarray(choices_rad), size=count))
    largest = np.pi if limit_rad is None else limit_rad
    return rng.uniform(-largest, largest, size=count) + 0.0


def spread_angles(count: int, limit_rad: float | None, rng: np.random.Generator) -> FloatArray:
    """``(count,)`` angles spread over what is allowed, each at random in its part of it.

    ``limit_rad``: largest turn from upright; None for any.

    Examples
    --------
    >>> angles = spread_angles(4, 1.0, np.random.default_rng(0))
    >>> np.floor(angles * 2).tolist()
    [-2.0, -1.0, 0.0, 1.0]
    """
    largest = np.pi if limit_rad is None else limit_rad
    return (2 * (np.arange(count) + rng.random(count)) / count - 1) * largest


def nearest_allowed(
    angles_rad: FloatArray, limit_rad: float | None, choices_rad: tuple[float, ...] | None
) -> FloatArray:
    """Angles that an earlier layout had, turned no further than it takes to be allowed.

    ``angles_rad``: ``(n,)``.

    Examples
    --------
    >>> nearest_allowed(np.array([0.4, 6.2, -3.0]), None, (0.0, 3.0)).tolist()
    [0.0, 0.0, 3.0]
    >>> nearest_allowed(np.array([0.4, -3.0]), 0.5, None).tolist()
    [0.4, -0.5]
    """
    if choices_rad is not None:
        choices = np.asarray(choices_rad)
        away = np.abs(_shortest(angles_rad[:, None] - choices))
        return np.asarray(choices[np.argmin(away, axis=1)])
    if limit_rad is None:
        return angles_rad
    return np.clip(_shortest(angles_rad), -limit_rad, limit_rad)


def _shortest(angles_rad: FloatArray) -> FloatArray:
    """The same turns the short way round; those within half a turn stay bit for bit."""
    turns = np.rint(angles_rad / (2 * np.pi))
    return np.asarray(angles_rad - 2 * np.pi * turns)


YIELDING = 1.0
"""How strongly items that fill their hull badly begin smaller than their nominal size,
where sizes are free: the scale goes with (area / hull area) to this power. 0 starts a
spiral as large as a disc, larger spends the container on compact items. Tried."""


def nominal_scales(areas: FloatArray, weights: FloatArray, total_cu2: float) -> FloatArray:
    """Scales at which areas are in the shares of the weights.

    ``areas``: ``(n,)``, item units squared: of the outlines where sizes are data, of their hulls
    where items are to look equally large.
    ``weights``: ``(n,)``, positive.
    ``total_cu2``: sum of the areas asked for, canvas units squared.

    Examples
    --------
    >>> nominal_scales(np.array([1.0, 4.0]), np.ones(2), 8.0).tolist()
    [2.0, 1.0]
    """
    shares = weights / weights.max()
    return np.asarray(np.sqrt(total_cu2 * shares / shares.sum() / areas))


def shared_scales(
    areas: FloatArray, seen: FloatArray, weights: FloatArray, total_cu2: float
) -> FloatArray:
    """Scales where areas are data: true areas in the shares of the weights.

    ``areas``: ``(n,)`` true areas of the items, item units squared.
    ``seen``: ``(n,)`` areas of what stands for them while they are placed.
    ``weights``: ``(n,)``, positive.
    ``total_cu2``: sum of the areas seen, canvas units squared.

    Examples
    --------
    >>> shared_scales(np.array([1.0, 4.0]), np.array([2.0, 8.0]), np.ones(2), 16.0).tolist()
    [2.0, 1.0]
    """
    larger = float(np.average(seen / areas, weights=weights))
    return nominal_scales(areas, weights, total_cu2 / larger)


def yielding_scales(
    areas: FloatArray, hulls: FloatArray, nominal: FloatArray, ratio: float, total_cu2: float
) -> FloatArray:
    """First scales where sizes are free: compact items larger, straggly ones smaller.

    ``areas``, ``hulls``: ``(n,)`` areas of the outlines and of their convex hulls.
    ``nominal``: ``(n,)`` middle of each item's range.
    ``ratio``: scales stay within ``nominal / ratio`` and ``nominal * ratio``.
    ``total_cu2``: sum of the areas to begin with, unless the bounds forbid it.

    Examples
    --------
    >>> one = np.ones(2)
    >>> compact, straggly = yielding_scales(one, np.array([1.0, 2.0]), one, 2.0, 1.0)
    >>> bool(compact > straggly >= 0.5)
    True
    """
    scales = nominal * (areas / hulls) ** YIELDING
    scales *= np.sqrt(total_cu2 / np.sum(areas * scales**2))
    return np.asarray(np.clip(scales, nominal / ratio, nominal * ratio))
