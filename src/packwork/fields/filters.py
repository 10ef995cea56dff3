"""Filters of images: box means by running sums, and saliency by the spectral residual.

M. McDonnell, "Box-filtering techniques", Computer Graphics and Image Processing 17 (1981), 65-70:
any size for the same price. X. Hou and L. Zhang, "Saliency Detection: A Spectral Residual
Approach", CVPR 2007, doi:10.1109/CVPR.2007.383267. Ours adds a margin of mirror image, or opposite
edges that meet would stand out; sums the channels; and leaves blank pictures blank.
"""

from __future__ import annotations

import numpy as np

from packwork.arrays import FloatArray, Image
from packwork.errors import ShapeError
from packwork.fields import _kernels


def box_mean(image: Image, size: int) -> Image:
    """Mean over the square of ``size`` pixels, odd, centred on each pixel; zero off the image.

    Linear and its own adjoint, so it also carries derivatives back. ``image``: contiguous.

    >>> box_mean(np.array([[0.0, 9.0, 0.0]]), 3).tolist()
    [[1.0, 1.0, 1.0]]
    """
    if size < 1 or size % 2 == 0:
        raise ShapeError(f"a box must have an odd size of at least 1 px, not {size}")
    across = np.empty_like(image)
    result = np.empty_like(image)
    _kernels.box_sum_across(image, size // 2, across)
    _kernels.box_sum_down(across, size // 2, 1.0 / (size * size), result)
    return result


def structural_similarity(one: FloatArray, other: FloatArray) -> float:
    """Mean structural similarity of two images of lightness, 0..1, over squares of 7 pixels.

    Z. Wang, A. Bovik, H. Sheikh and E. Simoncelli, "Image quality assessment: from error
    visibility to structural similarity", IEEE Transactions on Image Processing 13 (2004), 600-612.

    >>> ramp = np.tile(np.linspace(0, 1, 20), (20, 1))
    >>> structural_similarity(ramp, ramp), structural_similarity(ramp, 1 - ramp) < 0
    (1.0, True)
    """
    whole = box_mean(np.ones(one.shape), 7)
    a, b, aa, bb, ab = (
        box_mean(image, 7) / whole for image in (one, other, one**2, other**2, one * other)
    )
    like = (2 * a * b + 1e-4) * (2 * (ab - a * b) + 9e-4)
    return float((like / ((a**2 + b**2 + 1e-4) * (aa - a**2 + bb - b**2 + 9e-4))).mean())


BLANK = 0.01
"""Standard deviation of a picture, of 1, below which nothing in it stands out: about that of
compression. Chosen."""

MARGIN_PX = 12
"""Margin of mirror image. Without it corners stand out, with a whole image all is drawn to the
middle. Tried."""

_NEIGHBOURS = 3

_SPREAD = 2.5

_FLOOR = 1e-6


def spectral_residual(picture: FloatArray) -> FloatArray:
    """Saliency of each pixel, 0..1; zeros for a picture of one colour.

    The logarithm of a picture's spectrum is smooth but for what is peculiar to it. ``picture``:
    ``(rows, columns, channels)``, 0..1, about 64 pixels long: what is found is as large as a few
    pixels.

    >>> picture = np.random.default_rng(0).normal(0.5, 0.03, (48, 64, 1))
    >>> picture[20:26, 40:46] = 1.0
    >>> found = spectral_residual(picture)
    >>> row, column = np.unravel_index(found.argmax(), found.shape)
    >>> bool(abs(row - 22.5) < 4), bool(abs(column - 42.5) < 4)
    (True, True)
    """
    from scipy.ndimage import gaussian_filter

    if float(picture.std(axis=(0, 1)).max()) < BLANK:
        return np.zeros(picture.shape[:2])
    total = sum(_residual(picture[:, :, k]) for k in range(picture.shape[2]))
    smooth = gaussian_filter(np.asarray(total), _SPREAD, mode="nearest")
    span = float(np.ptp(smooth))
    # By the root: what stands out a little is not lost beside what stands out most.
    return np.sqrt((smooth - smooth.min()) / span) if span > 0 else np.zeros(smooth.shape)


def _residual(channel: FloatArray) -> FloatArray:
    from scipy.ndimage import uniform_filter

    margin = min(MARGIN_PX, *(side - 1 for side in channel.shape))
    spectrum = np.fft.fft2(np.pad(channel, margin, mode="reflect"))
    strength = np.log(np.abs(spectrum) + _FLOOR)
    residual = strength - uniform_filter(strength, _NEIGHBOURS, mode="wrap")
    back = np.fft.ifft2(np.exp(residual + 1j * np.angle(spectrum)))
    return np.asarray(np.abs(back[margin:-margin, margin:-margin]) ** 2)
