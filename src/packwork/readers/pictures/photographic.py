"""Detection of photographs among masks, by their mid-tones."""

from __future__ import annotations

import numpy as np
from PIL import Image

from packwork.arrays import BoolArray, FloatArray

SMALL_PX = 256
"""Longer side at which texture is looked for: noise and JPEG blocks are gone there. Chosen."""

LEAST_MID = 0.3
"""Share of mid-tones in a photograph. Masks have them along their edges only; 15 of 18
photographs tried had 0.75 or more, soft masks up to 0.6. Chosen."""

LEAST_TURNS = 0.07
"""Share of pixels where a photograph turns from brighter to darker or back, of those that are
mid-tones. Tried: photographs 0.07 to 0.66, masks of every kind 0.06 at most (twelve flat greys
as a poor JPEG)."""

LEAST_GREYS = 48.0
"""Greys that the mid-tones of a photograph spread over, as the exponential of their entropy.
Tried: photographs 62 or more, shaded logos 39 at most; a photograph of few greys has hardly
anything but mid-tones (``ALL_MID``)."""

ALL_MID = 0.9
"""Share of mid-tones from which few greys are no sign of a drawing. Chosen."""

_DARK, _LIGHT = 32 / 255, 223 / 255
_STEP = 1.5 / 255


def looks_photographic(darkness: FloatArray) -> bool:
    """Whether a picture has mid-tones all over, of many greys, that go up and down.

    Parameters
    ----------
    darkness
        ``[row, col]``, 0..1.

    Examples
    --------
    >>> rng = np.random.default_rng(0)
    >>> looks_photographic(rng.uniform(0, 1, (200, 200))), looks_photographic(np.eye(200))
    (True, False)
    """
    if _mid(darkness).mean() < LEAST_MID:
        return False
    small = _reduced(darkness)
    mid = _mid(small)
    turns = float(np.count_nonzero(_turning(small) & mid)) / small.size
    if not mid.any() or turns < LEAST_TURNS:
        return False
    return float(mid.mean()) >= ALL_MID or _greys(small[mid]) >= LEAST_GREYS


def _mid(grey: FloatArray) -> BoolArray:
    return np.asarray((grey > _DARK) & (grey < _LIGHT))


def _reduced(grey: FloatArray) -> FloatArray:
    image = Image.fromarray(grey.astype(np.float32))
    factor = SMALL_PX / max(image.size)
    if factor >= 1:
        return grey
    size = max(1, round(image.width * factor)), max(1, round(image.height * factor))
    return np.asarray(image.resize(size, Image.Resampling.BOX), dtype=np.float64)


def _turning(grey: FloatArray) -> BoolArray:
    """Pixels that are brighter, or darker, than both their neighbours along a row or column."""
    turning = np.zeros(grey.shape, dtype=bool)
    for values, found in ((grey, turning), (grey.T, turning.T)):
        steps = np.diff(values, axis=0)
        before, after = steps[:-1], steps[1:]
        is_far = np.minimum(np.abs(before), np.abs(after)) >= _STEP
        found[1:-1] |= (before * after < 0) & is_far
    return turning


def _greys(values: FloatArray) -> float:
    """How many greys values spread over: the exponential of their entropy."""
    shares = np.bincount((255 * values).astype(int)) / values.size
    shares = shares[shares > 0]
    return float(np.exp(-(shares * np.log(shares)).sum()))
