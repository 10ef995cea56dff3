"""Resolution of photographs and pictures where they lie, and how large that lets them be."""

from __future__ import annotations

import base64
import logging
import xml.etree.ElementTree as ET
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from packwork.arrays import FloatArray
from packwork.errors import RecipeError
from packwork.geometry import affine
from packwork.phrasing import enumerated, number_of
from packwork.pipeline.job import Job
from packwork.readers.svg_syntax.coordinates import parse_transform
from packwork.scene.item import Art, PhotoArt, PictureArt, VectorArt
from packwork.scene.layout import Layout
from packwork.scene.recolour import XLINK, tree_of
from packwork.units import convert
from packwork.writers.pictures import DPI

_LOG = logging.getLogger("packwork")

ROUNDING = 1e-3
"""Share by which a photo may miss what is asked: sizes are rounded, pixels are not. Chosen."""

SIDES = ("width", "height")

MOST_NAMED = 5
"""Photos that a line names; a report has them all. Chosen."""


@dataclass(frozen=True)
class PhotoPixels:
    """A raster of a layout, and its own pixels to the inch of the canvas, however it is drawn."""

    photo: str
    ppi: float


def photo_pixels(layout: Layout) -> tuple[PhotoPixels, ...]:
    """Pixels to the inch of all photos and pictures of a layout, in its order.

    Drawings with pictures in them count by the coarsest of these; the picture behind comes last.
    """
    inch = convert(1.0, "in", layout.container.unit)
    scales = layout.poses.axis_scales.max(axis=1).tolist()
    sides: dict[Art, float] = {}
    found: list[PhotoPixels] = []
    for item, scale in zip(layout.items, scales, strict=True):
        if item.art not in sides:
            sides[item.art] = pixel_side(item.art)
        if side := scale * sides[item.art]:
            found.append(PhotoPixels(item.name, round(inch / side, 2)))
    behind = layout.container.backdrop
    if behind is not None:
        side = _stretch(behind.matrix)
        found.append(PhotoPixels(layout.container.name, round(inch / side, 2)))
    return tuple(found)


def pixel_side(art: Art) -> float:
    """Side of the largest pixel that an art has, in units of its item; 0 if it has none.

    Examples
    --------
    >>> pixel_side(PictureArt(b"", 5, 4, 3 * np.eye(2, 3)))
    3.0
    """
    if isinstance(art, PhotoArt):
        return 1.0
    if isinstance(art, PictureArt):
        return _stretch(art.matrix)
    if isinstance(art, VectorArt) and "<image" in art.markup:
        return _embedded_side(tree_of(art.markup), art.matrix)
    return 0.0


def _stretch(matrix: FloatArray) -> float:
    """Longest that a unit becomes."""
    return float(np.linalg.norm(matrix[:, :2], 2))


def _embedded_side(element: ET.Element, outer: FloatArray) -> float:
    """Side of the largest pixel of the pictures in an element."""
    matrix = affine.compose(outer, parse_transform(element.get("transform")))
    inner = (_embedded_side(child, matrix) for child in element)
    return max([_own_side(element) * _stretch(matrix), *inner])


def _own_side(element: ET.Element) -> float:
    """Side of a pixel of an ``image``, in its own units; 0 if it is none that can be opened."""
    href = element.get(f"{{{XLINK}}}href") or element.get("href") or ""
    if element.tag != "image" or not href.startswith("data:"):
        return 0.0
    # Only drawings with pictures in them load the picture library.
    from packwork.readers.pictures.decode import picture_size

    size = picture_size(base64.b64decode(href.partition(",")[2]))
    if size is None:
        return 0.0
    sides = [float(element.get(key, "0")) / px for key, px in zip(SIDES, size, strict=True)]
    fit = element.get("preserveAspectRatio", "")
    return max(sides) if "none" in fit or "slice" in fit else min(sides)


def coarser(photos: Sequence[PhotoPixels], ppi: float) -> list[PhotoPixels]:
    """Of photos that have fewer pixels to the inch, each name once, the coarsest first.

    Examples
    --------
    >>> [one.photo for one in coarser([PhotoPixels("a", 90), PhotoPixels("b", 300)], 300)]
    ['a']
    """
    coarsest: dict[str, PhotoPixels] = {}
    for one in sorted(photos, key=lambda one: one.ppi):
        if one.ppi < (1 - ROUNDING) * ppi:
            coarsest.setdefault(one.photo, one)
    return list(coarsest.values())


def coarse_photos(layout: Layout, dpi: float | None, is_bounded: bool = False) -> list[str]:
    """Photos and pictures that have fewer pixels than paper is to show, in a sentence; or nothing.

    Parameters
    ----------
    dpi
        What was asked of the files; None leaves it to what printers like, and asks nothing of a
        canvas in px, which is for screens.
    """
    if dpi is None and layout.container.unit == "px":
        return []
    asked = dpi or DPI
    photos = photo_pixels(layout)
    short = coarser(photos, asked)
    if not short:
        return []
    named = enumerated([f"{one.photo} ({one.ppi:.0f})" for one in short], MOST_NAMED)
    kinds = len({one.photo for one in photos})
    remedy = "--least-dpi N keeps such smaller" if is_bounded else "files of more pixels would do"
    many = number_of(kinds, "picture has", "pictures have")
    return [f"{len(short)} of {many} fewer than {asked:g} pixels to the inch: {named}; {remedy}"]


def tell_coarse(layout: Layout, dpi: float | None) -> None:
    """Log what :func:`coarse_photos` says of a layout that is written."""
    for sentence in coarse_photos(layout, dpi):
        _LOG.warning("%s", sentence)


def largest_scales(job: Job) -> FloatArray:
    """``(n,)`` scales beyond which photos would have fewer pixels than ``least_dpi`` asks.

    Infinite for what is no photo, and for photos whose size is given.
    """
    least = job.plan.least_dpi
    if least is None:
        return np.full(len(job.items), np.inf)
    if job.plan.sizes != "free":
        raise RecipeError(
            "least_dpi", f"bounds free sizes, not {job.plan.sizes} ones; use --sizes free"
        )
    most = convert(1.0, "in", job.container.unit) / least
    sides = [pixel_side(item.art) for item in job.items]
    return np.array(
        [
            most / side if side and "size" not in one.pin else np.inf
            for side, one in zip(sides, job.asked, strict=True)
        ]
    )
