"""Whether the transparency of a picture says what it shows, or is an accident of it."""

from __future__ import annotations

import numpy as np

from packwork.arrays import FloatArray
from packwork.readers.pictures.decode import Pixels

LEAST_CLEAR_OF_ITEM = 0.001
"""Share of an item's picture that is clear where its transparency decides. Larger takes the
rounded corners of a playing card, 0.15 % of it, for an accident, and its white rim for paper;
smaller lets a few translucent pixels keep the paper round a drawing. Chosen."""

LEAST_CLEAR_OF_MASK = 0.01
"""The same of a mask. Larger passes over small windows in a plate; smaller lets the rounded
corners of a page hide what is painted on it. Chosen."""

_FAINTEST = 1 / 255


def solidity(pixels: Pixels) -> FloatArray:
    """Opacity 0..1 of RGBA pixels, the most opaque one taken for 1: a faint shape is a shape.

    Examples
    --------
    >>> solidity(np.array([[[0, 0, 0, 100], [0, 0, 0, 50]]], np.uint8)).tolist()
    [[1.0, 0.5]]
    """
    alpha = pixels[:, :, 3].astype(np.float64)
    return np.asarray(alpha / max(float(alpha.max()), 255 * _FAINTEST))


def decides(solid: FloatArray, least_clear: float) -> bool:
    """Whether a real share of a picture is clear.

    Parameters
    ----------
    solid
        As :func:`solidity` gave it.
    least_clear
        Share of the pixels that are less than half as opaque as the most opaque one.

    Examples
    --------
    >>> page = np.ones((20, 20)); page[0, 0] = 0
    >>> decides(page, LEAST_CLEAR_OF_ITEM), decides(page, LEAST_CLEAR_OF_MASK)
    (True, False)
    """
    return float(np.count_nonzero(solid < 0.5)) >= least_clear * solid.size
