"""Masks to regions: dark is inside, unless they are photographs."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from PIL import Image

from packwork.arrays import BoolArray, FloatArray
from packwork.geometry.polygon import Region
from packwork.readers.options import HALF
from packwork.readers.pictures.decode import MAX_PICTURE_BYTES, Pixels, decode_picture
from packwork.readers.pictures.silhouette import (
    ART_PX,
    LEAST_CLEAR_OF_MASK,
    SPECK,
    decides,
    outline_of_coverage,
    raised,
    solidity,
    tell_what_is_faint,
    without_enclosed_white,
)
from packwork.readers.reading import UnfitError, notice, read_bytes, reading_file
from packwork.readers.regions import NEARLY_ALL, clean_union, tell_if_full

SMALL_PX = 256
"""Longer side at which texture is looked for: noise and JPEG blocks are gone there. Chosen."""

LEAST_MID = 0.3
"""Share of mid-tones in a photograph. Masks have them along their edges only. Chosen."""

LEAST_TURNS = 0.07
"""Share of pixels where a photograph turns from brighter to darker or back, of those that are
mid-tones. Tried: masks of every kind have 0.06 at most."""

LEAST_GREYS = 48.0
"""Greys that the mid-tones of a photograph spread over, as the exponential of their entropy.
Tried: shaded logos have 39 at most; a photograph of fewer has hardly anything but mid-tones."""

ALL_MID = 0.9
"""Share of mid-tones from which few greys are no sign of a drawing. Chosen."""

_DARK, _LIGHT = 32 / 255, 223 / 255
_STEP = 1.5 / 255


def looks_photographic(darkness: FloatArray) -> bool:
    """Whether darkness ``[row, col]`` has mid-tones all over, of many greys, up and down.

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
    """Number of greys that values spread over: the exponential of their entropy."""
    shares = np.bincount((255 * values).astype(int)) / values.size
    shares = shares[shares > 0]
    return float(np.exp(-(shares * np.log(shares)).sum()))


SMALLEST_SIDE_PX = 8
"""Shorter side of a mask that is taken for one. Chosen."""

_LUMINANCE = (0.299, 0.587, 0.114)
_WHY_FULL = {
    True: "its transparency says what is inside; make all clear that is not to be filled, or "
    "give black on white without transparency",
    False: "nearly all of it is dark, and dark is inside; paint what is to be filled black on "
    "white",
}


@dataclass(frozen=True, eq=False)
class TracedMask:
    """Region of a mask, in its pixels, and the size of its canvas."""

    region: Region
    width: float
    height: float


def trace_mask(path: str | Path, alpha_threshold: float = HALF) -> TracedMask:
    """Region of a picture that says inside (dark) or outside (light).

    Where a real share of it is clear, that decides instead: from ``alpha_threshold`` on it is
    inside, but for white patches within a dark shape; a few translucent pixels count as the light
    page behind them. An all-dark mask is the whole canvas. The contour follows the half-way level
    to a fraction of a pixel and is simplified to 0.2 px; the stairs of hard-edged masks are taken
    for straight edges. A notice tells of a mask that fills nearly all of its page, is dark all
    along its edge or looks like a photograph.
    """
    data = read_bytes(path, MAX_PICTURE_BYTES)
    with reading_file(str(path)):
        return mask_of_pixels(decode_picture(data, ART_PX).pixels, alpha_threshold)


def mask_of_pixels(pixels: Pixels, alpha_threshold: float = HALF) -> TracedMask:
    """Region of decoded RGBA pixels.

    >>> pixels = np.full((20, 20, 4), 255, np.uint8); pixels[5:15, 5:15, :3] = 0
    >>> [round(side) for side in mask_of_pixels(pixels).region.bounds]
    [5, 5, 15, 15]
    """
    rows, columns = pixels.shape[:2]
    if min(rows, columns) < SMALLEST_SIDE_PX:
        raise UnfitError(
            f"has only {columns} x {rows} pixels; a mask needs at least "
            f"{SMALLEST_SIDE_PX} on each side, better some hundreds"
        )
    solid = solidity(pixels)
    inside = solid * np.asarray(1.0 - pixels[:, :, :3] @ np.array(_LUMINANCE) / 255.0)
    by_alpha = decides(solid, LEAST_CLEAR_OF_MASK)
    if by_alpha or (inside.max() < 0.5 and solid.min() < 0.5):
        inside, by_alpha = raised(without_enclosed_white(pixels, solid), alpha_threshold), True
        tell_what_is_faint(solid, alpha_threshold)
    if inside.max() < 0.5:
        raise UnfitError(
            "is all light, and dark is inside; paint the region to fill black on white"
        )
    mask = mask_of_shares(inside)
    _tell(inside, mask.region.area / inside.size, by_alpha=by_alpha)
    return mask


def mask_of_shares(inside: FloatArray) -> TracedMask:
    """Region of ``(rows, columns)`` shares of pixels that are inside, some half or more.

    >>> shares = np.zeros((20, 20)); shares[5:15, 5:15] = 1
    >>> [round(side) for side in mask_of_shares(shares).region.bounds]
    [5, 5, 15, 15]
    """
    rows, columns = inside.shape
    region = clean_union(outline_of_coverage(inside), speck=SPECK)
    return TracedMask(region, float(columns), float(rows))


def _tell(inside: FloatArray, share: float, *, by_alpha: bool) -> None:
    """Notice what was probably not meant as a mask, or not so."""
    if not by_alpha and looks_photographic(inside):
        notice(
            "looks like a photograph, of which the dark parts are filled; to place items round "
            "what it shows use around:IMAGE, to fill a shape give its black silhouette on white"
        )
    elif share > NEARLY_ALL:
        tell_if_full(share, _WHY_FULL[by_alpha])
    elif not by_alpha and min(side.min() for side in (inside[[0, -1]], inside[:, [0, -1]])) > 0.5:
        notice(
            "is dark all along its edge, and dark is inside; if the light shape is to be filled, "
            "invert the picture"
        )
