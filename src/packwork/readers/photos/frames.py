"""Crop of a photo: the part that is shown, and its region."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import shapely

from packwork.geometry import affine
from packwork.geometry.overlay import buffered
from packwork.geometry.polygon import Region
from packwork.readers.options import HALF
from packwork.readers.photos.options import PhotoOptions
from packwork.readers.pictures.developing import Negative, Window, developed
from packwork.readers.pictures.silhouette import outline_of_cut_out
from packwork.readers.pictures.transparency import solidity, tell_what_is_faint

CUT_OUT_PX = 800
"""Longer side at which the outline of a cut-out is traced. Larger traces finer and gives the
outline more points. Chosen."""

CORNER_SEGMENTS = 16
"""Chords of a quarter circle, of borders and rounded corners. More: longer runs; these lie
within a thousandth of the radius. Chosen."""

MITRE = 10.0
"""How far a border reaches beyond a sharp corner, in widths. Larger than that of any
right angle, so that prints keep their corners."""


@dataclass(frozen=True, eq=False)
class PhotoCrop:
    """What of a photo is shown, in its upright pixels.

    Parameters
    ----------
    window
        The part of the photo.
    picture
        What is seen of the photo.
    whole
        The same with its border.
    is_cut
        Whether the picture is less than its window: shaped, or clear in places.
    """

    window: Window
    picture: Region
    whole: Region
    is_cut: bool


def framed(
    data: bytes,
    negative: Negative,
    options: PhotoOptions,
    threshold: float = HALF,
    shape: Region | None = None,
) -> PhotoCrop:
    """Frame of a photo: its rectangle, its cut-out, or the largest shape in its middle.

    Parameters
    ----------
    threshold
        Opacity from which a cut-out's pixel is inside, as a share of the most opaque one's.
    shape
        Region that the photo is cut to, of any size.

    Raises
    ------
    UnfitError
        If a cut-out shows nothing.
    """
    width, height = negative.width, negative.height
    full = (0.0, 0.0, float(width), float(height))
    shorter = min(width, height)
    if options.rounding:
        window, picture = full, _rounded(full, options.rounding * shorter)
    elif shape is not None:
        window, picture = _shaped(shape, full)
    elif negative.has_alpha:
        window, picture = full, _cut_out(data, negative, threshold)
    else:
        window, picture = full, shapely.box(*full)
    is_cut = picture.area < (1 - 1e-9) * shapely.box(*window).area
    return PhotoCrop(window, picture, _bordered(picture, options.border_share * shorter), is_cut)


def _rounded(full: Window, radius: float) -> Region:
    """A rectangle with round corners; half the shorter side as radius makes a pill."""
    left, top, right, bottom = full
    xs, ys = (left + radius, right - radius), (top + radius, bottom - radius)
    middles = shapely.multipoints([(x, y) for x in xs for y in ys])
    return buffered(middles.convex_hull, radius, quad_segs=CORNER_SEGMENTS)


def _shaped(shape: Region, full: Window) -> tuple[Window, Region]:
    """The largest copy of a shape in the middle of a photo, and the box about it."""
    left, top, right, bottom = shape.bounds
    scale = min(full[2] / (right - left), full[3] / (bottom - top))
    middle = full[2] / 2 - scale * (left + right) / 2, full[3] / 2 - scale * (top + bottom) / 2
    place = affine.similarity(*middle, 0.0, scale)
    placed = shapely.transform(shape, lambda points: affine.apply(place, points))
    x0, y0, x1, y1 = placed.bounds
    return (max(x0, 0.0), max(y0, 0.0), min(x1, full[2]), min(y1, full[3])), placed


def _cut_out(data: bytes, negative: Negative, threshold: float) -> Region:
    """What is not clear of a photo."""
    scale = min(1.0, CUT_OUT_PX / max(negative.width, negative.height))
    size = max(1, round(negative.width * scale)), max(1, round(negative.height * scale))
    full = (0.0, 0.0, float(negative.width), float(negative.height))
    pixels = np.asarray(developed(data, full, size))
    tell_what_is_faint(solidity(pixels), threshold)
    traced = outline_of_cut_out(pixels, threshold)
    ratio = np.array([negative.width / size[0], negative.height / size[1]])
    return shapely.transform(traced, lambda points: points * ratio)


def _bordered(picture: Region, width: float) -> Region:
    """Region with a border round it; corners stay corners, as those of prints do."""
    if width == 0:
        return picture
    is_box = picture.area > (1 - 1e-9) * shapely.box(*picture.bounds).area
    join = "mitre" if is_box else "round"
    return buffered(picture, width, quad_segs=CORNER_SEGMENTS, join_style=join, mitre_limit=MITRE)
