"""A picture that a layout is to show from afar."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from packwork.arrays import FloatArray
from packwork.errors import ShapeError
from packwork.fields.filters import box_mean


@dataclass(frozen=True, eq=False)
class TargetPicture:
    """Picture that is seen from afar, as it lies on a canvas.

    ``light``: ``(rows, columns, 3)`` red, green and blue as light, 0..1.
    ``px_per_cu``: pixels of it per canvas unit.

    Raises ``ShapeError`` if it is of another form.

    Examples
    --------
    >>> TargetPicture(np.zeros((20, 30, 3)), 0.5).spread
    0.0
    """

    light: FloatArray
    px_per_cu: float

    def __post_init__(self) -> None:
        if self.light.ndim != 3 or self.light.shape[2] != 3:
            raise ShapeError(f"a picture needs rows, columns and channels, not {self.light.shape}")

    @property
    def spread(self) -> float:
        """Largest standard deviation of its channels: 0 where it shows nothing."""
        return float(self.light.reshape(-1, 3).std(axis=0).max())


def blurred(light: FloatArray, share: float, count: int) -> FloatArray:
    """Light averaged over squares, ``share`` of the side of one of ``count`` parts of the whole.

    Examples
    --------
    >>> blurred(np.eye(4)[..., None], 3.0, 16)[1, 1].round(3).tolist()
    [0.333]
    """
    wide = share * np.sqrt(light.shape[0] * light.shape[1] / max(count, 1))
    size = 2 * round((wide - 1) / 2) + 1
    if size < 3:
        return light
    whole = box_mean(np.ones(light.shape[:2]), size)
    channels = [
        box_mean(np.ascontiguousarray(light[..., k]), size) / whole for k in range(light.shape[2])
    ]
    return np.stack(channels, axis=2)
