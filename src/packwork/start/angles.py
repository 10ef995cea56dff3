"""First angles of items, within limits or among choices."""

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

    Parameters
    ----------
    limit_rad
        Largest turn from upright; None for any.
    choices_rad
        The only angles allowed, or None.

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

    Parameters
    ----------
    limit_rad
        Largest turn from upright; None for any.

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

    Parameters
    ----------
    angles_rad
        ``(n,)``.

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
