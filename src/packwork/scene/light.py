"""Channels of colours as screens have them, to light and back: what blends as the eye blends it."""

from __future__ import annotations

import numpy as np

from packwork.arrays import FloatArray


def light_of(channels: FloatArray) -> FloatArray:
    """Red, green and blue as light, of channels 0..1 as screens have them (IEC 61966-2-1, sRGB).

    Examples
    --------
    >>> light_of(np.array([0.0, 0.5, 1.0])).round(3).tolist()
    [0.0, 0.214, 1.0]
    """
    low, high = channels / 12.92, ((channels + 0.055) / 1.055) ** 2.4
    return np.where(channels <= 0.04045, low, high)


def channels_of(light: FloatArray) -> FloatArray:
    """Channels as screens have them, of light; what is out of range is clamped.

    Examples
    --------
    >>> channels_of(light_of(np.array([0.0, 0.5, 1.0]))).round(9).tolist()
    [0.0, 0.5, 1.0]
    """
    held = np.clip(light, 0.0, 1.0)
    return np.where(held <= 0.0031308, 12.92 * held, 1.055 * held ** (1 / 2.4) - 0.055)
