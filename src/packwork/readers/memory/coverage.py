"""Arrays and pictures in memory: to the bytes of a picture file, or to shares of pixels."""

from __future__ import annotations

from dataclasses import dataclass
from io import BytesIO
from typing import Any

import numpy as np
from PIL import Image, ImageOps

from packwork.arrays import FloatArray
from packwork.readers.pictures.decode import MAX_PIXELS, MAX_SIDE_PX, eight_bit
from packwork.readers.reading import UnfitError

_KEPT_MODES = {"1", "L", "LA", "P", "RGB", "RGBA", "I;16"}
_FORMS = "give (rows, columns), or (rows, columns, 3 or 4) of colours"


@dataclass(frozen=True, eq=False)
class CoverageArray:
    """Share of each pixel that is inside.

    Parameters
    ----------
    shares
        ``[row, col]``, 0 to 1.
    """

    name: str
    shares: FloatArray


def coverage_of_array(array: Any, name: str) -> CoverageArray | bytes:
    r"""Coverage of an array of bools or floats; of one of whole numbers, a picture file.

    True, and 1.0, is inside. Whole numbers from 0 to 255 are grey or colours, as in a picture
    file, where dark is inside; if all of them are 0 or 1, they are bools.

    Raises
    ------
    UnfitError
        If its shape or its numbers are those of no picture.

    Examples
    --------
    >>> float(coverage_of_array(np.ones((9, 9), bool), "all").shares.mean())
    1.0
    >>> coverage_of_array(np.full((9, 9, 3), 99, np.uint8), "grey")[:4]
    b'\x89PNG'
    """
    values = np.asarray(array)
    if values.ndim == 3 and values.shape[2] == 1:
        values = values[:, :, 0]
    _check_array(values)
    is_whole = values.dtype.kind in "iu"
    low, high = values.min(), values.max()
    if is_whole and high > 1 and 0 <= low <= high <= 255:
        return png_of_picture(Image.fromarray(values.astype(np.uint8)))
    if not (0 <= low <= high <= 1):
        raise UnfitError(
            f"has numbers from {low:g} to {high:g}; give bools, shares from 0 to 1 (1 is inside), "
            "or whole numbers from 0 to 255 (dark is inside)"
        )
    if values.ndim == 3:
        return png_of_picture(Image.fromarray(np.round(values * 255.0).astype(np.uint8)))
    return CoverageArray(name, values.astype(np.float64))


def picture_of_array(array: Any) -> Image.Image:
    """Picture of an array of light or colours: shares from 0 to 1, or whole numbers to 255.

    Raises
    ------
    UnfitError
        If its shape or its numbers are those of no picture.

    Examples
    --------
    >>> picture_of_array(np.ones((2, 3))).size
    (3, 2)
    """
    values = np.asarray(array)
    if values.ndim == 3 and values.shape[2] == 1:
        values = values[:, :, 0]
    _check_array(values)
    low, high = values.min(), values.max()
    most = 255 if values.dtype.kind in "iu" else 1
    if not (0 <= low <= high <= most):
        raise UnfitError(
            f"has numbers from {low:g} to {high:g}; give shares from 0 to 1 (1 is light), or whole "
            "numbers from 0 to 255"
        )
    return Image.fromarray(np.round(values * (255.0 / most)).astype(np.uint8))


def png_of_picture(picture: Image.Image) -> bytes:
    r"""PNG file of a picture, turned upright as files are.

    Raises
    ------
    UnfitError
        If it has too many pixels, or they cannot be had.

    Examples
    --------
    >>> png_of_picture(Image.new("CMYK", (3, 2)))[:4]
    b'\x89PNG'
    """
    _check_size(picture.height, picture.width)
    file = BytesIO()
    try:
        upright = ImageOps.exif_transpose(picture)
        kept = upright if upright.mode in _KEPT_MODES else eight_bit(upright)
        kept.save(file, "PNG", compress_level=1)
    except (OSError, ValueError, SyntaxError, Image.DecompressionBombError) as error:
        reason = " ".join(str(error).split())[:120] or type(error).__name__
        raise UnfitError(f"is a broken picture ({reason}); load it again") from None
    return file.getvalue()


def _check_array(values: np.ndarray[Any, Any]) -> None:
    if values.ndim not in {2, 3} or (values.ndim == 3 and values.shape[2] not in {3, 4}):
        raise UnfitError(f"is an array of shape {values.shape}; {_FORMS}")
    if values.dtype.kind not in "biuf":
        raise UnfitError(f"is an array of {values.dtype}; give bools, floats or whole numbers")
    _check_size(*values.shape[:2])
    if values.dtype.kind == "f" and not np.isfinite(values).all():
        raise UnfitError("holds numbers that are NaN or infinite; replace them by 0 or 1")


def _check_size(rows: int, columns: int) -> None:
    if rows * columns == 0:
        raise UnfitError(f"has {columns} x {rows} pixels; give some")
    if rows * columns > MAX_PIXELS or max(rows, columns) > MAX_SIDE_PX:
        raise UnfitError(
            f"has {columns} x {rows} pixels; {MAX_PIXELS // 1_000_000} million and "
            f"{MAX_SIDE_PX:,} on a side are the most, so scale it down"
        )
