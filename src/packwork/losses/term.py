"""What a loss returns, and the shape of a loss."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

from packwork.arrays import FloatArray, Image


@dataclass(frozen=True, eq=False)
class Term:
    """Value of an image loss and its derivative.

    Parameters
    ----------
    value
        The loss; a mean over the image's pixels, so that levels agree.
    adjoint
        d value / d density, of the image's size.
    """

    value: float
    adjoint: Image


class ImageLoss(Protocol):
    """A pure function of the density image and the container's coverage.

    Both images are float32 or float64 of one size, ``[row, col]``; the density may
    exceed one. The weight lives in the recipe, not in the loss.
    """

    def __call__(self, density: Image, container: Image) -> Term:
        """Return the value and its derivative; leave both images as they are."""
        ...


@dataclass(frozen=True, eq=False)
class PoseTerm:
    """Value of an object-space loss and its derivative by position.

    Parameters
    ----------
    value
        The loss.
    x, y
        ``(n,)`` derivatives by the items' positions, per canvas unit.
    """

    value: float
    x: FloatArray
    y: FloatArray
